// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A junction is the hull of the points of the cells (and of the boundary) that are nearest to a
// place where cells meet. The sides of all junctions divide the path at once; junctions that
// overlap, or whose sides cross an outline, are cut out of the path by booleans.
#include "geom/region/voronoi_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/work.h"
#include "geom/region/autoindex.h"
#include "geom/region/faces.h"
#include "geom/region/grid_partition.h"
#include "geom/region/segment_grid.h"
#include "geom/region/voronoi_cells.h"

namespace gable {
namespace {

class PathNetwork {
 public:
  PathNetwork(const Polygon& p, const VoronoiOptions& o) : p_(p), o_(o) {}

  // What the areas leave free, taken apart at its junctions.
  std::vector<RegionPiece> run(const Region& taken, const std::vector<RegionPiece>& cells,
                               const std::vector<RegionPiece>& areas) const {
    constexpr EdgeOrigin made{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
    std::vector<RegionPiece> out;
    const std::vector<Meeting> meetings = allMeetings(cells, areas);
    EdgeSource beside;
    for (Ring& r : gable::ringsOf(taken)) {
      beside.origins.resize(beside.origins.size() + r.size(), made);
      beside.rings.push_back(std::move(r));
    }
    std::vector<RegionPiece> junctions;
    if (!divideByChords(meetings, beside, out, junctions)) {
      divideByHulls(leftBeside(wholePiece(p_), taken, beside), meetings, out, junctions);
    }
    out.insert(out.end(), std::make_move_iterator(junctions.begin()),
               std::make_move_iterator(junctions.end()));
    const double thin = std::min(0.02, o_.pathWidth / 50);
    mergeSlivers(out, thin, std::min(0.25, o_.pathWidth * o_.pathWidth / 20));
    uint32_t index = 0;
    for (RegionPiece& p : out) {
      p.ix = index++;
      p.part = 0;
      const OrientedRect frame = orientedFrame(p.polygon.outer);
      p.axis = frame.width >= frame.height ? frame.x : perpendicular(frame.x);
      p.width = std::max(frame.width, frame.height);
      p.height = o_.pathWidth;
    }
    return out;
  }

 private:
  // On the outline of a cell, on the region's boundary or between them all.
  struct Spot {
    Vec2 at;
    uint32_t owner;
  };
  static constexpr uint32_t kBoundary = kSite, kBetween = kSite + 1;

  // A place where cells meet, and what becomes of it: the hull of what of each is nearest.
  struct Meeting {
    // It reaches a little into the cells, so that it closes all ways.
    Ring hull;
    std::vector<Spot> spots;
  };

  // The sides of the junctions divide what is free between the outlines; false where they cross
  // anything.
  bool divideByChords(const std::vector<Meeting>& meetings, const EdgeSource& beside,
                      std::vector<RegionPiece>& paths, std::vector<RegionPiece>& junctions) const {
    const RegionPiece whole = wholePiece(p_);
    std::vector<Segment> edges = edgesOf(p_);
    std::vector<EdgeOrigin> origins = whole.edges;
    for (const Segment& s : edgesOf(beside.rings)) edges.push_back({s.b, s.a});
    origins.insert(origins.end(), beside.origins.begin(), beside.origins.end());
    std::vector<Segment> chords;
    // By chord: a meeting lies on its left, on its right.
    std::vector<std::array<bool, 2>> inner;
    std::map<std::array<double, 4>, size_t> numbers;
    std::vector<Meeting> others;
    const std::vector<std::vector<Spot>> outlines = clearOutlines(meetings, edges);
    for (size_t m = 0; m < meetings.size(); ++m) {
      if (outlines[m].empty()) others.push_back(meetings[m]);
      for (const Segment& s : sidesOf(outlines[m])) {
        // Neighbours may share a side.
        const auto back = numbers.find({s.b.x, s.b.y, s.a.x, s.a.y});
        if (back != numbers.end()) {
          inner[back->second][1] = true;
        } else if (numbers.try_emplace({s.a.x, s.a.y, s.b.x, s.b.y}, chords.size()).second) {
          chords.push_back(s);
          inner.push_back({true, false});
        }
      }
    }
    std::vector<Face> faces;
    if (!facesOf(edges, chords, 2 * kRegionGrid, faces)) return false;
    std::vector<RegionPiece> network;
    for (Face& f : faces) {
      RegionPiece piece;
      piece.kind = PieceKind::Path;
      for (const uint32_t e : f.edges) {
        if (e < edges.size()) {
          piece.edges.push_back(origins[e]);
          continue;
        }
        const size_t half = e - edges.size();
        if (inner[half / 2][half % 2]) piece.kind = PieceKind::Junction;
        piece.edges.push_back({kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
      }
      piece.polygon = std::move(f.polygon);
      (piece.kind == PieceKind::Junction ? junctions : network).push_back(std::move(piece));
    }
    divideByHulls(std::move(network), others, paths, junctions);
    return true;
  }

  // The hull of a meeting's spots, for those that keep clear of each other and of the outlines.
  static std::vector<std::vector<Spot>> clearOutlines(const std::vector<Meeting>& meetings,
                                                      std::span<const Segment> edges) {
    std::vector<std::vector<Spot>> out(meetings.size());
    std::vector<Box2> boxes;
    std::vector<size_t> order;
    for (size_t m = 0; m < meetings.size(); ++m) {
      boxes.push_back(bounds(meetings[m].hull));
      order.push_back(m);
    }
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return boxes[a].min.x != boxes[b].min.x ? boxes[a].min.x < boxes[b].min.x : a < b;
    });
    std::vector<bool> clear(meetings.size(), true);
    for (size_t i = 0; i < order.size(); ++i) {
      for (size_t k = i + 1; k < order.size(); ++k) {
        work();
        const size_t a = order[i], b = order[k];
        if (boxes[b].min.x > boxes[a].max.x) break;
        if (convexOverlap(meetings[a].hull, meetings[b].hull)) clear[a] = clear[b] = false;
      }
    }
    SegmentGrid grid(edges);
    for (size_t m = 0; m < meetings.size(); ++m) {
      if (!clear[m]) continue;
      std::vector<Spot> outline = hullOf(meetings[m].spots);
      bool crossed = outline.size() < 3;
      for (const Segment& s : sidesOf(outline)) {
        Box2 box;
        box.include(s.a);
        box.include(s.b);
        grid.query(box, [&](uint32_t e) {
          crossed = crossed || segmentsCross(s, edges[e], 2 * kRegionGrid);
        });
      }
      if (!crossed) out[m] = std::move(outline);
    }
    return out;
  }

  // The sides of a junction; where both ends lie on the outline of one cell, or of the region, that
  // is the side.
  static std::vector<Segment> sidesOf(const std::vector<Spot>& outline) {
    std::vector<Segment> out;
    for (size_t i = 0; i < outline.size(); ++i) {
      const Spot &from = outline[i], &to = outline[(i + 1) % outline.size()];
      if (from.owner != to.owner) out.push_back({from.at, to.at});
    }
    return out;
  }

  static std::vector<Spot> hullOf(const std::vector<Spot>& spots) {
    std::vector<Vec2> points;
    for (const Spot& s : spots) points.push_back(s.at);
    std::vector<Spot> out;
    for (const Vec2 v : convexHull(points)) {
      out.push_back(
          *std::find_if(spots.begin(), spots.end(), [&](const Spot& s) { return s.at == v; }));
    }
    return out;
  }

  // No line along an edge of one keeps the other away.
  static bool convexOverlap(const Ring& a, const Ring& b) {
    const auto apart = [](const Ring& r, const Ring& other) {
      for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
        const Vec2 d = r[i] - r[j];
        const double least = 4 * kRegionGrid * length(d);
        if (std::all_of(other.begin(), other.end(),
                        [&](Vec2 v) { return cross(d, v - r[j]) < least; })) {
          return true;
        }
      }
      return false;
    };
    return !apart(a, b) && !apart(b, a);
  }

