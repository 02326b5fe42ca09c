// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ground: each stretch is a ribbon between two cuts square to it, where its kerbs leave those of
// its neighbours at the junction; a junction is what its streets cover up to the cuts, its corners
// rounded by growing and shrinking. What two of them claim goes to the one that comes first, among
// neighbours only, and blocks are what is left of the area.

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"
#include "geom/plan/street_graph.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "math/box.h"
#include "math/trig.h"

namespace gable {

namespace {

/// A cut lies at most this share of a stretch from its end.
constexpr double kMostCut = 0.45;

// A stretch as it leaves a node.
struct Leaving {
  uint32_t edge;
  Line line;
  double length;
  double half;
  Vec2 direction;
  double cut = 0;
};

Line reversed(Line line) {
  std::reverse(line.begin(), line.end());
  return line;
}

// The part of a line between two lengths.
Line partOf(const Line& line, double from, double to) {
  const Path path(line);
  Line out{path.at(from).point};
  double sum = 0;
  for (size_t i = 1; i < path.points().size(); ++i) {
    sum += length(path.points()[i] - path.points()[i - 1]);
    if (sum > from + 1e-6 && sum < to - 1e-6) out.push_back(path.points()[i]);
  }
  out.push_back(path.at(to).point);
  return out;
}

std::vector<Leaving> leavings(const StreetGraph& g, uint32_t node) {
  std::vector<Leaving> out;
  for (size_t k = 0; k < g.nodes[node].edges.size(); ++k) {
    work(8 + out.size());
    const uint32_t e = g.nodes[node].edges[k];
    const StreetGraph::Edge& edge = g.edges[e];
    const bool seen =
        std::any_of(out.begin(), out.end(), [&](const Leaving& l) { return l.edge == e; });
    const bool forward = edge.from == node && !(edge.to == node && seen);
    Leaving l{
        e, forward ? edge.line : reversed(edge.line), Path(edge.line).length(), edge.width / 2, {},
        0};
    // Curves leave in the direction they have a street's width away.
    l.direction = normalized(Path(l.line).at(std::min(l.half, l.length / 2)).point - l.line[0]);
    out.push_back(std::move(l));
  }
  return out;
}

// Where the facing kerbs of two stretches part, as the length along each.
void cutCorner(Leaving& a, Leaving& b, double radius) {
  const double sine = cross(a.direction, b.direction), cosine = dot(a.direction, b.direction);
  const double angle =
      atan2Deg(sine, cosine) < 0 ? 360 + atan2Deg(sine, cosine) : atan2Deg(sine, cosine);
  if (angle > 150 || std::fabs(sine) < 1e-3) return;
  const double rounding = radius / std::max(tanDeg(angle / 2), 0.1);
  a.cut = std::max(a.cut, (b.half + a.half * cosine) / sine + rounding);
  b.cut = std::max(b.cut, (a.half + b.half * cosine) / sine + rounding);
}

Region junctionOf(std::vector<Leaving>& legs, double radius) {
  for (size_t i = 0; i < legs.size(); ++i) cutCorner(legs[i], legs[(i + 1) % legs.size()], radius);
  OffsetOptions round;
  round.join = OffsetJoin::Round;
  round.roundError = 0.02;
  Region covered, mouth;
  for (Leaving& l : legs) {
    l.cut = std::clamp(l.cut, std::min(l.half / 2, l.length * kMostCut), l.length * kMostCut);
    const double beyond = std::min(l.cut + 2 * radius + 1, l.length / 2);
    covered = unite(covered, thicken(partOf(l.line, 0, beyond), l.half));
    mouth = unite(mouth, thicken(partOf(l.line, 0, l.cut), l.half + radius));
  }
  // The node itself, where streets meet at their outer sides.
  double widest = 0;
  for (const Leaving& l : legs) widest = std::max(widest, l.half);
  const Vec2 at = legs[0].line[0];
  const Region disc{{arc(at, widest, 0, 360 - 22.5, 0.02 + widest / 20), {}}};
  covered = unite(covered, disc);
  mouth = unite(mouth, disc);
  if (radius > 0) covered = offset(offset(covered, radius, round), -radius, round);
  return intersect(covered, mouth);
}

Box2 boxOf(const Region& r) {
  Box2 box;
  for (const Polygon& p : r) {
    const Box2 b = bounds(p);
    box.include(b.min);
    box.include(b.max);
  }
  return box;
}

// Gives out ground: what was given to a neighbour before is left out.
class Ground {
 public:
  explicit Ground(const Region& area) : area_(area), box_(boxOf(area)) {}

