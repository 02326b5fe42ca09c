// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Geometric predicates with exact signs. Inputs are finite doubles whose products neither overflow
// nor underflow (magnitudes between 1e-140 and 1e140, or zero).
#pragma once

#include <cmath>

#include "math/vec.h"

namespace gable {

/// Without the quick look at the rounded determinant.
int exactOrientation(Vec2 a, Vec2 b, Vec2 c);

/// +1 when a, b, c turn left (counter-clockwise), -1 right, 0 exactly collinear. O(1); the exact
/// path runs only where the rounded determinant is in doubt.
inline int orientation(Vec2 a, Vec2 b, Vec2 c) {
  // (3 + 16 eps) eps with eps = 2^-53: Shewchuk's ccwerrboundA.
  constexpr double kBound = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  const double bound = kBound * (std::fabs(left) + std::fabs(right));
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exactOrientation(a, b, c);
}

/// p lies on the closed segment a b, exactly.
bool onSegment(Vec2 a, Vec2 b, Vec2 p);

}  // namespace gable
