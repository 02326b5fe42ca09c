// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/trim.h"

#include <algorithm>
#include <cmath>

#include "geom/mesh/clip.h"

namespace gable {

namespace {

// Planes through the corners of polygons that were snapped to a grid are this far off, in metres.
constexpr double kOnPlane = 1e-6;

// How far the scope's box lies beyond a plane at most; the geometry lies within the box.
double beyond(const Shape& s, const TrimPlane& plane) {
  double far = dot(plane.normal, s.scope.origin) - plane.distance;
  const Vec3* const axes[3] = {&s.scope.x, &s.scope.y, &s.scope.z};
  for (size_t i = 0; i < 3; ++i) far += std::max(0.0, dot(plane.normal, *axes[i]) * s.size[i]);
  return far;
}

bool fillsItsBox(const Shape& s) {
  if (s.geometry.kind != GeometryKind::Mesh) return true;
  const Box3 box = s.geometry.mesh->bounds();
  for (size_t i = 0; i < 3; ++i) {
    const double ref = s.geometry.refSize[i], slack = 1e-9 * (1 + std::fabs(ref));
    if (box.min[i] < std::min(ref, 0.0) - slack || box.max[i] > std::max(ref, 0.0) + slack) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool trimGeometry(Shape& s) {
  if (!s.extra || s.extra->trim.empty() || s.geometry.kind == GeometryKind::None) return false;
  if (!s.trimVertical && !s.trimHorizontal) return false;
  const double extent = std::fabs(s.size.x) + std::fabs(s.size.y) + std::fabs(s.size.z);
  const bool boxed = fillsItsBox(s);
  MeshRef mesh;
  bool trimmed = false;
  for (const TrimPlane& plane : s.extra->trim) {
    if (!(plane.horizontal ? s.trimHorizontal : s.trimVertical)) continue;
    if (boxed && beyond(s, plane) <= std::max(kOnPlane, 1e-9 * (1 + extent))) continue;
    if (!mesh) mesh = meshInScope(s);
    if (mesh->empty()) break;
    Plane cut;
    cut.normal = s.scope.toLocalDirection(plane.normal);
    cut.offset = plane.distance - dot(plane.normal, s.scope.origin);
    CutOptions options;
    options.cap = true;
    options.tolerance = kOnPlane;
    options.capSlot = mesh->faces[0].materialSlot;
    PlaneCut parts = cutByPlane(*mesh, cut, options);
    if (parts.front.mesh.empty()) continue;
    mesh = makeRef<Mesh>(std::move(parts.back.mesh));
    trimmed = true;
  }
  if (!trimmed) return false;
  s.geometry = {};
  if (!mesh->empty()) s.geometry = {GeometryKind::Mesh, false, s.size, std::move(mesh)};
  return true;
}

}  // namespace gable
