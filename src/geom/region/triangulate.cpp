// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Holes are joined to what is around them by bridges (Eberly, "Triangulation by ear clipping"),
// from the rightmost hole on; but a bridge goes to the nearest vertex that is seen, which a k-d
// tree of the vertices and grids of edges and bridges find in about O(n log n) in all, and which
// exact tests against all edges decide, so that touching and collinear rings need no special ray.
// The one weakly simple ring that results loses its ears in turn. Only vertices that are not convex
// can lie in an ear; a static grid finds them, and none is ever added to them. Exact signs let a
// collinear vertex block an ear whose edge it lies on, so that it never ends in a flat triangle.
#include "geom/region/triangulate.h"

#include <algorithm>
#include <optional>

#include "base/work.h"
#include "geom/region/bridge_search.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {
namespace {

struct Node {
  Vec2 at;
  uint32_t point = 0;
  uint32_t prev = 0;
  uint32_t next = 0;
  bool blocks = false;  // Not convex, and still in the ring.
};

// Strictly inside the angle at `x` that runs counter-clockwise from y to z, less than 180 degrees.
bool insideWedge(Vec2 x, Vec2 y, Vec2 z, Vec2 q) {
  return orientation(x, y, q) > 0 && orientation(x, q, z) > 0;
}

class Clipping {
 public:
  Clipping(std::span<const Vec2> points, std::span<const uint32_t> ringEnds,
           std::vector<Triangle>& out)
      : out_(out) {
    link(points, ringEnds);
  }

  void run() {
    if (rings_.empty()) return;
    if (rings_.size() > 1) {
      linkTouches();
      joinHoles();
    }
    prepareGrid();
    for (const uint32_t outer : outers_) clipEars(outer);
  }

 private:
  // The nodes of each ring, outer ones counter-clockwise and holes clockwise, repeated points
  // skipped. A ring is named by its first node.
  void link(std::span<const Vec2> points, std::span<const uint32_t> ringEnds) {
    uint32_t first = 0;
    nodes_.reserve(points.size() + 2 * ringEnds.size());
    for (size_t k = 0; k < ringEnds.size(); ++k) {
      linkRing(points, first, ringEnds[k], k == 0);
      first = ringEnds[k];
      if (k == 0 && rings_.empty()) return;
    }
  }

  void linkRing(std::span<const Vec2> points, uint32_t first, uint32_t end, bool outer) {
    const auto base = static_cast<uint32_t>(nodes_.size());
    double twice = 0;
    for (uint32_t i = first; i < end; ++i) {
      if (i > first + 1) twice += cross(points[i - 1] - points[first], points[i] - points[first]);
    }
    const bool turned = (twice < 0) == outer;
    for (uint32_t k = 0; k < end - first; ++k) {
      const uint32_t i = turned ? end - 1 - k : first + k;
      if (nodes_.size() > base && nodes_.back().at == points[i]) continue;
      nodes_.push_back({points[i], i, 0, 0, false});
    }
    while (nodes_.size() > base + 1 && nodes_.back().at == nodes_[base].at) nodes_.pop_back();
    const auto n = static_cast<uint32_t>(nodes_.size()) - base;
    if (n < 3) {
      nodes_.resize(base);
      return;
    }
    for (uint32_t k = 0; k < n; ++k) {
      nodes_[base + k].prev = base + (k + n - 1) % n;
      nodes_[base + k].next = base + (k + 1) % n;
    }
    rings_.push_back(base);
    if (outer) outers_.push_back(base);
  }

  Vec2 at(uint32_t n) const { return nodes_[n].at; }

  // Direction to q leads into the interior at node n.
  bool inCone(uint32_t n, Vec2 q) const {
    const Vec2 x = at(n), next = at(nodes_[n].next), prev = at(nodes_[n].prev);
    if (orientation(prev, x, next) > 0) return insideWedge(x, next, prev, q);
    return !(orientation(x, q, next) >= 0 && orientation(q, x, prev) >= 0);
  }

  uint32_t rightmost(uint32_t ring) const {
    uint32_t best = ring;
    for (uint32_t n = nodes_[ring].next; n != ring; n = nodes_[n].next) {
      const bool further = at(n).x != at(best).x ? at(n).x > at(best).x : at(n).y < at(best).y;
      if (further) best = n;
    }
    return best;
  }

