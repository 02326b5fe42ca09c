// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the rules of a grammar call and read, with all that they lead to.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/progen3d/grammar.h"

namespace gable::progen3d {

class Uses {
 public:
  /// O(calls x rules) at worst.
  explicit Uses(const Grammar& grammar);

  bool calledByAny(std::string_view rule) const { return of(rule).called; }
  /// Some way leads to it from the start.
  bool isReachable(std::string_view rule) const { return of(rule).reachable; }
  /// It or a rule that leads to it draws the variable in its head.
  bool mayBind(std::string_view rule, std::string_view variable) const;
  /// Something in it or below is drawn or chosen.
  bool isRandom(std::string_view rule) const { return of(rule).random; }
  /// About how many bodies it leaves with all it calls.
  double bodies(std::string_view rule) const { return of(rule).bodies; }
  /// Some expression reads this name.
  bool readsName(const std::string& name) const { return names_.count(name) > 0; }

 private:
  struct Entry {
    std::vector<size_t> calls;
    std::set<std::string_view> bound;
    bool called = false, reachable = false, random = false;
    double own = 0, turns = 1, bodies = 0;
  };
  const Entry& of(std::string_view rule) const;
  void readCalls(size_t rule);
  void spread();

  const Grammar& g_;
  std::vector<Entry> entries_;
  std::set<std::string> names_;
};

}  // namespace gable::progen3d
