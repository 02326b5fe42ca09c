// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Places for rectangles on an area: each as near as possible to where it is wished, clear of the
// border and of each other. Plan coordinates, metres.
//
// Promises
//  1. What is placed lies within the area, `edge` from its border and `gap` from all others, up to
//     a tenth of a millimetre.
//  2. The largest are placed first, of equals the first, or all in the order given; none is moved
//     afterwards. A rectangle gets the place nearest to its wish that is free at its turn; only
//     from corner to corner a hundredth more than the gap may be kept. There is no place only where
//     there is none.
//  3. Equal input gives equal output.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct Footprint {
  /// Along its own x axis and square to it.
  double width = 1, depth = 1;
  /// Where its middle is to be.
  Vec2 wish;
  /// Of its x axis, degrees counter-clockwise.
  double angle = 0;

  /// The corners around a middle, counter-clockwise from the least x and y of its own axes.
  Ring at(Vec2 middle, double margin = 0) const;
};

struct ArrangedPlace {
  bool placed = false;
  Vec2 middle;
};

enum class ArrangeOrder : uint8_t { Largest, Given };

/// By footprint. Footprints of no size are never placed. `taken` is ground that is not free.
/// O(n^2 log n) for n footprints and the edges of the area together.
std::vector<ArrangedPlace> arrange(const Polygon& area, const std::vector<Footprint>& footprints,
                                   double gap, double edge, const Region& taken = {},
                                   ArrangeOrder order = ArrangeOrder::Largest);

/// A place in each cell of a grid of `distance`, moved from its middle by up to `jitter` of half
/// of the distance along both axes; those that are inside of the area and `edge` from its border.
/// At most `most`. Row by row from the least y.
std::vector<Vec2> scatterJittered(const Polygon& area, double distance, double jitter, double edge,
                                  size_t most, uint64_t seed);

}  // namespace gable
