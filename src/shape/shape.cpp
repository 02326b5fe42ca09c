// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/hash.h"

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

// No attribute that a primitive could not carry.
bool plainMesh(const Mesh& m) {
  if (!m.normals.empty() || !m.vertexTags.empty()) return false;
  if (m.faceCount() > 1 &&
      std::any_of(m.edgeTags.begin(), m.edgeTags.end(), [](uint32_t t) { return t != 0; })) {
    return false;
  }
  for (int set = 0; set < m.setCount(); ++set) {
    if (m.hasUv(set)) return false;
  }
  for (const MeshFace& f : m.faces) {
    if (f.materialSlot != 0 || f.smooth || f.loopCount != 1) return false;
  }
  return true;
}

constexpr std::array<BoxFace, 6> kCubeFaces{{{{0, 1, 2, 3}, kSideBottom},
                                             {{7, 6, 5, 4}, kSideTop},
                                             {{3, 2, 6, 7}, kSideFront},
                                             {{2, 1, 5, 6}, kSideRight},
                                             {{1, 0, 4, 5}, kSideBack},
                                             {{0, 3, 7, 4}, kSideLeft}}};
// The ring 3 2 1 0 of a QuadXz, turned round at the bottom, then a side an edge, then the top.
constexpr std::array<BoxFace, 6> kExtrudedFaces{{{{3, 0, 1, 2}, kSideBottom},
                                                 {{3, 2, 6, 7}, kSideFront},
                                                 {{2, 1, 5, 6}, kSideRight},
                                                 {{1, 0, 4, 5}, kSideBack},
                                                 {{0, 3, 7, 4}, kSideLeft},
                                                 {{7, 6, 5, 4}, kSideTop}}};

Vec3 boxPosition(uint32_t i, const Vec3& size) {
  const uint32_t around = i % 4;
  return {around == 1 || around == 2 ? size.x : 0, i >= 4 ? size.y : 0,
          around == 2 || around == 3 ? size.z : 0};
}

bool samePoint(const Vec3& a, const Vec3& b, const Vec3& size) {
  return same(a.x, b.x, size.x) && same(a.y, b.y, size.y) && same(a.z, b.z, size.z);
}

