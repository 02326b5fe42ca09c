// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A convex cell in the plane is found by halving the box with the bisectors of the nearest sites
// (until those left are too far to reach it); the region is then cut by the few bisectors that
// bound the cell. What the cells leave free is the path, which falls into sections at the hulls of
// the places where cells meet.
#include "geom/region/voronoi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/autoindex.h"
#include "geom/region/faces.h"
#include "geom/region/grid_partition.h"
#include "geom/region/line.h"
#include "geom/region/peel.h"
#include "geom/region/segment_grid.h"

namespace gable {
namespace {

constexpr double kSameSite = 1e-3;

// While cells are made, the edge between two of them names the other site: kSite + its index.
constexpr uint32_t kSite = 0x80000000;

bool boxesMeet(const Box2& a, const Box2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

bool isBorder(const EdgeOrigin& e) { return e.source >= kSite && e.source != kNoEdge; }

// Sites in squares that hold about one each, visited ring by ring around a place.
class Buckets {
 public:
  Buckets(std::span<const Disc> sites, const Box2& box) : origin_(box.min) {
    const Vec2 size = box.size();
    const double n = static_cast<double>(sites.size());
    side_ = std::max({std::sqrt(size.x * size.y / n), std::max(size.x, size.y) / 1000, 1e-9});
    nx_ = static_cast<int>(size.x / side_) + 1;
    ny_ = static_cast<int>(size.y / side_) + 1;
    of_.resize(static_cast<size_t>(nx_) * static_cast<size_t>(ny_));
    for (size_t i = 0; i < sites.size(); ++i) {
      const auto [x, y] = squareOf(sites[i].centre);
      of_[index(x, y)].push_back(i);
    }
  }
  // No site of a ring is nearer than this.
  double nearest(int ring) const { return (ring - 1) * side_; }
  int most() const { return std::max(nx_, ny_) + 1; }
  std::vector<size_t> ringAround(Vec2 p, int ring) const {
    const auto [cx, cy] = squareOf(p);
    std::vector<size_t> out;
    for (int y = std::max(0, cy - ring); y <= std::min(ny_ - 1, cy + ring); ++y) {
      const bool whole = y == cy - ring || y == cy + ring;
      for (int x = cx - ring; x <= cx + ring; x += whole || ring == 0 ? 1 : 2 * ring) {
        work();
        if (x < 0 || x >= nx_) continue;
        const std::vector<size_t>& here = of_[index(x, y)];
        out.insert(out.end(), here.begin(), here.end());
      }
    }
    return out;
  }

 private:
  std::pair<int, int> squareOf(Vec2 p) const {
    return {std::clamp(static_cast<int>((p.x - origin_.x) / side_), 0, nx_ - 1),
            std::clamp(static_cast<int>((p.y - origin_.y) / side_), 0, ny_ - 1)};
  }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(nx_) + static_cast<size_t>(x);
  }
  Vec2 origin_;
  double side_ = 1;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<size_t>> of_;
};

// The sites whose bisectors bound the cell of site i within the box.
std::vector<size_t> neighboursOf(size_t i, std::span<const Disc> sites, const Buckets& buckets,
                                 const Box2& box) {
  struct Corner {
    Vec2 at;
    size_t edge;  // The bisector of the edge that starts here.
  };
  const size_t none = sites.size();
  std::vector<Corner> cell{{box.min, none},
                           {{box.max.x, box.min.y}, none},
                           {box.max, none},
                           {{box.min.x, box.max.y}, none}};
  const Vec2 own = sites[i].centre;
  const auto away = [&](size_t k) { return length(sites[k].centre - own); };
  const auto reach = [&] {
    double r = 0;
    for (const Corner& c : cell) r = std::max(r, length(c.at - own));
    return r;
  };
  const auto halve = [&](size_t k) {
    const Vec2 normal = sites[k].centre - own;
    const double limit = dot(normal, own + sites[k].centre) / 2;
    std::vector<Corner> next;
    for (size_t c = 0; c < cell.size(); ++c) {
      work();
      const Corner& a = cell[c];
      const Corner& b = cell[(c + 1) % cell.size()];
      const double da = dot(normal, a.at) - limit, db = dot(normal, b.at) - limit;
      if (da <= 0) next.push_back(a);
      if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
        next.push_back({a.at + (b.at - a.at) * (da / (da - db)), da < 0 ? k : a.edge});
      } else if (da == 0 && db > 0) {
        next.back().edge = k;
      }
    }
    cell = std::move(next);
  };
  for (int ring = 0; buckets.nearest(ring) <= 2 * reach() && ring < buckets.most(); ++ring) {
    std::vector<size_t> order = buckets.ringAround(own, ring);
    std::erase(order, i);
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      const double da = away(a), db = away(b);
      return da != db ? da < db : a < b;
    });
    for (const size_t k : order) {
      work();
      if (away(k) > 2 * reach()) break;
      halve(k);
    }
  }
  std::vector<size_t> out;
  for (const Corner& c : cell) {
    if (c.edge != none) out.push_back(c.edge);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

// The region cut by the bisectors of a cell: what lies nearer to its site.
std::vector<RegionPiece> cellOf(const RegionPiece& whole, size_t i, std::span<const Disc> sites,
                                const Buckets& buckets, const Box2& box) {
  std::vector<RegionPiece> cell{whole};
  for (const size_t k : neighboursOf(i, sites, buckets, box)) {
    const Vec2 a = sites[i].centre, b = sites[k].centre;
    std::vector<RegionPiece> nearer;
    for (const RegionPiece& p : cell) {
      // The bisector with the site to its left; equal lines for both sites.
      const Vec2 along = perpendicular(b - a);
      for (StripPiece& s : leftOfLine(p.polygon, (a + b) * 0.5, along)) {
        RegionPiece part = p;
        part.edges.clear();
        for (const uint32_t e : s.edgeOrigin) {
          part.edges.push_back(e < StripPiece::kOnLine
                                   ? p.edges[e]
                                   : EdgeOrigin{kSite + static_cast<uint32_t>(k), EdgeRole::Cut,
                                                EdgeOrigin::kNoSide});
        }
        part.polygon = std::move(s.polygon);
        nearer.push_back(std::move(part));
      }
    }
    cell = std::move(nearer);
  }
  for (RegionPiece& p : cell) p.ix = static_cast<uint32_t>(i);
  return cell;
}

// Between two bends of a border: 6 m or a twentieth of the outline, at least twice their reach.
double bendLength(const Polygon& p, double jitter) {
  return std::max(2 * jitter, std::min(6.0, 0.05 * perimeter(p)));
}

// A border between two cells with bends, from a to b; the same points for both cells.
void addBent(Vec2 a, Vec2 b, size_t own, size_t other, std::span<const Disc> sites,
             const VoronoiOptions& o, double bend, Ring& out) {
  const size_t low = std::min(own, other), high = std::max(own, other);
  const Vec2 across = normalized(sites[high].centre - sites[low].centre);
  const bool forward = dot(b - a, perpendicular(across)) > 0;
  const Vec2 from = forward ? a : b, to = forward ? b : a;
  const double l = length(to - from);
  const auto n = static_cast<uint32_t>(std::clamp(std::ceil(l / bend - 1e-6), 1.0, 200.0));
  std::vector<Vec2> inner;
  const uint64_t border = hashCombine(hashCombine(o.seed, low), high);
  for (uint32_t k = 1; k < n; ++k) {
    // Near its ends a border could meet the next one.
    const double most = std::min(o.jitter, 0.3 * l * std::min(k, n - k) / n);
    inner.push_back(from + (to - from) * (static_cast<double>(k) / n) +
                    across * randomIn(hashCombine(border, k), -most, most));
  }
  if (!forward) std::reverse(inner.begin(), inner.end());
  out.push_back(a);
  out.insert(out.end(), inner.begin(), inner.end());
}

class Voronoi {
 public:
  Voronoi(const Polygon& p, const VoronoiOptions& o) : p_(p), o_(o) {}

  VoronoiResult run(std::span<const Disc> sites) {
    VoronoiResult out;
    addSites(sites, out.sites);
    if (out.sites.empty()) return out;
    std::vector<RegionPiece> cells = allCells(out.sites);
    if (o_.jitter > 0) bend(cells, out.sites);
    std::vector<RegionPiece> orphans = takeOrphans(cells, out.sites);
    if (o_.orphans == Orphans::Merge) mergeInto(cells, orphans);
    if (o_.orphans == Orphans::Own) {
      cells.insert(cells.end(), orphans.begin(), orphans.end());
      orphans.clear();
    }
    countRings(cells);
    finish(cells, out);
    for (RegionPiece& p : out.pieces) {
      for (EdgeOrigin& e : p.edges) {
        if (isBorder(e)) e.source = kNoEdge;
      }
    }
    return out;
  }

 private:
  void addSites(std::span<const Disc> sites, std::vector<Disc>& out) const {
    std::vector<std::pair<double, size_t>> byX;
    for (size_t i = 0; i < sites.size(); ++i) byX.push_back({sites[i].centre.x, i});
    std::sort(byX.begin(), byX.end());
    std::vector<bool> same(sites.size(), false);
    for (size_t a = 0; a < byX.size(); ++a) {
      for (size_t b = a + 1; b < byX.size() && byX[b].first - byX[a].first < kSameSite; ++b) {
        work();
        const size_t i = byX[a].second, k = byX[b].second;
        if (length(sites[i].centre - sites[k].centre) < kSameSite) same[std::max(i, k)] = true;
      }
    }
    for (size_t i = 0; i < sites.size(); ++i) {
      if (!same[i] && locate(p_, sites[i].centre) == Where::Inside) out.push_back(sites[i]);
    }
  }

  std::vector<RegionPiece> allCells(const std::vector<Disc>& sites) const {
    const Box2 box = bounds(p_);
    const Buckets buckets(sites, box);
    const RegionPiece whole = wholePiece(p_);
    std::vector<RegionPiece> cells;
    for (size_t i = 0; i < sites.size(); ++i) {
      for (RegionPiece& p : cellOf(whole, i, sites, buckets, box)) cells.push_back(std::move(p));
    }
    return cells;
  }

  // Bends the borders. What two cells would share stays with the first; what none has goes to a
  // neighbour.
  void bend(std::vector<RegionPiece>& cells, const std::vector<Disc>& sites) const {
    const double step = bendLength(p_, o_.jitter);
    std::vector<RegionPiece> out;
    Region taken;
    for (const RegionPiece& c : cells) {
      EdgeSource source;
      size_t edge = 0;
      for (const Ring& r : ringsOf(c.polygon)) {
        Ring ring;
        const size_t before = source.origins.size();
        for (size_t k = 0; k < r.size(); ++k, ++edge) {
          const EdgeOrigin& e = c.edges[edge];
          const Vec2 a = r[k], b = r[(k + 1) % r.size()];
          if (isBorder(e)) {
            addBent(a, b, c.ix, e.source - kSite, sites, o_, step, ring);
          } else {
            ring.push_back(a);
          }
          source.origins.resize(before + ring.size(), e);
        }
        source.rings.push_back(std::move(ring));
      }
      const EdgeSource sources[] = {sourceOf(p_), source};
      Region others;
      for (const Polygon& t : taken) {
        if (boxesMeet(bounds(t), bounds(c.polygon))) others.push_back(t);
      }
      for (Polygon& p :
           subtract(intersect(repaired(source.rings, FillRule::NonZero), {p_}), others)) {
        RegionPiece piece = c;
        piece.edges = originsOf(p, sources);
        taken.push_back(p);
        piece.polygon = std::move(p);
        out.push_back(std::move(piece));
      }
    }
    EdgeSource beside;
    for (Ring& r : gable::ringsOf(taken)) {
      beside.origins.resize(beside.origins.size() + r.size(),
                            {kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
      beside.rings.push_back(std::move(r));
    }
    std::vector<RegionPiece> left = leftBeside(wholePiece(p_), taken, beside);
    cells = std::move(out);
    mergeInto(cells, left);
  }

  static std::vector<RegionPiece> takeOrphans(std::vector<RegionPiece>& cells,
                                              const std::vector<Disc>& sites) {
    std::vector<RegionPiece> kept, orphans;
    for (RegionPiece& c : cells) {
      const bool own = contains(c.polygon, sites[c.ix].centre);
      (own ? kept : orphans).push_back(std::move(c));
      if (!own) orphans.back().part = 1;
    }
    cells = std::move(kept);
    return orphans;
  }

  // As slivers are: each goes to the neighbour with the longest border, again and again, until none
  // has a neighbour.
  static void mergeInto(std::vector<RegionPiece>& cells, std::vector<RegionPiece>& orphans) {
    for (bool moved = true; moved && !orphans.empty();) {
      std::vector<RegionPiece> rest;
      for (RegionPiece& o : orphans) {
        if (absorbSliver(cells, o) == cells.size()) rest.push_back(std::move(o));
      }
      moved = rest.size() < orphans.size();
      orphans = std::move(rest);
    }
  }

  // Cells at the boundary are 0 away from it, their neighbours 1, and so on.
  static void countRings(std::vector<RegionPiece>& cells) {
    constexpr uint32_t kUnknown = 0xffffffff;
    std::map<uint32_t, std::vector<size_t>> bySite;
    for (size_t i = 0; i < cells.size(); ++i) bySite[cells[i].ix].push_back(i);
    std::vector<size_t> front;
    for (size_t i = 0; i < cells.size(); ++i) {
      const bool atBoundary =
          std::any_of(cells[i].edges.begin(), cells[i].edges.end(),
                      [](const EdgeOrigin& e) { return e.role == EdgeRole::Kept; });
      cells[i].iy = atBoundary ? 0 : kUnknown;
      if (atBoundary) front.push_back(i);
    }
    for (uint32_t ring = 1; !front.empty(); ++ring) {
      std::vector<size_t> next;
      for (const size_t i : front) {
        for (const EdgeOrigin& e : cells[i].edges) {
          if (!isBorder(e)) continue;
          const auto found = bySite.find(e.source - kSite);
          if (found == bySite.end()) continue;
          for (const size_t k : found->second) {
            if (cells[k].iy != kUnknown) continue;
            cells[k].iy = ring;
            next.push_back(k);
          }
        }
      }
      front = std::move(next);
    }
    for (RegionPiece& c : cells) {
      if (c.iy == kUnknown) c.iy = 0;
    }
  }

  void finish(std::vector<RegionPiece>& cells, VoronoiResult& out) const {
    std::vector<RegionPiece> areas;
    for (const RegionPiece& c : cells) {
      for (RegionPiece& s : shrunk(c)) areas.push_back(std::move(s));
    }
    std::vector<RegionPiece> centres;
    std::vector<RegionPiece> uncut = o_.centres ? areas : std::vector<RegionPiece>();
    if (o_.centres) cutCentres(out.sites, areas, centres);
    Region taken;
    for (const RegionPiece& a : areas) taken.push_back(a.polygon);
    for (const RegionPiece& c : centres) taken.push_back(c.polygon);
    const bool full = o_.pathWidth <= 0 && o_.smoothing.kind == Smoothing::Kind::None &&
                      o_.orphans != Orphans::Path;
    if (!full) {
      const EdgeOrigin made{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
      addPaths(taken, made, cells, o_.centres ? uncut : areas, out.pieces);
    }
    areas.insert(areas.end(), std::make_move_iterator(out.pieces.begin()),
                 std::make_move_iterator(out.pieces.end()));
    areas.insert(areas.end(), std::make_move_iterator(centres.begin()),
                 std::make_move_iterator(centres.end()));
    out.pieces = std::move(areas);
  }

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

  // What the areas leave free, taken apart at its junctions.
  void addPaths(const Region& taken, EdgeOrigin made, const std::vector<RegionPiece>& cells,
                const std::vector<RegionPiece>& areas, std::vector<RegionPiece>& out) const {
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
  }

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
        if (boxesMeet(boxes[i], box)) here.push_back({meetings[i].hull, {}});
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

  // The cell less half a path, smoothed.
  std::vector<RegionPiece> shrunk(const RegionPiece& cell) const {
    const double half = o_.pathWidth / 2;
    std::vector<RegionPiece> inner;
    if (!(half > 0)) {
      inner.push_back(cell);
    } else {
      std::vector<PeelEdge> edges;
      for (uint32_t i = 0; i < cell.edges.size(); ++i) {
        if (o_.borderPath || cell.edges[i].role != EdgeRole::Kept) edges.push_back({i, 0, 1, half});
      }
      const std::vector<RegionPiece> rest = o_.borderPath
                                                ? contract(cell.polygon, half)
                                                : peel(cell.polygon, edges, PeelEnds::Follow).rest;
      for (const RegionPiece& r : rest) inner.push_back(named(r, cell));
    }
    if (o_.smoothing.kind == Smoothing::Kind::None) return inner;
    std::vector<RegionPiece> out;
    for (const RegionPiece& p : inner) {
      for (Polygon& s : smoothed(p.polygon, o_.smoothing)) {
        RegionPiece piece = p;
        const EdgeSource sources[] = {sourceOf(p)};
        piece.edges = originsOf(s, sources, {kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide});
        piece.polygon = std::move(s);
        piece.part = static_cast<uint32_t>(out.size());
        out.push_back(std::move(piece));
      }
    }
    return out;
  }

  // Origins of a shrunk cell in terms of the region: moved edges lie beside the path.
  RegionPiece named(const RegionPiece& shrunkCell, const RegionPiece& cell) const {
    RegionPiece out = cell;
    out.polygon = shrunkCell.polygon;
    out.edges.clear();
    for (const EdgeOrigin& e : shrunkCell.edges) {
      if (e.role == EdgeRole::Kept) {
        out.edges.push_back(cell.edges[e.source]);
      } else {
        const uint32_t source = e.source == kNoEdge ? kNoEdge : cell.edges[e.source].source;
        out.edges.push_back({source, EdgeRole::Path, EdgeOrigin::kNoSide});
      }
    }
    out.part = shrunkCell.part;
    return out;
  }

  void cutCentres(const std::vector<Disc>& sites, std::vector<RegionPiece>& areas,
                  std::vector<RegionPiece>& junctions) const {
    std::vector<RegionPiece> cut;
    for (RegionPiece& a : areas) {
      const Disc& d = sites[a.ix];
      if (!(d.radius > 0) || !contains(a.polygon, d.centre)) {
        cut.push_back(std::move(a));
        continue;
      }
      PlanFigure circle;
      circle.shape = PlanShape::Circle;
      circle.a = d.radius;
      const Region disc{{ringOf(circle, d.centre), {}}};
      const EdgeOrigin inside{kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide};
      const EdgeOrigin outside{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
      for (RegionPiece& p : combineTraced(BooleanOp::Difference, a, disc, inside)) {
        cut.push_back(std::move(p));
      }
      for (RegionPiece& p : combineTraced(BooleanOp::Intersection, a, disc, outside)) {
        p.kind = PieceKind::Remainder;
        junctions.push_back(std::move(p));
      }
    }
    areas = std::move(cut);
    addLostCentres(sites, areas, junctions);
  }

  // Smoothing may take a cell away from its site; the disc then lies in the path.
  void addLostCentres(const std::vector<Disc>& sites, const std::vector<RegionPiece>& areas,
                      std::vector<RegionPiece>& junctions) const {
    Region taken;
    for (const RegionPiece& a : areas) taken.push_back(a.polygon);
    for (uint32_t i = 0; i < sites.size(); ++i) {
      const bool given = std::any_of(junctions.begin(), junctions.end(),
                                     [&](const RegionPiece& j) { return j.ix == i; });
      if (given || !(sites[i].radius > 0)) continue;
      const Region disc{{ringOf({PlanShape::Circle, sites[i].radius, 0, 24}, sites[i].centre), {}}};
      const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
      Region others = taken;
      for (const RegionPiece& j : junctions) others.push_back(j.polygon);
      for (const RegionPiece& p :
           combineTraced(BooleanOp::Intersection, wholePiece(p_), disc, made)) {
        for (RegionPiece& free : combineTraced(BooleanOp::Difference, p, others, made)) {
          free.kind = PieceKind::Remainder;
          free.ix = i;
          junctions.push_back(std::move(free));
        }
      }
    }
  }

  const Polygon& p_;
  const VoronoiOptions& o_;
};

}  // namespace

VoronoiResult voronoiPartition(const Polygon& p, std::span<const Disc> sites,
                               const VoronoiOptions& options) {
  return Voronoi(p, options).run(sites);
}

}  // namespace gable
