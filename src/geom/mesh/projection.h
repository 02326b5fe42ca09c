// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Projection of a plane along the coordinate axis that its normal is nearest to, which keeps the
// coordinates exact and the direction of rings.
#pragma once

#include <cmath>
#include <cstddef>

#include "math/vec.h"

namespace gable {

/// Which coordinates become x and y so that the normal points at the viewer.
struct Projection {
  size_t x = 0, y = 1;
  Vec2 operator()(const Vec3& p) const { return {p[x], p[y]}; }
};

inline Projection projectionFor(const Vec3& n) {
  const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
  if (az >= ax && az >= ay) return n.z >= 0 ? Projection{0, 1} : Projection{1, 0};
  if (ay >= ax) return n.y >= 0 ? Projection{2, 0} : Projection{0, 2};
  return n.x >= 0 ? Projection{1, 2} : Projection{2, 1};
}

}  // namespace gable
