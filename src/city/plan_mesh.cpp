// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ears are clipped and edges exchanged until the circle of each triangle is free of its neighbours'
// corners (C. L. Lawson, "Software for C1 surface interpolation", 1977). Then each triangle takes
// the points of the grid that lie in it, one splits it into three that share the rest, and edges
// are exchanged again.
#include "city/plan_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"

namespace gable {
namespace {

constexpr uint32_t kNone = 0xffffffff;
constexpr double kClearGain = 1e-9;
constexpr size_t kFlipsEach = 60;
// Of the spacing: nearer to an outline or a corner no point is added.
constexpr double kClear = 0.4;

class Refiner {
 public:
  Refiner(PlanMesh& mesh) : m_(mesh) {
    link();
    pushAll();
    flipAll();
  }

  void refine(double spacing) {
    const auto before = static_cast<uint32_t>(m_.triangles.size());
    for (uint32_t t = 0; t < before; ++t) {
      std::vector<Vec2> inside = pointsIn(t, spacing);
      if (!inside.empty()) insert(t, std::move(inside));
    }
    if (m_.triangles.size() == before) return;
    pushAll();
    flipAll();
  }

 private:
  double side(uint32_t a, uint32_t b, Vec2 p) const {
    return cross(m_.points[b] - m_.points[a], p - m_.points[a]);
  }
  double side(uint32_t a, uint32_t b, uint32_t c) const { return side(a, b, m_.points[c]); }

  // What is beyond each edge, by pairs of equal ends.
  void link() {
    struct End {
      uint32_t low, high, triangle, edge;
      bool operator<(const End& o) const {
        if (low != o.low) return low < o.low;
        return high != o.high ? high < o.high : triangle < o.triangle;
      }
    };
    std::vector<End> ends;
    for (uint32_t t = 0; t < m_.triangles.size(); ++t) {
      work();
      for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t a = m_.triangles[t][i], b = m_.triangles[t][(i + 1) % 3];
        ends.push_back({std::min(a, b), std::max(a, b), t, i});
      }
    }
    std::sort(ends.begin(), ends.end());
    beyond_.assign(m_.triangles.size(), {kNone, kNone, kNone});
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      const End &a = ends[i], &b = ends[i + 1];
      if (a.low != b.low || a.high != b.high) continue;
      beyond_[a.triangle][a.edge] = b.triangle;
      beyond_[b.triangle][b.edge] = a.triangle;
      ++i;
    }
  }
  void replace(uint32_t at, uint32_t was, uint32_t is) {
    if (at == kNone) return;
    for (uint32_t& n : beyond_[at]) {
      if (n == was) {
        n = is;
        return;
      }
    }
  }

  void pushAll() {
    open_.clear();
    for (uint32_t t = 0; t < m_.triangles.size(); ++t) {
      for (uint32_t i = 0; i < 3; ++i) {
        if (beyond_[t][i] != kNone && beyond_[t][i] > t) open_.push_back({t, i});
      }
    }
  }
  void flipAll() {
    size_t left = kFlipsEach * m_.triangles.size();
    while (!open_.empty() && left > 0) {
      work(4);
      const auto [t, i] = open_.back();
      open_.pop_back();
      if (flip(t, i)) --left;
    }
  }
  double cotangent(uint32_t v, uint32_t a, uint32_t b) const {
    const Vec2 x = m_.points[a] - m_.points[v], y = m_.points[b] - m_.points[v];
    return dot(x, y) / std::fabs(cross(x, y));
  }
  bool flip(uint32_t t, uint32_t i) {
    const uint32_t n = beyond_[t][i];
    if (n == kNone) return false;
    const uint32_t a = m_.triangles[t][i], b = m_.triangles[t][(i + 1) % 3],
                   c = m_.triangles[t][(i + 2) % 3];
    uint32_t j = 0;
    while (j < 3 && m_.triangles[n][j] != b) ++j;
    if (j == 3 || m_.triangles[n][(j + 1) % 3] != a) return false;
    const uint32_t d = m_.triangles[n][(j + 2) % 3];
    if (c == d || !(side(a, d, c) > 0) || !(side(d, b, c) > 0)) return false;
    if (!(cotangent(c, a, b) + cotangent(d, a, b) < -kClearGain)) return false;
    const uint32_t ad = beyond_[n][(j + 1) % 3], db = beyond_[n][(j + 2) % 3],
                   bc = beyond_[t][(i + 1) % 3], ca = beyond_[t][(i + 2) % 3];
    m_.triangles[t] = {a, d, c};
    m_.triangles[n] = {d, b, c};
    beyond_[t] = {ad, n, ca};
    beyond_[n] = {db, bc, t};
    replace(ad, n, t);
    replace(bc, t, n);
    for (const uint32_t k : {0u, 2u}) open_.push_back({t, k});
    for (const uint32_t k : {0u, 1u}) open_.push_back({n, k});
    return true;
  }

