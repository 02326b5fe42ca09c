// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// InPlace: what changes the present shape in passing, without a child: rules run in place (do),
// loops (repeat), and blocks of local values (local). Each is a frame on one stack for all
// activations, and what it began is undone when it ends. An activation that ends early drops the
// frames that it opened with cut().
//
// A rule run in place, and each turn of a loop, has an address of its own for random numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/activation.h"
#include "runtime/local_values.h"

namespace gable {

class InPlace {
 public:
  enum class Kind : uint8_t { Rule, Loop, Locals };

  /// `locals` must outlive the frames.
  explicit InPlace(LocalValues& locals) : locals_(locals) {}

  /// Forgets all frames. `rules`: so many rules are in place already, around a portion.
  void begin(uint32_t rules);
  uint32_t size() const { return static_cast<uint32_t>(frames_.size()); }
  /// Drops the frames after the first `count`, without their ends.
  void cut(uint32_t count) {
    if (frames_.size() > count) frames_.resize(count);
  }
  /// Of the innermost frame; there must be one.
  Kind innermost() const { return frames_.back().kind; }
  /// How many rules run in place, counted to the first `count` frames.
  uint32_t rulesIn(uint32_t count) const { return count > 0 ? frames_[count - 1].rules : around_; }
  uint32_t rules() const { return rulesIn(size()); }

  /// Where the code goes on behind a rule, and what the value stack is cut to.
  struct Return {
    const Instruction* pc = nullptr;
    uint32_t stackBase = 0;
  };
  /// Makes the activation run another rule, whose arguments begin at `back.stackBase`. `site`: the
  /// address of the call.
  void beginRule(Activation& a, const RuleCode& code, uint32_t rule, uint64_t site,
                 const Return& back);
  /// The activation runs the rule around again.
  Return endRule(Activation& a);

  /// `site`: the address of the loop.
  void beginLoop(Shape& s, uint32_t turns, uint64_t site);
  /// The next turn of the innermost loop. False when there is none: then the loop has ended.
  bool nextTurn(Shape& s);
  /// The turn at work, counted from 0.
  uint32_t turn() const { return frames_.back().turn; }
  void endLoop(Shape& s);

  void beginLocals(const Shape& s);
  void endLocals(Shape& s);

 private:
  struct Frame {
    Kind kind = Kind::Rule;
    /// The previous scope of the rule around is kept in previous_, at this place.
    bool keepsPrevious = false;
    uint32_t previous = 0;
    /// Rules in place now, this one included.
    uint32_t rules = 0;
    // Rule: that around, and what goes on behind it.
    Return back;
    uint32_t parameters = 0, rule = 0;
    // Loop.
    uint32_t turn = 0, turns = 0;
    IndexInfo split;
    // Locals: the values of the block around.
    uint32_t locals = 0, localCount = 0;
    /// Rule and Loop: the address of the shape before. Loop: that of the loop.
    uint64_t path = 0, loopPath = 0;
  };
  Frame& open(Kind kind);

  LocalValues& locals_;
  std::vector<Frame> frames_;
  std::vector<PreviousScope> previous_;
  uint32_t around_ = 0;
};

}  // namespace gable
