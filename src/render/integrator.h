// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Light along a path, and the pixels it makes.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "render/light.h"
#include "render/render.h"
#include "render/tracer.h"

namespace gable::rt {

/// A scene ready to be looked at.
struct Stage {
  const World& world;
  const Tracer& tracer;
  const Light& light;
  bool ground = true;
  float groundHeight = 0;
  /// 1 / metres.
  float haze = 0;
  /// From this distance on the empty ground pales, so that no edge shows where it meets the sky.
  float nearGround = 250;
  uint32_t bounces = 3;
};

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

PathResult tracePath(const Stage& stage, Ray ray, uint32_t x, uint32_t y, uint32_t sample,
                     uint32_t seed);

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

/// Fills the film, a tile of pixels a task; adds up the rays. False when progress ended it.
bool tracePicture(const Stage& stage, const Camera& camera, const RenderOptions& options,
                  Film& film, uint64_t& rays);

}  // namespace gable::rt
