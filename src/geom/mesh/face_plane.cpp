// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Projections of faces to the plane and back.
#include "geom/mesh/face_plane.h"

#include "base/work.h"

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
    work(loop.cornerCount);
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

}  // namespace gable
