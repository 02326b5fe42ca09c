// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Points of a region: its middle, and discs scattered in it. Plan coordinates, metres.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct Disc {
  Vec2 centre;
  double radius = 0;
};

/// The centre of mass; it may lie outside.
Vec2 centroid(const Polygon& p);
bool isConvex(const Polygon& p);

/// The pole of inaccessibility: the disc in the polygon whose radius is within 1 % (and one
/// millimetre) of the largest. By a search over squares that are divided, the most promising first;
/// O(n) a square.
Disc poleOf(const Polygon& p);

/// What rules call the middle: the centre of mass of a convex region, the pole of any other.
Vec2 middleOf(const Polygon& p);

struct ScatterOptions {
  uint32_t count = 1;
  double least = 0, most = 0;
  /// Kept free between discs, and between discs and the boundary.
  double gap = 0, edge = 0;
  uint64_t seed = 0;
};

/// Discs that neither touch each other nor the boundary, in the order in which they were drawn.
/// Radii are drawn first and placed largest first: sixty tries for each, then with a radius nearer
/// to the least, until none fits; so there may be fewer. O(count * (tries * n + count)).
std::vector<Disc> scatterDiscs(const Polygon& p, const ScatterOptions& options);

/// Points no nearer to each other than `distance`, as many as fit by dart throwing around those
/// found before (Bridson 2007), at most `most` of them.
std::vector<Vec2> scatterPoisson(const Polygon& p, double distance, double edge, size_t most,
                                 uint64_t seed);

}  // namespace gable
