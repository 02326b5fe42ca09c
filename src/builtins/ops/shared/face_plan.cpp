// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/face_plan.h"

#include "builtins/ops/shared/refit.h"
#include "geom/mesh/face_plane.h"

namespace gable {

Frame planFrame(const Mesh& m, size_t face) {
  const Vec3 normal = straightened(m.normal(face));
  const Vec3 at = m.at(m.loopsOf(face)[0].firstCorner);
  for (size_t a = 0; a < 3; ++a) {
    if (normal[a] != 1 && normal[a] != -1) continue;
    Vec3 origin;
    origin[a] = at[a];
    // Upward and forward faces keep x; others take what is right-handed.
    Vec3 x;
    x[a == 0 ? 2 : 0] = a == 0 ? -normal.x : a == 1 ? 1 : normal.z;
    return Frame::of(origin, x, cross(normal, x), normal);
  }
  return faceFrame(m, face);
}

}  // namespace gable
