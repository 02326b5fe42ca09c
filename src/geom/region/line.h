// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Cutting a polygon by a line, or into strips between parallel lines. Plan coordinates, metres.
//
// Promises:
//   1. The pieces of all strips make up the polygon; their rings are oriented as Polygon says and
//      start next to where the input's first ring starts.
//   2. Pieces on both sides of a line share exactly the same points on it, and input points keep
//      their bits.
//   3. Each edge of a piece is a part of one input edge or lies on one line.
//   4. No piece has less than 1e-12 of its box's area; points within 1e-9 of the polygon's extent
//      from a line count as lying on it.
// The polygon must be valid (region/clean.h); of others some pieces are given. O(n log n) a line.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct StripPiece {
  /// Edges that lie on line k have the origin kOnLine + k.
  static constexpr uint32_t kOnLine = 0x80000000;

  Polygon polygon;
  /// Strip 0 lies before the first line, strip k between line k - 1 and line k.
  uint32_t strip = 0;
  /// For each edge (outer ring, then holes) the input edge that it is a part of, counted through
  /// the outer ring and the holes, or the line.
  std::vector<uint32_t> edgeOrigin;
};

/// Lines are the points p with dot(normal, p) = offsets[k], ascending; normal need not be a unit
/// vector. Pieces come strip by strip.
std::vector<StripPiece> splitIntoStrips(const Polygon& p, Vec2 normal,
                                        std::span<const double> offsets);

/// By the line through `point` along `direction`: strip 0 is its left side, strip 1 its right.
std::vector<StripPiece> splitByLine(const Polygon& p, Vec2 point, Vec2 direction);
/// The left side only: the same pieces, in less time.
std::vector<StripPiece> leftOfLine(const Polygon& p, Vec2 point, Vec2 direction);

}  // namespace gable
