// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Reach: the code that a rule is made of, itself and all that it calls or asks, as one number.
// Where it is equal in two programs, a call of the rule on the same shape does the same in both,
// however the text around has changed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "program/program.h"

namespace gable {

struct Reach {
  /// Of instructions with their operands' content and their addresses for randomness; places in the
  /// text do not count. Comparable between programs that share a ValuePool.
  uint64_t code = 0;
  /// Sorted indices of Program::attributes that are read on the way, initialisers included.
  std::vector<uint32_t> attributes;
  /// Whether any are set on the way, for a shape or for a block.
  bool setsAttributes = false;
};

/// The reaches of a program, which reads its code once. The program must outlive it.
class Reaches {
 public:
  explicit Reaches(const Program& program);
  ~Reaches();
  Reaches(const Reaches&) = delete;
  Reaches& operator=(const Reaches&) = delete;

  /// By rule of the program. O(code + calls + rules * attributes).
  std::vector<Reach> all() const;
  /// What the rules `roots` do where rules that have none of the effects, nor lead to any that has,
  /// are left out, as in the pass that finds out who asks for room; within operations that gather
  /// nothing is left out. The values that attributes start with count where something reads them.
  /// Places in the text count for operations that ask for room, which are told by them.
  Reach within(std::span<const uint32_t> roots, uint32_t effects) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace gable
