// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/refit.h"

#include <cmath>
#include <utility>

namespace gable {

Vec3 straightened(const Vec3& direction) {
  const Vec3 d = normalized(direction);
  for (size_t a = 0; a < 3; ++a) {
    if (std::fabs(d[a]) < 1 - 1e-12) continue;
    Vec3 axis;
    axis[a] = d[a] > 0 ? 1 : -1;
    return axis;
  }
  return d;
}

Frame axesWithY(const Vec3& y, const Vec3& x) {
  const Frame f = frameFromZ({}, y, x);
  return Frame::of({}, f.x, f.z, cross(f.x, f.z));
}

void refit(Shape& s, Mesh mesh, const Frame& axes, bool downward) {
  Frame turned = axes;
  turned.origin = {};
  if (turned.turned) mesh = transformed(mesh, {1, 1, 1}, inverse(turned));
  s.scope = s.scope * turned;
  s.size = {};
  setMesh(s, std::move(mesh), ScopeFit::Refit);
  if (!downward || s.size.y <= 0) return;
  const Vec3 up{0, s.size.y, 0};
  Mesh hung = *meshInScope(s);
  for (Vec3& p : hung.positions) p = p - up;
  s.scope.origin = s.scope.point(up);
  s.size.y = -s.size.y;
  setMesh(s, std::move(hung), ScopeFit::Keep);
}

}  // namespace gable
