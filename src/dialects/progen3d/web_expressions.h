// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions of the web language as nodes. `rand(v)` draws a variable anew while it is read: the
// draw becomes a step before the statement, and what is read of the variable besides is held in
// attributes of its own, so that the order from left to right counts.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "dialects/progen3d/names.h"
#include "dialects/progen3d/nodes.h"
#include "dialects/progen3d/web_grammar.h"
#include "dialects/progen3d/web_uses.h"

namespace gable::progen3d::web {

/// Where the range of a variable is kept that is drawn anew; of whole ones, one beyond the most.
inline std::string leastOf(std::string_view name) { return std::string(name) + "_least"; }
inline std::string mostOf(std::string_view name) { return std::string(name) + "_most"; }

class Expressions {
 public:
  Expressions(const Grammar& grammar, Builder& builder, const Names& names, const Uses& uses,
              Diagnostics& diagnostics)
      : g_(grammar), b_(builder), names_(names), uses_(uses), diagnostics_(diagnostics) {}

  NodeId value(uint32_t id);
  /// True or false: a comparison, or whether a number is not 0.
  NodeId condition(uint32_t id);
  /// The value where it has no names and draws; `known` becomes false for others.
  double constant(uint32_t id, bool& known) const;
  Span spanOf(uint32_t id) const { return g_.expressions[id].span; }
  /// 0 where b is 0.
  NodeId quotient(NodeId a, NodeId b, Span at);
  /// A value that can be read several times in this statement.
  std::string hold(NodeId value, Span at);

  /// The steps of R name ( min max ) and R name.
  Nodes draw(const Statement& s);

  void enterRule();
  void enterStatement(const Statement& s);
  /// The steps that must stand before what was made since; none are left.
  Nodes takeBefore() { return std::exchange(before_, {}); }
  /// What a bracket draws ends with it.
  void leaveBracket(const Sequence& body);
  /// Outside of turns their index is 0.
  void inTurns(bool yes);
  bool readsTurn() const { return readsTurn_; }

  /// How many attributes are needed to hold values.
  size_t held() const { return mostHeld_; }
  std::string heldName(size_t k) const;
  /// The functions that the nodes call.
  void declareHelpers(Nodes& declarations, Span at);

 private:
  NodeId name(const Expression& e);
  NodeId function(const Expression& e);
  NodeId rand(const Expression& e);
  NodeId set(const std::string& written, NodeId value, Span at);
  NodeId anew(std::string_view variable, Span at);
  NodeId read(std::string_view variable, Span at);
  void countReads(uint32_t id);
  void unknownVariable(std::string_view name, Span at);
  // Of a variable that the statement draws and reads besides.
  bool mustHold(std::string_view variable) const;

  const Grammar& g_;
  Builder& b_;
  const Names& names_;
  const Uses& uses_;
  Diagnostics& diagnostics_;
  Nodes before_;
  bool inStatement_ = false, inTurns_ = false, readsTurn_ = false;
  bool divides_ = false, asksTruth_ = false, truncates_ = false;
  size_t held_ = 0, mostHeld_ = 0;
  std::map<std::string_view, int> reads_;
  std::set<std::string_view> rolled_, lost_, unknown_;
};

}  // namespace gable::progen3d::web
