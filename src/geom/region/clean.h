// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Cleaning and checking of rings: duplicates, collinear vertices, spikes, near touches, validity.
// Plan coordinates, metres. All functions accept any finite input and never fail; a ring that has
// nothing left becomes empty or is dropped. What crosses itself is mended by `repaired`
// (region/boolean.h), which stands on these.
//
// Validity is decided with exact signs:
//   1. a ring is simple when it has three vertices or more, no two edges cross or overlap, and no
//      vertex lies on another edge or vertex of the ring;
//   2. a polygon is valid when its rings are simple, the outer one counter-clockwise and holes
//      clockwise, holes lie inside the outer ring and outside each other; rings may touch in
//      points;
//   3. a region is valid when its polygons are and no two of them overlap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/region.h"
#include "geom/region/segment_grid.h"

namespace gable {

/// O(n) to O(n log n) in practice, by a grid over the edges.
bool isSimple(const Ring& r);
bool isValid(const Polygon& p);
bool isValid(const Region& r);

/// Drops vertices that lie within `tolerance` of the one before, and spikes (an edge that runs back
/// over the one before it). Fewer than three vertices left: empty.
void dropDuplicates(Ring& r, double tolerance);

/// Also drops vertices within `tolerance` of the line through their neighbours. A tolerance of 0
/// drops exactly collinear ones.
void dropCollinear(Ring& r, double tolerance);

/// dropCollinear on all rings; polygons without an outer ring are dropped.
void clean(Region& r, double tolerance);

/// Makes vertices within `tolerance` of each other equal, and leads edges through vertices within
/// `tolerance` of them; then dropDuplicates. Rings may touch or overlap after it. True when
/// something moved.
bool weld(std::vector<Ring>& rings, double tolerance);

/// Takes rings apart where they visit a point twice, until each ring visits its points once.
/// Parts of fewer than three vertices are dropped.
void splitAtRepeats(std::vector<Ring>& rings);

/// Polygons from oriented rings: each counter-clockwise ring is an outer one, each clockwise ring a
/// hole of the smallest outer ring around it; holes without one are dropped. Rings must not cross.
Region nest(std::vector<Ring> rings);

/// The same where nothing is in doubt: every vertex is further than `distance` from each edge that
/// it does not end, nothing crosses or is nested wrongly, so that `out` is valid and stays so when
/// its points move by less than half the distance. False, and nothing done, otherwise; also in
/// rare cases that are near the distance.
bool nestClear(const std::vector<Ring>& rings, double distance, Region& out);

/// For each edge of `result` (all rings concatenated), the edge of `sources` (all concatenated)
/// that it lies on within `tolerance` and with the same direction, opposite ones second best;
/// kNoEdge where there is none. With `shift`, source edges are moved to their left by it first:
/// offsets.
constexpr uint32_t kNoEdge = 0xffffffff;
std::vector<uint32_t> traceEdges(const std::vector<Ring>& result, const std::vector<Ring>& sources,
                                 double tolerance, double shift = 0);

/// The same for edges one by one.
std::vector<uint32_t> traceSegments(std::span<const Segment> result,
                                    std::span<const Segment> sources, double tolerance);

/// The rings of a region in order: outer, holes, next polygon.
std::vector<Ring> ringsOf(const Region& r);

}  // namespace gable
