// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Region: a planar area with holes, in plan coordinates (x right, y up, metres). Outer rings are
// counter-clockwise, holes clockwise; rings do not repeat their first point. A region may consist
// of several polygons; polygons of one region do not overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "math/box.h"
#include "math/vec.h"

namespace gable {

using Ring = std::vector<Vec2>;

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

using Region = std::vector<Polygon>;

/// Positive for counter-clockwise rings. The shoelace sum runs relative to the first point, so that
/// coordinates of a million metres lose nothing.
double signedArea(const Ring& r);
/// Outer area less the holes'.
double area(const Polygon& p);
double area(const Region& r);
Box2 bounds(const Ring& r);
Box2 bounds(const Polygon& p);
double perimeter(const Ring& r);
/// Where a point lies, decided with exact signs; O(n). An empty ring has everything outside.
enum class Where : uint8_t { Outside, Boundary, Inside };
Where locate(const Ring& r, Vec2 point);
/// Even-odd over all rings.
Where locate(const Polygon& p, Vec2 point);
/// Inside or on the boundary.
bool contains(const Polygon& p, Vec2 point);
/// Outer counter-clockwise, holes clockwise.
void orient(Polygon& p);

}  // namespace gable
