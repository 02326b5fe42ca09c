// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rings of points are made once and shared by the faces above and below them.
#include "geom/primitive/solids.h"

#include <vector>

#include "math/trig.h"

namespace gable {

namespace {

double angleOf(double step, uint32_t sides) { return 360.0 * step / sides; }

Vec3 onCircle(double degrees, double y) { return {cosDeg(degrees), y, -sinDeg(degrees)}; }

std::vector<uint32_t> addRing(MeshBuilder& b, uint32_t sides, double radius, double y) {
  std::vector<uint32_t> ring;
  for (uint32_t i = 0; i < sides; ++i) {
    const Vec3 p = onCircle(angleOf(i, sides), 0);
    ring.push_back(b.addPosition({p.x * radius, y, p.z * radius}));
  }
  return ring;
}

void addCorner(MeshBuilder& b, uint32_t position, Vec2 uv, const Vec3& normal) {
  const uint32_t corner = b.addCorner(position);
  b.setUv(corner, 0, uv);
  b.setNormal(corner, normal);
}

// A cap: seen from its normal side the picture is upright for the top and mirrored for the bottom,
// so that text reads right on both.
void addCap(MeshBuilder& b, const std::vector<uint32_t>& ring, bool up) {
  b.beginFace();
  b.beginLoop();
  const size_t n = ring.size();
  for (size_t i = 0; i < n; ++i) {
    const uint32_t p = ring[up ? i : (n - i) % n];
    const Vec3 at = b.mesh().positions[p];
    addCorner(b, p, {(1 + at.x) / 2, (1 + (up ? -at.z : at.z)) / 2}, {0, up ? 1.0 : -1.0, 0});
  }
}

}  // namespace

Mesh makeDisk(uint32_t sides) {
  MeshBuilder b;
  addCap(b, addRing(b, sides, 1, 0), true);
  Mesh m = b.take();
  // A flat face needs no normals of its own.
  m.normals.clear();
  return m;
}

Mesh makeCylinder(uint32_t sides) {
  MeshBuilder b;
  const auto low = addRing(b, sides, 1, 0), high = addRing(b, sides, 1, 1);
  addCap(b, low, false);
  addCap(b, high, true);
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t j = (i + 1) % sides;
    const double u = double(i) / sides, v = double(i + 1) / sides;
    const Vec3 here = onCircle(angleOf(i, sides), 0), there = onCircle(angleOf(i + 1, sides), 0);
    b.beginFace();
    b.beginLoop();
    addCorner(b, low[i], {u, 0}, here);
    addCorner(b, low[j], {v, 0}, there);
    addCorner(b, high[j], {v, 1}, there);
    addCorner(b, high[i], {u, 1}, here);
  }
  return b.take();
}

Mesh makeCone(uint32_t sides) {
  MeshBuilder b;
  const auto low = addRing(b, sides, 1, 0);
  const uint32_t apex = b.addPosition({0, 1, 0});
  addCap(b, low, false);
  // The slope of a cone of radius 1 and height 1.
  const auto normalAt = [&](double step) { return normalized(onCircle(angleOf(step, sides), 1)); };
  for (uint32_t i = 0; i < sides; ++i) {
    b.beginFace();
    b.beginLoop();
    addCorner(b, low[i], {double(i) / sides, 0}, normalAt(i));
    addCorner(b, low[(i + 1) % sides], {double(i + 1) / sides, 0}, normalAt(i + 1));
    addCorner(b, apex, {(i + 0.5) / sides, 1}, normalAt(i + 0.5));
  }
  return b.take();
}

Mesh makeSphere(uint32_t sides, uint32_t divisions) {
  MeshBuilder b;
  const uint32_t south = b.addPosition({0, -1, 0}), north = b.addPosition({0, 1, 0});
  std::vector<std::vector<uint32_t>> rings;
  for (uint32_t k = 1; k < divisions; ++k) {
    const double latitude = 180.0 * k / divisions - 90;
    rings.push_back(addRing(b, sides, cosDeg(latitude), sinDeg(latitude)));
  }
  // Each point of a unit sphere is its own normal.
  const auto corner = [&](uint32_t position, double step, uint32_t k) {
    addCorner(b, position, {step / sides, double(k) / divisions}, b.mesh().positions[position]);
  };
  for (uint32_t k = 0; k < divisions; ++k) {
    for (uint32_t i = 0; i < sides; ++i) {
      const uint32_t j = (i + 1) % sides;
      b.beginFace();
      b.beginLoop();
      if (k == 0) {
        corner(south, i + 0.5, 0);
      } else {
        corner(rings[k - 1][i], i, k);
        corner(rings[k - 1][j], i + 1, k);
      }
      if (k + 1 == divisions) {
        corner(north, i + 0.5, divisions);
      } else {
        corner(rings[k][j], i + 1, k + 1);
        corner(rings[k][i], i, k + 1);
      }
    }
  }
  return b.take();
}

}  // namespace gable
