// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The edges are halves that run both ways, sorted around their vertices by exact signs; walking
// with the cell on the left gives the cycles that bound cells. A cycle that runs clockwise bounds
// its part from without: it belongs to the smallest cell of another part that holds it. How often
// the outline runs around a cell follows from one neighbour to the next.
#include "geom/solid/cells.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "math/predicates.h"

namespace gable::solid {
namespace {

constexpr uint32_t kNone = 0xffffffff;

class CellFinder {
 public:
  CellFinder(const Facets& facets, uint32_t facet) : facets_(facets), facet_(facet) {}

  void run(const FacetEdges& edges, std::vector<Piece>& out) {
    collect(edges);
    if (net_.empty()) return;
    sortAround();
    walk();
    nest();
    wind();
    give(out);
  }

 private:
  // Half 2k runs along edge k from its lower vertex, half 2k + 1 back.
  static uint32_t twin(uint32_t h) { return h ^ 1u; }
  uint32_t from(uint32_t h) const { return ends_[h / 2][h & 1u]; }
  uint32_t to(uint32_t h) const { return ends_[h / 2][1 - (h & 1u)]; }
  Vec2 at(uint32_t local) const { return points_[local]; }

  uint32_t local(uint32_t v) const {
    return static_cast<uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) -
                                 vertices_.begin());
  }

  void collect(const FacetEdges& edges) {
    struct Use {
      Edge edge;
      int net;
      bool operator<(const Use& o) const { return edge < o.edge; }
    };
    std::vector<Use> uses;
    for (const Edge& e : edges.outline) {
      const bool up = e[0] < e[1];
      uses.push_back({up ? e : Edge{e[1], e[0]}, up ? 1 : -1});
    }
    for (const Edge& e : edges.inner) {
      uses.push_back({e[0] < e[1] ? e : Edge{e[1], e[0]}, 0});
    }
    std::sort(uses.begin(), uses.end());
    for (const Use& u : uses) {
      work();
      if (!ends_.empty() && ends_.back() == u.edge) {
        net_.back() += u.net;
      } else {
        ends_.push_back(u.edge);
        net_.push_back(u.net);
      }
    }
    for (const Edge& e : ends_) vertices_.insert(vertices_.end(), {e[0], e[1]});
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (Edge& e : ends_) e = {local(e[0]), local(e[1])};
    const Facet& f = facets_.list[facet_];
    for (const uint32_t v : vertices_) points_.push_back(f.project(facets_.pool[v]));
    prune();
  }

  // Edges that end nowhere divide nothing.
  void prune() {
    std::vector<std::vector<uint32_t>> around(vertices_.size());
    for (uint32_t k = 0; k < ends_.size(); ++k) {
      for (const uint32_t v : ends_[k]) around[v].push_back(k);
    }
    std::vector<uint32_t> degree;
    for (const auto& a : around) degree.push_back(static_cast<uint32_t>(a.size()));
    std::vector<bool> gone(ends_.size());
    std::vector<uint32_t> open;
    for (uint32_t v = 0; v < degree.size(); ++v) {
      if (degree[v] == 1) open.push_back(v);
    }
    while (!open.empty()) {
      const uint32_t v = open.back();
      open.pop_back();
      for (const uint32_t k : around[v]) {
        work();
        if (gone[k]) continue;
        gone[k] = true;
        for (const uint32_t w : ends_[k]) {
          if (--degree[w] == 1) open.push_back(w);
        }
      }
    }
    size_t kept = 0;
    for (size_t k = 0; k < ends_.size(); ++k) {
      if (gone[k]) continue;
      ends_[kept] = ends_[k];
      net_[kept++] = net_[k];
    }
    ends_.resize(kept);
    net_.resize(kept);
  }

  // The upper half of the directions first, counter-clockwise from +x on.
  bool before(uint32_t g, uint32_t h) const {
    const Vec2 o = at(from(g)), p = at(to(g)), q = at(to(h));
    const auto lower = [&](Vec2 r) { return r.y < o.y || (r.y == o.y && r.x < o.x); };
    if (lower(p) != lower(q)) return lower(q);
    const int turn = orientation(o, p, q);
    return turn != 0 ? turn > 0 : to(g) < to(h);
  }

  void sortAround() {
    const size_t halves = 2 * ends_.size();
    std::vector<uint32_t> order(halves);
    for (uint32_t h = 0; h < halves; ++h) order[h] = h;
    std::sort(order.begin(), order.end(), [&](uint32_t g, uint32_t h) {
      if (from(g) != from(h)) return from(g) < from(h);
      return g != h && before(g, h);
    });
    work(halves);
    next_.assign(halves, 0);
    for (size_t first = 0; first < halves;) {
      size_t last = first;
      while (last < halves && from(order[last]) == from(order[first])) ++last;
      for (size_t k = first; k < last; ++k) {
        // Arriving against order[k], the cell on the left ends at the one clockwise of it.
        next_[twin(order[k])] = order[k > first ? k - 1 : last - 1];
      }
      first = last;
    }
  }

