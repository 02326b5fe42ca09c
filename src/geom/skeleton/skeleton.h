// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The weighted straight skeleton of a polygon with holes: every edge sweeps inwards at its own
// speed, and the ground that an edge sweeps is its face. Lifted by time, the faces are the roof.
//
// Promises, for a simple polygon (outer ring counter-clockwise, holes clockwise, not crossing):
// 1. faces[i] is of the i-th edge, outer ring first, then the holes; edge k starts at point k.
// 2. A face is a counter-clockwise loop that begins with its own edge; all its vertices lie in the
//    plane through that edge whose slope is 1 / weight.
// 3. The faces tile the polygon and share vertices by index, without T-junctions. The first
//    inputCount vertices are the polygon's own, at height 0.
// 4. The result depends on nothing but the arguments.
//
// Where edges in one line and of one weight meet, at the start or later, their faces part at a
// right angle to the line; what is in line is told at 2^-30 of the extent. An edge of weight 0
// stands still: its face is upright and has no area in plan. Between neighbours in line that differ
// in weight stands an upright face (a step), listed after the edges' own. An edge without length,
// or within a spike of no width, has an empty face. Rings may touch themselves and each other.
//
// Units are metres; heights are times: after height h an edge has moved by weight * h. Coordinates
// may be large (the shape is recentred). What cannot be done ends in `status`, with no faces:
// "skeleton-input" for what is no polygon, "skeleton-unbounded" where only edges of weight 0 bound
// a part, "skeleton-failed" for rings that cross. O(n r + m log m) for r reflex corners and m
// events.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/status.h"
#include "geom/region/region.h"

namespace gable {

struct SkeletonVertex {
  Vec2 xy;
  double height = 0;
};

struct SkeletonFace {
  /// Ring 0 is the outer one, 1 the first hole.
  uint32_t ring = 0, edge = 0;
  /// True for the faces after the edges' own: an upright one that stands on the start of the edge.
  bool step = false;
  /// Indices into vertices; the first two are the ends of the edge.
  std::vector<uint32_t> loop;
  /// Clockwise; only where a fast edge has run round an island of slower ones.
  std::vector<std::vector<uint32_t>> holes;
};

struct Skeleton {
  Status status;
  std::vector<SkeletonVertex> vertices;
  uint32_t inputCount = 0;
  std::vector<SkeletonFace> faces;

  /// The largest height of all vertices.
  double maxHeight() const;
};

/// `weights`: per ring and edge the speed (the cotangent of the slope), at least 0; an empty span
/// is 1 everywhere. With `maxHeight` the roof is cut off there: faces end in edges at that height,
/// whose lower side is the polygon set back.
Skeleton buildSkeleton(const Polygon& polygon, std::span<const std::vector<double>> weights = {},
                       double maxHeight = std::numeric_limits<double>::infinity());

}  // namespace gable
