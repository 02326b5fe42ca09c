// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The hull is Andrew's monotone chain (1979).
#include "geom/region/hull.h"

#include <algorithm>
#include <limits>

#include "base/work.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {

Ring convexHull(std::span<const Vec2> points) {
  work(4 * points.size());
  std::vector<Vec2> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  Ring hull;
  const auto extend = [&](Vec2 p, size_t least) {
    while (hull.size() >= least && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vec2 p : sorted) extend(p, 2);
  const size_t lower = hull.size() + 1;
  for (size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i], lower);
  hull.pop_back();
  return hull;
}

namespace {

// The rectangle around a hull with one side along a direction; `i` holds the hull's extreme points
// to the right, far and left, which only move on as the direction turns.
struct Calipers {
  const Ring& hull;
  size_t right = 0, far = 0, left = 0;

  Vec2 at(size_t i) const { return hull[i % hull.size()]; }
  void advance(size_t& i, size_t from, Vec2 d) const {
    i = std::max(i, from);
    while (dot(at(i + 1) - at(i), d) > 0 && i < from + hull.size()) ++i;
  }
  OrientedRect around(size_t edge) {
    const Vec2 a = at(edge), x = normalized(at(edge + 1) - a);
    advance(right, edge + 1, x);
    advance(far, right, perpendicular(x));
    advance(left, far, -x);
    const double low = dot(at(left) - a, x), high = dot(at(right) - a, x);
    return {a + x * low, x, high - low, dot(at(far) - a, perpendicular(x))};
  }
};

}  // namespace

OrientedRect smallestRect(std::span<const Vec2> points) {
  const Ring hull = convexHull(points);
  if (hull.empty()) return {};
  if (hull.size() < 3) {
    const Vec2 d = hull.back() - hull.front();
    if (d == Vec2{}) return {hull[0], {1, 0}, 0, 0};
    return {hull[0], normalized(d), length(d), 0};
  }
  Calipers calipers{hull};
  OrientedRect best;
  for (size_t i = 0; i < hull.size(); ++i) {
    const OrientedRect r = calipers.around(i);
    // Later ones win only by more than rounding.
    if (i == 0 || r.area() < best.area() * (1 - 1e-12)) best = r;
  }
  return best;
}

double distanceToBoundary(const Polygon& p, Vec2 point) {
  double d = std::numeric_limits<double>::infinity();
  for (const Segment& s : edgesOf(p)) d = std::min(d, distanceTo(s, point));
  return d;
}

double signedDistance(const Polygon& p, Vec2 point) {
  const double d = distanceToBoundary(p, point);
  return contains(p, point) ? d : -d;
}

}  // namespace gable
