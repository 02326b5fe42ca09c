// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a grammar of the web language declares, reads and calls.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/progen3d/web_grammar.h"

namespace gable::progen3d::web {

/// The turn of the rule that runs.
inline bool isTurnIndex(std::string_view name) { return name == "ri" || name == "repeatIndex"; }
/// pi and e, whatever else has the name.
inline bool isConstant(std::string_view name) {
  return name == "pi" || name == "PI" || name == "e" || name == "E";
}

/// A variable that some `R` draws.
struct Drawn {
  /// `R*` draws it first.
  bool whole = false;
  /// Some `R` of the other kind draws it as well.
  bool ofBothKinds = false;
  /// It is drawn anew from the range that it was drawn from last.
  bool redrawn = false;
  Span span;
};

class Uses {
 public:
  explicit Uses(const Grammar& grammar);

  /// By name, in the order of names.
  const std::map<std::string_view, Drawn>& drawn() const { return drawn_; }
  bool isDrawn(std::string_view name) const { return drawn_.count(name) > 0; }
  bool isParameter(std::string_view name) const { return parameters_.count(name) > 0; }
  const std::set<std::string_view>& parameters() const { return parameters_; }
  /// Some DSX ... DTZ stands in it.
  bool hasSides() const { return hasSides_; }
  bool isCalled(std::string_view rule) const { return called_.count(rule) > 0; }
  bool isReachable(std::string_view rule) const { return reachable_.count(rule) > 0; }

 private:
  void read(const Sequence& sequence, std::set<std::string_view>& calls);
  void read(uint32_t expression);
  void reach(const std::map<std::string_view, std::set<std::string_view>>& calls);

  const Grammar& g_;
  bool hasSides_ = false;
  std::map<std::string_view, Drawn> drawn_;
  std::set<std::string_view> parameters_, called_, reachable_, redrawn_;
};

/// Whether the sequence draws the variables itself, wherever in it; those are added.
void drawnIn(const Sequence& sequence, std::set<std::string_view>& names);

}  // namespace gable::progen3d::web
