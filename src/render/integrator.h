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
  /// With Stage::ambient: how much of the sky was seen from there, where it was asked.
  float open = 0;
  uint32_t rays = 0;
};

/// Light that is no number counts as none.
void keepFinite(PathResult& result);

/// Coats smoother than this show a picture of their surroundings, which must not be smoothed.
/// No material of the library varies about it, painted metal and copper least of all: its own
/// roughness would speckle it.
constexpr float kMirror = 0.22f;

/// The share of a surface's light that haze leaves on its way.
float clearAlong(const Stage& stage, const Surface& surface, float distance);
/// The brightest that a light sample may be.
float fireflyLimit(const Light& light);
Vec3f withoutFireflies(const Vec3f& light, float limit);
/// With Stage::ambient: what comes from a direction whose sky is open to that share.
Vec3f skyBehind(const Stage& stage, const Vec3f& direction, float open);

/// A way from a surface to a lamp, and the light that comes back from the surface where nothing
/// stands in it; black where there is no lamp.
struct LampRay {
  Ray ray;
  Vec3f light;
};
LampRay rayToLamp(const Stage& stage, const Surface& surface, const Lobes& lobes, const Vec3f& view,
                  float pick, Vec2f u);

/// `brief` leaves out what is indirect, at a third of the cost: all else is as in a whole path.
PathResult tracePath(const Stage& stage, const Ray& ray, uint32_t x, uint32_t y, uint32_t sample,
                     uint32_t seed, bool brief = false);

/// A path of one sample of a pixel.
struct PathStart {
  Ray ray;
  uint32_t x = 0, y = 0, sample = 0;
};

/// The path that meets that surface first.
PathResult goOnFrom(const Stage& stage, const PathStart& start, const Surface& surface,
                    float distance, uint32_t seed, bool brief);

/// The rest of a path whose first surface, one that mirrors nothing and is not clear, has its
/// sunlight already; `carried`: what of the light that leaves it gets to the camera.
PathResult goOn(const Stage& stage, const PathStart& start, const Surface& surface,
                const Lobes& lobes, const Vec3f& carried, uint32_t seed);

/// Several paths, Tracer::kMostTogether at most, each as tracePath() traces it. The rays to their
/// first surfaces run side by side, and those on to the sun; with Stage::ambient all do.
void traceTogether(const Stage& stage, std::span<const PathStart> starts, uint32_t seed, bool brief,
                   PathResult* results);

}  // namespace gable::rt
