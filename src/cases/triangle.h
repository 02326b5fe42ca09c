// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pairs of triangles in space: how near they come, and what they share of a plane. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "math/box.h"

namespace gable::cases {

/// Corners, counter-clockwise seen from the side it looks to.
struct Triangle : std::array<Vec3, 3> {
  /// Equal for equal materials.
  uint64_t material = 0;
};

Box3 boundsOf(const Triangle& t);

/// Where the segment from a to b goes through a triangle, as a share of its length.
std::optional<double> pierced(const Vec3& a, const Vec3& b, const Triangle& t);

double distance(const Vec3& p, const Triangle& t);

/// Whether some two points of them are at most `gap` apart; always where they cross.
bool withinReach(const Triangle& a, const Triangle& b, double gap);

/// The area that lies on both, where they look the same way and are at most `gap` apart; else 0.
/// `at` becomes the middle of that area.
double sharedArea(const Triangle& a, const Triangle& b, double gap, Vec3& at);

}  // namespace gable::cases
