// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What makes sweeps over thousands of edges fast: outlines are looked at box by box. A sweep costs
// edges times edges that stand side by side; box by box it costs a little more than its result.
// Grid coordinates: whole numbers, one unit the least distance of points in a result.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "geom/region/region.h"

namespace gable {

/// Shortens the ways that outlines make outside of a box. Every edge that reaches into the box
/// stays as it is, and how often outlines go round a place in the box too. The order of points
/// stays; outlines far from the box vanish. O(n).
void shortenOutside(std::vector<Ring>& rings, const Box2& box);

struct Operands {
  std::vector<Ring> a, b;
};

/// The part of a result within a box, as the rings of a valid region.
using WithinBox = std::function<std::vector<Ring>(const Operands&, const Box2&)>;
/// Whether a point is one of the input.
using IsInput = std::function<bool(Vec2)>;

/// Divides until a box has few edges, asks for the result in each, and puts the results together.
/// Points that stand on borders between boxes, and are none of the input's, are taken out again
/// where they lie on the line of their neighbours. False, and nothing given out, where the parts do
/// not fit together. O(n log n) where outlines do not lie on each other.
bool resultInTiles(Operands operands, const Box2& box, const WithinBox& within,
                   const IsInput& isInput, Region& out);

}  // namespace gable
