// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/face_plan.h"

#include "builtins/ops/shared/refit.h"
#include "geom/mesh/face_plane.h"

namespace gable {

Frame axisFrame(size_t axis, double sign) {
  Vec3 z, x;
  z[axis] = sign;
  // Upward and forward views keep x; others take what is right-handed.
  x[axis == 0 ? 2 : 0] = axis == 0 ? -sign : axis == 1 ? 1 : sign;
  return Frame::of({}, x, cross(z, x), z);
}

Frame planFrame(const Mesh& m, size_t face) {
  const Vec3 normal = straightened(m.normal(face));
  const Vec3 at = m.at(m.loopsOf(face)[0].firstCorner);
  for (size_t a = 0; a < 3; ++a) {
    if (normal[a] != 1 && normal[a] != -1) continue;
    Frame f = axisFrame(a, normal[a]);
    f.origin[a] = at[a];
    return f;
  }
  return faceFrame(m, face);
}

}  // namespace gable
