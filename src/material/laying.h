// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How a material that counts in metres lies on a face: u runs level along the face, v up it. Both
// depend on the face's normal alone, so courses of neighbouring faces meet: on upright faces v is
// the height, and on slopes of one pitch the courses meet at ridges, hips and eaves, since v is the
// height by the sine of the pitch. Level faces have u along x and v against z, as seen from above.
#pragma once

#include <cmath>

#include "math/vec.h"

namespace gable {

struct FaceAxes {
  Vec3 u, v;
  Vec2 at(const Vec3& p) const { return {dot(u, p), dot(v, p)}; }
};

/// `n`: unit, in a frame whose y runs up. Lengths on the face are kept, but on faces that count as
/// level, up to 10 degrees, which are stretched by 1.5 % at most.
inline FaceAxes layingAxes(const Vec3& n) {
  constexpr double kLevel = 0.17364817766693033;  // The sine of 10 degrees.
  const double level = std::sqrt(n.x * n.x + n.z * n.z);
  if (!(level > kLevel)) return {{1, 0, 0}, {0, 0, n.y < 0 ? 1.0 : -1.0}};
  return {{n.z / level, 0, -n.x / level}, {0, 1 / level, 0}};
}

}  // namespace gable
