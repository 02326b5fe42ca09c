// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The gradients of u and v over a face come from Green's theorem; their dual vectors tell how far
// one goes on the surface for one unit.
#include "geom/mesh/uv.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "math/trig.h"

namespace gable {
namespace {

std::vector<Vec2>& setOf(Mesh& m, int set) { return m.uvs[static_cast<size_t>(set)]; }
const std::vector<Vec2>& setOf(const Mesh& m, int set) { return m.uvs[static_cast<size_t>(set)]; }

// Moves the values of some corners to [0, 1].
class Normalizer {
 public:
  explicit Normalizer(UvNormalize mode) : mode_(mode) {}
  void include(Vec2 uv) { box_.include(uv); }
  Vec2 apply(Vec2 uv) const {
    const Vec2 size = box_.size();
    const auto share = [](double v, double low, double extent) {
      return extent > 0 ? (v - low) / extent : 0;
    };
    const double longer = std::max(size.x, size.y);
    const Vec2 both{share(uv.x, box_.min.x, mode_ == UvNormalize::Uniform ? longer : size.x),
                    share(uv.y, box_.min.y, mode_ == UvNormalize::Uniform ? longer : size.y)};
    if (mode_ == UvNormalize::U) return {both.x, uv.y};
    if (mode_ == UvNormalize::V) return {uv.x, both.y};
    return both;
  }

 private:
  UvNormalize mode_;
  Box2 box_;
};

template <class Visit>
void forCorners(const Mesh& m, size_t face, const Visit& visit) {
  for (const MeshLoop& loop : m.loopsOf(face)) {
    work(loop.cornerCount);
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      visit(loop.firstCorner + i, loop.firstCorner + (i + 1) % loop.cornerCount);
    }
  }
}

double tileScale(const UvTile& tile, double unit, double range) {
  if (tile.size == 0 || unit <= 0) return 1;
  if (!tile.floating) return unit / tile.size;
  if (range <= 0) return 1;
  const double count = std::max(1.0, std::floor(range * unit / std::fabs(tile.size) + 0.5));
  return (tile.size < 0 ? -count : count) / range;
}

}  // namespace

Box2 uvBounds(const Mesh& m, int set) {
  Box2 box;
  for (const Vec2 uv : setOf(m, set)) box.include(uv);
  return box;
}

void projectUv(Mesh& m, int set, const Vec3& origin, const Vec3& u, const Vec3& v) {
  std::vector<Vec2>& uvs = setOf(m, set);
  uvs.resize(m.corners.size());
  for (uint32_t c = 0; c < m.corners.size(); ++c) {
    work();
    const Vec3 p = m.at(c) - origin;
    uvs[c] = {dot(p, u), dot(p, v)};
  }
}

void scaleUv(Mesh& m, int set, Vec2 by) {
  for (Vec2& uv : setOf(m, set)) uv = {uv.x * by.x, uv.y * by.y};
}

void translateUv(Mesh& m, int set, Vec2 by) {
  for (Vec2& uv : setOf(m, set)) uv = uv + by;
}

void rotateUv(Mesh& m, int set, double degrees) {
  const double c = cosDeg(degrees), s = sinDeg(degrees);
  for (Vec2& uv : setOf(m, set)) uv = {uv.x * c - uv.y * s, uv.x * s + uv.y * c};
}

void normalizeUv(Mesh& m, int set, UvNormalize mode, bool eachFace) {
  std::vector<Vec2>& uvs = setOf(m, set);
  if (uvs.empty()) return;
  if (!eachFace) {
    Normalizer all(mode);
    for (const Vec2 uv : uvs) all.include(uv);
    for (Vec2& uv : uvs) uv = all.apply(uv);
    return;
  }
  for (size_t f = 0; f < m.faces.size(); ++f) {
    Normalizer one(mode);
    forCorners(m, f, [&](uint32_t c, uint32_t) { one.include(uvs[c]); });
    forCorners(m, f, [&](uint32_t c, uint32_t) { uvs[c] = one.apply(uvs[c]); });
  }
}

Vec2 uvUnitLength(const Mesh& m, int set) {
  const std::vector<Vec2>& uvs = setOf(m, set);
  if (uvs.empty()) return {};
  Vec2 sum;
  double total = 0;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    const Vec3 normal = m.normal(f);
    Vec3 gu, gv;
    const Vec2 first = uvs[m.loopsOf(f)[0].firstCorner];
    forCorners(m, f, [&](uint32_t a, uint32_t b) {
      const Vec2 middle = (uvs[a] + uvs[b]) * 0.5 - first;
      const Vec3 outward = cross(m.at(b) - m.at(a), normal);
      gu += outward * middle.x;
      gv += outward * middle.y;
    });
    const double area = m.area(f);
    // |dual of gu| = |gv| / |gu x gv|, with gradients that are the sums over the area.
    const double turned = std::fabs(dot(cross(gu, gv), normal));
    if (!(area > 0) || !(turned > 0)) continue;
    sum = sum + Vec2{length(gv), length(gu)} * (area / turned * area);
    total += area;
  }
  return total > 0 ? sum * (1 / total) : Vec2{};
}

void tileUv(Mesh& m, int set, const UvTile& u, const UvTile& v) {
  const Vec2 unit = uvUnitLength(m, set), range = uvBounds(m, set).size();
  scaleUv(m, set, {tileScale(u, unit.x, range.x), tileScale(v, unit.y, range.y)});
}

void copyUv(Mesh& m, int from, int to) {
  if (from != to) setOf(m, to) = setOf(m, from);
}

void deleteUv(Mesh& m, int set) { setOf(m, set).clear(); }

}  // namespace gable
