// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Geometric predicates with exact signs. Inputs are finite doubles whose products neither overflow
// nor underflow (magnitudes between 1e-140 and 1e140, or zero).
#pragma once

#include "math/vec.h"

namespace gable {

/// +1 when a, b, c turn left (counter-clockwise), -1 right, 0 exactly collinear. O(1); the exact
/// path runs only where the rounded determinant is in doubt.
int orientation(Vec2 a, Vec2 b, Vec2 c);

/// p lies on the closed segment a b, exactly.
bool onSegment(Vec2 a, Vec2 b, Vec2 p);

}  // namespace gable
