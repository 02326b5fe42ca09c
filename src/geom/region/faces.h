// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces: the polygons between outlines that are known, without a boolean. Where the parts of a
// region have been made one by one, what they leave free is bounded by the region's edges and
// theirs turned round; chords divide it further. Plan coordinates, metres.
//
// Promises:
//   1. Every polygon is valid, and each of its edges says which edge or chord it is a part of.
//   2. Areas of faces add up to what the edges bound, counted with signs.
//   3. Edges that run opposite each other bound nothing and vanish; chords stay.
// Where that cannot be kept (edges cross, ends stay open, an area is missing) nothing is given out:
// the caller takes a boolean. O(n log n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/region.h"
#include "geom/region/segment_grid.h"

namespace gable {

struct Face {
  Polygon polygon;
  /// By edge, through the outer ring and the holes: the number of the edge; for chords the number
  /// of edges + 2 k, or + 2 k + 1 where the chord runs the other way.
  std::vector<uint32_t> edges;
};

/// The insides of both cross; ends within `tolerance` of the other's line do not count.
bool segmentsCross(const Segment& s, const Segment& t, double tolerance);

/// The faces to the left of `edges`, divided by `chords`. Points within `tolerance` become one, and
/// edges are led through points within it. False, and nothing given out, where that fails.
bool facesOf(std::span<const Segment> edges, std::span<const Segment> chords, double tolerance,
             std::vector<Face>& out);

}  // namespace gable
