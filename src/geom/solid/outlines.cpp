// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/outlines.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "math/predicates.h"

namespace gable::solid {
namespace {

/// The kept pieces of a face that look alike.
struct Group {
  uint32_t face = 0;
  bool turned = false;
  std::vector<uint32_t> others;
  std::vector<uint32_t> pieces;

  bool operator<(const Group& o) const {
    return std::tie(face, turned, others, pieces) < std::tie(o.face, o.turned, o.others, o.pieces);
  }
  bool looksLike(const Group& o) const {
    return std::tie(face, turned, others) == std::tie(o.face, o.turned, o.others);
  }
};

std::vector<Group> groupsOf(const Facets& facets, const std::vector<Piece>& pieces,
                            const Selection& selection) {
  std::vector<Group> single, out;
  for (const Kept& k : selection.kept) {
    Group g{facets.list[pieces[k.piece].facet].face, k.turned, {}, {k.piece}};
    for (const uint32_t o : k.others) {
      const uint32_t face = facets.list[pieces[o].facet].face;
      if (face != g.face) g.others.push_back(face);
    }
    std::sort(g.others.begin(), g.others.end());
    g.others.erase(std::unique(g.others.begin(), g.others.end()), g.others.end());
    work();
    single.push_back(std::move(g));
  }
  std::sort(single.begin(), single.end());
  for (Group& g : single) {
    if (!out.empty() && out.back().looksLike(g)) {
      out.back().pieces.push_back(g.pieces[0]);
    } else {
      out.push_back(std::move(g));
    }
  }
  return out;
}

// Joins edges, of which as many start at each vertex as end there, to loops that visit no vertex
// twice. Where several edges start, the one that closes the wedge on the left comes next.
class LoopTracer {
 public:
  LoopTracer(const VertexPool& pool, const Projection& project, std::vector<Edge> edges)
      : pool_(pool), project_(project), edges_(std::move(edges)), used_(edges_.size()) {
    std::sort(edges_.begin(), edges_.end());
  }

  bool run(std::vector<std::vector<uint32_t>>& loops) {
    for (size_t i = 0; i < edges_.size(); ++i) {
      if (!used_[i] && !walk(i, loops)) return false;
    }
    return true;
  }

 private:
  static constexpr size_t kNone = SIZE_MAX;

  bool walk(size_t start, std::vector<std::vector<uint32_t>>& loops) {
    std::vector<uint32_t> path{edges_[start][0]};
    used_[start] = true;
    uint32_t at = edges_[start][1];
    placeOf_.assign(edges_.size() + 1, kNone);
    placeOf_[slot(path[0])] = 0;
    while (true) {
      work();
      const size_t place = placeOf_[slot(at)];
      if (place != kNone) {
        for (size_t k = place; k < path.size(); ++k) placeOf_[slot(path[k])] = kNone;
        loops.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(place), path.end());
        path.resize(place);
        if (path.empty()) return true;
      }
      placeOf_[slot(at)] = path.size();
      path.push_back(at);
      const size_t next = leaving(path[path.size() - 2], at);
      if (next == kNone) return false;
      used_[next] = true;
      at = edges_[next][1];
    }
  }

  // The first edge from a vertex on stands for it.
  size_t slot(uint32_t v) const {
    return static_cast<size_t>(std::lower_bound(edges_.begin(), edges_.end(), Edge{v, 0}) -
                               edges_.begin());
  }

  size_t leaving(uint32_t from, uint32_t v) const {
    size_t best = kNone;
    for (size_t k = slot(v); k < edges_.size() && edges_[k][0] == v; ++k) {
      if (used_[k]) continue;
      if (best == kNone || after(v, from, edges_[best][1], edges_[k][1])) best = k;
    }
    return best;
  }

  // Turning counter-clockwise around v from the direction of `from`, q comes after p.
  bool after(uint32_t v, uint32_t from, uint32_t p, uint32_t q) const {
    const Vec2 o = at(v), d = at(from), a = at(p), b = at(q);
    const auto half = [&](Vec2 r) {
      const int turn = orientation(o, d, r);
      if (turn != 0) return turn > 0 ? 1 : 3;
      return dot(r - o, d - o) > 0 ? 4 : 2;
    };
    const int ha = half(a), hb = half(b);
    return ha != hb ? hb > ha : orientation(o, a, b) > 0;
  }

  Vec2 at(uint32_t v) const { return project_(pool_[v]); }

  const VertexPool& pool_;
  const Projection& project_;
  std::vector<Edge> edges_;
  std::vector<bool> used_;
  std::vector<size_t> placeOf_;
};

class OutlineMaker {
 public:
  OutlineMaker(const Facets& facets, const std::vector<Piece>& pieces)
      : facets_(facets), pieces_(pieces) {}

  bool run(const Selection& selection, std::vector<Outline>& out) {
    const std::vector<Group> groups = groupsOf(facets_, pieces_, selection);
    if (!collectUses(groups, selection.closed)) return false;
    for (uint32_t g = 0; g < groups.size(); ++g) {
      if (!trace(groups[g], g, out)) return false;
    }
    return true;
  }

 private:
  struct Use {
    uint64_t edge = 0;
    uint32_t group = 0;
    int direction = 0;
  };

