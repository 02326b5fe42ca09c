// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Autoindexing: the logical corners and edges of a region, and the quadrilateral that a region
// roughly is. Plan coordinates, metres. Logical edges are counted clockwise from the south-west
// corner: of a quad 0 is west, 1 north, 2 east and 3 south.
//
// Promises: every edge of the outer ring belongs to exactly one logical edge; those of one are
// contiguous along the ring. Edges of holes belong to none. Equal input gives equal output.
// O(n log n) and some thousand steps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/region/hull.h"
#include "geom/region/region.h"

namespace gable {

/// South-west, south-east, north-east, north-west.
using Quad = std::array<Vec2, 4>;

/// The smallest box with its x axis along the plane's where it lies along the axes, else along its
/// longer side towards the east.
OrientedRect orientedFrame(const Ring& outer);

struct BestQuad {
  /// Vertices of the ring, counter-clockwise from the south-west; all equal when there is none.
  std::array<uint32_t, 4> corner{};
  /// 1 for a rectangle; beneath kRoughlyQuad it is none.
  double score = -1e9;
  bool found() const { return score > -1e8; }
};
constexpr double kRoughlyQuad = 0.55;

/// The four vertices that make the best quadrilateral: much of the area, angles near 90 degrees.
BestQuad bestQuad(const Ring& outer);

struct LogicalEdges {
  /// By edge of the outer ring.
  std::vector<uint32_t> of;
  uint32_t count = 0;
};

/// The four sides: those between the corners of the best quad, or, where it has none, between the
/// vertices nearest to the corners of the oriented box. A triangle has one side of no length.
LogicalEdges sidesOf(const Ring& outer);

/// Edges of one kind (equal numbers in `kind`, by edge) as long as they do not bend by more than 30
/// degrees where the kind changes; as `autoindex` where there are fewer than three such.
LogicalEdges chainsOf(const Ring& outer, const std::vector<uint32_t>& kind);

/// What an edge of a sector between two rays lies on.
enum class SectorSide : uint8_t { Centre, Ray, Outer };

/// 0 is the border of the centre (no edge where the centre is a point), 1 the first ray clockwise,
/// then the outer chain between bends of more than 30 degrees, and last the other ray: so that 1
/// and -1 are each other's images. As `autoindex` where the ring is no sector.
LogicalEdges sectorOf(const Ring& outer, const std::vector<SectorSide>& side);

/// As `sidesOf` where the ring is roughly a quad, else an edge between any two bends.
LogicalEdges autoindex(const Ring& outer);

}  // namespace gable
