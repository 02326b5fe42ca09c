// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Snapping: all points go to nodes, one a place; segments are then led through the nodes near them
// and through new nodes where they cross, again and again until nothing changes. A node never
// moves, so that this ends.
#include "geom/plan/street_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/work.h"
#include "geom/region/hull.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"

namespace gable {

namespace {

constexpr int kMostRounds = 16;

// Places that are told apart when they are further than `snap` from each other.
class Places {
 public:
  explicit Places(double snap) : snap_(std::max(snap, 1e-3)) {}

  uint32_t find(Vec2 p) {
    const auto [cx, cy] = cellOf(p);
    uint32_t best = kNone;
    double least = snap_;
    work(16);
    for (int64_t x = cx - 1; x <= cx + 1; ++x) {
      for (int64_t y = cy - 1; y <= cy + 1; ++y) {
        const auto at = cells_.find({x, y});
        if (at == cells_.end()) continue;
        work(at->second.size());
        for (uint32_t i : at->second) {
          const double d = length(points_[i] - p);
          if (d < least) {
            least = d;
            best = i;
          }
        }
      }
    }
    if (best != kNone) return best;
    points_.push_back(p);
    cells_[{cx, cy}].push_back(static_cast<uint32_t>(points_.size() - 1));
    return static_cast<uint32_t>(points_.size() - 1);
  }
  /// Places nearer than snap to a segment, but not its ends, in the order along it.
  std::vector<uint32_t> along(uint32_t from, uint32_t to) const {
    const Vec2 a = points_[from], d = points_[to] - a;
    std::vector<std::pair<double, uint32_t>> found;
    const auto low = cellOf({std::min(a.x, a.x + d.x), std::min(a.y, a.y + d.y)});
    const auto high = cellOf({std::max(a.x, a.x + d.x), std::max(a.y, a.y + d.y)});
    const double reach = snap_ + std::fabs(snap_);
    for (int64_t x = low.first - 1; x <= high.first + 1; ++x) {
      work();
      // Of a column only the cells near the line.
      const double x0 = (static_cast<double>(x) - 1) * snap_, x1 = x0 + 3 * snap_;
      double y0 = std::min(a.y, a.y + d.y), y1 = std::max(a.y, a.y + d.y);
      if (std::fabs(d.x) > reach) {
        const auto yAt = [&](double at) {
          return a.y + d.y * std::clamp((at - a.x) / d.x, 0.0, 1.0);
        };
        y0 = std::min(yAt(x0), yAt(x1));
        y1 = std::max(yAt(x0), yAt(x1));
      }
      const int64_t r0 = cellOf({0, y0}).second - 1, r1 = cellOf({0, y1}).second + 1;
      for (int64_t y = r0; y <= r1; ++y) {
        work(4);
        const auto at = cells_.find({x, y});
        if (at == cells_.end()) continue;
        work(at->second.size());
        for (uint32_t i : at->second) {
          if (i == from || i == to) continue;
          const double t = dot(points_[i] - a, d) / dot(d, d);
          if (t <= 0 || t >= 1 || length(points_[i] - (a + d * t)) >= snap_) continue;
          found.emplace_back(t, i);
        }
      }
    }
    std::sort(found.begin(), found.end());
    std::vector<uint32_t> out;
    for (const auto& [t, i] : found) out.push_back(i);
    return out;
  }
  Vec2 at(uint32_t i) const { return points_[i]; }
  size_t size() const { return points_.size(); }

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  std::pair<int64_t, int64_t> cellOf(Vec2 p) const {
    return {static_cast<int64_t>(std::floor(p.x / snap_)),
            static_cast<int64_t>(std::floor(p.y / snap_))};
  }
  double snap_;
  std::vector<Vec2> points_;
  std::map<std::pair<int64_t, int64_t>, std::vector<uint32_t>> cells_;
};

struct Piece {
  uint32_t from, to, street;
};

bool finite(Vec2 p) { return std::fabs(p.x) < 1e9 && std::fabs(p.y) < 1e9; }

// Where two segments cross inside both.
bool crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d, Vec2& at) {
  const Vec2 u = b - a, v = d - c;
  const double det = cross(u, v);
  if (std::fabs(det) <= 1e-12 * length(u) * length(v)) return false;
  const double s = cross(c - a, v) / det, t = cross(c - a, u) / det;
  if (s <= 0 || s >= 1 || t <= 0 || t >= 1) return false;
  at = a + u * s;
  return true;
}

// New places where pieces cross; false when there are none.
bool addCrossings(const std::vector<Piece>& pieces, Places& places) {
  std::vector<Segment> segments;
  for (const Piece& p : pieces) segments.push_back({places.at(p.from), places.at(p.to)});
  SegmentGrid grid(segments);
  bool any = false;
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    const Segment& s = segments[i];
    Box2 box;
    box.include(s.a);
    box.include(s.b);
    std::vector<uint32_t> near;
    grid.query(box, [&](uint32_t k) {
      if (k > i) near.push_back(k);
    });
    std::sort(near.begin(), near.end());
    for (uint32_t k : near) {
      work();
      const Piece &p = pieces[i], &q = pieces[k];
      if (p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to) continue;
      Vec2 at;
      if (!crossing(s.a, s.b, segments[k].a, segments[k].b, at)) continue;
      places.find(at);
      any = true;
    }
  }
  return any;
}

