// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Projections of faces to the plane and back.
#include "geom/mesh/face_plane.h"

#include <cmath>

namespace gable {

Frame faceFrame(const Mesh& m, size_t face) {
  const MeshLoop& loop = m.loopsOf(face)[0];
  const Vec3 origin = m.at(loop.firstCorner);
  const Vec3 normal = m.normal(face);
  if (normal == Vec3{}) return Frame::moved(origin);
  Vec3 x;
  for (uint32_t i = 0; i < loop.cornerCount && x == Vec3{}; ++i) {
    x = m.at(loop.firstCorner + (i + 1) % loop.cornerCount) - m.at(loop.firstCorner + i);
  }
  return frameFromZ(origin, normal, x);
}

Polygon facePolygon(const Mesh& m, size_t face, const Frame& frame) {
  Polygon p;
  bool outer = true;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    Ring ring;
    for (const uint32_t position : m.cornersOf(loop)) {
      const Vec3 local = frame.toLocal(m.positions[position]);
      ring.push_back({local.x, local.y});
    }
    if (outer) {
      p.outer = std::move(ring);
    } else {
      p.holes.push_back(std::move(ring));
    }
    outer = false;
  }
  return p;
}

void addFace(MeshBuilder& b, const Polygon& p, const Frame& frame, uint16_t materialSlot,
             uint32_t tags) {
  b.beginFace(materialSlot, tags);
  const auto addLoop = [&](const Ring& r) {
    b.beginLoop();
    for (const Vec2 v : r) b.addCorner(b.addPosition(frame.point({v.x, v.y, 0})));
  };
  addLoop(p.outer);
  for (const Ring& h : p.holes) addLoop(h);
}

Mesh meshOf(const Region& r, const Frame& frame) {
  MeshBuilder b;
  for (const Polygon& p : r) addFace(b, p, frame);
  return b.take();
}

void triangulateFace(const Mesh& m, size_t face, std::vector<Triangle>& out) {
  const Vec3 n = m.areaNormal(face);
  const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
  if (!(ax + ay + az > 0)) return;
  // The two axes across the greatest one, in the order that keeps the face counter-clockwise.
  const size_t across = ax > ay && ax > az ? 0 : (ay > az ? 1 : 2);
  size_t u = (across + 1) % 3, v = (across + 2) % 3;
  if (n[across] < 0) std::swap(u, v);
  std::vector<Vec2> points;
  std::vector<uint32_t> ends;
  const uint32_t first = m.loopsOf(face)[0].firstCorner;
  bool contiguous = true;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    contiguous = contiguous && loop.firstCorner == first + points.size();
    for (const uint32_t position : m.cornersOf(loop)) {
      points.push_back({m.positions[position][u], m.positions[position][v]});
    }
    ends.push_back(static_cast<uint32_t>(points.size()));
  }
  std::vector<uint32_t> names;
  if (!contiguous) {
    for (const MeshLoop& loop : m.loopsOf(face)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) names.push_back(loop.firstCorner + i);
    }
  }
  const size_t begin = out.size();
  triangulate(points, ends, out);
  for (size_t t = begin; t < out.size(); ++t) {
    for (uint32_t& i : out[t]) i = contiguous ? first + i : names[i];
  }
}

}  // namespace gable
