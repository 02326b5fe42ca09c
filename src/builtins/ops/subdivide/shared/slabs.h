// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From the pieces of a divided length to the child shapes that lie there.
#pragma once

#include <vector>

#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "shape/op_call.h"

namespace gable {

/// The borders between pieces and beside gaps, ascending, and for each piece the slab (between two
/// borders) that it is.
struct Cuts {
  std::vector<double> at;
  std::vector<size_t> slab;
};

/// Of pieces of [0, whole] in order from either end; borders are given from `from` on.
Cuts cutsOf(const SplitPieces& pieces, double from, double whole);

/// The child as one of the pieces of its split.
Shape numbered(Shape child, size_t index, size_t total);

/// Cuts the shape's mesh along a scope axis and gives out the pieces, whose sizes are lengths along
/// it. Pieces without geometry are not given out. With `adjust` scopes are fitted to their
/// geometry; with `cap` solids are closed.
void emitSlabs(OpCall& call, Axis axis, const SplitPieces& pieces, bool adjust, bool cap);

}  // namespace gable