  // The same by booleans.
  static void divideByHulls(std::vector<RegionPiece> network, const std::vector<Meeting>& meetings,
                            std::vector<RegionPiece>& paths, std::vector<RegionPiece>& junctions) {
    std::vector<Box2> boxes;
    for (const Meeting& m : meetings) boxes.push_back(bounds(m.hull));
    const EdgeOrigin cut{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
    for (RegionPiece& n : network) {
      n.kind = PieceKind::Path;
      n.part = 0;
      Region here;
      const Box2 box = bounds(n.polygon);
      for (size_t i = 0; i < meetings.size(); ++i) {
        if (boxes[i].meets(box)) here.push_back({meetings[i].hull, {}});
      }
      if (here.empty()) {
        paths.push_back(std::move(n));
        continue;
      }
      for (RegionPiece& j : combineTraced(BooleanOp::Intersection, n, here, cut)) {
        j.kind = PieceKind::Junction;
        junctions.push_back(std::move(j));
      }
      for (RegionPiece& s : combineTraced(BooleanOp::Difference, n, here, cut)) {
        paths.push_back(std::move(s));
      }
    }
  }

  // Where three cells meet, or two at the boundary.
  std::vector<Meeting> allMeetings(const std::vector<RegionPiece>& cells,
                                   const std::vector<RegionPiece>& areas) const {
    struct Corner {
      Vec2 at;
      uint32_t cell;
      bool boundary;
    };
    std::vector<Corner> corners;
    for (const RegionPiece& c : cells) {
      size_t first = 0;
      for (const Ring& r : ringsOf(c.polygon)) {
        const size_t n = r.size();
        for (size_t k = 0; k < n; ++k) {
          const bool kept = c.edges[first + k].role == EdgeRole::Kept ||
                            c.edges[first + (k + n - 1) % n].role == EdgeRole::Kept;
          corners.push_back({r[k], c.ix, kept});
        }
        first += n;
      }
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
      return a.at.x != b.at.x   ? a.at.x < b.at.x
             : a.at.y != b.at.y ? a.at.y < b.at.y
                                : a.cell < b.cell;
    });
    std::map<uint32_t, std::vector<const RegionPiece*>> bySite;
    for (const RegionPiece& a : areas) bySite[a.ix].push_back(&a);
    const double near = 1e-6 * length(bounds(p_).size()) + 4 * kRegionGrid;
    std::vector<bool> used(corners.size(), false);
    std::vector<Meeting> out;
    for (size_t i = 0; i < corners.size(); ++i) {
      if (used[i]) continue;
      std::set<uint32_t> sites;
      bool boundary = false;
      for (size_t k = i; k < corners.size() && corners[k].at.x - corners[i].at.x <= near; ++k) {
        work();
        if (used[k] || length(corners[k].at - corners[i].at) > near) continue;
        used[k] = true;
        sites.insert(corners[k].cell);
        boundary = boundary || corners[k].boundary;
      }
      if (sites.size() < (boundary && o_.borderPath ? 2u : 3u)) continue;
      Meeting m = meetingAt(corners[i].at, sites, bySite, boundary && o_.borderPath);
      if (m.hull.size() >= 3) out.push_back(std::move(m));
    }
    return out;
  }

