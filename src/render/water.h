// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Water as a camera sees it: waves that nobody has to model, and how far one sees into it.
#pragma once

#include "render/surface.h"

namespace gable::rt {

/// Index of refraction.
constexpr float kWater = 1.33f;

/// Gives a level surface of water, seen along a unit direction, its waves: the normal bends, and
/// where waves are finer than what the eye tells apart at that distance, or than what is seen of
/// the surface in a `width` (see surfaceAt), the surface is rougher instead. Takes clearness from
/// `opacity`.
void makeWater(Surface& surface, const Vec3f& direction, float distance, float width);

/// Direction of a ray that meets water, within it; zero where all is mirrored. Both unit, `normal`
/// against the ray.
Vec3f refracted(const Vec3f& direction, const Vec3f& normal, float index);

/// Share of light that is left after so many metres: red goes first.
Vec3f throughWater(float metres, float clearness);

}  // namespace gable::rt
