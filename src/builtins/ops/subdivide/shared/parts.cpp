// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/parts.h"

#include <algorithm>
#include <cmath>

namespace gable {

namespace {

// How far a box reaches beyond a plane; negative when it lies wholly behind.
double reach(const Shape& s, const TrimPlane& plane, double grow) {
  const Frame& f = s.scope;
  const Vec3 half{std::fabs(s.size.x) / 2 + grow, std::fabs(s.size.y) / 2 + grow,
                  std::fabs(s.size.z) / 2 + grow};
  return dot(plane.normal, f.point(s.size * 0.5)) - plane.distance +
         std::fabs(dot(plane.normal, f.x)) * half.x + std::fabs(dot(plane.normal, f.y)) * half.y +
         std::fabs(dot(plane.normal, f.z)) * half.z;
}

}  // namespace

Shape scopePart(const Shape& parent, Axis axis, double start, double size) {
  Shape child = parent;
  const auto a = static_cast<size_t>(axis);
  const double sign = parent.size[a] < 0 ? -1 : 1;
  Vec3 offset;
  offset[a] = sign * start;
  child.scope.origin = parent.scope.point(offset);
  child.size[a] = sign * size;
  return child;
}

void setPartMesh(Shape& child, const Shape& parent, Mesh mesh, bool adjust) {
  if (!adjust) {
    const Vec3 moved = parent.scope.toLocal(child.scope.origin);
    if (moved != Vec3{}) {
      for (Vec3& p : mesh.positions) p = p - moved;
    }
    setMesh(child, std::move(mesh), ScopeFit::Keep);
    return;
  }
  child.scope = parent.scope;
  child.size = parent.size;
  setMesh(child, std::move(mesh), ScopeFit::Refit);
  if (parent.size.x >= 0 && parent.size.y >= 0 && parent.size.z >= 0) return;
  // The scope keeps its handedness: its origin goes to the far corner of the mirrored axes.
  Vec3 corner;
  Vec3 size = child.size;
  for (size_t i = 0; i < 3; ++i) {
    if (parent.size[i] >= 0) continue;
    corner[i] = size[i];
    size[i] = -size[i];
  }
  Mesh moved = *meshInScope(child);
  for (Vec3& p : moved.positions) p = p - corner;
  child.scope.origin = child.scope.point(corner);
  child.size = size;
  setMesh(child, std::move(moved), ScopeFit::Keep);
}

void forgetFarTrimPlanes(Shape& s) {
  if (!s.extra || s.extra->trim.empty()) return;
  const double grow = std::max({std::fabs(s.size.x), std::fabs(s.size.y), std::fabs(s.size.z)}) / 4;
  const auto far = [&](const TrimPlane& p) { return reach(s, p, grow) < 0; };
  if (std::none_of(s.extra->trim.begin(), s.extra->trim.end(), far)) return;
  ShapeExtra extra = *s.extra;
  std::erase_if(extra.trim, far);
  const bool projected = std::any_of(extra.projections.begin(), extra.projections.end(),
                                     [](const UvProjection& p) { return p.present; });
  s.extra =
      extra.trim.empty() && !projected ? Ref<ShapeExtra>() : makeRef<ShapeExtra>(std::move(extra));
}

}  // namespace gable