// The rectangle covering the scope in the order of makeQuadMesh. Other starting corners of the
// ring stay meshes: edge indices are visible to rules.
GeometryKind quadKind(const std::array<Vec3, 4>& corners, const Vec3& size) {
  if (size.x <= 0) return GeometryKind::Mesh;
  const auto matches = [&](const Vec3(&ring)[4]) {
    for (size_t i = 0; i < 4; ++i) {
      if (!samePoint(corners[i], ring[i], size)) return false;
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

bool isBox(const Mesh& m, const Vec3& size, BoxOrder order) {
  if (m.corners.size() != 24 || m.positions.size() != 8) return false;
  if (size.x <= 0 || size.y <= 0 || size.z <= 0) return false;
  const auto& faces = boxFaces(order);
  for (size_t f = 0; f < 6; ++f) {
    const MeshLoop& loop = m.loopsOf(f)[0];
    if (loop.cornerCount != 4) return false;
    for (uint32_t i = 0; i < 4; ++i) {
      const Vec3 expected = boxPosition(faces[f].ring[i], size);
      if (!samePoint(m.at(loop.firstCorner + i), expected, size)) return false;
    }
  }
  return true;
}

bool isPlainQuad(const Mesh& m) {
  return m.faceCount() == 1 && m.corners.size() == 4 && plainMesh(m);
}

// A rectangle with the tags of a face with four corners.
Geometry quadOf(GeometryKind kind, const Mesh& face) {
  Geometry g = primitive(kind, face.faces[0].tags);
  for (size_t i = 0; i < face.edgeTags.size(); ++i) g.tags[quadEdges(kind)[i]] = face.edgeTags[i];
  return g;
}

// The primitive that a mesh is exactly, or a geometry of kind Mesh without the mesh.
Geometry recognised(const Mesh& m, const Vec3& size) {
  Geometry g{GeometryKind::Mesh, false, size, {}};
  if (isPlainQuad(m)) {
    const GeometryKind kind = quadKind({m.at(0), m.at(1), m.at(2), m.at(3)}, size);
    return kind == GeometryKind::Mesh ? g : quadOf(kind, m);
  }
  if (!plainMesh(m)) return g;
  if (m.faceCount() != 6) return g;
  for (const BoxOrder order : {BoxOrder::Cube, BoxOrder::Extruded}) {
    if (!isBox(m, size, order)) continue;
    g.kind = GeometryKind::Box;
    g.order = order;
    g.refSize = {};
    for (size_t f = 0; f < 6; ++f) g.tags[boxFaces(order)[f].side] = m.faces[f].tags;
    break;
  }
  return g;
}

// A primitive of negative size is the mirrored one, which still looks outward.
void turnIfMirrored(Mesh& m, const Vec3& size) {
  if (((size.x < 0) != (size.y < 0)) == (size.z < 0)) return;
  for (size_t f = 0; f < m.faceCount(); ++f) reverseFace(m, f);
}

Mesh boxMesh(const Geometry& g, const Vec3& size) {
  Mesh m = makeBoxMesh(size, g.uv);
  const auto& faces = boxFaces(g.order);
  for (size_t f = 0; f < 6; ++f) {
    const MeshLoop& loop = m.loopsOf(f)[0];
    for (uint32_t i = 0; i < 4; ++i) m.corners[loop.firstCorner + i] = faces[f].ring[i];
    m.faces[f].tags = g.tags[faces[f].side];
  }
  turnIfMirrored(m, size);
  return m;
}

Mesh quadMesh(const Geometry& g, const Vec3& size) {
  const bool xy = g.kind == GeometryKind::QuadXy;
  Mesh m = makeQuadMesh(size.x, xy ? size.y : size.z, xy ? QuadPlane::Xy : QuadPlane::Xz, g.uv);
  m.faces[0].tags = g.tags[xy ? kSideFront : kSideTop];
  if (hasEdgeTags(g)) {
    for (const BoxSide side : quadEdges(g.kind)) m.edgeTags.push_back(g.tags[side]);
  }
  turnIfMirrored(m, size);
  return m;
}

void moveGeometry(Mesh& m, const Vec3& by) {
  for (Vec3& p : m.positions) p += by;
}

// The size of a scope around its content.
Vec3 sizeAround(const Box3& box) {
  Vec3 size = box.size();
  // Flat up to rounding is flat: the next operation should see a face as a face.
  const double extent = std::max({size.x, size.y, size.z});
  for (size_t i = 0; i < 3; ++i) {
    if (size[i] <= 1e-9 * (1 + extent)) size[i] = 0;
  }
  return size;
}

// As setMesh() does it for a face that is a rectangle in the scope, without a mesh of its own: many
// initial shapes are such. False, and nothing done, where it is none.
bool setQuad(Shape& s, const Mesh& face, const Frame& toScope) {
  if (!isPlainQuad(face) || face.positions.size() != 4) return false;
  std::array<Vec3, 4> corners;
  Box3 box;
  for (uint32_t i = 0; i < 4; ++i) box.include(corners[i] = toScope.point(face.at(i)));
  const Vec3 size = sizeAround(box);
  for (Vec3& p : corners) p += -box.min;
  const GeometryKind kind = quadKind(corners, size);
  if (kind == GeometryKind::Mesh) return false;
  if (box.min != Vec3{}) s.scope.origin = s.scope.point(box.min);
  s.size = size;
  s.geometry = quadOf(kind, face);
  return true;
}

}  // namespace

const std::array<BoxFace, 6>& boxFaces(BoxOrder order) {
  return order == BoxOrder::Cube ? kCubeFaces : kExtrudedFaces;
}

const std::array<BoxSide, 4>& quadEdges(GeometryKind quad) {
  static constexpr std::array<BoxSide, 4> kXy{kSideBottom, kSideRight, kSideTop, kSideLeft};
  static constexpr std::array<BoxSide, 4> kXz{kSideFront, kSideRight, kSideBack, kSideLeft};
  return quad == GeometryKind::QuadXy ? kXy : kXz;
}

bool hasEdgeTags(const Geometry& quad) {
  const auto& edges = quadEdges(quad.kind);
  return std::any_of(edges.begin(), edges.end(),
                     [&](BoxSide side) { return quad.tags[side] != 0; });
}

uint64_t contentHash(const Geometry& g) {
  uint64_t h =
      hashCombine(static_cast<uint64_t>(g.kind) << 16 | static_cast<uint64_t>(g.order) << 8,
                  (g.uv ? 1u : 0u) | (g.instanced ? 2u : 0u));
  for (size_t i = 0; i < g.tags.size(); i += 2) {
    h = hashCombine(h, uint64_t{g.tags[i]} << 32 | g.tags[i + 1]);
  }
  // A primitive fills the scope whatever the scope was when it was made.
  if (g.kind != GeometryKind::Mesh) return h;
  for (size_t i = 0; i < 3; ++i) h = hashCombine(h, hashDouble(g.refSize[i]));
  return hashCombine(h, g.mesh->sharedHash());
}

Geometry primitive(GeometryKind kind, uint32_t tags) {
  Geometry g{kind, false, {}, {}};
  if (kind == GeometryKind::Box) g.tags.fill(tags);
  if (kind == GeometryKind::QuadXy) g.tags[kSideFront] = tags;
  if (kind == GeometryKind::QuadXz) g.tags[kSideTop] = tags;
  return g;
}

MeshRef meshInScope(const Shape& s) {
  switch (s.geometry.kind) {
    case GeometryKind::None: return makeRef<Mesh>();
    case GeometryKind::QuadXy:
    case GeometryKind::QuadXz: return makeRef<Mesh>(quadMesh(s.geometry, s.size));
    case GeometryKind::Box: return makeRef<Mesh>(boxMesh(s.geometry, s.size));
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
    s.size = sizeAround(box);
  }
  // All or nothing: memory may be refused.
  Geometry made = recognised(mesh, s.size);
  if (made.kind == GeometryKind::Mesh) made.mesh = makeRef<Mesh>(std::move(mesh));
  s.geometry = std::move(made);
}

void setMesh(Shape& s, MeshRef mesh, ScopeFit fit) {
  if (fit == ScopeFit::Keep && mesh && !mesh->empty()) {
    s.geometry = recognised(*mesh, s.size);
    if (s.geometry.kind == GeometryKind::Mesh) s.geometry.mesh = std::move(mesh);
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

void setInitialGeometry(Shape& s, const Mesh& mesh) {
  Frame axes;
  if (mesh.faceCount() == 1 && mesh.loops[0].cornerCount >= 3) {
    const Vec3 up = mesh.normal(0);
    const Vec3 edge = mesh.at(1) - mesh.at(0);
    // frameFromZ gives x along the hint and z along the normal; y of the scope is that normal.
    const Frame f = frameFromZ({}, up, edge);
    if (up != Vec3{}) axes = Frame::of({}, f.x, f.z, cross(f.x, f.z));
  }
  s.scope = axes;
  const Frame toScope = inverse(axes);
  if (!mesh.empty() && !setQuad(s, mesh, toScope)) {
    setMesh(s, transformed(mesh, {1, 1, 1}, toScope), ScopeFit::Refit);
  }
  s.pivot = s.scope;
  if (mesh.faceCount() > 0) s.pivot.origin = mesh.at(0);
}

const UvProjection* ShapeExtra::projection(int set) const {
  for (const UvProjection& p : projections) {
    if (p.set == set) return &p;
  }
  return nullptr;
}

void ShapeExtra::setProjection(const UvProjection& p) {
  const auto at = std::lower_bound(projections.begin(), projections.end(), p.set,
                                   [](const UvProjection& q, int set) { return q.set < set; });
  if (at != projections.end() && at->set == p.set)
    *at = p;
  else
    projections.insert(at, p);
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
