// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What lies behind single points of a picture: its layers as data, and what drawings are made of.
#pragma once

#include "render/stage.h"

namespace gable::rt {

/// What the eye sees at a point of the picture.
struct Glimpse {
  /// Metres ahead; 0 where there is nothing.
  float depth = 0;
  Vec3f normal, albedo, point;
  /// Numbers as in RawLayers.
  uint32_t object = 0, instance = 0, source = 0, material = 0;
  bool isGround = false, isCut = false, isPane = false;
  Matter matter = Matter::Plain;
};

/// The first thing along a camera's ray that is less than half clear.
Glimpse glimpse(const Stage& stage, const Scene& scene, const Camera& camera, const Ray& ray);

/// All layers, one ray a pixel.
RawLayers traceLayers(const Stage& stage, const Scene& scene, const Camera& camera,
                      const RenderOptions& options);

}  // namespace gable::rt
