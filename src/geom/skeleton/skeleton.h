// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The weighted straight skeleton of a polygon with holes: every edge sweeps inwards at its own
// speed, and the ground that an edge sweeps is its face. Lifted by time, the faces are the roof.
//
// Promises, for a simple polygon (rings closed implicitly, neither touching nor crossing):
//  1. faces[i] belongs to the i-th edge, outer ring first, then the holes, edge k from point k to
//  k+1;
//  2. a face is a counter-clockwise loop that begins with its own edge, and all its vertices lie in
//     the plane through that edge whose slope is 1 / weight;
//  3. the faces tile the polygon: neighbours share vertices by index, and a vertex of one is a
//  vertex
//     of the other (no T-junctions); vertices 0 .. inputCount-1 are the polygon's own, height 0;
//  4. the result depends on nothing but the arguments.
// An edge shorter than the grid (2^-51 of the extent) has an empty face. Where collinear neighbours
// of one weight meet, their faces part at a right angle to the edge. An edge of weight 0 stands
// still: its face is upright and has no area in plan. Between collinear neighbours that differ in
// weight stands an upright face (a step), listed after the edges' own.
//
// Units are metres; heights are times: after height h an edge has moved by weight * h. Coordinates
// may be large (the shape is recentred). What cannot be done ends in `status`, with no faces: code
// "skeleton-input" for a polygon that is not one, "skeleton-unbounded" where nothing moves and no
// maxHeight ends it, "skeleton-failed" for one that touches itself. O(n r + n log n) for r reflex
// corners.
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
