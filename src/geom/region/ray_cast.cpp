// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/ray_cast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/work.h"
#include "geom/region/places.h"
#include "geom/region/point_cells.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {
namespace {

// Whether two segments have a point in common; on one line they must overlap.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int p = orientation(a, b, c), q = orientation(a, b, d);
  if (p * q > 0 || orientation(c, d, a) * orientation(c, d, b) > 0) return false;
  if (p != 0 || q != 0) return true;
  const auto apart = [](double from, double to, double other, double end) {
    return std::max(from, to) < std::min(other, end) || std::max(other, end) < std::min(from, to);
  };
  return !apart(a.x, b.x, c.x, d.x) && !apart(a.y, b.y, c.y, d.y);
}

}  // namespace

RayCaster::RayCaster(const Polygon& p, const RayOptions& o) : p_(p), o_(o), edges_(edgesOf(p)) {
  scale_ = length(bounds(p).size());
  uint32_t first = 0;
  for (const Ring& r : ringsOf(p)) {
    const auto n = static_cast<uint32_t>(r.size());
    for (uint32_t i = 0; i < n; ++i) {
      before_.push_back(first + (i + n - 1) % n);
      after_.push_back(first + (i + 1) % n);
    }
    first += n;
  }
  sides_.resize(edges_.size());
  corners_.resize(edges_.size());
  std::iota(corners_.begin(), corners_.end(), 0u);
  std::sort(corners_.begin(), corners_.end(), [&](uint32_t i, uint32_t k) {
    return edges_[i].a == edges_[k].a ? i < k : lessXy(edges_[i].a, edges_[k].a);
  });
}

bool RayCaster::takeCentres(std::span<const Vec2> centres) {
  bool inside = true;
  for (const Vec2 c : centres) {
    work();
    if (locate(p_, c) == Where::Inside) {
      centres_.push_back(c);
    } else {
      inside = false;
    }
  }
  if (centres_.empty()) centres_.push_back(poleOf(p_).centre);
  return inside;
}

void RayCaster::cast(std::span<const RayTarget> targets) {
  for (const RayTarget& t : targets) castTo(t);
  dropDuplicates();
  link();
}

// The first boundary point along a ray, beyond its start; edges at `except` do not count.
bool RayCaster::firstHit(Vec2 from, Vec2 d, Vec2 except, bool hasExcept, Ray& hit,
                         double& reach) const {
  bool found = false;
  reach = 1e300;
  work(edges_.size());
  // Most edges lie on one side of the ray; which those are is found without branches.
  for (size_t i = 0; i < edges_.size(); ++i) sides_[i] = cross(d, edges_[i].a - from);
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    const Vec2 a = edges_[i].a, b = edges_[i].b;
    if (sides_[i] * sides_[after_[i]] > 0) continue;
    if (hasExcept && (a == except || b == except)) continue;
    const double det = cross(d, b - a);
    if (det == 0) continue;
    const double t = cross(a - from, b - a) / det;
    const double u = cross(a - from, d) / det;
    if (!(t > 0) || u < 0 || u > 1 || t >= reach) continue;
    reach = t;
    hit = {from, a + (b - a) * u, i, u};
    found = true;
  }
  return found;
}

// Whether the corner where an edge starts is seen from a place through the region's outside. For
// corners that the outlines visit once.
bool RayCaster::fromOutside(uint32_t edge, Vec2 place) const {
  const Vec2 a = edges_[before_[edge]].a, v = edges_[edge].a, b = edges_[edge].b;
  const bool right = orientation(v, b, place) < 0, behind = orientation(a, v, place) < 0;
  return orientation(a, v, b) >= 0 ? right || behind : right && behind;
}

std::pair<uint32_t, uint32_t> RayCaster::cornerAt(Vec2 place) const {
  const auto first = std::lower_bound(corners_.begin(), corners_.end(), place,
                                      [&](uint32_t i, Vec2 v) { return lessXy(edges_[i].a, v); });
  auto last = first;
  while (last != corners_.end() && edges_[*last].a == place) ++last;
  work(static_cast<size_t>(last - first));
  return {first == last ? kNoEdge : *first, static_cast<uint32_t>(last - first)};
}

// A ray from a centre to a target; false when it is hidden from there.
bool RayCaster::rayTo(Vec2 c, const RayTarget& t, Ray& ray) const {
  double reach = 0;
  if (t.kind == RayTarget::Kind::Direction) {
    return length(t.value) > 0 && firstHit(c, t.value, {}, false, ray, reach);
  }
  const Vec2 d = t.value - c;
  if (!(length(d) > 0)) return false;
  // A vertex of the region is met exactly; nothing else may lie before it.
  const auto [corner, visits] = cornerAt(t.value);
  if (visits > 0) {
    Ray first;
    const bool blocked = firstHit(c, d, t.value, true, first, reach) && reach < 1 - 1e-9;
    // The ray must come from within: a corner may be seen through its own outside.
    const bool outside =
        !blocked &&
        (visits == 1 ? fromOutside(corner, c) : locate(p_, t.value - d * 1e-6) == Where::Outside);
    if (blocked || outside) {
      if (!o_.stopHidden || !blocked) return false;
      ray = first;
      return true;
    }
    ray = {c, t.value, corner, 0};
    return true;
  }
  if (!firstHit(c, d, {}, false, ray, reach)) return false;
  return reach >= 1 - 1e-9 || o_.stopHidden;
}