  Region claim(const Region& wanted) {
    if (wanted.empty()) return {};
    const Box2 box = boxOf(wanted);
    Region mine = intersect(wanted, area_);
    Region taken;
    for (size_t k : near(box)) {
      work();
      if (boxes_[k].meets(box)) taken.insert(taken.end(), given_[k].begin(), given_[k].end());
    }
    if (!taken.empty()) mine = subtract(mine, taken);
    if (mine.empty()) return {};
    remember(mine);
    return mine;
  }
  Region left() const {
    Region all;
    for (const Region& r : given_) all.insert(all.end(), r.begin(), r.end());
    return all.empty() ? area_ : subtract(area_, all);
  }

 private:
  // A coarse grid over the area.
  static constexpr int kCells = 64;
  int cell(double v, double low, double high) const {
    const double share = high > low ? (v - low) / (high - low) : 0;
    return static_cast<int>(std::clamp(share * kCells, 0.0, kCells - 1.0));
  }
  template <class Visit>
  void cells(const Box2& b, Visit&& visit) const {
    for (int y = cell(b.min.y, box_.min.y, box_.max.y); y <= cell(b.max.y, box_.min.y, box_.max.y);
         ++y) {
      for (int x = cell(b.min.x, box_.min.x, box_.max.x);
           x <= cell(b.max.x, box_.min.x, box_.max.x); ++x) {
        visit(static_cast<size_t>(y) * kCells + static_cast<size_t>(x));
      }
    }
  }
  std::vector<size_t> near(const Box2& box) const {
    std::vector<size_t> out;
    cells(box, [&](size_t c) { out.insert(out.end(), grid_[c].begin(), grid_[c].end()); });
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  void remember(const Region& mine) {
    boxes_.push_back(boxOf(mine));
    cells(boxes_.back(), [&](size_t c) { grid_[c].push_back(given_.size()); });
    given_.push_back(mine);
  }

  const Region& area_;
  Box2 box_;
  std::vector<Region> given_;
  std::vector<Box2> boxes_;
  std::vector<std::vector<size_t>> grid_{kCells * kCells};
};

}  // namespace

StreetPlan planStreets(const StreetGraph& graph, const Region& area, double cornerRadius,
                       double leastBlock) {
  StreetPlan plan;
  Ground ground(area);
  // How much of each stretch its junctions take, at its beginning and its end.
  std::vector<std::array<double, 2>> cuts(graph.edges.size(), {0, 0});
  for (uint32_t n = 0; n < graph.nodes.size(); ++n) {
    plan.junctions.emplace_back();
    if (graph.nodes[n].edges.size() < 3) continue;
    std::vector<Leaving> legs = leavings(graph, n);
    plan.junctions.back() = ground.claim(junctionOf(legs, std::max(cornerRadius, 0.0)));
    for (const Leaving& l : legs) {
      const bool forward = l.line == graph.edges[l.edge].line && graph.edges[l.edge].from == n;
      cuts[l.edge][forward ? 0 : 1] = l.cut;
    }
  }
  for (uint32_t e = 0; e < graph.edges.size(); ++e) {
    const StreetGraph::Edge& edge = graph.edges[e];
    const double whole = Path(edge.line).length();
    plan.roadways.push_back(
        ground.claim(thicken(partOf(edge.line, cuts[e][0], whole - cuts[e][1]), edge.width / 2)));
  }
  for (Polygon& p : ground.left()) {
    (gable::area(p) >= leastBlock ? plan.blocks : plan.islands).push_back(std::move(p));
  }
  return plan;
}

}  // namespace gable
