// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Light along a path.
#pragma once

#include <cstdint>

#include "render/stage.h"

namespace gable::rt {

/// What one camera path brings home.
struct PathResult {
  /// Light that needs no smoothing: emission, sky, mirrors.
  Vec3f direct;
  /// Sunlight on the first surface, and all the rest, as that surface reflects them.
  Vec3f sun, indirect;
  /// Colour, normal and distance of the first surface, for the smoothing; 0 where there is none.
  Vec3f albedo, normal;
  float distance = 0;
  uint32_t rays = 0;
};

/// `brief` leaves out what is indirect, at a third of the cost: all else is as in a whole path.
PathResult tracePath(const Stage& stage, const Ray& ray, uint32_t x, uint32_t y, uint32_t sample,
                     uint32_t seed, bool brief = false);

}  // namespace gable::rt
