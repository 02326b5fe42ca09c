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

// How far the box of that size at an origin along the axes lies beyond a plane at most; geometry
// lies within the box of its scope.
double beyond(const Vec3& origin, const Frame& axes, const Vec3& size, const TrimPlane& plane) {
  return dot(plane.normal, origin) - plane.distance +
         std::max(0.0, dot(plane.normal, axes.x) * size.x) +
         std::max(0.0, dot(plane.normal, axes.y) * size.y) +
         std::max(0.0, dot(plane.normal, axes.z) * size.z);
}

bool isOn(const Shape& s, const TrimPlane& plane) {
  return plane.horizontal ? s.trimHorizontal : s.trimVertical;
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
  const double slack = std::max(kOnPlane, 1e-9 * (1 + extent));
  const bool boxed = fillsItsBox(s);
  MeshRef mesh;
  bool trimmed = false;
  for (const TrimPlane& plane : s.extra->trim) {
    if (!isOn(s, plane)) continue;
    if (boxed && beyond(s.scope.origin, s.scope, s.size, plane) <= slack) continue;
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

bool reachesTrimPlane(const LightPart& part) {
  if (!part.trim) return false;
  const Vec3 origin = part.trim->there(part.origin);
  for (const LightPlane& p : part.trim->planes) {
    const double reach = dot(p.along, origin) + dot(p.ahead, part.size);
    if (p.on && reach > p.distance + kOnPlane / 2) return true;
  }
  return false;
}

}  // namespace gable
