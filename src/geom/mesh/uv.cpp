// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The gradients of u and v over a face come from Green's theorem; their dual vectors tell how far
// one goes on the surface for one unit.
#include "geom/mesh/uv.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/face_triangles.h"
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

// How u and v grow over the plane of a face; of a face that bends, in the mean.
struct Gradients {
  double area = 0;
  Vec3 normal, u, v;
};

Gradients gradientsOf(const Mesh& m, size_t face, const std::vector<Vec2>& uvs) {
  Gradients g;
  g.area = m.area(face);
  g.normal = m.normal(face);
  if (!(g.area > 0)) return g;
  const Vec2 first = uvs[m.loopsOf(face)[0].firstCorner];
  forCorners(m, face, [&](uint32_t a, uint32_t b) {
    const Vec2 middle = (uvs[a] + uvs[b]) * 0.5 - first;
    const Vec3 outward = cross(m.at(b) - m.at(a), g.normal);
    g.u += outward * middle.x;
    g.v += outward * middle.y;
  });
  g.u = g.u * (1 / g.area);
  g.v = g.v * (1 / g.area);
  return g;
}

// Whether some corner has other values than the gradients from the first corner give it.
bool bends(const Mesh& m, size_t face, const std::vector<Vec2>& uvs, const Gradients& g) {
  constexpr double kStraight = 1e-6;
  const MeshLoop& outer = m.loopsOf(face)[0];
  if (!(g.area > 0) || (outer.cornerCount == 3 && m.loopsOf(face).size() == 1)) return false;
  Box2 box;
  Vec2 worst;
  forCorners(m, face, [&](uint32_t c, uint32_t) {
    const Vec3 away = m.at(c) - m.at(outer.firstCorner);
    const Vec2 off = uvs[c] - uvs[outer.firstCorner] - Vec2{dot(g.u, away), dot(g.v, away)};
    worst = {std::max(worst.x, std::fabs(off.x)), std::max(worst.y, std::fabs(off.y))};
    box.include(uvs[c]);
  });
  const Vec2 size = box.size();
  return worst.x > kStraight * size.x || worst.y > kStraight * size.y;
}

// The mean, by area, of what a unit of u and of v spans: |dual of grad u| = |grad v| / |grad u x
// grad v|.
class UnitLength {
 public:
  void add(double area, Vec2 lengths) {
    sum_ = sum_ + lengths * area;
    area_ += area;
  }
  void add(const Gradients& g) {
    const double turned = std::fabs(dot(cross(g.u, g.v), g.normal));
    if (g.area > 0 && turned > 0) add(g.area, Vec2{length(g.v), length(g.u)} * (1 / turned));
  }
  Vec2 value() const { return area_ > 0 ? sum_ * (1 / area_) : Vec2{}; }

 private:
  Vec2 sum_;
  double area_ = 0;
};

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
  UnitLength mean;
  FaceTriangulator triangulator;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    const Gradients g = gradientsOf(m, f, uvs);
    if (!bends(m, f, uvs, g)) {
      mean.add(g);
      continue;
    }
    // The mean over the face's uv space, where triangles along one border weigh nothing: dp/du =
    // (p t.y - q s.y) / det, and det is twice the triangle's area there.
    triangles.clear();
    triangulator.add(m, f, triangles);
    Vec2 sum;
    double space = 0;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 p = m.at(b) - m.at(a), q = m.at(c) - m.at(a);
      const Vec2 s = uvs[b] - uvs[a], t = uvs[c] - uvs[a];
      sum = sum + Vec2{length(p * t.y - q * s.y), length(q * s.x - p * t.x)};
      space += std::fabs(cross(s, t));
    }
    if (space > 0) mean.add(g.area, sum * (1 / space));
  }
  return mean.value();
}

Mesh cutWhereUvBends(const Mesh& m, int set, int coordinate) {
  const std::vector<Vec2>& uvs = setOf(m, set);
  const auto axis = static_cast<size_t>(coordinate);
  constexpr double kSame = 1e-9;
  std::vector<double> values(uvs.size(), 0), cuts;
  double low = HUGE_VAL, high = -HUGE_VAL;
  std::vector<bool> bent(m.faceCount());
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (uvs.empty() || !bends(m, f, uvs, gradientsOf(m, f, uvs))) continue;
    bent[f] = true;
    forCorners(m, f, [&](uint32_t c, uint32_t) {
      values[c] = uvs[c][axis];
      cuts.push_back(values[c]);
      low = std::min(low, values[c]);
      high = std::max(high, values[c]);
    });
  }
  if (cuts.empty()) return m;
  // Other faces lie below all cuts.
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (!bent[f]) forCorners(m, f, [&](uint32_t c, uint32_t) { values[c] = low; });
  }
  std::sort(cuts.begin(), cuts.end());
  const double same = kSame * (high - low);
  std::vector<double> apart;
  for (const double c : cuts) {
    if (c - (apart.empty() ? low : apart.back()) > same && high - c > same) apart.push_back(c);
  }
  return apart.empty() ? m : scoreField(m, values, apart);
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
