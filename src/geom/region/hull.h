// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Convex hull, smallest oriented box, distances. Plan coordinates, metres.
#pragma once

#include <span>
#include <vector>

#include "geom/region/region.h"

namespace gable {

/// Counter-clockwise from the lowest of the leftmost points, without collinear points; fewer than
/// three points when the input has no area. Exact signs. O(n log n).
Ring convexHull(std::span<const Vec2> points);

/// A rectangle anywhere in the plane: its corners are origin, + x * width, and so on; x is a unit
/// vector and height runs to its left.
struct OrientedRect {
  Vec2 origin, x{1, 0};
  double width = 0, height = 0;

  double area() const { return width * height; }
  Vec2 y() const { return perpendicular(x); }
  Vec2 at(double u, double v) const { return origin + x * u + y() * v; }
  /// Counter-clockwise from the origin.
  Ring ring() const { return {at(0, 0), at(width, 0), at(width, height), at(0, height)}; }
};

/// The bounding rectangle of least area; one side lies on the hull. Of equals the one whose side
/// comes first on the hull. Width runs along that side. Rotating calipers (Toussaint 1983), O(n)
/// after the hull. A single point or a line gives a rectangle of no height.
OrientedRect smallestRect(std::span<const Vec2> points);

/// Distance to the nearest point of any ring; infinite without rings. O(n).
double distanceToBoundary(const Polygon& p, Vec2 point);
/// The same, negative outside.
double signedDistance(const Polygon& p, Vec2 point);

}  // namespace gable
