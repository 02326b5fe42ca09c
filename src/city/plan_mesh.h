// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A polygon as triangles of about one size, for ground that bends within it: points on a grid are
// added inside, none on its outline. Plan coordinates, metres.
//
// Promises: the triangles of a valid polygon are counter-clockwise, have an area each, and together
// that of the polygon; every edge of the polygon is an edge of one triangle. Equal input gives
// equal output. About O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"
#include "geom/region/triangulate.h"

namespace gable {

struct PlanMesh {
  /// Those of the outer ring and the holes, one after the other, then those inside.
  std::vector<Vec2> points;
  std::vector<Triangle> triangles;
};

/// `spacing` metres lie between points inside; 0: none are added.
PlanMesh meshOf(const Polygon& polygon, double spacing);

}  // namespace gable