  // Places of the grid within a triangle, clear of its corners and of the outline, row by row.
  std::vector<Vec2> pointsIn(uint32_t t, double spacing) const {
    const auto& v = m_.triangles[t];
    Box2 box;
    for (const uint32_t i : v) box.include(m_.points[i]);
    std::vector<Vec2> out;
    const double first = std::ceil(box.min.y / spacing), last = std::floor(box.max.y / spacing);
    for (double r = first; r <= last; ++r) {
      work(4);
      const double y = r * spacing;
      double left = box.max.x, right = box.min.x;
      for (uint32_t i = 0; i < 3; ++i) {
        const Vec2 a = m_.points[v[i]], b = m_.points[v[(i + 1) % 3]];
        if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y || a.y == b.y) continue;
        const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        left = std::min(left, x);
        right = std::max(right, x);
      }
      // Every second row is moved by half a step.
      const double shift = std::fmod(std::fabs(r), 2) * 0.5;
      for (double c = std::ceil(left / spacing - shift); (c + shift) * spacing <= right; ++c) {
        work();
        const Vec2 p{(c + shift) * spacing, y};
        if (isClear(t, p, kClear * spacing)) out.push_back(p);
      }
    }
    return out;
  }
  bool isClear(uint32_t t, Vec2 p, double clear) const {
    const auto& v = m_.triangles[t];
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[(i + 1) % 3];
      const double l = length(m_.points[b] - m_.points[a]);
      const double least = beyond_[t][i] == kNone ? clear * l : 1e-6 * l;
      if (!(side(a, b, p) > least) || length(p - m_.points[a]) < clear) return false;
    }
    return true;
  }
  bool isIn(uint32_t t, Vec2 p) const {
    const auto& v = m_.triangles[t];
    for (uint32_t i = 0; i < 3; ++i) {
      const double l = length(m_.points[v[(i + 1) % 3]] - m_.points[v[i]]);
      if (!(side(v[i], v[(i + 1) % 3], p) > 1e-6 * l)) return false;
    }
    return true;
  }

  // A point that falls on an edge between others is left out.
  void insert(uint32_t triangle, std::vector<Vec2> points) {
    struct Task {
      uint32_t triangle;
      std::vector<Vec2> points;
    };
    std::vector<Task> tasks{{triangle, std::move(points)}};
    while (!tasks.empty()) {
      Task task = std::move(tasks.back());
      tasks.pop_back();
      const Vec2 p = task.points[task.points.size() / 2];
      const std::array<uint32_t, 3> parts = split(task.triangle, p);
      std::array<std::vector<Vec2>, 3> lists;
      for (const Vec2 q : task.points) {
        work();
        for (size_t k = 0; k < 3; ++k) {
          if (isIn(parts[k], q)) {
            lists[k].push_back(q);
            break;
          }
        }
      }
      for (size_t k = 0; k < 3; ++k) {
        if (!lists[k].empty()) tasks.push_back({parts[k], std::move(lists[k])});
      }
    }
  }
  std::array<uint32_t, 3> split(uint32_t t, Vec2 p) {
    const auto v = m_.triangles[t];
    const auto n = beyond_[t];
    const auto at = static_cast<uint32_t>(m_.points.size());
    const auto next = static_cast<uint32_t>(m_.triangles.size());
    m_.points.push_back(p);
    m_.triangles[t] = {v[0], v[1], at};
    m_.triangles.push_back({v[1], v[2], at});
    m_.triangles.push_back({v[2], v[0], at});
    beyond_[t] = {n[0], next, next + 1};
    beyond_.push_back({n[1], next + 1, t});
    beyond_.push_back({n[2], t, next});
    replace(n[1], t, next);
    replace(n[2], t, next + 1);
    return {t, next, next + 1};
  }

  PlanMesh& m_;
  // By triangle and edge: the triangle on its other side.
  std::vector<std::array<uint32_t, 3>> beyond_;
  std::vector<std::pair<uint32_t, uint32_t>> open_;
};

}  // namespace

PlanMesh meshOf(const Polygon& polygon, double spacing) {
  PlanMesh out;
  out.points = polygon.outer;
  for (const Ring& h : polygon.holes) out.points.insert(out.points.end(), h.begin(), h.end());
  out.triangles = triangulate(polygon);
  Refiner refiner(out);
  if (spacing > 0) refiner.refine(spacing);
  return out;
}

}  // namespace gable