void RayCaster::castTo(const RayTarget& t) {
  bool found = false;
  Ray best;
  for (const Vec2 c : centres_) {
    work(edges_.size());
    Ray r;
    if (!rayTo(c, t, r)) continue;
    if (found && length(r.to - r.from) >= length(best.to - best.from)) continue;
    best = r;
    found = true;
  }
  if (found) rays_.push_back(best);
}

void RayCaster::dropDuplicates() {
  std::vector<Ray> kept;
  PointCells ends(std::max(o_.pathWidth, 1e-9 * scale_), rays_.size());
  for (const Ray& r : rays_) {
    work();
    if (ends.snap(r.to) == kept.size()) kept.push_back(r);
  }
  rays_ = std::move(kept);
}

bool RayCaster::sees(Vec2 a, Vec2 b) const {
  return std::none_of(edges_.begin(), edges_.end(),
                      [&](const Segment& e) { return meet(a, b, e.a, e.b); });
}

bool RayCaster::crossesAny(Vec2 a, Vec2 b) const {
  work(links_.size());
  const auto meets = [&](const Ray& r) {
    if (r.from == a || r.from == b || r.to == a || r.to == b) return false;
    return meet(a, b, r.from, r.to);
  };
  return std::any_of(links_.begin(), links_.end(), meets);
}

void RayCaster::addLink(size_t i, size_t k) {
  const bool mayCross = o_.links == CentreLinks::Opposite;
  if (!sees(centres_[i], centres_[k])) return;
  if (!mayCross && crossesAny(centres_[i], centres_[k])) return;
  links_.push_back({centres_[i], centres_[k]});
}

void RayCaster::link() {
  const size_t n = centres_.size();
  if (n < 2 || o_.links == CentreLinks::None) return;
  if (o_.links == CentreLinks::Pairs) {
    for (size_t i = 0; i + 1 < n; i += 2) addLink(i, i + 1);
  } else if (o_.links == CentreLinks::Loop || o_.links == CentreLinks::Opposite) {
    linkAround();
  } else {
    linkTree();
  }
  // Rays give way to links.
  std::erase_if(rays_, [&](const Ray& r) { return crossesAny(r.from, r.to); });
  std::vector<Ray> kept;
  for (const Ray& r : rays_) {
    work(kept.size());
    const bool crosses = std::any_of(kept.begin(), kept.end(), [&](const Ray& k) {
      return !(k.from == r.from) && meet(k.from, k.to, r.from, r.to);
    });
    if (!crosses) kept.push_back(r);
  }
  rays_ = std::move(kept);
}

// By angle around the middle of all centres, which gives a round that does not cross itself.
void RayCaster::linkAround() {
  Vec2 middle;
  for (const Vec2 c : centres_) middle = middle + c * (1.0 / static_cast<double>(centres_.size()));
  std::vector<size_t> order(centres_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const Vec2 u = centres_[a] - middle, v = centres_[b] - middle;
    const bool upU = u.y > 0 || (u.y == 0 && u.x > 0), upV = v.y > 0 || (v.y == 0 && v.x > 0);
    if (upU != upV) return upU;
    const double c = cross(u, v);
    return c != 0 ? c > 0 : a < b;
  });
  if (o_.links == CentreLinks::Opposite) {
    // Of an odd number the last stays without a partner.
    const size_t half = order.size() / 2;
    for (size_t i = 0; i < half; ++i) addLink(order[i], order[i + half]);
    return;
  }
  for (size_t i = 0; i < order.size(); ++i) {
    if (order.size() == 2 && i == 1) break;
    addLink(order[i], order[(i + 1) % order.size()]);
  }
}

// The shortest tree of what sees each other; then, as far as wanted, further short links.
void RayCaster::linkTree() {
  struct Link {
    size_t a, b;
    double length;
  };
  std::vector<Link> all;
  for (size_t a = 0; a < centres_.size(); ++a) {
    work();
    for (size_t b = a + 1; b < centres_.size(); ++b) {
      work(edges_.size());
      if (sees(centres_[a], centres_[b])) all.push_back({a, b, length(centres_[b] - centres_[a])});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Link& a, const Link& b) { return a.length < b.length; });
  std::vector<size_t> group(centres_.size());
  std::iota(group.begin(), group.end(), size_t{0});
  std::vector<Link> others;
  for (const Link& l : all) {
    work(group.size());
    const size_t from = group[l.a], to = group[l.b];
    if (from == to) {
      others.push_back(l);
      continue;
    }
    std::replace(group.begin(), group.end(), from, to);
    addLink(l.a, l.b);
  }
  if (o_.links != CentreLinks::Thin) return;
  std::erase_if(others, [&](const Link& l) { return crossesAny(centres_[l.a], centres_[l.b]); });
  const auto take = static_cast<size_t>(
      std::round(std::clamp(o_.thin, 0.0, 1.0) * static_cast<double>(others.size())));
  for (size_t i = 0; i < take; ++i) addLink(others[i].a, others[i].b);
}

}  // namespace gable
