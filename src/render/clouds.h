// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Heaps of cloud as in fair weather, for the eye alone: they hide the sky, the sun and the stars
// behind them, but cast no shadow. What stands in a part of the sky is found when somebody looks
// there first: some seconds of a processor for the whole of it, and a table look-up from then on.
#pragma once

#include <memory>

#include "render/vec3f.h"

namespace gable::rt {

class Clouds {
 public:
  /// What stands in one direction.
  struct Seen {
    /// The share of the light behind that comes through.
    float clear = 1;
    /// What is sent to the eye for each unit of the sun's irradiance and of the sky's. The sun's
    /// share is that across from it; see forward().
    float sun = 0, sky = 0;
  };

  /// `cover`: the share of the sky overhead that they hide, above 0 to 1. `sunElevation` in
  /// degrees.
  Clouds(double cover, double sunElevation);
  ~Clouds();

  /// In a unit direction with x towards the sun's azimuth and y up; nothing below the horizon.
  /// Any thread may ask.
  Seen seen(const Vec3f& direction) const;
  /// How much more sunlight is sent to an eye that looks towards the sun: by the cosine of the
  /// angle from it, 1 at a right angle.
  static float forward(float cosine);

  bool isFor(double cover, double sunElevation) const;

 private:
  class Dome;
  std::unique_ptr<Dome> dome_;
};

}  // namespace gable::rt
