// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Coverage: seen along the normal, the geometry is an interval and so is each edge that looks the
// same way. The ends of edges divide the geometry's interval; each piece goes to the nearest of the
// edges over it.
#include "shape/edge_attributes.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/work.h"

namespace gable {

namespace {

// Seen from the side, a normal within this of the plane's own has no direction in the plane.
constexpr double kFlat = 1e-6;
// Lengths and depths nearer than this are equal, in metres.
constexpr double kSame = 1e-7;

double distanceTo(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double square = dot(d, d);
  const double t = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return length(p - (a + d * t));
}

Vec3 meanNormal(const Mesh& m) {
  Vec3 sum;
  for (size_t f = 0; f < m.faceCount(); ++f) sum += m.areaNormal(f);
  return sum == Vec3{} ? Vec3{0, 1, 0} : normalized(sum);
}

}  // namespace

std::string_view edgeAttributeName(std::string_view name) {
  constexpr std::string_view kPrefix = "/edgeattr/";
  return name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name;
}

EdgeAttributes::EdgeAttributes(const Mesh& footprint, Given attributes, const ValuePool& pool)
    : plane_(frameFromZ({}, meanNormal(footprint), Vec3{1, 0, 0})),
      attributes_(std::move(attributes)) {
  const auto flat = [&](uint32_t corner) {
    const Vec3 p = plane_.toLocal(footprint.at(corner));
    return Vec2{p.x, p.y};
  };
  for (size_t f = 0; f < footprint.faceCount(); ++f) {
    const double side = dot(footprint.areaNormal(f), plane_.z) < 0 ? -1 : 1;
    for (const MeshLoop& loop : footprint.loopsOf(f)) {
      // A face of two corners is one edge.
      const uint32_t count = loop.cornerCount < 3 ? loop.cornerCount - 1 : loop.cornerCount;
      for (uint32_t i = 0; i < count; ++i) {
        work();
        Edge e;
        e.from = flat(loop.firstCorner + i);
        e.to = flat(loop.firstCorner + (i + 1) % loop.cornerCount);
        const Vec2 d = e.to - e.from;
        const double l = length(d);
        if (l > 0) e.outward = Vec2{d.y, -d.x} * (side / l);
        edges_.push_back(e);
      }
    }
  }
  std::ranges::sort(attributes_, {}, [](const auto& a) -> const std::string& { return a.first; });
  for (const auto& [name, value] : attributes_) {
    hash_ = hashCombine(hashCombine(hash_, hashBytes(name)), value.hash());
  }
  findStreets(pool);
}

const Value* EdgeAttributes::find(std::string_view name) const {
  for (const auto& [own, value] : attributes_) {
    if (own == name) return &value;
  }
  return nullptr;
}

// The street is in front: its direction is the mean of those of its edges by their lengths. Where
// streets on opposite sides cancel each other out it is that of the widest one, the first of them.
void EdgeAttributes::findStreets(const ValuePool& pool) {
  const Value* given = find(kStreetWidth);
  if (!given || given->type != ValueType::FloatArray) return;
  const std::vector<double>& widths = pool.array(*given).numbers;
  const auto widthOf = [&](size_t e) { return e < widths.size() ? widths[e] : 0.0; };
  Vec2 front, widest;
  double whole = 0, width = 0;
  for (size_t e = 0; e < edges_.size(); ++e) {
    if (!(widthOf(e) > 0)) continue;
    const double l = length(edges_[e].to - edges_[e].from);
    front = front + edges_[e].outward * l;
    whole += l;
    if (widthOf(e) <= width) continue;
    width = widthOf(e);
    widest = edges_[e].outward;
  }
  if (!(whole > 0)) return;
  if (length(front) <= 1e-6 * whole) front = widest;
  const Vec2 right{-front.y, front.x};
  for (size_t e = 0; e < edges_.size(); ++e) {
    const double ahead = dot(edges_[e].outward, front), aside = dot(edges_[e].outward, right);
    // The two other sides of a corner lot lie at 45 degrees: they are sides.
    const bool behind = -ahead > std::fabs(aside) + 1e-6 * length(front);
    sides_.push_back(widthOf(e) > 0 ? StreetSide::Front
                     : behind       ? StreetSide::Back
                     : aside > 0    ? StreetSide::Right
                                    : StreetSide::Left);
  }
}

int32_t EdgeAttributes::edgeAt(std::span<const Vec3> points, const Vec3& normal) const {
  if (edges_.empty() || points.empty()) return -1;
  const Vec3 direction = plane_.toLocalDirection(normalized(normal));
  Vec2 along{direction.x, direction.y};
  along = length(along) <= kFlat ? Vec2{} : along * (1 / length(along));
  const Vec2 across{-along.y, along.x};
  Vec2 middle;
  double low = 0, high = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 local = plane_.toLocal(points[i]);
    const Vec2 p{local.x, local.y};
    middle = middle + p * (1 / static_cast<double>(points.size()));
    low = i == 0 ? dot(p, across) : std::min(low, dot(p, across));
    high = i == 0 ? dot(p, across) : std::max(high, dot(p, across));
  }
  if (along == Vec2{}) return nearest(middle, along);
  const int32_t best = covered(along, low, high, dot(middle, along));
  return best >= 0 ? best : nearest(middle, along);
}