  // Which groups use an edge; false where what should be closed is not.
  bool collectUses(const std::vector<Group>& groups, bool closed) {
    for (uint32_t g = 0; g < groups.size(); ++g) {
      for (const uint32_t p : groups[g].pieces) {
        work(pieces_[p].edges.size());
        for (const Edge& e : pieces_[p].edges) {
          uses_.push_back({edgeKey(e), g, (e[0] < e[1]) != groups[g].turned ? 1 : -1});
        }
      }
    }
    std::sort(uses_.begin(), uses_.end(), [](const Use& a, const Use& b) {
      return std::tie(a.edge, a.group, a.direction) < std::tie(b.edge, b.group, b.direction);
    });
    if (!closed) return true;
    for (size_t i = 0; i < uses_.size();) {
      int sum = 0;
      const uint64_t edge = uses_[i].edge;
      for (; i < uses_.size() && uses_[i].edge == edge; ++i) sum += uses_[i].direction;
      if (sum != 0) return false;
    }
    return true;
  }

  // Others than the group use the edge.
  bool held(uint64_t edge, uint32_t group) const {
    auto at = std::lower_bound(uses_.begin(), uses_.end(), edge,
                               [](const Use& u, uint64_t key) { return u.edge < key; });
    for (; at != uses_.end() && at->edge == edge; ++at) {
      if (at->group != group) return true;
    }
    return false;
  }

  bool trace(const Group& g, uint32_t number, std::vector<Outline>& out) {
    const Facet& facet = facets_.list[pieces_[g.pieces[0]].facet];
    std::vector<std::vector<uint32_t>> loops;
    if (g.pieces.size() == 1 && !isDivided(facet)) {
      std::vector<Edge> edges = pieces_[g.pieces[0]].edges;
      if (!LoopTracer(facets_.pool, facet.project, std::move(edges)).run(loops)) return false;
    } else if (!LoopTracer(facets_.pool, facet.project, edgesOf(g, number)).run(loops)) {
      return false;
    }
    nest(g, facet.project, loops, out);
    return true;
  }

  std::vector<Edge> edgesOf(const Group& g, uint32_t number) const {
    std::vector<Edge> all, out;
    for (const uint32_t p : g.pieces) {
      all.insert(all.end(), pieces_[p].edges.begin(), pieces_[p].edges.end());
    }
    work(all.size());
    std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) {
      return std::pair(edgeKey(a), a) < std::pair(edgeKey(b), b);
    });
    for (size_t i = 0; i < all.size();) {
      const uint64_t key = edgeKey(all[i]);
      const size_t first = i;
      int net = 0;
      for (; i < all.size() && edgeKey(all[i]) == key; ++i) net += all[i][0] < all[i][1] ? 1 : -1;
      if (held(key, number)) {
        out.insert(out.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
                   all.begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
      const Edge up{std::min(all[first][0], all[first][1]), std::max(all[first][0], all[first][1])};
      for (; net > 0; --net) out.push_back(up);
      for (; net < 0; ++net) out.push_back({up[1], up[0]});
    }
    return out;
  }

  void nest(const Group& g, const Projection& project, std::vector<std::vector<uint32_t>>& loops,
            std::vector<Outline>& out) const {
    const size_t first = out.size();
    std::vector<double> areas;
    std::vector<size_t> holes;
    for (size_t k = 0; k < loops.size(); ++k) {
      if (loops[k].size() < 3) continue;
      const double area = areaOf(loops[k], project);
      if (area > 0) {
        out.push_back({g.face, g.turned, g.others, {loops[k]}});
        areas.push_back(area);
      } else {
        holes.push_back(k);
      }
    }
    for (const size_t k : holes) {
      size_t best = out.size();
      const Vec2 p = project((facets_.pool[loops[k][0]] + facets_.pool[loops[k][1]]) * 0.5);
      for (size_t o = first; o < out.size(); ++o) {
        if (best != out.size() && areas[o - first] >= areas[best - first]) continue;
        if (holds(out[o].loops[0], project, p)) best = o;
      }
      if (best != out.size()) out[best].loops.push_back(std::move(loops[k]));
    }
    for (size_t o = first; g.turned && o < out.size(); ++o) {
      for (auto& loop : out[o].loops) std::reverse(loop.begin(), loop.end());
    }
  }

  double areaOf(const std::vector<uint32_t>& loop, const Projection& project) const {
    double area = 0;
    const Vec2 o = project(facets_.pool[loop[0]]);
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      area += cross(project(facets_.pool[loop[i]]) - o, project(facets_.pool[loop[i + 1]]) - o);
    }
    work(loop.size());
    return area;
  }

  bool holds(const std::vector<uint32_t>& loop, const Projection& project, Vec2 p) const {
    bool inside = false;
    work(loop.size());
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = project(facets_.pool[loop[i]]);
      const Vec2 b = project(facets_.pool[loop[i + 1 < loop.size() ? i + 1 : 0]]);
      if (passes(a, b, p)) inside = !inside;
    }
    return inside;
  }

  const Facets& facets_;
  const std::vector<Piece>& pieces_;
  std::vector<Use> uses_;
};

}  // namespace

bool outlinesOf(const Facets& facets, const std::vector<Piece>& pieces, const Selection& selection,
                std::vector<Outline>& out) {
  return OutlineMaker(facets, pieces).run(selection, out);
}

}  // namespace gable::solid