  // Where one visit of a point lies in the interior angle of another, they exchange what follows:
  // afterwards every visit has an angle of its own.
  void linkTouches() {
    std::vector<uint32_t> order(nodes_.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      if (at(a).x != at(b).x) return at(a).x < at(b).x;
      return at(a).y != at(b).y ? at(a).y < at(b).y : a < b;
    });
    bool linked = false;
    for (size_t i = 0, end = 0; i < order.size(); i = end) {
      while (end < order.size() && at(order[end]) == at(order[i])) ++end;
      for (size_t k = i; k < end; ++k) {
        for (size_t l = i; l < end; ++l)
          linked = (k != l && exchange(order[k], order[l])) || linked;
      }
    }
    if (linked) findRings();
  }

  bool exchange(uint32_t a, uint32_t b) {
    if (!inCone(a, at(nodes_[b].next)) || !inCone(a, at(nodes_[b].prev))) return false;
    std::swap(nodes_[a].next, nodes_[b].next);
    nodes_[nodes_[a].next].prev = a;
    nodes_[nodes_[b].next].prev = b;
    return true;
  }

  // Rings after linking: those that turn left are outer ones, the others holes.
  void findRings() {
    std::vector<bool> seen(nodes_.size());
    rings_.clear();
    outers_.clear();
    for (uint32_t first = 0; first < nodes_.size(); ++first) {
      if (seen[first]) continue;
      double twice = 0;
      uint32_t n = first;
      do {
        work();
        seen[n] = true;
        twice += cross(at(n) - at(first), at(nodes_[n].next) - at(first));
        n = nodes_[n].next;
      } while (n != first);
      (twice > 0 ? outers_ : rings_).push_back(first);
    }
    rings_.insert(rings_.begin(), outers_.begin(), outers_.end());
  }

  void joinHoles() {
    if (rings_.size() == outers_.size() || outers_.empty()) return;
    std::vector<Segment> edges;
    for (const Node& n : nodes_) edges.push_back({n.at, at(n.next)});
    SegmentGrid grid(edges);
    std::vector<uint32_t> tips;
    for (size_t k = outers_.size(); k < rings_.size(); ++k) tips.push_back(rightmost(rings_[k]));
    std::sort(tips.begin(), tips.end(), [&](uint32_t a, uint32_t b) {
      if (at(a).x != at(b).x) return at(a).x > at(b).x;
      return at(a).y != at(b).y ? at(a).y < at(b).y : a < b;
    });
    NearestNames joined(points());
    for (const uint32_t outer : outers_) join(outer, joined);
    for (const uint32_t tip : tips) bridge(tip, edges, grid, joined);
  }

  std::vector<Vec2> points() const {
    std::vector<Vec2> out;
    out.reserve(nodes_.size());
    for (const Node& n : nodes_) out.push_back(n.at);
    return out;
  }

  // The nodes of a ring can be bridged to from now on.
  void join(uint32_t ring, NearestNames& joined) const {
    uint32_t n = ring;
    do {
      work();
      joined.add(n);
      n = nodes_[n].next;
    } while (n != ring);
  }

  // Nearest joined vertex that the hole's tip sees; one that it only touches along the way as a
  // last resort, which valid input never needs.
  void bridge(uint32_t tip, const std::vector<Segment>& edges, SegmentGrid& grid,
              NearestNames& joined) {
    std::optional<uint32_t> first, seen;
    joined.visitFrom(at(tip), [&](uint32_t candidate) {
      if (!first) first = candidate;
      if (sees(tip, candidate, edges, grid)) seen = candidate;
      return seen.has_value();
    });
    const uint32_t chosen = seen ? *seen : first.value_or(outers_[0]);
    join(tip, joined);
    const auto copies = static_cast<uint32_t>(nodes_.size());
    splice(chosen, tip);
    joined.addCopy(copies, tip);
    joined.addCopy(copies + 1, chosen);
  }

  bool sees(uint32_t tip, uint32_t v, const std::vector<Segment>& edges, SegmentGrid& grid) {
    const Vec2 m = at(tip), q = at(v);
    if (m == q || !inCone(v, m) || !inCone(tip, q)) return false;
    bool blocked = false;
    const auto test = [&](const Segment& e) { blocked = blocked || obstructs(m, q, e); };
    Box2 box;
    box.include(m);
    box.include(q);
    bridges_.query(box, test);
    if (!blocked) grid.query(box, [&](uint32_t i) { test(edges[i]); });
    return !blocked;
  }

