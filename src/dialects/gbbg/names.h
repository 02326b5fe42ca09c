// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From symbols to names of rules: a symbol keeps its name where Gable's language can have a rule of
// that name; else letters that cannot stand there become _, and a number or _ is added.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "program/spec.h"

namespace gable::gbbg {

class Names {
 public:
  explicit Names(const Catalogue& catalogue) : catalogue_(catalogue) {}

  /// The same name for the same symbol, different names for different symbols.
  const std::string& of(const std::string& symbol);
  /// A name that no symbol has so far.
  std::string fresh(const std::string& wanted);

 private:
  bool usable(const std::string& name) const;

  const Catalogue& catalogue_;
  std::map<std::string, std::string> given_;
  std::set<std::string> taken_;
};

}  // namespace gable::gbbg
