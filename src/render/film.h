// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pixels that paths make, before they are smoothed and shown.
#pragma once

#include <vector>

#include "render/stage.h"

namespace gable::rt {

/// A part of the light that is smoothed by itself: its mean over the samples of a pixel, and the
/// variance of that mean over albedo, by luminance.
struct FilmLayer {
  std::vector<Vec3f> light;
  std::vector<float> variance;
};

/// Means over the samples of a pixel, rows from the top.
struct Film {
  uint32_t width = 0, height = 0;
  FilmLayer sun, indirect;
  std::vector<Vec3f> direct, albedo;
  /// Over the samples that hit something; the normal shrinks where they disagree.
  std::vector<Vec3f> normal;
  std::vector<float> distance;
  /// Standard deviation of the distance.
  std::vector<float> spread;
};

/// A lens of that radius in metres; what lies at `focus` along the view is sharp.
struct Lens {
  float radius = 0, focus = 1;
};

/// Fills the film, a tile of pixels a task; adds up the rays. False when progress ended it.
bool tracePicture(const Stage& stage, const Camera& camera, const Lens& lens,
                  const RenderOptions& options, Film& film, uint64_t& rays);

}  // namespace gable::rt
