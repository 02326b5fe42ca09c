// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Measures and normals declared in mesh/topology.h. The volume is the divergence theorem over fans
// of each loop.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/mesh/topology.h"
#include "math/trig.h"

namespace gable {
namespace {

// Turns below this angle (degrees) count as straight.
constexpr double kStraight = 0.01;

// Angle from the direction before a corner to the one after it.
double angleBetween(const Vec3& a, const Vec3& b) {
  return atan2Deg(length(cross(a, b)), dot(a, b));
}

template <class Test>
bool allFaces(const Mesh& m, const Test& test) {
  for (size_t f = 0; f < m.faces.size(); ++f) {
    if (!test(f)) return false;
  }
  return !m.faces.empty();
}

Vec3 edgeBefore(const Mesh& m, const MeshLoop& loop, uint32_t i) {
  const uint32_t n = loop.cornerCount;
  return m.at(loop.firstCorner + i) - m.at(loop.firstCorner + (i + n - 1) % n);
}

Vec3 edgeAfter(const Mesh& m, const MeshLoop& loop, uint32_t i) {
  return m.at(loop.firstCorner + (i + 1) % loop.cornerCount) - m.at(loop.firstCorner + i);
}

}  // namespace

double volume(const Mesh& m) {
  if (m.positions.empty()) return 0;
  const Vec3 origin = m.positions[0];
  double six = 0;
  for (const MeshFace& f : m.faces) {
    for (uint32_t l = f.firstLoop; l < f.firstLoop + f.loopCount; ++l) {
      work();
      const MeshLoop& loop = m.loops[l];
      const Vec3 a = m.at(loop.firstCorner) - origin;
      for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
        const Vec3 b = m.at(loop.firstCorner + i) - origin;
        const Vec3 c = m.at(loop.firstCorner + i + 1) - origin;
        six += dot(a, cross(b, c));
      }
    }
  }
  return six / 6;
}

double boundaryLength(const Mesh& m) {
  const Topology t(m);
  double sum = 0;
  for (uint32_t e = 0; e < t.edgeCount(); ++e) {
    const uint32_t c = t.usesOf(e)[0];
    if (t.isBoundary(e)) sum += length(m.at(t.next(c)) - m.at(c));
  }
  return sum;
}

size_t holeCount(const Mesh& m) {
  size_t n = 0;
  for (const MeshFace& f : m.faces) n += f.loopCount - 1;
  return n;
}

size_t edgeCount(const Mesh& m) { return Topology(m).edgeCount(); }

bool isConcave(const Mesh& m, size_t face) {
  if (m.faces[face].loopCount > 1) return true;
  const Vec3 normal = m.normal(face);
  const MeshLoop& loop = m.loopsOf(face)[0];
  for (uint32_t i = 0; i < loop.cornerCount; ++i) {
    const Vec3 a = edgeBefore(m, loop, i), b = edgeAfter(m, loop, i);
    if (dot(cross(a, b), normal) < 0 && angleBetween(a, b) > kStraight) return true;
  }
  return false;
}

bool isConcave(const Mesh& m) {
  for (size_t f = 0; f < m.faces.size(); ++f) {
    if (isConcave(m, f)) return true;
  }
  return false;
}

bool isPlanar(const Mesh& m, size_t face, double tolerance) {
  const Vec3 normal = m.normal(face);
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const Vec3 a = edgeBefore(m, loop, i), b = edgeAfter(m, loop, i);
      const double turn = angleBetween(a, b);
      // Straight corners have no normal of their own.
      if (turn < kStraight || turn > 180 - kStraight) continue;
      const double off = angleBetween(normal, cross(a, b));
      if (std::min(off, 180 - off) > tolerance) return false;
    }
  }
  return true;
}

bool isPlanar(const Mesh& m, double tolerance) {
  return allFaces(m, [&](size_t f) { return isPlanar(m, f, tolerance); });
}

bool isRectangular(const Mesh& m, size_t face, double tolerance) {
  const MeshLoop& loop = m.loopsOf(face)[0];
  if (m.faces[face].loopCount != 1 || loop.cornerCount != 4) return false;
  for (uint32_t i = 0; i < 4; ++i) {
    const double turn = angleBetween(edgeBefore(m, loop, i), edgeAfter(m, loop, i));
    if (std::fabs(turn - 90) > tolerance) return false;
  }
  return true;
}

bool isRectangular(const Mesh& m, double tolerance) {
  return allFaces(m, [&](size_t f) { return isRectangular(m, f, tolerance); });
}

namespace {

// The angle of the face at a corner: how much of the neighbourhood it fills.
double cornerAngle(const Mesh& m, const MeshLoop& loop, uint32_t i, const Vec3& normal) {
  const Vec3 in = edgeBefore(m, loop, i), out = edgeAfter(m, loop, i);
  const double turn = angleBetween(in, out);
  return dot(cross(in, out), normal) >= 0 ? 180 - turn : 180 + turn;
}

template <class Visit>
void forCorners(const Mesh& m, const Visit& visit) {
  for (size_t f = 0; f < m.faces.size(); ++f) {
    const Vec3 normal = m.normal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      work(loop.cornerCount);
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        visit(loop.firstCorner + i, normal * cornerAngle(m, loop, i, normal));
      }
    }
  }
}

}  // namespace

std::vector<Vec3> vertexNormals(const Mesh& m) {
  std::vector<Vec3> sums(m.positions.size());
  forCorners(m, [&](uint32_t c, const Vec3& part) { sums[m.corners[c]] += part; });
  for (Vec3& n : sums) n = normalized(n);
  return sums;
}

// Corners around a position fall into groups joined by soft edges; each group has one normal.
void softenNormals(Mesh& m, double angle) {
  const Topology t(m);
  std::vector<uint32_t> group(m.corners.size());
  for (uint32_t c = 0; c < group.size(); ++c) group[c] = c;
  const auto rootOf = [&](uint32_t c) {
    while (group[c] != c) c = group[c] = group[group[c]];
    return c;
  };
  for (uint32_t e = 0; e < t.edgeCount(); ++e) {
    work(4);
    const uint32_t a = t.usesOf(e)[0], b = t.twin(a);
    if (b == Topology::kNone) continue;
    const double sharp = std::fabs(t.dihedralAngle(e));
    if (sharp >= angle) continue;
    group[rootOf(a)] = rootOf(t.next(b));
    group[rootOf(t.next(a))] = rootOf(b);
  }
  std::vector<Vec3> sums(m.corners.size());
  forCorners(m, [&](uint32_t c, const Vec3& part) { sums[rootOf(c)] += part; });
  m.normals.assign(m.corners.size(), Vec3{});
  for (uint32_t c = 0; c < m.corners.size(); ++c) m.normals[c] = normalized(sums[rootOf(c)]);
}

}  // namespace gable
