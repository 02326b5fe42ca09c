// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/deformation.h"

#include <algorithm>
#include <cmath>

namespace gable {

namespace {

Vec3 between(const Deformation& d, Vec3 u, const DeformedSides& sides) {
  const double t = std::clamp((u[sides.axis] - sides.low) / (sides.high - sides.low), 0.0, 1.0);
  if (u[sides.frontAxis] > 0) u = scaled(u, d.front);
  if (sides.hasTop && u.y > 0) u = scaled(u, d.top);
  if (t == 0) return d.near.point(u);
  if (t == 1) return d.far.point(u);
  return d.near.point(u) * (1 - t) + d.far.point(u) * t;
}

// Corners of a loop without those that coincide with the one before.
std::vector<uint32_t> distinctCorners(const Mesh& m, const MeshLoop& loop) {
  std::vector<uint32_t> ring;
  for (uint32_t i = 0; i < loop.cornerCount; ++i) {
    const uint32_t c = loop.firstCorner + i;
    if (ring.empty() || m.at(c) != m.at(ring.back())) ring.push_back(c);
  }
  while (ring.size() > 1 && m.at(ring.front()) == m.at(ring.back())) ring.pop_back();
  return ring;
}

bool isFlat(const Mesh& m, const std::vector<uint32_t>& ring) {
  if (ring.size() < 4) return true;
  const Vec3 normal =
      normalized(cross(m.at(ring[1]) - m.at(ring[0]), m.at(ring[2]) - m.at(ring[0])));
  double extent = 0;
  for (const uint32_t c : ring) extent = std::max(extent, length(m.at(c) - m.at(ring[0])));
  return std::all_of(ring.begin(), ring.end(), [&](uint32_t c) {
    return std::fabs(dot(normal, m.at(c) - m.at(ring[0]))) <= 1e-9 * extent;
  });
}

class Rebuilder {
 public:
  explicit Rebuilder(const Mesh& from) : from_(from) {
    for (uint32_t p = 0; p < from.positions.size(); ++p) b_.copyPosition(from, p);
  }
  void addFace(size_t face) {
    const std::vector<uint32_t> ring = distinctCorners(from_, from_.loopsOf(face)[0]);
    if (ring.size() < 3) return;
    if (isFlat(from_, ring)) {
      add(face, ring);
      return;
    }
    for (size_t i = 1; i + 1 < ring.size(); ++i) add(face, {ring[0], ring[i], ring[i + 1]});
  }
  Mesh take() { return b_.take(); }

 private:
  void add(size_t face, const std::vector<uint32_t>& ring) {
    const MeshFace& f = from_.faces[face];
    b_.beginFace(f.materialSlot, f.tags, f.smooth);
    b_.beginLoop();
    for (const uint32_t c : ring) {
      const uint32_t corner = b_.addCorner(from_.corners[c]);
      for (int set = 0; set < from_.setCount(); ++set) {
        if (from_.hasUv(set)) b_.setUv(corner, set, from_.set(set)[c]);
      }
    }
  }

  const Mesh& from_;
  MeshBuilder b_;
};

bool mirrors(const Deformation& d, const Vec3& size) {
  double sign = d.near.determinant() != 0 ? d.near.determinant() : d.far.determinant();
  for (size_t i = 0; i < 3; ++i) sign *= size[i] < 0 ? -1 : 1;
  return sign < 0;
}

}  // namespace

Mesh flatFaces(const Mesh& m) {
  Rebuilder rebuilt(m);
  for (size_t f = 0; f < m.faceCount(); ++f) rebuilt.addFace(f);
  return rebuilt.take();
}

Mesh deformedMesh(const Shape& s, const Mesh& unit, const DeformedSides& sides) {
  const Deformation& d = s.extra->deformation;
  Mesh m = unit;
  // The normals of curved faces would have to be made anew.
  m.normals.clear();
  for (Vec3& p : m.positions) p = scaled(between(d, p, sides), s.size);
  Mesh out = flatFaces(m);
  if (mirrors(d, s.size)) {
    for (size_t f = 0; f < out.faceCount(); ++f) reverseFace(out, f);
  }
  return out;
}

void bakeDeformation(Shape& s) {
  const Deformation d = s.extra->deformation;
  ShapeExtra extra = extraOf(s);
  if (s.geometry.kind != GeometryKind::None) {
    // The geometry at unit size, whatever its size was.
    Mesh unit = *meshInScope(s);
    for (Vec3& p : unit.positions) {
      for (size_t i = 0; i < 3; ++i) p[i] = s.size[i] != 0 ? p[i] / s.size[i] : 0;
    }
    setMesh(s, deformedMesh(s, unit, {}), ScopeFit::Refit);
  } else {
    const auto image = [&](const Vec3& v) { return s.scope.direction(scaled(v, s.size)); };
    const Vec3 x = image(d.near.x), y = image(d.near.y), z = image(d.near.z);
    const Vec3 origin = s.scope.point(scaled(d.near.origin, s.size));
    s.scope = frameFromZ(origin, length(z) > 0 ? z : cross(x, y), x);
    s.size = {length(x), length(y), length(z)};
  }
  extra.deformed = false;
  extra.deformation = {};
  const bool empty = extra.trim.empty() && extra.projections.empty();
  s.extra = empty ? Ref<ShapeExtra>() : makeRef<ShapeExtra>(extra);
}

}  // namespace gable
