// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Two facets whose planes cross meet on a line. Where the edges of each come to the plane of the
// other are all places on it at which the common part can begin or end; between two of these that
// follow each other either all or nothing is common, which the middle tells.
#include "geom/solid/contacts.h"

#include <algorithm>
#include <utility>

#include "base/work.h"
#include "geom/solid/box_tree.h"

namespace gable::solid {
namespace {

// On which side of a plane the vertices of a facet lie, by loop and place in it.
struct Sides {
  std::vector<int> sign;
  bool below = false, on = false, above = false;

  bool apart() const { return !on && !(below && above); }
  bool flat() const { return !below && !above; }
};

class Contacts {
 public:
  explicit Contacts(Facets& facets) : facets_(facets), pool_(facets.pool) {}

  void run() {
    std::vector<Box3> boxes;
    for (const Facet& f : facets_.list) boxes.push_back(f.box);
    const BoxTree tree(boxes);
    const Vec3 slack{pool_.tolerance(), pool_.tolerance(), pool_.tolerance()};
    for (uint32_t i = 0; i < facets_.list.size(); ++i) {
      const Box3 near{boxes[i].min - slack, boxes[i].max + slack};
      near_.clear();
      tree.query(near, [&](uint32_t j) {
        if (j > i) near_.push_back(j);
      });
      std::sort(near_.begin(), near_.end());
      for (const uint32_t j : near_) meet(facets_.list[i], i, facets_.list[j], j);
    }
    shareInPlane();
  }

 private:
  Sides sidesOf(const Facet& f, const Facet& plane) const {
    Sides out;
    const double slack = pool_.tolerance() / 2;
    for (const auto& loop : f.loops) {
      work(loop.size());
      for (const uint32_t v : loop) {
        const double h = plane.height(pool_[v]);
        out.sign.push_back(h > slack ? 1 : h < -slack ? -1 : 0);
        out.below = out.below || h < -slack;
        out.above = out.above || h > slack;
      }
    }
    out.on = std::find(out.sign.begin(), out.sign.end(), 0) != out.sign.end();
    return out;
  }

  void meet(Facet& f, uint32_t i, Facet& g, uint32_t j) {
    const Sides ofG = sidesOf(g, f);
    if (ofG.apart()) return;
    const Sides ofF = sidesOf(f, g);
    if (ofF.apart()) return;
    if (ofF.flat() || ofG.flat()) {
      meetInPlane(f, i, g, j);
    } else {
      meetOnLine(f, ofF, g, ofG);
    }
  }

  void meetOnLine(Facet& f, const Sides& ofF, Facet& g, const Sides& ofG) {
    places_.clear();
    addPlaces(f, ofF, g);
    addPlaces(g, ofG, f);
    if (places_.empty()) return;
    sortAlongLine();
    for (const uint32_t v : places_) {
      addPoint(f, v);
      addPoint(g, v);
    }
    for (size_t k = 0; k + 1 < places_.size(); ++k) {
      const uint32_t u = places_[k], v = places_[k + 1];
      const Vec3 middle = (pool_[u] + pool_[v]) * 0.5;
      if (!covers(f, pool_, middle) || !covers(g, pool_, middle)) continue;
      addEdge(f, u, v);
      addEdge(g, u, v);
    }
  }

  // The vertices of f on the plane of g and the crossings of its edges with it, within g.
  void addPlaces(const Facet& f, const Sides& sides, const Facet& g) {
    size_t base = 0;
    for (const auto& loop : f.loops) {
      for (size_t k = 0; k < loop.size(); ++k) {
        const size_t next = k + 1 < loop.size() ? k + 1 : 0;
        const int a = sides.sign[base + k], b = sides.sign[base + next];
        if (a == 0 && covers(g, pool_, pool_[loop[k]])) places_.push_back(loop[k]);
        if (a * b >= 0) continue;
        const Vec3 p = crossing(loop[k], loop[next], g);
        if (covers(g, pool_, p)) places_.push_back(pool_.snap(p));
      }
      base += loop.size();
    }
  }

  // The same for both directions of the edge.
  Vec3 crossing(uint32_t u, uint32_t v, const Facet& g) const {
    const Vec3 a = pool_[std::min(u, v)], b = pool_[std::max(u, v)];
    const double ha = g.height(a), hb = g.height(b);
    return a + (b - a) * (ha / (ha - hb));
  }

