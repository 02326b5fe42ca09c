// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How two surfaces lie to each other, for context queries. Lengths up to kContactTolerance count as
// contact, not as overlap.
#pragma once

#include <array>
#include <vector>

#include "geom/mesh/mesh.h"
#include "math/box.h"

namespace gable {

constexpr double kContactTolerance = 1e-3;

struct TriangleSoup {
  std::vector<std::array<Vec3, 3>> triangles;
  Box3 box;
  bool closed = false;
};

TriangleSoup soupOf(const Mesh& m);

/// All of `a` is inside of the closed `solid` or on its surface.
bool insideSolid(const TriangleSoup& a, const TriangleSoup& solid);
/// Some of `a` lies inside of the closed `solid`, or the other way round.
bool overlapsSolid(const TriangleSoup& a, const TriangleSoup& solid);
/// Overlap, or faces that lie on each other over an area.
bool touchesSolid(const TriangleSoup& a, const TriangleSoup& solid);

/// The distance of two boxes given by frame and size; 0 when they meet.
double boxDistance(const Frame& a, const Vec3& aSize, const Frame& b, const Vec3& bSize);

}  // namespace gable
