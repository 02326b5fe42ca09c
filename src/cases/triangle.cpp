// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The nearest points of two triangles that do not cross lie on two edges, or on a corner and a
// face. Nearest points as in C. Ericson, Real-Time Collision Detection, 5.1.5 and 5.1.9.

#include "cases/triangle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gable::cases {
namespace {

// Faces that look the same way differ by less than a tenth of a degree.
constexpr double kSameWay = 1 - 1.5e-6;

double squared(const Vec3& v) { return dot(v, v); }

double squaredDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = squared(along);
  const double t = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
  return squared(a + along * t - p);
}

// Of two segments; where they are parallel an end is as near as any point.
double squaredDistance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double turn = uu * vv - uv * uv;
  double least = std::min({squaredDistance(a, c, d), squaredDistance(b, c, d),
                           squaredDistance(c, a, b), squaredDistance(d, a, b)});
  if (turn <= 1e-12 * uu * vv) return least;
  const double s = (uv * vw - vv * uw) / turn, t = (uu * vw - uv * uw) / turn;
  if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, squared(w + u * s - v * t));
  return least;
}

// A side of an edge is told by the sign of a volume; the sum of squares does not overflow there.
bool projectsInto(const Vec3& p, const Triangle& t, const Vec3& normal) {
  for (size_t i = 0; i < 3; ++i) {
    if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) < 0) return false;
  }
  return true;
}

Vec3 areaNormal(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

// Whether a corner or an edge of `a` reaches the face of `b`.
bool reachesFace(const Triangle& a, const Triangle& b, const Vec3& normal, double gap) {
  for (size_t i = 0; i < 3; ++i) {
    const double height = dot(a[i] - b[0], normal);
    if (std::fabs(height) <= gap && projectsInto(a[i], b, normal)) return true;
    if (pierced(a[i], a[(i + 1) % 3], b)) return true;
  }
  return false;
}

// All of `a` lies further than `gap` before the plane of `b`, or further behind it.
bool besidePlane(const Triangle& a, const Triangle& b, const Vec3& normal, double gap) {
  const double h0 = dot(a[0] - b[0], normal), h1 = dot(a[1] - b[0], normal),
               h2 = dot(a[2] - b[0], normal);
  return std::min({h0, h1, h2}) > gap || std::max({h0, h1, h2}) < -gap;
}

// What of a polygon lies to the left of the line from a to b.
void clip(std::vector<Vec2>& polygon, Vec2 a, Vec2 b, std::vector<Vec2>& out) {
  out.clear();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double from = cross(b - a, p - a), to = cross(b - a, q - a);
    if (from >= 0) out.push_back(p);
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
      out.push_back(p + (q - p) * (from / (from - to)));
    }
  }
  std::swap(polygon, out);
}

}  // namespace

Box3 boundsOf(const Triangle& t) {
  Box3 box;
  for (const Vec3& p : t) box.include(p);
  return box;
}

std::optional<double> pierced(const Vec3& a, const Vec3& b, const Triangle& t) {
  const Vec3 normal = areaNormal(t);
  const double from = dot(a - t[0], normal), to = dot(b - t[0], normal);
  if ((from > 0) == (to > 0)) return std::nullopt;
  const double at = from / (from - to);
  if (!projectsInto(a + (b - a) * at, t, normal)) return std::nullopt;
  return at;
}

double distance(const Vec3& p, const Triangle& t) {
  const Vec3 normal = normalized(areaNormal(t));
  if (projectsInto(p, t, normal)) return std::fabs(dot(p - t[0], normal));
  return std::sqrt(std::min({squaredDistance(p, t[0], t[1]), squaredDistance(p, t[1], t[2]),
                             squaredDistance(p, t[2], t[0])}));
}

bool withinReach(const Triangle& a, const Triangle& b, double gap) {
  const Vec3 na = normalized(areaNormal(a)), nb = normalized(areaNormal(b));
  if (besidePlane(a, b, nb, gap) || besidePlane(b, a, na, gap)) return false;
  if (reachesFace(a, b, nb, gap) || reachesFace(b, a, na, gap)) return true;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      if (squaredDistance(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]) <= gap * gap) return true;
    }
  }
  return false;
}

double sharedArea(const Triangle& a, const Triangle& b, double gap, Vec3& at) {
  const Vec3 na = normalized(areaNormal(a)), nb = normalized(areaNormal(b));
  if (dot(na, nb) < kSameWay || besidePlane(b, a, na, gap)) return 0;
  const Vec3 u = normalized(a[1] - a[0]), v = cross(na, u);
  const auto flat = [&](const Vec3& p) { return Vec2{dot(p - a[0], u), dot(p - a[0], v)}; };
  std::vector<Vec2> shared{flat(b[0]), flat(b[1]), flat(b[2])}, other;
  for (size_t i = 0; i < 3 && shared.size() > 2; ++i) {
    clip(shared, flat(a[i]), flat(a[(i + 1) % 3]), other);
  }
  if (shared.size() < 3) return 0;
  double twice = 0;
  Vec2 middle;
  for (size_t i = 0; i < shared.size(); ++i) {
    if (i > 1) twice += cross(shared[i - 1] - shared[0], shared[i] - shared[0]);
    middle = middle + shared[i] * (1.0 / static_cast<double>(shared.size()));
  }
  at = a[0] + u * middle.x + v * middle.y;
  return std::fabs(dot(at - b[0], nb)) <= gap ? twice / 2 : 0;
}

}  // namespace gable::cases
