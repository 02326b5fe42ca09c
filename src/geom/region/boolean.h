// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Booleans and offsets of regions, and the repair of what crosses itself. Plan coordinates, metres.
//
// Promises:
//   1. The result is valid in the sense of region/clean.h: outer rings counter-clockwise, holes
//      clockwise and nested; rings may touch in points.
//   2. New points lie on a grid of 2^-16 m whose origin is near the operands, so that map
//      coordinates of a million metres lose nothing; input points that survive keep their bits.
//   3. Equal input gives equal output: polygons and ring starts follow the order of the input
//      vertices they contain, what has none follows by coordinates.
//   4. Input may be any finite rings; each operand is taken as `repaired` would see it. Points that
//      are not finite make their ring vanish.
// What is thinner than the grid vanishes. O((n + k) log n) for k crossings, mostly.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

/// The grid of results, in metres.
constexpr double kRegionGrid = 0x1.0p-16;

enum class BooleanOp : uint8_t { Union, Intersection, Difference, SymmetricDifference };

Region combine(BooleanOp op, const Region& a, const Region& b);

inline Region unite(const Region& a, const Region& b) { return combine(BooleanOp::Union, a, b); }
inline Region intersect(const Region& a, const Region& b) {
  return combine(BooleanOp::Intersection, a, b);
}
inline Region subtract(const Region& a, const Region& b) {
  return combine(BooleanOp::Difference, a, b);
}

enum class FillRule : uint8_t { NonZero, EvenOdd, Positive };

/// The area that rings of any kind enclose, as a valid region.
Region repaired(const std::vector<Ring>& rings, FillRule rule);

enum class OffsetJoin : uint8_t { Miter, Round, Square };

struct OffsetOptions {
  OffsetJoin join = OffsetJoin::Miter;
  /// How far a miter may reach, in multiples of the distance; beyond it the corner is cut square.
  double miterLimit = 10;
  /// The chord error of round joins, in metres.
  double roundError = 0.005;
};

/// Moves the boundary outward by `distance` (inward where negative): what vanishes is left out, so
/// the result may be empty.
Region offset(const Region& r, double distance, const OffsetOptions& options = {});

/// A band along an open line: all points within `distance` of it, with butt, square or round ends
/// by the join (Miter: butt).
Region thicken(const std::vector<Vec2>& line, double distance, const OffsetOptions& options = {});

}  // namespace gable
