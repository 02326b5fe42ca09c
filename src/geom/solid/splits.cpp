// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A pass goes over the edges of each facet in the order of their boxes, and divides those that
// cross or run through a vertex. A vertex counts as on an edge within half of the distance that
// vertices keep from each other, so that the parts of an edge are shorter than it. Passes are
// repeated, since the parts bend to their vertices; nearly always the second finds nothing.
#include "geom/solid/splits.h"

#include <algorithm>
#include <utility>

#include "math/predicates.h"

namespace gable::solid {

bool Splits::add(uint32_t u, uint32_t v, uint32_t w) {
  if (w == u || w == v) return false;
  std::vector<uint32_t>& list = inside_[edgeKey(u, v)];
  if (std::find(list.begin(), list.end(), w) != list.end()) return false;
  const Vec3 from = pool_[std::min(u, v)], along = pool_[std::max(u, v)] - from;
  const auto place = [&](uint32_t x) { return dot(pool_[x] - from, along); };
  const auto at =
      std::find_if(list.begin(), list.end(), [&](uint32_t x) { return place(x) > place(w); });
  list.insert(at, w);
  work();
  return true;
}

bool Splits::expand(uint32_t u, uint32_t v, std::vector<Edge>& out, int depth) const {
  constexpr int kDeepest = 48;
  work();
  const auto found = inside_.find(edgeKey(u, v));
  if (found == inside_.end()) {
    out.push_back({u, v});
    return true;
  }
  if (depth > kDeepest) return false;
  const std::vector<uint32_t>& list = found->second;
  uint32_t last = u;
  for (size_t k = 0; k < list.size(); ++k) {
    const uint32_t w = u < v ? list[k] : list[list.size() - 1 - k];
    if (!expand(last, w, out, depth + 1)) return false;
    last = w;
  }
  return expand(last, v, out, depth + 1);
}

bool isDivided(const Facet& f) {
  if (!f.inner.empty() || !f.points.empty()) return true;
  std::vector<uint32_t> all;
  for (const auto& loop : f.loops) all.insert(all.end(), loop.begin(), loop.end());
  if (all.size() == 3) return false;
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) != all.end();
}

bool edgesOf(const Facet& f, const Splits& splits, FacetEdges& out) {
  out.outline.clear();
  out.inner.clear();
  bool good = true;
  forEdges(f, [&](uint32_t u, uint32_t v) { good = good && splits.expand(u, v, out.outline); });
  for (const Edge& e : f.inner) good = good && splits.expand(e[0], e[1], out.inner);
  return good;
}

namespace {

class Divider {
 public:
  Divider(Facets& facets, Splits& splits)
      : facets_(facets), pool_(facets.pool), splits_(splits), seen_(facets.list.size()) {}

  bool run() {
    constexpr int kMostPasses = 24;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      bool changed = false;
      for (uint32_t i = 0; i < facets_.list.size(); ++i) {
        const Facet& f = facets_.list[i];
        if (!isDivided(f)) continue;
        if (!gather(f)) return false;
        if (seen_[i] == items_.size()) continue;
        seen_[i] = items_.size();
        if (divide(f)) {
          changed = true;
          seen_[i] = 0;
        }
      }
      if (!changed) return true;
    }
    return false;
  }

 private:
  // An edge, or a point where both ends are one, with its box in the projection.
  struct Item {
    uint32_t u = 0, v = 0;
    Box2 box;
  };

  bool gather(const Facet& f) {
    if (!edgesOf(f, splits_, edges_)) return false;
    std::vector<Edge>& all = edges_.inner;
    all.insert(all.end(), edges_.outline.begin(), edges_.outline.end());
    for (const uint32_t p : f.points) all.push_back({p, p});
    for (Edge& e : all) {
      if (e[0] > e[1]) std::swap(e[0], e[1]);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    items_.clear();
    for (const Edge& e : all) {
      Item item{e[0], e[1], {}};
      item.box.include(f.project(pool_[e[0]]));
      item.box.include(f.project(pool_[e[1]]));
      items_.push_back(item);
    }
    work(items_.size());
    return true;
  }

  bool divide(const Facet& f) {
    std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
      if (a.box.min.x != b.box.min.x) return a.box.min.x < b.box.min.x;
      return std::pair(a.u, a.v) < std::pair(b.u, b.v);
    });
    const double slack = pool_.tolerance();
    bool changed = false;
    for (size_t i = 0; i < items_.size(); ++i) {
      const Item s = items_[i];
      for (size_t j = i + 1; j < items_.size(); ++j) {
        const Item& t = items_[j];
        work();
        if (t.box.min.x > s.box.max.x + slack) break;
        if (t.box.min.y > s.box.max.y + slack || s.box.min.y > t.box.max.y + slack) continue;
        if (meet(f, s, t)) changed = true;
      }
    }
    return changed;
  }

  bool meet(const Facet& f, const Item& s, const Item& t) {
    bool touched = false, changed = false;
    const auto tryEnd = [&](const Item& edge, uint32_t w) {
      if (edge.u == edge.v || w == edge.u || w == edge.v) return;
      if (nearestOn(pool_[edge.u], pool_[edge.v], pool_[w]).distance > pool_.tolerance() / 2) {
        return;
      }
      touched = true;
      changed = splits_.add(edge.u, edge.v, w) || changed;
    };
    tryEnd(s, t.u);
    if (t.v != t.u) tryEnd(s, t.v);
    tryEnd(t, s.u);
    if (s.v != s.u) tryEnd(t, s.v);
    return touched ? changed : cross(f, s, t);
  }

  bool cross(const Facet& f, const Item& s, const Item& t) {
    const bool share = s.u == t.u || s.u == t.v || s.v == t.u || s.v == t.v;
    if (share || s.u == s.v || t.u == t.v) return false;
    const Vec2 a = f.project(pool_[s.u]), b = f.project(pool_[s.v]);
    const Vec2 c = f.project(pool_[t.u]), d = f.project(pool_[t.v]);
    if (orientation(a, b, c) * orientation(a, b, d) >= 0) return false;
    if (orientation(c, d, a) * orientation(c, d, b) >= 0) return false;
    const double ha = gable::cross(d - c, a - c), hb = gable::cross(d - c, b - c);
    const Vec3 at = pool_[s.u] + (pool_[s.v] - pool_[s.u]) * (ha / (ha - hb));
    const uint32_t w = facets_.pool.snap(at);
    const bool first = splits_.add(s.u, s.v, w);
    return splits_.add(t.u, t.v, w) || first;
  }

  Facets& facets_;
  const VertexPool& pool_;
  Splits& splits_;
  // How many items a facet had when nothing was left to divide.
  std::vector<size_t> seen_;
  FacetEdges edges_;
  std::vector<Item> items_;
};

// The two sides of a face without width become one chain of edges.
void sew(const Facets& facets, Splits& splits) {
  for (const auto& loop : facets.slivers) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t u = loop[i], v = loop[(i + 1) % loop.size()];
      for (const uint32_t w : loop) {
        work();
        const Vec3 a = facets.pool[u], b = facets.pool[v];
        const Nearest n = nearestOn(a, b, facets.pool[w]);
        const bool within = n.along > 0 && n.along < 1;
        if (within && n.distance <= facets.pool.tolerance()) splits.add(u, v, w);
      }
    }
  }
}

}  // namespace

bool divideEdges(Facets& facets, Splits& splits) {
  sew(facets, splits);
  return Divider(facets, splits).run();
}

}  // namespace gable::solid
