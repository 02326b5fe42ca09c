// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/frames.h"

#include <cmath>

namespace gable {

namespace {

// Chains of quarter turns and their inverses leave errors of some 1e-16; directions that differ by
// less than this are one direction.
constexpr double kSameDirection = 1e-12;

bool positive(const Vec3& size, GeometryKind kind) {
  switch (kind) {
    case GeometryKind::QuadXy: return size.x > 0 && size.y > 0 && size.z == 0;
    case GeometryKind::QuadXz: return size.x > 0 && size.y == 0 && size.z > 0;
    case GeometryKind::Box: return size.x > 0 && size.y > 0 && size.z > 0;
    default: return false;
  }
}

}  // namespace

Frame worldFrame(const Services& services) { return inverse(services.world()); }

Frame objectFrame(const Services& services) {
  return inverse(services.world()) * services.initialShape().origin;
}

Frame frameOf(CoordSystem system, const Shape& s, const Services& services) {
  switch (system) {
    case CoordSystem::Scope: return s.scope;
    case CoordSystem::Pivot: return s.pivot;
    case CoordSystem::Object: return objectFrame(services);
    case CoordSystem::World: break;
  }
  return worldFrame(services);
}

Frame composedAxes(const Frame& outer, const Frame& inner) {
  Frame f = outer * inner;
  f.origin = {};
  return f;
}

void turnAxes(Frame& f, const Frame& turn) {
  const Vec3 origin = f.origin;
  f = composedAxes(turn, f);
  f.origin = origin;
}

bool sameAxes(const Frame& a, const Frame& b) {
  return length(a.x - b.x) <= kSameDirection && length(a.y - b.y) <= kSameDirection &&
         length(a.z - b.z) <= kSameDirection;
}

void realignScope(Shape& s, const Frame& axes) {
  if (!sameAxes(axes, s.scope)) {
    alignScope(s, axes);
  } else if (!positive(s.size, s.geometry.kind)) {
    const Frame kept = s.scope;
    alignScope(s, kept);
  }
}

bool isMirrored(const Vec3& size) { return ((size.x < 0) != (size.y < 0)) != (size.z < 0); }

Mesh reversed(const Mesh& m) {
  Mesh out = m;
  for (size_t f = 0; f < out.faces.size(); ++f) reverseFace(out, f);
  return out;
}

void resizeScope(Shape& s, const Vec3& size) {
  const auto plain = [](const Vec3& v) { return v.x >= 0 && v.y >= 0 && v.z >= 0; };
  if ((!plain(size) || !plain(s.size)) && s.geometry.kind != GeometryKind::None) {
    const bool isMesh = s.geometry.kind == GeometryKind::Mesh;
    const Vec3 ref = isMesh ? s.geometry.refSize : s.size;
    if (isMirrored(scaled(size, ref)) != isMirrored(scaled(s.size, ref))) {
      const MeshRef mesh = isMesh ? s.geometry.mesh : meshInScope(s);
      s.geometry = {GeometryKind::Mesh, false, ref, makeRef<Mesh>(reversed(*mesh))};
    }
  }
  // No negative zeros: they would print and hash as something else.
  s.size = size + Vec3{};
}

}  // namespace gable
