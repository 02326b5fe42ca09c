// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Points are classified by the generalised winding number (Jacobson, Kavan, Sorkine 2013, with the
// solid angle of Van Oosterom and Strackee 1983), which needs no ray and no special cases. Box
// distance is by alternating projection, which ends at the nearest pair of two convex sets.

#include "runtime/solid_tests.h"

#include <algorithm>
#include <cmath>

#include "geom/mesh/face_triangles.h"
#include "geom/mesh/topology.h"
#include "math/trig.h"

namespace gable {

namespace {

using Tri = std::array<Vec3, 3>;

double solidAngle(const Tri& t, const Vec3& p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double det = dot(a, cross(b, c));
  const double den = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * toRadians(atan2Deg(det, den));
}

Vec3 closestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double l = dot(d, d);
  return l > 0 ? a + d * std::clamp(dot(p - a, d) / l, 0.0, 1.0) : a;
}

double distanceToTriangle(const Vec3& p, const Tri& t) {
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool inside = n != Vec3{};
  for (size_t i = 0; i < 3 && inside; ++i) {
    inside = dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) >= 0;
  }
  if (inside) return std::fabs(dot(p - t[0], n));
  double best = length(p - closestOnSegment(p, t[0], t[1]));
  best = std::min(best, length(p - closestOnSegment(p, t[1], t[2])));
  return std::min(best, length(p - closestOnSegment(p, t[2], t[0])));
}

enum class Place { Outside, Surface, Inside };

Place placeOf(const Vec3& p, const TriangleSoup& solid) {
  double angle = 0;
  for (const Tri& t : solid.triangles) {
    if (distanceToTriangle(p, t) <= kContactTolerance) return Place::Surface;
    angle += solidAngle(t, p);
  }
  return std::fabs(angle) > 2 * kPi ? Place::Inside : Place::Outside;
}

// The edge p-q passes through the triangle, more than touching it on both sides.
bool pierces(const Vec3& p, const Vec3& q, const Tri& t) {
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  const double dp = dot(p - t[0], n), dq = dot(q - t[0], n);
  if (!((dp > kContactTolerance && dq < -kContactTolerance) ||
        (dp < -kContactTolerance && dq > kContactTolerance))) {
    return false;
  }
  const Vec3 x = p + (q - p) * (dp / (dp - dq));
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 edge = t[(i + 1) % 3] - t[i];
    // Strictly inside by more than the tolerance, measured from each edge.
    if (dot(cross(edge, x - t[i]), n) <= kContactTolerance * length(edge)) return false;
  }
  return true;
}

bool near(const Box3& a, const Box3& b) {
  for (size_t i = 0; i < 3; ++i) {
    if (a.min[i] > b.max[i] + kContactTolerance || b.min[i] > a.max[i] + kContactTolerance) {
      return false;
    }
  }
  return true;
}

Box3 boxOf(const Tri& t) {
  Box3 b;
  for (const Vec3& p : t) b.include(p);
  return b;
}

bool pierceEachOther(const TriangleSoup& a, const TriangleSoup& b) {
  for (const Tri& s : a.triangles) {
    const Box3 box = boxOf(s);
    if (!near(box, b.box)) continue;
    for (const Tri& t : b.triangles) {
      if (!near(box, boxOf(t))) continue;
      for (size_t i = 0; i < 3; ++i) {
        if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) return true;
      }
    }
  }
  return false;
}

// Points that lie off the surface of `a` on its inner side tell overlap even where faces coincide.
bool hasPointInside(const TriangleSoup& a, const TriangleSoup& solid) {
  for (const Tri& t : a.triangles) {
    const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
    const Vec3 middle = (t[0] + t[1] + t[2]) * (1.0 / 3);
    const Vec3 probe = a.closed ? middle - n * (4 * kContactTolerance) : middle;
    if (placeOf(probe, solid) == Place::Inside) return true;
    if (placeOf(t[0], solid) == Place::Inside) return true;
  }
  return false;
}

// Clips a polygon to the inner side of a line in the plane of n.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& a, const Vec3& b,
                          const Vec3& n) {
  const Vec3 inward = cross(n, b - a);
  std::vector<Vec3> out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[(i + 1) % polygon.size()];
    const double dp = dot(p - a, inward), dq = dot(q - a, inward);
    if (dp >= 0) out.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) out.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return out;
}

bool lieOnEachOther(const Tri& s, const Tri& t) {
  const Vec3 n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  for (const Vec3& p : s) {
    if (std::fabs(dot(p - t[0], n)) > kContactTolerance) return false;
  }
  std::vector<Vec3> common(s.begin(), s.end());
  for (size_t i = 0; i < 3 && !common.empty(); ++i) {
    common = clipped(common, t[i], t[(i + 1) % 3], n);
  }
  Vec3 area;
  for (size_t i = 1; i + 1 < common.size(); ++i) {
    area += cross(common[i] - common[0], common[i + 1] - common[0]);
  }
  return length(area) > kContactTolerance * kContactTolerance * 2;
}

}  // namespace

TriangleSoup soupOf(const Mesh& m) {
  TriangleSoup s;
  FaceTriangulator faces;
  std::vector<std::array<uint32_t, 3>> corners;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    corners.clear();
    faces.add(m, f, corners);
    for (const auto& t : corners) s.triangles.push_back({m.at(t[0]), m.at(t[1]), m.at(t[2])});
  }
  for (const Tri& t : s.triangles) {
    for (const Vec3& p : t) s.box.include(p);
  }
  s.closed = !m.empty() && Topology(m).closed();
  return s;
}

bool insideSolid(const TriangleSoup& a, const TriangleSoup& solid) {
  if (!near(a.box, solid.box) || a.triangles.empty()) return false;
  for (const Tri& t : a.triangles) {
    for (const Vec3& p : t) {
      if (placeOf(p, solid) == Place::Outside) return false;
    }
    if (placeOf((t[0] + t[1] + t[2]) * (1.0 / 3), solid) == Place::Outside) return false;
  }
  return !pierceEachOther(a, solid);
}

bool overlapsSolid(const TriangleSoup& a, const TriangleSoup& solid) {
  if (!near(a.box, solid.box)) return false;
  if (pierceEachOther(a, solid) || hasPointInside(a, solid)) return true;
  return a.closed && hasPointInside(solid, a);
}

bool touchesSolid(const TriangleSoup& a, const TriangleSoup& solid) {
  if (!near(a.box, solid.box)) return false;
  if (overlapsSolid(a, solid)) return true;
  for (const Tri& s : a.triangles) {
    for (const Tri& t : solid.triangles) {
      if (near(boxOf(s), boxOf(t)) && lieOnEachOther(s, t)) return true;
    }
  }
  return false;
}

double boxDistance(const Frame& a, const Vec3& aSize, const Frame& b, const Vec3& bSize) {
  const auto project = [](const Vec3& p, const Frame& f, const Vec3& size) {
    Vec3 q = f.toLocal(p);
    for (size_t i = 0; i < 3; ++i) {
      q[i] = std::clamp(q[i], std::min(0.0, size[i]), std::max(0.0, size[i]));
    }
    return f.point(q);
  };
  constexpr int kMostSteps = 500;
  Vec3 p = a.point(aSize * 0.5), q;
  double last = -1;
  for (int step = 0; step < kMostSteps; ++step) {
    q = project(p, b, bSize);
    p = project(q, a, aSize);
    const double d = length(p - q);
    if (last >= 0 && last - d < 1e-9) return d;
    last = d;
  }
  return last;
}

}  // namespace gable