// Leads the pieces through the places near them; false when nothing changed.
bool leadThrough(std::vector<Piece>& pieces, const Places& places) {
  std::vector<Piece> out;
  bool any = false;
  for (const Piece& p : pieces) {
    work();
    uint32_t from = p.from;
    for (uint32_t through : places.along(p.from, p.to)) {
      if (through == from) continue;
      out.push_back({from, through, p.street});
      from = through;
      any = true;
    }
    if (from != p.to) out.push_back({from, p.to, p.street});
  }
  pieces = std::move(out);
  return any;
}

// One piece between two places, of the widest street.
void dropDoubles(std::vector<Piece>& pieces, const std::vector<Street>& streets) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> best;
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    work(4);
    const auto key = std::minmax(pieces[i].from, pieces[i].to);
    if (key.first == key.second) continue;
    const auto [at, fresh] = best.try_emplace({key.first, key.second}, i);
    if (!fresh && streets[pieces[i].street].width > streets[pieces[at->second].street].width) {
      at->second = i;
    }
  }
  std::vector<uint32_t> kept;
  for (const auto& [key, i] : best) kept.push_back(i);
  std::sort(kept.begin(), kept.end());
  std::vector<Piece> out;
  for (uint32_t i : kept) out.push_back(pieces[i]);
  pieces = std::move(out);
}

// Joins pieces into stretches between junctions, dead ends and changes of street.
class Stretches {
 public:
  Stretches(const std::vector<Piece>& pieces, const Places& places,
            const std::vector<Street>& streets)
      : pieces_(pieces),
        places_(places),
        streets_(streets),
        at_(places.size()),
        used_(pieces.size(), false) {
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      at_[pieces[i].from].push_back(i);
      at_[pieces[i].to].push_back(i);
    }
  }
  StreetGraph graph() {
    StreetGraph g;
    for (uint32_t i = 0; i < pieces_.size(); ++i) {
      if (used_[i]) continue;
      const bool begins = !passesThrough(pieces_[i].from), ends = !passesThrough(pieces_[i].to);
      if (begins || ends) addFrom(g, i, begins ? pieces_[i].from : pieces_[i].to);
    }
    // Rings without a junction begin anywhere.
    for (uint32_t i = 0; i < pieces_.size(); ++i) {
      if (!used_[i]) addFrom(g, i, pieces_[i].from);
    }
    return g;
  }

 private:
  bool passesThrough(uint32_t place) const {
    return at_[place].size() == 2 && pieces_[at_[place][0]].street == pieces_[at_[place][1]].street;
  }
  void addFrom(StreetGraph& g, uint32_t piece, uint32_t start) {
    StreetGraph::Edge e;
    e.street = pieces_[piece].street;
    e.width = streets_[e.street].width;
    e.line.push_back(places_.at(start));
    uint32_t at = start;
    for (;;) {
      work();
      used_[piece] = true;
      at = pieces_[piece].from == at ? pieces_[piece].to : pieces_[piece].from;
      e.line.push_back(places_.at(at));
      if (!passesThrough(at) || at == start) break;
      const uint32_t next = at_[at][0] == piece ? at_[at][1] : at_[at][0];
      if (used_[next]) break;
      piece = next;
    }
    e.from = nodeOf(g, start);
    e.to = nodeOf(g, at);
    const auto number = static_cast<uint32_t>(g.edges.size());
    g.nodes[e.from].edges.push_back(number);
    g.nodes[e.to].edges.push_back(number);
    g.edges.push_back(std::move(e));
  }
  uint32_t nodeOf(StreetGraph& g, uint32_t place) {
    const auto [at, fresh] = nodes_.try_emplace(place, static_cast<uint32_t>(g.nodes.size()));
    if (fresh) g.nodes.push_back({places_.at(place), {}});
    return at->second;
  }

  const std::vector<Piece>& pieces_;
  const Places& places_;
  const std::vector<Street>& streets_;
  std::vector<std::vector<uint32_t>> at_;
  std::vector<bool> used_;
  std::map<uint32_t, uint32_t> nodes_;
};