int32_t EdgeAttributes::covered(const Vec2& along, double low, double high, double depth) const {
  const Vec2 across{-along.y, along.x};
  struct Over {
    uint32_t edge;
    double from, to, depthFrom, slope;
  };
  std::vector<Over> over;
  std::vector<double> ends{low, high};
  for (uint32_t e = 0; e < edges_.size(); ++e) {
    work();
    const Edge& edge = edges_[e];
    if (!(dot(edge.outward, along) > kFlat)) continue;
    double from = dot(edge.from, across), to = dot(edge.to, across);
    double depthFrom = dot(edge.from, along), depthTo = dot(edge.to, along);
    if (from > to) {
      std::swap(from, to);
      std::swap(depthFrom, depthTo);
    }
    if (to < low - kSame || from > high + kSame || !(to > from)) continue;
    over.push_back({e, from, to, depthFrom, (depthTo - depthFrom) / (to - from)});
    for (const double end : {from, to}) {
      if (end > low && end < high) ends.push_back(end);
    }
  }
  std::ranges::sort(ends);
  std::vector<double> coverage(over.size(), 0);
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    const double at = (ends[i] + ends[i + 1]) / 2;
    // A point covers what it lies on.
    const double part = high - low <= kSame ? 1 : ends[i + 1] - ends[i];
    size_t best = over.size();
    double least = 0;
    for (size_t k = 0; k < over.size(); ++k) {
      work();
      const Over& o = over[k];
      if (at < o.from - kSame || at > o.to + kSame) continue;
      const double away = std::fabs(o.depthFrom + o.slope * (at - o.from) - depth);
      if (best < over.size() && away >= least - kSame) continue;
      best = k;
      least = away;
    }
    if (best < over.size()) coverage[best] += part;
  }
  int32_t found = -1;
  double most = 0;
  for (size_t k = 0; k < over.size(); ++k) {
    if (coverage[k] <= most + (found < 0 ? 0 : kSame)) continue;
    most = coverage[k];
    found = static_cast<int32_t>(over[k].edge);
  }
  return found;
}

// Of the edges that look along, or of all.
int32_t EdgeAttributes::nearest(Vec2 p, const Vec2& along) const {
  for (const bool all : {false, true}) {
    int32_t found = -1;
    double least = 0;
    for (size_t e = 0; e < edges_.size(); ++e) {
      work();
      if (!all && !(dot(edges_[e].outward, along) > kFlat)) continue;
      const double away = distanceTo(p, edges_[e].from, edges_[e].to);
      if (found >= 0 && away >= least - kSame) continue;
      found = static_cast<int32_t>(e);
      least = away;
    }
    if (found >= 0) return found;
  }
  return -1;
}

}  // namespace gable
