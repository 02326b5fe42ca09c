// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Convex hulls in space, for collision shapes: few corners, closed, and never degenerate.
//
// 1. Every corner is one of the given points, moved to the nearest point of a grid whose steps are
//    the longest side of their box over kHullSteps.
// 2. There are at most kMostHullCorners: the points that reach farthest in as many directions. What
//    is cut off is small, and lies between them.
// 3. Triangles are counter-clockwise seen from outside, and have area.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace gable {

constexpr double kHullSteps = 1 << 19;
/// Physics engines take 255 triangles, and these are at most twice the corners.
constexpr size_t kMostHullCorners = 98;

struct ConvexHull {
  std::vector<Vec3> corners;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// Without triangles where the points lie in a plane, or are not finite. O(n) in the points.
ConvexHull convexHull3(std::span<const Vec3> points);

}  // namespace gable
