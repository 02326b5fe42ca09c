// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The light of a picture: one sun, a sky that is blue above and pale at the horizon, haze, and the
// exposure at which sunlit stone comes out bright but not white. In these units the sun gives a
// surface that faces it an irradiance of 1 in red.
#pragma once

#include <array>

#include "render/render.h"
#include "render/vec3f.h"

namespace gable::rt {

class Light {
 public:
  /// `sunElevation` and `sunAzimuth` in degrees.
  Light(const RenderOptions& options, double sunElevation, double sunAzimuth);

  /// Towards the sun's centre.
  Vec3f sunDirection;
  /// Irradiance of a surface that faces the sun; black at night.
  Vec3f sun;
  /// What the sky gives a horizontal plane.
  Vec3f skyIrradiance;
  Vec3f groundAlbedo;
  /// Picture light = radiance * exposure, before it adapts to the picture.
  float exposure = 1;

  /// A direction on the sun's disc.
  Vec3f towardsSun(Vec2f u) const;
  /// What lights surfaces, from a unit direction; below the horizon what an open ground sends up.
  Vec3f sky(const Vec3f& direction) const;
  /// What the camera and mirrors see of the sky.
  Vec3f shownSky(const Vec3f& direction) const;
  Vec3f horizon() const { return shown_[0]; }

 private:
  /// By elevation, from the horizon to the zenith, in even steps of its sine's square root.
  static constexpr int kSteps = 64;
  using Gradient = std::array<Vec3f, kSteps + 1>;
  static Vec3f at(const Gradient& gradient, float up);
  /// 1 on average over the horizon, 20 % more on the sun's side than on the other.
  float sunSide(const Vec3f& direction) const;

  Gradient light_, shown_;
  Vec3f ground_;
  Vec2f sunPlan_;
  bool uniform_ = false;
};

}  // namespace gable::rt
