// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Triangles of polygons with holes, by ear clipping with exact signs. No vertices are added.
//
// Promises:
//   1. A valid polygon (region/clean.h) of n vertices and h holes gives n - 2 + 2h triangles, two
//      less for each point where rings touch; all are counter-clockwise, none has zero area, and
//      their areas sum up to the polygon's.
//   2. Anything else gives at most as many triangles, none of exactly zero area, and always ends.
//   3. Ring directions do not matter; equal input gives equal output.
// O(n log n) on common shapes, O(n^2) at worst.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/region.h"

namespace gable {

using Triangle = std::array<uint32_t, 3>;

/// Indices into the vertices of the outer ring and the holes, concatenated.
std::vector<Triangle> triangulate(const Polygon& p);

/// The same triangles with edges exchanged until each circle through a triangle's corners is free
/// of its neighbours' (Lawson 1977): no long slivers, and bands between two outlines become strips
/// from one to the other. O(n^2) at worst, about linear after ear clipping.
std::vector<Triangle> triangulateEvenly(const Polygon& p);

/// The same on flat arrays: ring k ends before points[ringEnds[k]], the outer ring is the first.
/// Appends to `out`.
void triangulate(std::span<const Vec2> points, std::span<const uint32_t> ringEnds,
                 std::vector<Triangle>& out);

}  // namespace gable