  void sortAlongLine() {
    std::sort(places_.begin(), places_.end());
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    if (places_.size() < 3) return;
    // The line is where the places are: the planes may be nearly parallel.
    const Vec3 first = pool_[places_[0]];
    Vec3 direction;
    for (const uint32_t v : places_) {
      const Vec3 d = pool_[v] - first;
      if (dot(d, d) > dot(direction, direction)) direction = d;
    }
    std::vector<std::pair<double, uint32_t>> order;
    for (const uint32_t v : places_) order.emplace_back(dot(pool_[v] - first, direction), v);
    std::sort(order.begin(), order.end());
    for (size_t k = 0; k < order.size(); ++k) places_[k] = order[k].second;
  }

  void meetInPlane(Facet& f, uint32_t i, Facet& g, uint32_t j) {
    if (!apartBesideAnEdge(f, g) && !apartBesideAnEdge(g, f)) {
      inPlane_.emplace_back(i, j);
      return;
    }
    addTouching(f, g);
    addTouching(g, f);
  }

  // All of g lies on or beyond the line of one edge of f, and f on this side of it.
  bool apartBesideAnEdge(const Facet& f, const Facet& g) const {
    bool apart = false;
    const double slack = pool_.tolerance();
    const auto beyond = [&](const Facet& of, const Vec3& at, const Vec3& out, double sign) {
      for (const auto& loop : of.loops) {
        work(loop.size());
        for (const uint32_t v : loop) {
          if (sign * dot(pool_[v] - at, out) < -slack) return false;
        }
      }
      return true;
    };
    forEdges(f, [&](uint32_t u, uint32_t v) {
      if (apart) return;
      const Vec3 out = normalized(cross(pool_[v] - pool_[u], f.normal));
      apart = beyond(g, pool_[u], out, 1) && beyond(f, pool_[u], out, -1);
    });
    return apart;
  }

  void addTouching(const Facet& from, Facet& to) {
    for (const auto& loop : from.loops) {
      for (const uint32_t v : loop) {
        if (covers(to, pool_, pool_[v])) addPoint(to, v);
      }
    }
  }

  void shareInPlane() {
    struct Given {
      std::vector<Edge> edges;
      std::vector<uint32_t> points;
    };
    std::vector<Given> given(facets_.list.size());
    for (const auto& [i, j] : inPlane_) {
      give(facets_.list[i], facets_.list[j], given[j].edges, given[j].points);
      give(facets_.list[j], facets_.list[i], given[i].edges, given[i].points);
    }
    for (size_t i = 0; i < given.size(); ++i) {
      Facet& f = facets_.list[i];
      f.inner.insert(f.inner.end(), given[i].edges.begin(), given[i].edges.end());
      f.points.insert(f.points.end(), given[i].points.begin(), given[i].points.end());
    }
  }

  void give(const Facet& from, const Facet& to, std::vector<Edge>& edges,
            std::vector<uint32_t>& points) const {
    const auto put = [&](uint32_t u, uint32_t v) {
      Box3 box;
      box.include(pool_[u]);
      box.include(pool_[v]);
      if (box.meets(to.box, pool_.tolerance()) && !to.hasEdge(u, v)) edges.push_back({u, v});
    };
    forEdges(from, put);
    for (const Edge& e : from.inner) put(e[0], e[1]);
    for (const uint32_t v : from.points) {
      if (!to.hasVertex(v) && covers(to, pool_, pool_[v])) points.push_back(v);
    }
    work(from.inner.size() + from.points.size());
  }

  static void addPoint(Facet& f, uint32_t v) {
    if (!f.hasVertex(v)) f.points.push_back(v);
  }
  static void addEdge(Facet& f, uint32_t u, uint32_t v) {
    if (!f.hasEdge(u, v)) f.inner.push_back({u, v});
  }

  Facets& facets_;
  VertexPool& pool_;
  std::vector<uint32_t> near_, places_;
  std::vector<std::pair<uint32_t, uint32_t>> inPlane_;
};

}  // namespace

void findContacts(Facets& facets) { Contacts(facets).run(); }

}  // namespace gable::solid
