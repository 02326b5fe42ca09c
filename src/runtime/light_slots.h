// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LightSlots: which slots of split blocks are light: their parts become leaves in a few plain
// steps, or go, or are divided once more. It follows from the program alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/small_buffer.h"
#include "program/program.h"

namespace gable {

struct LightSlot {
  bool light = false;
  /// The shared rule that takes the parts as they are, if it sees neither their number nor their
  /// place; null else.
  const RuleCode* taker = nullptr;
  /// NIL: the parts go.
  bool drop = false;
  /// The last rule called works in a frame of its own, and so do the steps.
  bool boundary = false;
  /// The leaf has a name without a rule.
  bool named = false;
  /// Rules called on the way, and the one whose code comes last.
  uint8_t calls = 0;
  /// What a part counts as: each call is a shape, and so is a leaf or an end that belongs to none.
  uint32_t shapes = 0;
  /// And what it counts as work, so that the way in which it is made does not tell.
  uint32_t work = 0;
  uint32_t rule = 0;
  /// The block of the split at the end, plus 1; 0 for a leaf.
  uint32_t block = 0;
  /// Of the leaf.
  StringId name = 0;
  uint32_t source = 0;
  struct Step {
    bool (*apply)(LightPart&, const void* arguments);
    alignas(std::max_align_t) std::byte arguments[LightOp::kRoom];
  };
  SmallBuffer<Step, 4> steps;
};

class LightSlots {
 public:
  /// `flat`: leaves are placed in the world at once. Must outlive the slots.
  LightSlots(const Program& program, bool flat)
      : program_(program), flat_(flat), slots_(program.blocks.size()) {}

  /// By slot of a block, which belongs to a rule.
  const std::vector<LightSlot>& of(uint32_t block, uint32_t rule) {
    std::vector<LightSlot>& slots = slots_[block];
    if (slots.empty()) fill(slots, block, rule);
    return slots;
  }

 private:
  void fill(std::vector<LightSlot>& slots, uint32_t block, uint32_t rule) const;
  LightSlot slotAt(uint32_t rule, uint32_t entry) const;
  const RuleCode* takerAt(const Instruction& at) const;
  bool isPlainSplit(const Instruction& at) const;
  bool addStep(LightSlot& slot, const Instruction& at) const;
  bool addCall(LightSlot& slot, const Instruction& at) const;

  const Program& program_;
  const bool flat_;
  std::vector<std::vector<LightSlot>> slots_;
};

}  // namespace gable
