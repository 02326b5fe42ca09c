// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/shape.h"

#include <cmath>

#include "base/check.h"

namespace gable {

namespace {

Vec3 scaleOf(const Shape& s) {
  Vec3 scale{1, 1, 1};
  for (size_t i = 0; i < 3; ++i) {
    const double ref = s.geometry.refSize[i];
    if (ref != 0 && ref != s.size[i]) scale[i] = s.size[i] / ref;
  }
  return scale;
}

// True when a and b differ by no more than rounding at the size `extent`.
bool same(double a, double b, double extent) { return std::fabs(a - b) <= 1e-9 * (1 + extent); }

bool plainFace(const Mesh& m) {
  if (m.faces[0].materialSlot != 0 || m.faces[0].tags != 0 || m.faces[0].smooth) return false;
  if (m.faces.size() != 1 || m.loops.size() != 1 || m.corners.size() != 4) return false;
  if (!m.edgeTags.empty() || !m.normals.empty()) return false;
  for (int set = 0; set < kUvSets; ++set) {
    if (m.hasUv(set)) return false;
  }
  return true;
}

// The kind of a mesh that is one rectangle covering the scope in the order of makeQuadMesh. Other
// starting corners of the ring stay meshes: edge indices are visible to rules.
GeometryKind quadKind(const Mesh& m, const Vec3& size) {
  if (m.faces.empty() || !plainFace(m)) return GeometryKind::Mesh;
  if (size.x <= 0) return GeometryKind::Mesh;
  const auto matches = [&](const Vec3(&ring)[4]) {
    for (uint32_t i = 0; i < 4; ++i) {
      for (size_t a = 0; a < 3; ++a) {
        if (!same(m.at(i)[a], ring[i][a], size[a])) return false;
      }
    }
    return true;
  };
  const double x = size.x, y = size.y, z = size.z;
  if (z == 0 && y > 0 && matches({{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}})) {
    return GeometryKind::QuadXy;
  }
  if (y == 0 && z > 0 && matches({{0, 0, z}, {x, 0, z}, {x, 0, 0}, {0, 0, 0}})) {
    return GeometryKind::QuadXz;
  }
  return GeometryKind::Mesh;
}

void moveGeometry(Mesh& m, const Vec3& by) {
  for (Vec3& p : m.positions) p += by;
}

}  // namespace

MeshRef meshInScope(const Shape& s) {
  switch (s.geometry.kind) {
    case GeometryKind::None: return makeRef<Mesh>();
    case GeometryKind::QuadXy:
    case GeometryKind::QuadXz: {
      const bool xy = s.geometry.kind == GeometryKind::QuadXy;
      return makeRef<Mesh>(makeQuadMesh(s.size.x, xy ? s.size.y : s.size.z,
                                        xy ? QuadPlane::Xy : QuadPlane::Xz, s.geometry.uv));
    }
    case GeometryKind::Box: return makeRef<Mesh>(makeBoxMesh(s.size, s.geometry.uv));
    case GeometryKind::Mesh: break;
  }
  const Vec3 scale = scaleOf(s);
  if (scale == Vec3{1, 1, 1}) return s.geometry.mesh;
  return makeRef<Mesh>(transformed(*s.geometry.mesh, scale, Frame{}));
}

Mesh meshInLocal(const Shape& s) {
  if (s.geometry.kind != GeometryKind::Mesh) {
    return transformed(*meshInScope(s), {1, 1, 1}, s.scope);
  }
  return transformed(*s.geometry.mesh, scaleOf(s), s.scope);
}

void setMesh(Shape& s, Mesh mesh, ScopeFit fit) {
  if (mesh.empty()) {
    s.geometry = {};
    return;
  }
  if (fit == ScopeFit::Refit) {
    const Box3 box = mesh.bounds();
    if (box.min != Vec3{}) {
      s.scope.origin = s.scope.point(box.min);
      moveGeometry(mesh, -box.min);
    }
    s.size = box.size();
    // Flat up to rounding is flat: the next operation should see a face as a face.
    const double extent = std::max({s.size.x, s.size.y, s.size.z});
    for (size_t i = 0; i < 3; ++i) {
      if (s.size[i] <= 1e-9 * (1 + extent)) s.size[i] = 0;
    }
  }
  const GeometryKind kind = quadKind(mesh, s.size);
  s.geometry = {kind, false, s.size, {}};
  if (kind == GeometryKind::Mesh) s.geometry.mesh = makeRef<Mesh>(std::move(mesh));
}

void setMesh(Shape& s, MeshRef mesh, ScopeFit fit) {
  if (fit == ScopeFit::Keep && mesh && !mesh->empty() && mesh->faceCount() > 1) {
    s.geometry = {GeometryKind::Mesh, false, s.size, std::move(mesh)};
  } else {
    setMesh(s, mesh ? Mesh(*mesh) : Mesh(), fit);
  }
}

void alignScope(Shape& s, const Frame& axes) {
  if (s.geometry.kind == GeometryKind::None) {
    Box3 box;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner{i & 1 ? s.size.x : 0, i & 2 ? s.size.y : 0, i & 4 ? s.size.z : 0};
      box.include(axes.toLocal(s.scope.point(corner)));
    }
    s.scope = axes;
    s.scope.origin = axes.point(box.min);
    s.size = box.size();
    return;
  }
  Mesh mesh = transformed(meshInLocal(s), {1, 1, 1}, inverse(axes));
  s.scope = axes;
  setMesh(s, std::move(mesh), ScopeFit::Refit);
}

ShapeExtra extraOf(const Shape& s) { return s.extra ? *s.extra : ShapeExtra{}; }

GeometryCounts countsOf(const Geometry& g) {
  switch (g.kind) {
    case GeometryKind::None: return {};
    case GeometryKind::QuadXy:
    case GeometryKind::QuadXz: return {1, 4, 4, 0};
    case GeometryKind::Box: return {6, 12, 8, 0};
    case GeometryKind::Mesh: break;
  }
  GeometryCounts c;
  const Mesh& m = *g.mesh;
  c.faces = static_cast<uint32_t>(m.faceCount());
  c.vertices = static_cast<uint32_t>(m.positions.size());
  for (const MeshFace& f : m.faces) c.holes += f.loopCount - 1;
  // Every undirected edge once, whatever the number of faces at it.
  std::vector<uint64_t> edges;
  edges.reserve(m.corners.size());
  for (const MeshLoop& loop : m.loops) {
    const auto ring = m.cornersOf(loop);
    for (size_t i = 0; i < ring.size(); ++i) {
      const uint64_t a = ring[i], b = ring[(i + 1) % ring.size()];
      edges.push_back(a < b ? a << 32 | b : b << 32 | a);
    }
  }
  std::sort(edges.begin(), edges.end());
  c.edges = static_cast<uint32_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
  return c;
}

}  // namespace gable
