// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pixels that paths make, before they are smoothed and shown.
#pragma once

#include <algorithm>
#include <vector>

#include "render/stage.h"

namespace gable::rt {

/// Means over the samples in and about a pixel, rows from the top.
struct Film {
  uint32_t width = 0, height = 0;
  /// Light that needs no smoothing, and sunlight on the first surfaces.
  std::vector<Vec3f> direct, sun;
  std::vector<Vec3f> albedo;
  /// Indirect light over albedo (albedoDivisor), and the variance of its luminance from the samples
  /// of the pixel alone.
  std::vector<Vec3f> irradiance;
  std::vector<float> variance;
  /// Of first surfaces, weighted by the luminance of their albedo as the light they send is; 0
  /// where there are none. The normal shrinks where they disagree.
  std::vector<Vec3f> normal;
  std::vector<float> distance;
};

/// What indirect light is divided by: nothing is quite black.
inline Vec3f albedoDivisor(const Vec3f& albedo) {
  constexpr float kLeast = 0.02f;
  return {std::max(kLeast, albedo.x), std::max(kLeast, albedo.y), std::max(kLeast, albedo.z)};
}

/// A lens of that radius in metres; what lies at `focus` along the view is sharp.
struct Lens {
  float radius = 0, focus = 1;
};

/// Fills the film, a tile of pixels a task; adds up the rays. False when progress ended it.
bool tracePicture(const Stage& stage, const Camera& camera, const Lens& lens,
                  const RenderOptions& options, Film& film, uint64_t& rays);

}  // namespace gable::rt