  Meeting meetingAt(Vec2 v, const std::set<uint32_t>& sites,
                    const std::map<uint32_t, std::vector<const RegionPiece*>>& bySite,
                    bool boundary) const {
    // Into the cell, in metres: some grid steps.
    const double into = std::min(1e-3, o_.pathWidth / 100);
    std::vector<Vec2> points;
    Meeting m;
    for (const uint32_t s : sites) {
      const auto found = bySite.find(s);
      if (found == bySite.end()) continue;
      double least = 1e300;
      Vec2 best;
      for (const RegionPiece* a : found->second) {
        const Vec2 q = nearestOnOutline(a->polygon, v);
        if (length(q - v) < least) {
          least = length(q - v);
          best = q;
        }
      }
      if (!(least > 0)) continue;
      m.spots.push_back({best, s});
      points.push_back(best + normalized(best - v) * into);
      if (!boundary) continue;
      const Vec2 foot = nearestOnOutline(p_, best);
      if (!(length(foot - best) > 0)) continue;
      m.spots.push_back({foot, kBoundary});
      points.push_back(foot + normalized(foot - best) * into);
    }
    if (points.size() < 3) return m;
    m.spots.push_back({v, boundary ? kBoundary : kBetween});
    points.push_back(v);
    m.hull = convexHull(points);
    return m;
  }

  static Vec2 nearestOnOutline(const Polygon& p, Vec2 at) {
    double least = 1e300;
    Vec2 best = at;
    const auto look = [&](const Ring& r) {
      for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
        const Vec2 d = r[i] - r[j];
        const double l = dot(d, d);
        const double t = l > 0 ? std::clamp(dot(at - r[j], d) / l, 0.0, 1.0) : 0;
        const Vec2 q = r[j] + d * t;
        const double away = dot(q - at, q - at);
        if (away >= least) continue;
        least = away;
        best = q;
      }
    };
    look(p.outer);
    for (const Ring& h : p.holes) look(h);
    return best;
  }

  const Polygon& p_;
  const VoronoiOptions& o_;
};

}  // namespace

std::vector<RegionPiece> voronoiPaths(const Polygon& region, const VoronoiOptions& options,
                                      const Region& taken, const std::vector<RegionPiece>& cells,
                                      const std::vector<RegionPiece>& areas) {
  return PathNetwork(region, options).run(taken, cells, areas);
}

}  // namespace gable
