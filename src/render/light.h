// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The light of a picture: the sun, the sky about it (render/sky.h), what lamps give at night, and
// the exposure at which sunlit stone comes out bright but not white. In these units the sun of a
// bright morning gives a surface that faces it an irradiance of 1 in red.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/clouds.h"
#include "render/render.h"
#include "render/sky.h"
#include "render/vec3f.h"

namespace gable::rt {

/// Unit, towards where the sun stands, degrees.
Vec3f towardsSun(double elevation, double azimuth);

class Light {
 public:
  /// `sunElevation` and `sunAzimuth` in degrees. `clouds` may be null.
  Light(const RenderOptions& options, double sunElevation, double sunAzimuth,
        std::shared_ptr<const Clouds> clouds = nullptr);

  /// Towards the sun's centre.
  Vec3f sunDirection;
  /// Irradiance of a surface that faces the sun; black at night.
  Vec3f sun;
  /// What the sky gives a horizontal plane.
  Vec3f skyIrradiance;
  Vec3f groundAlbedo;
  /// Picture light = radiance * exposure, before it adapts to the picture.
  float exposure = 1;
  /// 0 by day, 1 when it is dark.
  float night = 0;
  /// The radiance of an emissive 1 as the camera sees it, and as it lights its surroundings: a lamp
  /// outshines the street a thousand times, and no picture shows that.
  float shownGlow = 0, glow = 0;

  /// Of the sun's disc, in radians.
  float sunRadius() const { return sunRadius_; }
  /// A direction on the sun's disc.
  Vec3f towardsSun(Vec2f u) const;
  /// What lights surfaces, from a unit direction; below the horizon what an open ground sends up.
  Vec3f sky(const Vec3f& direction) const;
  /// What mirrors show of the sky: air and clouds.
  Vec3f shownSky(const Vec3f& direction) const;
  /// All that the camera sees there: the stars and the sun's disc with the glare about it, too.
  Vec3f shown(const Vec3f& direction) const;
  /// The air at the horizon below or above a direction: what distance fades into.
  Vec3f horizon(const Vec3f& direction) const;

 private:
  Vec3f shownAir(const Vec3f& direction) const;
  Vec3f shownStars(const Vec3f& direction) const;
  Vec3f shownSun(const Vec3f& direction) const;
  /// What lies behind the clouds, seen with them before it.
  Vec3f behindClouds(const Vec3f& behind, const Vec3f& direction) const;
  Vec3f radiance(const Vec3f& direction, float up) const;
  /// Of the compass angle between a direction and the sun.
  float cosineFromSun(const Vec3f& direction) const;
  void makeHorizon();
  /// How much of the sky's light is shown at that sine of elevation: less of it in the dark.
  float shownShare(float up) const;

  std::optional<Sky> sky_;
  std::shared_ptr<const Clouds> clouds_;
  /// What horizon() says, by kHorizonSteps steps of the square root of the sine of half the angle
  /// from the sun: finer towards it. All that a camera sees through haze asks for it.
  std::vector<Vec3f> horizon_;
  /// White balance: from the physical sky to its light, and to what is shown of it.
  Vec3f lightScale_, shownScale_, nightLight_, nightShown_;
  Vec3f ground_, uniform_;
  /// The sun's disc.
  Vec3f acrossSun_, upSun_;
  float sunRadius_ = 0;
  Vec2f sunPlan_;
  /// 0 until dusk is far on, 1 in the depth of night.
  float dark_ = 0;
};

}  // namespace gable::rt
