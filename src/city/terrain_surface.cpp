// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/terrain_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gable {
namespace {

// In square metres: how far beyond an edge, times its length, a place still counts as on it.
constexpr double kOnEdge = 1e-7;

Box2 boxAround(const std::vector<Vec3>& points) {
  Box2 box;
  for (const Vec3& p : points) box.include({p.x, p.y});
  if (box.empty()) box.include({0, 0});
  return box;
}

}  // namespace

Box2 TerrainSurface::boxOf(uint32_t facet) const {
  Box2 box;
  for (const uint32_t i : facets_[facet].points) box.include(flat(i));
  return box;
}

TerrainSurface::TerrainSurface(std::vector<Vec3> points, std::vector<Facet> facets,
                               std::vector<Piece> pieces)
    : points_(std::move(points)),
      facets_(std::move(facets)),
      pieces_(std::move(pieces)),
      area_(boxAround(points_)),
      grid_(gridPoint(area_.min), gridPoint(area_.max), facets_.size()),
      lists_(grid_.size(), [&](const auto& put) {
        for (uint32_t f = 0; f < facets_.size(); ++f) {
          const Box2 box = boxOf(f);
          const GridPoint low = gridPoint(box.min), high = gridPoint(box.max);
          for (int64_t r = grid_.row(low.y); r <= grid_.row(high.y); ++r) {
            for (int64_t c = grid_.column(low.x); c <= grid_.column(high.x); ++c) {
              work();
              put(grid_.cell(c, r), f);
            }
          }
        }
      }) {}

bool TerrainSurface::holds(uint32_t facet, Vec2 p) const {
  const auto& v = facets_[facet].points;
  for (size_t i = 0; i < 3; ++i) {
    const Vec2 a = flat(v[i]), b = flat(v[(i + 1) % 3]);
    if (cross(b - a, p - a) < -kOnEdge) return false;
  }
  return true;
}

double TerrainSurface::heightOn(uint32_t facet, Vec2 p) const {
  const auto& v = facets_[facet].points;
  const Vec3 &a = points_[v[0]], &b = points_[v[1]], &c = points_[v[2]];
  // The corners themselves are exact.
  for (const uint32_t i : v) {
    if (points_[i].x == p.x && points_[i].y == p.y) return points_[i].z;
  }
  const Vec2 ab{b.x - a.x, b.y - a.y}, ac{c.x - a.x, c.y - a.y}, ap{p.x - a.x, p.y - a.y};
  const double whole = cross(ab, ac);
  if (!(std::fabs(whole) > 0)) return a.z;
  const double u = cross(ap, ac) / whole, w = cross(ab, ap) / whole;
  return a.z + u * (b.z - a.z) + w * (c.z - a.z);
}

uint32_t TerrainSurface::facetAt(Vec2 p) const {
  if (!area_.contains(p)) return kNothing;
  const size_t cell = grid_.cellOf(gridPoint(p));
  for (const uint32_t* i = lists_.begin(cell); i != lists_.end(cell); ++i) {
    work();
    if (holds(*i, p)) return *i;
  }
  return kNothing;
}

double TerrainSurface::nearestHeight(Vec2 p) const {
  const Vec2 size = area_.size();
  const double whole = std::max(size.x, size.y) + 1;
  double nearest = std::numeric_limits<double>::infinity(), height = 0;
  for (double reach = 0.01; !std::isfinite(nearest) && reach < 8 * whole; reach *= 8) {
    Box2 box;
    box.include(p - Vec2{reach, reach});
    box.include(p + Vec2{reach, reach});
    near(box, [&](uint32_t facet) {
      for (const uint32_t i : facets_[facet].points) {
        const double distance = length(flat(i) - p);
        if (!(distance < nearest)) continue;
        nearest = distance;
        height = points_[i].z;
      }
    });
  }
  return height;
}

double TerrainSurface::heightAt(Vec2 p) const {
  const Vec2 q{std::clamp(p.x, area_.min.x, area_.max.x),
               std::clamp(p.y, area_.min.y, area_.max.y)};
  const uint32_t facet = facetAt(q);
  return facet != kNothing ? heightOn(facet, q) : nearestHeight(q);
}

}  // namespace gable
