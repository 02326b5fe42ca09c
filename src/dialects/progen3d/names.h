// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The names of a grammar as names of the language: other signs become '_', and names that mean
// something else there (keywords, operations, selector words) get a '_' behind them, as do those
// that would fall together.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/progen3d/grammar.h"
#include "program/spec.h"

namespace gable::progen3d {

class Names {
 public:
  Names(const Grammar& grammar, const Catalogue& catalogue);
  Names(const std::vector<std::string>& rules, const std::vector<std::string>& values,
        const Catalogue& catalogue);

  std::string rule(std::string_view name) const { return rules_.at(std::string(name)); }
  /// Of a variable, or of the count of a rule's turns.
  std::string value(std::string_view name) const { return values_.at(std::string(name)); }
  /// A name of ours that no variable has.
  std::string function(std::string_view name) const;
  std::string startRule() const;

 private:
  std::map<std::string, std::string> rules_, values_;
  std::set<std::string> ruleNames_, valueNames_;
};

}  // namespace gable::progen3d
