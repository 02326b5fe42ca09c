// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rotations as unit quaternions (x, y, z, w), as glTF wants them.
#pragma once

#include <array>
#include <cmath>

#include "math/frame.h"

namespace gable {

/// The largest component is computed from the diagonal and the others from it, so that none loses
/// digits; w is not negative unless it is tiny.
inline std::array<double, 4> quaternionOf(const Frame& f) {
  const double xx = f.x.x, yy = f.y.y, zz = f.z.z;
  std::array<double, 4> q;
  if (xx + yy + zz > 0) {
    q = {f.y.z - f.z.y, f.z.x - f.x.z, f.x.y - f.y.x, 1 + xx + yy + zz};
  } else if (xx >= yy && xx >= zz) {
    q = {1 + xx - yy - zz, f.x.y + f.y.x, f.z.x + f.x.z, f.y.z - f.z.y};
  } else if (yy >= zz) {
    q = {f.x.y + f.y.x, 1 + yy - xx - zz, f.y.z + f.z.y, f.z.x - f.x.z};
  } else {
    q = {f.z.x + f.x.z, f.y.z + f.z.y, 1 + zz - xx - yy, f.x.y - f.y.x};
  }
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& c : q) c /= size;
  return q;
}

}  // namespace gable
