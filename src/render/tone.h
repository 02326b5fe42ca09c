// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From linear light to what a screen shows, and back. 1.0 in linear light is the camera's white;
// the curve bends towards it softly and never clips hard.
#pragma once

#include "render/vec3f.h"

namespace gable::rt {

/// Both work on one component in [0, 1].
float srgbToLinear(float v);
float linearToSrgb(float v);
Vec3f srgbToLinear(const Vec3& c);

/// 255 * linearToSrgb(v), to within a hundredth, in a few steps; for v in [0, 1].
float srgbLevel(float v);

/// Display-linear light in [0, 1] for scene light in [0, inf).
Vec3f toneMapped(const Vec3f& light);
/// The scene light whose toneMapped is `shown`, each component of which is below 1.
Vec3f inverseToneMapped(const Vec3f& shown);

}  // namespace gable::rt