  // An edge that meets the open sight line m q. Edges that end in m or q may leave to the side.
  static bool obstructs(Vec2 m, Vec2 q, const Segment& e) {
    const auto onSight = [&](Vec2 p) { return !(p == m) && !(p == q) && onSegment(m, q, p); };
    if (onSight(e.a) || onSight(e.b)) return true;
    if (e.a == m || e.b == m || e.a == q || e.b == q) return false;
    const int ea = orientation(m, q, e.a), eb = orientation(m, q, e.b);
    if (ea * eb >= 0 && (ea != 0 || eb != 0)) return false;
    return orientation(e.a, e.b, m) * orientation(e.a, e.b, q) <= 0 && (ea != 0 || eb != 0);
  }

  // v -> tip -> ... -> copy of tip -> copy of v -> what followed v.
  void splice(uint32_t v, uint32_t tip) {
    const auto tipCopy = static_cast<uint32_t>(nodes_.size());
    const uint32_t vCopy = tipCopy + 1;
    nodes_.push_back(nodes_[tip]);
    nodes_.push_back(nodes_[v]);
    nodes_[nodes_[tip].prev].next = tipCopy;
    nodes_[tipCopy].next = vCopy;
    nodes_[vCopy].prev = tipCopy;
    nodes_[nodes_[v].next].prev = vCopy;
    nodes_[v].next = tip;
    nodes_[tip].prev = v;
    bridges_.add({at(v), at(tip)});
  }

  int turn(uint32_t n) const { return orientation(at(nodes_[n].prev), at(n), at(nodes_[n].next)); }

  // Blocking nodes by cell of a uniform grid, about two a cell.
  void prepareGrid() {
    std::vector<uint32_t> blockers;
    for (uint32_t n = 0; n < nodes_.size(); ++n) {
      box_.include(at(n));
      nodes_[n].blocks = turn(n) <= 0;
      if (nodes_[n].blocks) blockers.push_back(n);
    }
    side_ = 1;
    while (side_ < 128 &&
           static_cast<size_t>(side_) * static_cast<size_t>(side_) * 2 < blockers.size()) {
      ++side_;
    }
    const Vec2 size = box_.size();
    inverse_ = {size.x > 0 ? side_ / size.x : 0, size.y > 0 ? side_ / size.y : 0};
    starts_.assign(static_cast<size_t>(side_) * static_cast<size_t>(side_) + 1, 0);
    for (const uint32_t b : blockers) ++starts_[cellOf(at(b)) + 1];
    for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    items_.resize(blockers.size());
    std::vector<uint32_t> fill(starts_.begin(), starts_.end() - 1);
    for (const uint32_t b : blockers) items_[fill[cellOf(at(b))]++] = b;
  }

  int column(double x) const { return clampCell((x - box_.min.x) * inverse_.x); }
  int row(double y) const { return clampCell((y - box_.min.y) * inverse_.y); }
  int clampCell(double v) const {
    if (!(v > 0)) return 0;
    return v < side_ ? static_cast<int>(v) : side_ - 1;
  }
  size_t cellOf(Vec2 p) const {
    return static_cast<size_t>(row(p.y)) * static_cast<size_t>(side_) +
           static_cast<size_t>(column(p.x));
  }

  bool isEar(uint32_t n) const {
    const uint32_t p = nodes_[n].prev, q = nodes_[n].next;
    const Vec2 a = at(p), b = at(n), c = at(q);
    if (orientation(a, b, c) <= 0) return false;
    Box2 box;
    box.include(a);
    box.include(b);
    box.include(c);
    const int x1 = column(box.max.x), y1 = row(box.max.y);
    for (int y = row(box.min.y); y <= y1; ++y) {
      for (int x = column(box.min.x); x <= x1; ++x) {
        const size_t cell =
            static_cast<size_t>(y) * static_cast<size_t>(side_) + static_cast<size_t>(x);
        for (uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
          work();
          const uint32_t r = items_[k];
          if (!nodes_[r].blocks || r == p || r == n || r == q) continue;
          if (blocksEar(r, a, b, c, box)) return false;
        }
      }
    }
    return true;
  }

