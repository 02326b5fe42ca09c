// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Local metres on the WGS 84 ellipsoid: the transverse Mercator projection about a point of the
// input, true to scale along its meridian.
//
// Promises: forward and inverse agree to a nanometre within 1000 km of the centre; the scale error
// is 1.2e-8 at 1 km, 1.2e-6 at 10 km and 1.2e-4 at 100 km east or west of the centre. The same bits
// on every machine.
#pragma once

#include "math/vec.h"

namespace gable {

/// Degrees.
struct LonLat {
  double longitude = 0, latitude = 0;
};

class TransverseMercator {
 public:
  /// The centre becomes (0, 0); latitude within [-89, 89] (clamped).
  explicit TransverseMercator(const LonLat& center);
  /// x east, y north, metres. Longitudes are taken modulo 360.
  Vec2 forward(const LonLat& p) const;
  LonLat inverse(Vec2 p) const;
  const LonLat& center() const { return center_; }

 private:
  LonLat center_;
  double northOfCenter_ = 0;
};

}  // namespace gable
