// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Reach: the code that a rule is made of, itself and all that it calls or asks, as one number.
// Where it is equal in two programs, a call of the rule on the same shape does the same in both,
// however the text around has changed.
#pragma once

#include <cstdint>
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

/// By rule of the program. O(code + calls + rules * attributes).
std::vector<Reach> reachOf(const Program& program);

}  // namespace gable
