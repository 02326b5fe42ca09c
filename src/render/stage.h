// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A scene ready to be looked at: the world with what a picture adds to it, its ground, the plane
// that cuts it open, light in its windows, clay in place of its materials. All rays of a picture
// ask it.
#pragma once

#include <optional>
#include <span>

#include "render/emitters.h"
#include "render/light.h"
#include "render/render.h"
#include "render/tracer.h"

namespace gable::rt {

struct Stage {
  const World& world;
  const Tracer& tracer;
  const Light& light;
  const Emitters& emitters;
  bool ground = true;
  float groundHeight = 0;
  /// 1 / metres.
  float haze = 0;
  /// From this distance on the empty ground pales, so that no edge shows where it meets the sky.
  float nearGround = 250;
  /// How wide a pixel is, in metres or, seen from an eye, in metres a metre away.
  float pixel = 0;
  bool parallel = false;
  uint32_t bounces = 3;
  /// Light comes from the sun and the sky alone: where the sky is hidden, this radiance stands for
  /// what other surfaces send.
  std::optional<Vec3f> ambient = {};
  bool clay = false;
  /// A plain background in place of sky and far ground, as light before the exposure.
  std::optional<Vec3f> paper = {};
  std::optional<Cut> cut = {};
  /// The ground as a block of soil instead of without an end.
  struct Block {
    Vec3f min, max;
  };
  std::optional<Block> block = {};
  /// Share of rooms with light in them.
  float litRooms = 0;
};

/// The nearest thing along a ray. `ordered`: it is looked at, so what was laid on a face shows (see
/// Tracer::intersectOrdered) and textures are sharp.
bool meet(const Stage& stage, const Ray& ray, bool ordered, Surface& surface, float& distance);

/// The share of light that gets along a ray.
float visibility(const Stage& stage, const Ray& ray);

// Several rays at once, as Tracer takes them: those of the camera and of one sun run side by side.
/// As meet() with `ordered`; bit i of the result: ray i met something.
uint32_t meetTogether(const Stage& stage, std::span<const Ray> rays, Surface* surfaces,
                      float* distances);
/// A ray that starts at nothing (`to` not above `from`) gets 1.
void visibilityTogether(const Stage& stage, std::span<const Ray> rays, float* shares);

/// What a pane shows of the room behind it at night, as an emission; black where nobody is at home.
/// `share`: of rooms with light; `middle`: of the piece it belongs to.
Vec3f roomLight(float share, const Vec3f& middle, const Vec3f& facet);

/// A start that does not meet its own surface again; grows with the coordinates' rounding.
Vec3f offsetFrom(const Vec3f& point, const Vec3f& facet, const Vec3f& direction);

}  // namespace gable::rt
