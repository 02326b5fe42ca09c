// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What parts of a split (shape/part.h) are, told without making them.
#pragma once

#include "shape/part.h"

namespace gable {

/// Where the scope of a part begins.
Vec3 originOfPart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece);

/// Whether two parts keep the same tags of the sides of the shape.
bool keepEqualTags(const Shape& parent, const PartPlan& plan, const SplitPiece& a,
                   const SplitPiece& b);

/// Whether a shape with this scope forgets a trim plane; see forgetFarTrimPlanes().
bool isFarFrom(const TrimPlane& plane, const Frame& scope, const Vec3& size);

}  // namespace gable
