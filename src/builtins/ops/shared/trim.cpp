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

// True when the box of that size at an origin along the axes lies wholly behind a plane; geometry
// lies within the box of its scope.
bool behind(const Vec3& origin, const Frame& axes, const Vec3& size, const TrimPlane& plane) {
  const double extent = std::fabs(size.x) + std::fabs(size.y) + std::fabs(size.z);
  double far = dot(plane.normal, origin) - plane.distance;
  far += std::max(0.0, dot(plane.normal, axes.x) * size.x);
  far += std::max(0.0, dot(plane.normal, axes.y) * size.y);
  far += std::max(0.0, dot(plane.normal, axes.z) * size.z);
  return far <= std::max(kOnPlane, 1e-9 * (1 + extent));
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
  const bool boxed = fillsItsBox(s);
  MeshRef mesh;
  bool trimmed = false;
  for (const TrimPlane& plane : s.extra->trim) {
    if (!isOn(s, plane)) continue;
    if (boxed && behind(s.scope.origin, s.scope, s.size, plane)) continue;
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
  const Shape& s = part.parent;
  if (!s.extra) return false;
  return std::any_of(s.extra->trim.begin(), s.extra->trim.end(), [&](const TrimPlane& plane) {
    return isOn(s, plane) && !behind(part.origin, s.scope, part.size, plane);
  });
}

}  // namespace gable