  void walk() {
    cycleOf_.assign(next_.size(), kNone);
    for (uint32_t h = 0; h < next_.size(); ++h) {
      if (cycleOf_[h] != kNone) continue;
      const auto cycle = static_cast<uint32_t>(first_.size());
      double area = 0;
      const Vec2 o = at(from(h));
      for (uint32_t g = h; cycleOf_[g] == kNone; g = next_[g]) {
        work();
        cycleOf_[g] = cycle;
        area += cross(at(from(g)) - o, at(to(g)) - o);
      }
      first_.push_back(h);
      area_.push_back(area);
    }
  }

  bool holds(uint32_t cycle, Vec2 p) const {
    bool inside = false;
    uint32_t h = first_[cycle];
    do {
      work();
      if (passes(at(from(h)), at(to(h)), p)) inside = !inside;
      h = next_[h];
    } while (h != first_[cycle]);
    return inside;
  }

  // For each cycle the cell that it bounds: a counter-clockwise cycle, or kNone for all around.
  void nest() {
    DisjointSets parts(vertices_.size());
    for (const Edge& e : ends_) parts.join(e[0], e[1]);
    cell_.assign(first_.size(), kNone);
    for (uint32_t c = 0; c < first_.size(); ++c) {
      if (area_[c] > 0) {
        cell_[c] = c;
        continue;
      }
      const uint32_t v = from(first_[c]);
      for (uint32_t d = 0; d < first_.size(); ++d) {
        if (!(area_[d] > 0) || parts.find(from(first_[d])) == parts.find(v)) continue;
        if (cell_[c] != kNone && area_[d] >= area_[cell_[c]]) continue;
        if (holds(d, at(v))) cell_[c] = d;
      }
    }
  }

  uint32_t cellOf(uint32_t half) const { return cell_[cycleOf_[half]]; }

  void wind() {
    const uint32_t outside = static_cast<uint32_t>(first_.size());
    const auto index = [&](uint32_t half) {
      const uint32_t c = cellOf(half);
      return c == kNone ? outside : c;
    };
    std::vector<std::vector<uint32_t>> halvesOf(first_.size() + 1);
    for (uint32_t h = 0; h < next_.size(); ++h) halvesOf[index(h)].push_back(h);
    turns_.assign(first_.size() + 1, 0);
    std::vector<bool> known(first_.size() + 1);
    std::vector<uint32_t> open{outside};
    known[outside] = true;
    while (!open.empty()) {
      const uint32_t c = open.back();
      open.pop_back();
      for (const uint32_t h : halvesOf[c]) {
        work();
        const uint32_t d = index(twin(h));
        if (known[d]) continue;
        known[d] = true;
        const int net = (h & 1u) == 0 ? net_[h / 2] : -net_[h / 2];
        turns_[d] = turns_[c] - net;
        open.push_back(d);
      }
    }
  }

  void give(std::vector<Piece>& out) {
    std::vector<uint32_t> pieceOf(first_.size(), kNone);
    for (uint32_t h = 0; h < next_.size(); ++h) {
      work();
      const uint32_t c = cellOf(h);
      if (c == kNone || turns_[c] == 0 || cellOf(twin(h)) == c) continue;
      if (pieceOf[c] == kNone) {
        pieceOf[c] = static_cast<uint32_t>(out.size());
        out.push_back({facet_, turns_[c], {}});
      }
      out[pieceOf[c]].edges.push_back({vertices_[from(h)], vertices_[to(h)]});
    }
  }

  const Facets& facets_;
  uint32_t facet_;
  // By number within the facet: its vertices, in ascending order, and where they are.
  std::vector<uint32_t> vertices_;
  std::vector<Vec2> points_;
  std::vector<Edge> ends_;
  // How often the outline runs along an edge from its lower vertex, less how often back.
  std::vector<int> net_;
  std::vector<uint32_t> next_, cycleOf_;
  // By cycle: a half on it, twice its area, the cell.
  std::vector<uint32_t> first_, cell_;
  std::vector<double> area_;
  std::vector<int> turns_;
};

}  // namespace

void addPieces(const Facets& facets, uint32_t facet, const FacetEdges& edges,
               std::vector<Piece>& out) {
  const Facet& f = facets.list[facet];
  if (isDivided(f)) {
    CellFinder(facets, facet).run(edges, out);
  } else {
    out.push_back({facet, 1, edges.outline});
  }
}

}  // namespace gable::solid
