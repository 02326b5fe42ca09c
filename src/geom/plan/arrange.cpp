// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Free places of a rectangle are found exactly, as in motion planning (T. Lozano-Perez, "Spatial
// planning: a configuration space approach", 1983): the area, less everywhere that its middle would
// make it cross an edge of the border (the sum of the edge and the rectangle) or another rectangle.
// Of what is left the point nearest to the wish is taken.
#include "geom/plan/arrange.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/hull.h"
#include "math/trig.h"

namespace gable {

namespace {

// Room for the grid that booleans round to.
constexpr double kRounding = 1e-4;
constexpr double kMostCells = 1e7;

Vec2 unit(double degrees) { return {cosDeg(degrees), sinDeg(degrees)}; }

// All sums of a point of one ring and one of another, both convex.
Ring sumOf(const Ring& a, const Ring& b) {
  std::vector<Vec2> points;
  for (const Vec2 p : a) {
    for (const Vec2 q : b) points.push_back(p + q);
  }
  return convexHull(points);
}

// Everything within a distance of a convex ring, up to the rounding of the corners: sides are moved
// exactly, and around a corner a polygon runs outside of the arc, by a hundredth of the distance at
// most.
Ring within(const Ring& convex, double distance) {
  if (!(distance > 0) || convex.size() < 3) return convex;
  constexpr double kStep = 15;
  Ring out;
  const size_t n = convex.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec2 in = normalized(convex[i] - convex[(i + n - 1) % n]),
               next = normalized(convex[(i + 1) % n] - convex[i]);
    const double turn = atan2Deg(cross(in, next), dot(in, next));
    const double parts = std::max(1.0, std::ceil(turn / kStep - 1e-9)), half = turn / parts / 2;
    const double first = atan2Deg(-in.x, in.y);
    for (double k = 0; k < parts; ++k) {
      out.push_back(convex[i] + unit(first + (2 * k + 1) * half) * (distance / cosDeg(half)));
    }
  }
  return out;
}

void addBorder(const Polygon& area, const Ring& shape, double edge, Region& out) {
  const auto add = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      Ring sum = within(sumOf({ring[i], ring[(i + 1) % ring.size()]}, shape), edge);
      if (sum.size() > 2) out.push_back({std::move(sum), {}});
    }
  };
  add(area.outer);
  for (const Ring& hole : area.holes) add(hole);
}

Vec2 nearestOnRing(const Ring& ring, Vec2 p, Vec2 best) {
  work(ring.size());
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], d = ring[(i + 1) % ring.size()] - a;
    const double t = dot(d, d) > 0 ? std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) : 0;
    const Vec2 at = a + d * t;
    if (length(at - p) < length(best - p)) best = at;
  }
  return best;
}

// False in an empty region.
bool nearestIn(const Region& region, Vec2 p, Vec2& out) {
  if (region.empty()) return false;
  out = {HUGE_VAL, HUGE_VAL};
  for (const Polygon& q : region) {
    if (contains(q, p)) {
      out = p;
      return true;
    }
    out = nearestOnRing(q.outer, p, out);
    for (const Ring& hole : q.holes) out = nearestOnRing(hole, p, out);
  }
  return true;
}

bool isSound(const Footprint& f) {
  return f.width > 0 && f.depth > 0 && std::isfinite(f.width) && std::isfinite(f.depth) &&
         std::isfinite(f.wish.x) && std::isfinite(f.wish.y) && std::isfinite(f.angle);
}

}  // namespace

Ring Footprint::at(Vec2 middle, double margin) const {
  const Vec2 x = unit(angle) * (width / 2 + margin),
             y = perpendicular(unit(angle)) * (depth / 2 + margin);
  return {middle - x - y, middle + x - y, middle + x + y, middle - x + y};
}

std::vector<ArrangedPlace> arrange(const Polygon& area, const std::vector<Footprint>& footprints,
                                   double gap, double edge, const Region& taken,
                                   ArrangeOrder sequence) {
  std::vector<ArrangedPlace> out(footprints.size());
  std::vector<size_t> order(footprints.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto larger = [&](size_t a, size_t b) {
    return footprints[a].width * footprints[a].depth > footprints[b].width * footprints[b].depth;
  };
  if (sequence == ArrangeOrder::Largest) std::stable_sort(order.begin(), order.end(), larger);
  const Region ground = taken.empty() ? Region{area} : subtract({area}, taken);
  std::vector<Ring> placed;
  for (const size_t i : order) {
    work(4 + placed.size());
    const Footprint& f = footprints[i];
    if (!isSound(f)) continue;
    Region blocked;
    const Ring shape = f.at({}, kRounding);
    for (const Polygon& p : ground) addBorder(p, shape, edge, blocked);
    for (const Ring& other : placed) blocked.push_back({within(sumOf(other, shape), gap), {}});
    ArrangedPlace& place = out[i];
    place.placed = nearestIn(subtract(ground, blocked), f.wish, place.middle);
    if (place.placed) placed.push_back(f.at(place.middle));
  }
  return out;
}

std::vector<Vec2> scatterJittered(const Polygon& area, double distance, double jitter, double edge,
                                  size_t most, uint64_t seed) {
  std::vector<Vec2> out;
  const Box2 box = bounds(area);
  if (!(distance > 0) || box.empty()) return out;
  const double columns = std::ceil(box.size().x / distance),
               rows = std::ceil(box.size().y / distance);
  if (!(columns * rows <= kMostCells)) return out;
  const double reach = std::clamp(jitter, 0.0, 1.0) * distance / 2;
  // Cells are shared out evenly on both sides of the middle.
  const Vec2 first = box.center() - Vec2{columns - 1, rows - 1} * (distance / 2);
  for (double row = 0; row < rows; ++row) {
    for (double column = 0; column < columns && out.size() < most; ++column) {
      work(8);
      const uint64_t cell =
          hashCombine(hashCombine(seed, static_cast<uint64_t>(row)), static_cast<uint64_t>(column));
      const Vec2 p = first + Vec2{column, row} * distance +
                     Vec2{randomIn(hashCombine(cell, 0), -reach, reach),
                          randomIn(hashCombine(cell, 1), -reach, reach)};
      if (edge > 0 ? signedDistance(area, p) >= edge : contains(area, p)) out.push_back(p);
    }
  }
  return out;
}

}  // namespace gable
