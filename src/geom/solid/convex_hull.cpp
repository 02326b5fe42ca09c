// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The incremental algorithm (Preparata, Hong: Convex hulls of finite sets of points in two and
// three dimensions, 1977) over the extreme points alone. On the grid a volume of three differences
// fits in 64 bits, so its sign is exact. A face is replaced only where the new point lies strictly
// outside it: then no point is in line with an edge that it is joined to, and no triangle is flat.
#include "geom/solid/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/work.h"
#include "math/box.h"

namespace gable {
namespace {

using Grid = std::array<int64_t, 3>;

Grid operator-(const Grid& a, const Grid& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Grid cross(const Grid& a, const Grid& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Above 0 where d lies outside the plane of a counter-clockwise a, b, c.
int64_t volume(const Grid& a, const Grid& b, const Grid& c, const Grid& d) {
  const Grid n = cross(b - a, c - a), e = d - a;
  return n[0] * e[0] + n[1] * e[1] + n[2] * e[2];
}

// All directions whose steps are -2 to 2, none a multiple of another.
std::vector<Vec3> directions() {
  std::vector<Vec3> out;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (std::gcd(std::gcd(x, y), z) != 1) continue;
        out.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
      }
    }
  }
  return out;
}

// The first of the points that reach farthest, a direction each; long boxes count as cubes.
std::vector<Vec3> extremes(std::span<const Vec3> points, const Box3& box) {
  Vec3 weight = box.size();
  for (size_t i = 0; i < 3; ++i) weight[i] = weight[i] > 0 ? 1 / weight[i] : 0;
  std::set<size_t> chosen;
  for (const Vec3& d : directions()) {
    work(points.size());
    const Vec3 toward = scaled(d, weight);
    size_t best = 0;
    double farthest = dot(toward, points[0] - box.min);
    for (size_t i = 1; i < points.size(); ++i) {
      const double reach = dot(toward, points[i] - box.min);
      if (reach <= farthest) continue;
      farthest = reach;
      best = i;
    }
    chosen.insert(best);
  }
  std::vector<Vec3> out;
  for (const size_t i : chosen) out.push_back(points[i]);
  return out;
}

class HullMaker {
 public:
  explicit HullMaker(std::vector<Grid> points) : points_(std::move(points)) {}

  std::vector<std::array<uint32_t, 3>> run() {
    if (!begin()) return {};
    for (uint32_t p = 0; p < points_.size(); ++p) add(p);
    return std::move(faces_);
  }

 private:
  bool outside(const std::array<uint32_t, 3>& f, uint32_t p) const {
    return volume(points_[f[0]], points_[f[1]], points_[f[2]], points_[p]) > 0;
  }

  // A first tetrahedron; false where all points lie in a plane.
  bool begin() {
    const auto count = static_cast<uint32_t>(points_.size());
    for (uint32_t b = 1; b < count; ++b) {
      for (uint32_t c = b + 1; c < count; ++c) {
        if (cross(points_[b] - points_[0], points_[c] - points_[0]) == Grid{}) continue;
        return beginOn(b, c);
      }
    }
    return false;
  }

  bool beginOn(uint32_t b, uint32_t c) {
    for (uint32_t d = 1; d < points_.size(); ++d) {
      const int64_t v = volume(points_[0], points_[b], points_[c], points_[d]);
      if (v == 0) continue;
      if (v > 0) std::swap(b, c);
      faces_ = {{0, b, c}, {0, d, b}, {b, d, c}, {c, d, 0}};
      return true;
    }
    return false;
  }

  void add(uint32_t p) {
    std::vector<std::array<uint32_t, 3>> kept;
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const auto& f : faces_) {
      if (!outside(f, p)) {
        kept.push_back(f);
        continue;
      }
      for (size_t k = 0; k < 3; ++k) edges.insert({f[k], f[(k + 1) % 3]});
    }
    if (edges.empty()) return;
    // The border of what is taken away: edges that it has in one direction only.
    for (const auto& [a, b] : edges) {
      if (!edges.contains({b, a})) kept.push_back({a, b, p});
    }
    faces_.swap(kept);
  }

  std::vector<Grid> points_;
  std::vector<std::array<uint32_t, 3>> faces_;
};

}  // namespace

ConvexHull convexHull3(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3& p : points) {
    if (!isFinite(p)) return {};
    box.include(p);
  }
  if (box.empty()) return {};
  const Vec3 size = box.size();
  const double side = std::max({size.x, size.y, size.z});
  if (!(side > 0) || !std::isfinite(side)) return {};
  const double step = side / kHullSteps;

  std::vector<Grid> grid;
  for (const Vec3& p : extremes(points, box)) {
    Grid g{};
    for (size_t i = 0; i < 3; ++i) {
      g[i] = static_cast<int64_t>(std::floor((p[i] - box.min[i]) / step + 0.5));
    }
    if (std::find(grid.begin(), grid.end(), g) == grid.end()) grid.push_back(g);
  }
  ConvexHull hull;
  hull.triangles = HullMaker(grid).run();
  // Corners in the order of their first triangle; those inside a facet are left out.
  std::vector<uint32_t> number(grid.size(), UINT32_MAX);
  for (auto& t : hull.triangles) {
    for (uint32_t& corner : t) {
      uint32_t& n = number[corner];
      if (n == UINT32_MAX) {
        n = static_cast<uint32_t>(hull.corners.size());
        Vec3 at = box.min;
        for (size_t i = 0; i < 3; ++i) at[i] += static_cast<double>(grid[corner][i]) * step;
        hull.corners.push_back(at);
      }
      corner = n;
    }
  }
  return hull;
}

}  // namespace gable
