// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A clear sky by physics: the air of the Earth with its dust and ozone, lit by the sun, from day
// through twilight into the dark. Colours are linear sRGB; the sun outside the air gives a surface
// that faces it an irradiance of 1 in each channel. Making one takes some hundredths of a second;
// asking it costs a table look-up.
#pragma once

#include <vector>

#include "render/vec3f.h"

namespace gable::rt {

class Sky {
 public:
  /// `sunElevation` in degrees. `haze`: the amount of dust, 1 in clear air, 5 on a milky day.
  explicit Sky(double sunElevation, double haze = 1);

  /// What is left of the sun on the ground; black when it has set.
  Vec3f sun;
  /// Of the whole sky on a level surface.
  Vec3f irradiance;

  /// From the direction whose sine of elevation is `up` and whose compass angle differs from the
  /// sun's by the angle with that cosine.
  Vec3f radiance(float up, float cosineFromSun) const;

 private:
  std::vector<Vec3f> table_;
};

}  // namespace gable::rt
