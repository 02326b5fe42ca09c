// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "geom/region/places.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/random.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/piece.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"
#include "math/trig.h"

namespace gable {

Vec2 centroid(const Polygon& p) {
  Vec2 sum;
  double whole = 0;
  if (p.outer.empty()) return sum;
  const Vec2 o = p.outer[0];
  for (const Ring& r : ringsOf(p)) {
    for (size_t i = 0; i < r.size(); ++i) {
      const Vec2 a = r[i] - o, b = r[(i + 1) % r.size()] - o;
      const double c = cross(a, b);
      sum = sum + (a + b) * c;
      whole += c;
    }
  }
  return whole != 0 ? o + sum * (1 / (3 * whole)) : o;
}

bool isConvex(const Polygon& p) {
  const size_t n = p.outer.size();
  if (!p.holes.empty() || n < 3) return false;
  for (size_t i = 0; i < n; ++i) {
    if (orientation(p.outer[i], p.outer[(i + 1) % n], p.outer[(i + 2) % n]) < 0) return false;
  }
  return true;
}

namespace {

struct Square {
  Vec2 middle;
  double half, distance, most;
  bool operator<(const Square& o) const { return most < o.most; }
};

}  // namespace

Disc poleOf(const Polygon& p) {
  const Box2 box = bounds(p);
  if (box.empty()) return {};
  const Vec2 size = box.size();
  const double side = std::min(size.x, size.y);
  const auto squareAt = [&](Vec2 m, double half) {
    const double d = signedDistance(p, m);
    return Square{m, half, d, d + half * std::sqrt(2.0)};
  };
  Square best = squareAt(centroid(p), 0);
  // Middles of ears: one of them lies inside whatever the shape.
  std::priority_queue<Square> open;
  if (!(side > 0)) return {box.min, 0};
  const double step = std::max(side, std::max(size.x, size.y) / 32);
  for (double x = box.min.x; x < box.max.x; x += step) {
    for (double y = box.min.y; y < box.max.y; y += step) {
      open.push(squareAt({x + step / 2, y + step / 2}, step / 2));
    }
  }
  constexpr int kMostSquares = 20000;
  for (int i = 0; i < kMostSquares && !open.empty(); ++i) {
    const Square s = open.top();
    open.pop();
    if (s.distance > best.distance) best = s;
    if (s.most - best.distance <= std::max(0.01 * std::fabs(best.distance), 1e-9 * side)) break;
    const double h = s.half / 2;
    for (const Vec2 d : {Vec2{-h, -h}, Vec2{h, -h}, Vec2{-h, h}, Vec2{h, h}}) {
      open.push(squareAt(s.middle + d, h));
    }
  }
  return {best.middle, std::max(0.0, best.distance)};
}

Vec2 middleOf(const Polygon& p) { return isConvex(p) ? centroid(p) : poleOf(p).centre; }

std::vector<Disc> scatterDiscs(const Polygon& p, const ScatterOptions& o) {
  struct Drawn {
    double radius;
    uint32_t index;
  };
  std::vector<Drawn> wanted;
  for (uint32_t i = 0; i < o.count; ++i) {
    wanted.push_back({randomIn(hashCombine(hashCombine(o.seed, 1), i), o.least, o.most), i});
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Drawn& a, const Drawn& b) { return a.radius > b.radius; });
  const Box2 box = bounds(p);
  std::vector<std::pair<uint32_t, Disc>> placed;
  const uint32_t tries = 60;
  uint64_t dart = 0;
  for (const Drawn& w : wanted) {
    bool found = false;
    constexpr int kShrinks = 8;
    for (int shrink = 0; shrink <= kShrinks && !found; ++shrink) {
      const double r = w.radius + (o.least - w.radius) * shrink / kShrinks;
      for (uint32_t t = 0; t < tries && !found; ++t) {
        const uint64_t at = hashCombine(hashCombine(o.seed, 2), dart++);
        const Vec2 c{randomIn(hashCombine(at, 0), box.min.x, box.max.x),
                     randomIn(hashCombine(at, 1), box.min.y, box.max.y)};
        const bool free = std::none_of(placed.begin(), placed.end(), [&](const auto& other) {
          return length(other.second.centre - c) <= other.second.radius + r + o.gap;
        });
        if (!free || !(signedDistance(p, c) > r + o.edge)) continue;
        placed.push_back({w.index, {c, r}});
        found = true;
      }
      if (w.radius <= o.least) break;
    }
    // The largest disc of all may fit where no dart fell.
    if (!found && placed.empty()) {
      const Disc pole = poleOf(p);
      if (pole.radius > o.least + o.edge) {
        placed.push_back(
            {w.index, {pole.centre, std::min(w.radius, pole.radius * 0.999 - o.edge)}});
      }
    }
  }
  std::sort(placed.begin(), placed.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Disc> out;
  for (const auto& [index, disc] : placed) out.push_back(disc);
  return out;
}

std::vector<Vec2> scatterPoisson(const Polygon& p, double distance, double edge, size_t most,
                                 uint64_t seed) {
  std::vector<Vec2> out;
  const Box2 box = bounds(p);
  if (!(distance > 0) || box.empty() || !std::isfinite(distance)) return out;
  // A grid whose cells hold one point at most.
  const double cell =
      std::max(distance / std::sqrt(2.0), std::max(box.size().x, box.size().y) / 4000);
  const auto nx = static_cast<size_t>(box.size().x / cell) + 1;
  const auto ny = static_cast<size_t>(box.size().y / cell) + 1;
  std::vector<std::vector<uint32_t>> cells(nx * ny);
  const auto column = [&](double v, size_t n) {
    return std::min(n - 1, static_cast<size_t>(std::max(0.0, v / cell)));
  };
  const auto inside = [&](Vec2 c) {
    return edge > 0 ? signedDistance(p, c) >= edge : contains(p, c);
  };
  const auto isFree = [&](Vec2 c) {
    if (c.x < box.min.x || c.y < box.min.y || c.x > box.max.x || c.y > box.max.y) return false;
    const size_t x = column(c.x - box.min.x, nx), y = column(c.y - box.min.y, ny);
    for (size_t i = x > 1 ? x - 2 : 0; i <= std::min(nx - 1, x + 2); ++i) {
      for (size_t k = y > 1 ? y - 2 : 0; k <= std::min(ny - 1, y + 2); ++k) {
        for (const uint32_t q : cells[k * nx + i]) {
          if (length(out[q] - c) < distance) return false;
        }
      }
    }
    return inside(c);
  };
  std::vector<uint32_t> active;
  const auto add = [&](Vec2 c) {
    cells[column(c.y - box.min.y, ny) * nx + column(c.x - box.min.x, nx)].push_back(
        static_cast<uint32_t>(out.size()));
    active.push_back(static_cast<uint32_t>(out.size()));
    out.push_back(c);
  };
  uint64_t draw = 0;
  const auto unit = [&] { return randomUnit(hashCombine(seed, draw++)); };
  constexpr int kStarts = 30, kAround = 20;
  for (int start = 0; start < kStarts && out.size() < most; ++start) {
    const double u = unit(), v = unit();
    const Vec2 c = box.min + Vec2{u * box.size().x, v * box.size().y};
    if (isFree(c)) add(c);
    while (!active.empty() && out.size() < most) {
      const auto pick = static_cast<size_t>(unit() * static_cast<double>(active.size()));
      const Vec2 from = out[active[pick]];
      bool found = false;
      for (int t = 0; t < kAround && !found; ++t) {
        const double angle = 360 * unit(), reach = distance * (1 + unit());
        const Vec2 at = from + Vec2{cosDeg(angle), sinDeg(angle)} * reach;
        if (!isFree(at)) continue;
        add(at);
        found = true;
      }
      if (!found) {
        active[pick] = active.back();
        active.pop_back();
      }
    }
  }
  return out;
}

}  // namespace gable