  // A node in the closed triangle blocks; one at a corner only when one of its edges leads inside.
  bool blocksEar(uint32_t r, Vec2 a, Vec2 b, Vec2 c, const Box2& box) const {
    const Vec2 v = at(r);
    if (v.x < box.min.x || v.x > box.max.x || v.y < box.min.y || v.y > box.max.y) return false;
    const auto enters = [&](Vec2 x, Vec2 y, Vec2 z) {
      return insideWedge(x, y, z, at(nodes_[r].prev)) || insideWedge(x, y, z, at(nodes_[r].next));
    };
    if (v == a) return enters(a, b, c);
    if (v == b) return enters(b, c, a);
    if (v == c) return enters(c, a, b);
    return orientation(a, b, v) >= 0 && orientation(b, c, v) >= 0 && orientation(c, a, v) >= 0;
  }

  void unlink(uint32_t n) {
    const uint32_t p = nodes_[n].prev, q = nodes_[n].next;
    nodes_[p].next = q;
    nodes_[q].prev = p;
    nodes_[n].blocks = false;
    --remaining_;
    for (const uint32_t k : {p, q}) nodes_[k].blocks = nodes_[k].blocks && turn(k) <= 0;
  }

  void emit(uint32_t n) {
    out_.push_back({nodes_[nodes_[n].prev].point, nodes_[n].point, nodes_[nodes_[n].next].point});
  }

  void clipEars(uint32_t start) {
    uint32_t n = start, since = 0;
    remaining_ = 0;
    do {
      ++remaining_;
      n = nodes_[n].next;
    } while (n != start);
    while (remaining_ > 3) {
      work();
      const uint32_t next = nodes_[n].next;
      if (isEar(n)) {
        emit(n);
        unlink(n);
        // Leaving out the next vertex makes better shaped triangles.
        n = nodes_[next].next;
        since = 0;
      } else {
        n = next;
        if (++since > remaining_) {
          n = force(n);
          since = 0;
        }
      }
    }
    if (remaining_ == 3 && turn(n) > 0) emit(n);
  }

  // No ear, so the input was not valid: a flat node goes without a triangle, else a convex one
  // with.
  uint32_t force(uint32_t n) {
    uint32_t convex = n;
    for (uint32_t i = 0, k = n; i < remaining_; ++i, k = nodes_[k].next) {
      work();
      const int t = turn(k);
      if (t == 0) {
        convex = k;
        break;
      }
      if (t > 0 && turn(convex) <= 0) convex = k;
    }
    const uint32_t next = nodes_[convex].next;
    if (turn(convex) > 0) emit(convex);
    unlink(convex);
    return next;
  }

  std::vector<Triangle>& out_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> rings_;   // One node of each ring: outer ones first, then holes.
  std::vector<uint32_t> outers_;  // One node of each ring whose ears are to be clipped.
  GrowingSegments bridges_;
  Box2 box_;
  Vec2 inverse_;
  int side_ = 1;
  uint32_t remaining_ = 0;
  std::vector<uint32_t> starts_, items_;
};

// Triangles and convex quadrilaterals, most faces of all, without any set-up.
bool triangulateSmall(std::span<const Vec2> p, std::vector<Triangle>& out) {
  const auto emit = [&](uint32_t a, uint32_t b, uint32_t c) {
    const int t = orientation(p[a], p[b], p[c]);
    if (t > 0) out.push_back({a, b, c});
    if (t < 0) out.push_back({c, b, a});
  };
  if (p.size() == 3) {
    emit(0, 1, 2);
    return true;
  }
  const int a = orientation(p[0], p[1], p[2]);
  if (a == 0 || a != orientation(p[1], p[2], p[3]) || a != orientation(p[2], p[3], p[0]) ||
      a != orientation(p[3], p[0], p[1])) {
    return false;
  }
  emit(0, 1, 2);
  emit(0, 2, 3);
  return true;
}

}  // namespace

void triangulate(std::span<const Vec2> points, std::span<const uint32_t> ringEnds,
                 std::vector<Triangle>& out) {
  if (points.size() < 3 || ringEnds.empty()) return;
  if (ringEnds.size() == 1 && points.size() <= 4 && triangulateSmall(points, out)) return;
  Clipping(points, ringEnds, out).run();
}

std::vector<Triangle> triangulate(const Polygon& p) {
  std::vector<Vec2> points = p.outer;
  std::vector<uint32_t> ends{static_cast<uint32_t>(points.size())};
  for (const Ring& h : p.holes) {
    points.insert(points.end(), h.begin(), h.end());
    ends.push_back(static_cast<uint32_t>(points.size()));
  }
  std::vector<Triangle> out;
  triangulate(points, ends, out);
  return out;
}

}  // namespace gable