// Inside, and further than `margin` from the border.
bool isWithin(const Region& area, Vec2 p, double margin) {
  return std::any_of(area.begin(), area.end(),
                     [&](const Polygon& q) { return signedDistance(q, p) > margin; });
}

// Pieces of the dead ends that are too short; empty when there are none.
std::vector<bool> shortEnds(const StreetGraph& g, const StreetGraphOptions& options,
                            const Places& places, const std::vector<Piece>& pieces) {
  std::map<std::pair<double, double>, bool> gone;
  bool any = false;
  for (const StreetGraph::Edge& e : g.edges) {
    const bool loose = g.nodes[e.from].edges.size() == 1 || g.nodes[e.to].edges.size() == 1;
    const bool alone = g.nodes[e.from].edges.size() == 1 && g.nodes[e.to].edges.size() == 1;
    if (!loose || alone || Path(e.line).length() >= options.shortest) continue;
    const uint32_t tip = g.nodes[e.from].edges.size() == 1 ? e.from : e.to;
    if (options.area && !isWithin(*options.area, g.nodes[tip].point, options.snap)) continue;
    any = true;
    for (size_t i = 0; i + 1 < e.line.size(); ++i) {
      work(4);
      const Vec2 middle = (e.line[i] + e.line[i + 1]) * 0.5;
      gone[{middle.x, middle.y}] = true;
    }
  }
  if (!any) return {};
  std::vector<bool> out;
  for (const Piece& p : pieces) {
    work(8);
    const Vec2 middle = (places.at(p.from) + places.at(p.to)) * 0.5;
    const Vec2 same = (places.at(p.to) + places.at(p.from)) * 0.5;
    out.push_back(gone.count({middle.x, middle.y}) > 0 || gone.count({same.x, same.y}) > 0);
  }
  return out;
}

void sortEdges(StreetGraph& g) {
  for (uint32_t n = 0; n < g.nodes.size(); ++n) {
    std::vector<std::pair<double, uint32_t>> byAngle;
    for (size_t k = 0; k < g.nodes[n].edges.size(); ++k) {
      const uint32_t e = g.nodes[n].edges[k];
      const Line& line = g.edges[e].line;
      // A loop leaves with its first piece and comes back with its last.
      const bool again = k > 0 && g.nodes[n].edges[k - 1] == e;
      const bool outgoing = g.edges[e].from == n && !again;
      const Vec2 d = outgoing ? line[1] - line[0] : line[line.size() - 2] - line.back();
      byAngle.emplace_back(atan2Deg(d.y, d.x), e);
    }
    std::stable_sort(byAngle.begin(), byAngle.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t k = 0; k < byAngle.size(); ++k) g.nodes[n].edges[k] = byAngle[k].second;
  }
}

}  // namespace

StreetGraph buildStreetGraph(const std::vector<Street>& streets,
                             const StreetGraphOptions& options) {
  Places places(options.snap);
  std::vector<Piece> pieces;
  for (uint32_t s = 0; s < streets.size(); ++s) {
    bool first = true;
    uint32_t from = 0;
    for (const Vec2 p : streets[s].line) {
      if (!finite(p)) continue;
      const uint32_t to = places.find(p);
      if (!first && to != from) pieces.push_back({from, to, s});
      first = false;
      from = to;
    }
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const bool led = leadThrough(pieces, places);
    dropDoubles(pieces, streets);
    const bool crossed = addCrossings(pieces, places);
    if (!led && !crossed) break;
  }
  StreetGraph g = Stretches(pieces, places, streets).graph();
  // Each round may free the next dead end.
  for (;;) {
    const std::vector<bool> gone = shortEnds(g, options, places, pieces);
    if (gone.empty()) break;
    std::vector<Piece> kept;
    for (size_t i = 0; i < pieces.size(); ++i) {
      if (!gone[i]) kept.push_back(pieces[i]);
    }
    if (kept.size() == pieces.size()) break;
    pieces = std::move(kept);
    g = Stretches(pieces, places, streets).graph();
  }
  sortEdges(g);
  return g;
}

}  // namespace gable
