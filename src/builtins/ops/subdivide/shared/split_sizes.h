// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How a length is divided by the pattern of a split block.
//
// Promises
//  1. Absolute sizes are kept, ' sizes are shares of the whole length, ~ sizes share what is left
//  in
//     the proportion of their weights.
//  2. A repeated group is repeated a whole number of times where the pattern has a ~ size to take
//  up
//     the difference: the number that stretches the ~ sizes least. Without one it is repeated as
//     often as it fits, and the last repetition is cut.
//  3. What lies beyond the length is cut or never made; a size of zero or less makes nothing.
//  4. Repetitions of one element have bit-equal sizes, so that their shapes can be shared.
//  5. The work is bounded: more than kMaxSplitPieces pieces, or a repetition that never ends, is a
//     failure before anything is made.
#pragma once

#include <cstdint>

#include "base/small_buffer.h"
#include "base/status.h"
#include "shape/op_call.h"

namespace gable {

/// The most shapes that one split may make, as the original's derivation width.
constexpr uint32_t kMaxSplitPieces = 100000;

using SplitPieces = SmallBuffer<SplitPiece, 48>;

/// The pieces as seen from the other end: the first lies there. Sizes and order stay.
void mirrorPieces(SplitPieces& pieces, double whole);

/// How much longer than `whole` the absolute and relative sizes of an unrepeated pattern are;
/// nothing above zero when they fit or when some are repeated.
double overflowOf(const SplitBlock& block, double whole);

/// Divides [0, whole]; pieces come in order and do not overlap. O(items + pieces).
/// Failures: split-size-number, split-endless, split-too-many.
Status dividePattern(const SplitBlock& block, double whole, SplitPieces& out);

}  // namespace gable
