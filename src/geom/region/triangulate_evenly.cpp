// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ear clipping, then edge flips. An edge between two triangles is exchanged for the other diagonal
// of their quadrilateral when the opposite angles add up to more than half a turn (C. L. Lawson,
// "Software for C1 surface interpolation", 1977). Rounding could make two diagonals take turns, so
// an edge goes only for a clear gain, and every triangle has a limit of flips.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/triangulate.h"

namespace gable {

namespace {

constexpr double kClearGain = 1e-9;
constexpr size_t kFlipsEach = 60;

using Edge = std::pair<uint32_t, uint32_t>;

class Flips {
 public:
  Flips(std::vector<Vec2> points, std::vector<Triangle> triangles)
      : points_(std::move(points)), triangles_(std::move(triangles)) {
    for (uint32_t t = 0; t < triangles_.size(); ++t) add(t);
    for (const auto& [edge, t] : owner_) {
      if (edge.first < edge.second) open_.push_back(edge);
    }
  }

  std::vector<Triangle> run() {
    size_t left = kFlipsEach * triangles_.size();
    while (!open_.empty() && left > 0) {
      work(8);
      const Edge e = open_.back();
      open_.pop_back();
      if (flip(e)) --left;
    }
    return std::move(triangles_);
  }

 private:
  void add(uint32_t t) {
    for (int i = 0; i < 3; ++i) owner_[{triangles_[t][i], triangles_[t][(i + 1) % 3]}] = t;
  }
  void remove(uint32_t t) {
    for (int i = 0; i < 3; ++i) owner_.erase({triangles_[t][i], triangles_[t][(i + 1) % 3]});
  }
  uint32_t opposite(uint32_t t, const Edge& e) const {
    for (const uint32_t v : triangles_[t]) {
      if (v != e.first && v != e.second) return v;
    }
    return e.first;
  }
  double side(uint32_t a, uint32_t b, uint32_t c) const {
    return cross(points_[b] - points_[a], points_[c] - points_[a]);
  }
  // Of the angle at v between a and b.
  double cotangent(uint32_t v, uint32_t a, uint32_t b) const {
    const Vec2 x = points_[a] - points_[v], y = points_[b] - points_[v];
    return dot(x, y) / std::fabs(cross(x, y));
  }

  bool flip(const Edge& e) {
    const auto one = owner_.find(e), two = owner_.find({e.second, e.first});
    if (one == owner_.end() || two == owner_.end()) return false;
    const uint32_t s = one->second, t = two->second;
    const uint32_t c = opposite(s, e), d = opposite(t, e);
    // The other diagonal lies inside, and both new triangles have an area.
    if (c == d || !(side(c, d, e.second) > 0) || !(side(d, c, e.first) > 0)) return false;
    // The sum of two cotangents is negative beyond half a turn.
    if (!(cotangent(c, e.first, e.second) + cotangent(d, e.first, e.second) < -kClearGain)) {
      return false;
    }
    remove(s);
    remove(t);
    triangles_[s] = {c, d, e.second};
    triangles_[t] = {d, c, e.first};
    add(s);
    add(t);
    for (const Edge& next : {Edge{d, e.second}, {e.second, c}, {c, e.first}, {e.first, d}}) {
      open_.push_back(next);
    }
    return true;
  }

  std::vector<Vec2> points_;
  std::vector<Triangle> triangles_;
  /// The triangle to the left of each directed edge.
  std::map<Edge, uint32_t> owner_;
  std::vector<Edge> open_;
};

}  // namespace

std::vector<Triangle> triangulateEvenly(const Polygon& p) {
  std::vector<Vec2> points;
  for (const Ring& r : ringsOf(Region{p})) points.insert(points.end(), r.begin(), r.end());
  return Flips(std::move(points), triangulate(p)).run();
}

}  // namespace gable
