// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A convex cell in the plane is found by halving the box with the bisectors of the nearest sites
// (until those left are too far to reach it); the region is then cut by the few bisectors that
// bound the cell. What the cells leave free is the path.
#include "geom/region/voronoi.h"

#include <algorithm>
#include <cmath>

#include "geom/region/grid_partition.h"
#include "geom/region/line.h"
#include "geom/region/peel.h"

namespace gable {
namespace {

constexpr double kSameSite = 1e-3;

// The sites whose bisectors bound the cell of site i within the box.
std::vector<size_t> neighboursOf(size_t i, std::span<const Disc> sites, const Box2& box) {
  struct Corner {
    Vec2 at;
    size_t edge;  // The bisector of the edge that starts here.
  };
  const size_t none = sites.size();
  std::vector<Corner> cell{{box.min, none},
                           {{box.max.x, box.min.y}, none},
                           {box.max, none},
                           {{box.min.x, box.max.y}, none}};
  std::vector<size_t> order;
  for (size_t k = 0; k < sites.size(); ++k) {
    if (k != i) order.push_back(k);
  }
  const Vec2 own = sites[i].centre;
  const auto away = [&](size_t k) { return length(sites[k].centre - own); };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const double da = away(a), db = away(b);
    return da != db ? da < db : a < b;
  });
  for (const size_t k : order) {
    double reach = 0;
    for (const Corner& c : cell) reach = std::max(reach, length(c.at - own));
    if (away(k) > 2 * reach) break;
    const Vec2 normal = sites[k].centre - own;
    const double limit = dot(normal, own + sites[k].centre) / 2;
    std::vector<Corner> next;
    for (size_t c = 0; c < cell.size(); ++c) {
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
                                const Box2& box) {
  std::vector<RegionPiece> cell{whole};
  for (const size_t k : neighboursOf(i, sites, box)) {
    const Vec2 a = sites[i].centre, b = sites[k].centre;
    std::vector<RegionPiece> nearer;
    for (const RegionPiece& p : cell) {
      // The bisector with the site to its left; equal lines for both sites.
      const Vec2 along = perpendicular(b - a);
      for (StripPiece& s : splitByLine(p.polygon, (a + b) * 0.5, along)) {
        if (s.strip != 0) continue;
        RegionPiece part = p;
        part.edges.clear();
        for (const uint32_t e : s.edgeOrigin) {
          part.edges.push_back(e < StripPiece::kOnLine
                                   ? p.edges[e]
                                   : EdgeOrigin{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
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

// Edges no longer than `most`.
Ring subdivided(const Ring& r, double most) {
  Ring out;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 a = r[i], b = r[(i + 1) % r.size()];
    const double n = std::clamp(std::ceil(length(b - a) / most), 1.0, 1000.0);
    for (double k = 0; k < n; ++k) out.push_back(a + (b - a) * (k / n));
  }
  return out;
}

Ring averaged(const Ring& r, double weight) {
  Ring out;
  const double side = (1 - weight) / 2;
  const size_t n = r.size();
  for (size_t i = 0; i < n; ++i) {
    out.push_back((r[(i + n - 1) % n] + r[(i + 1) % n]) * side + r[i] * weight);
  }
  return out;
}

Ring cornersCut(const Ring& r) {
  Ring out;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 a = r[i], b = r[(i + 1) % r.size()];
    out.push_back(a * 0.75 + b * 0.25);
    out.push_back(a * 0.25 + b * 0.75);
  }
  return out;
}

}  // namespace

Region smoothed(const Polygon& p, const Smoothing& s) {
  if (s.kind == Smoothing::Kind::None) return {p};
  if (s.kind == Smoothing::Kind::Round) {
    OffsetOptions round;
    round.join = OffsetJoin::Round;
    return intersect(offset(offset({p}, -s.radius, round), s.radius, round), {p});
  }
  std::vector<Ring> rings;
  for (const Ring& r : ringsOf(p)) {
    Ring out = r;
    if (s.kind == Smoothing::Kind::Average) {
      out = subdivided(r, std::max(std::min(6.0, 0.1 * perimeter(r)), 1e-6));
    }
    for (uint32_t k = 0; k < std::min(s.times, 6u); ++k) {
      out = s.kind == Smoothing::Kind::Average ? averaged(out, s.weight) : cornersCut(out);
    }
    rings.push_back(std::move(out));
  }
  return intersect(repaired(rings, FillRule::NonZero), {p});
}

namespace {

class Voronoi {
 public:
  Voronoi(const Polygon& p, const VoronoiOptions& o) : p_(p), o_(o) {}

  VoronoiResult run(std::span<const Disc> sites) {
    VoronoiResult out;
    for (const Disc& d : sites) {
      const bool apart = std::none_of(out.sites.begin(), out.sites.end(), [&](const Disc& other) {
        return length(other.centre - d.centre) < kSameSite;
      });
      if (apart && locate(p_, d.centre) == Where::Inside) out.sites.push_back(d);
    }
    if (out.sites.empty()) return out;
    std::vector<RegionPiece> cells = allCells(out.sites);
    std::vector<RegionPiece> orphans = takeOrphans(cells, out.sites);
    if (o_.orphans == Orphans::Merge) mergeInto(cells, orphans);
    if (o_.orphans == Orphans::Own) {
      cells.insert(cells.end(), orphans.begin(), orphans.end());
      orphans.clear();
    }
    finish(cells, out);
    return out;
  }

 private:
  std::vector<RegionPiece> allCells(const std::vector<Disc>& sites) const {
    Box2 box = bounds(p_);
    const RegionPiece whole = wholePiece(p_);
    std::vector<RegionPiece> cells;
    for (size_t i = 0; i < sites.size(); ++i) {
      for (RegionPiece& p : cellOf(whole, i, sites, box)) cells.push_back(std::move(p));
    }
    return cells;
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
        if (!absorbSliver(cells, o)) rest.push_back(std::move(o));
      }
      moved = rest.size() < orphans.size();
      orphans = std::move(rest);
    }
  }

  void finish(std::vector<RegionPiece>& cells, VoronoiResult& out) const {
    std::vector<RegionPiece> areas;
    for (const RegionPiece& c : cells) {
      for (RegionPiece& s : shrunk(c)) areas.push_back(std::move(s));
    }
    std::vector<RegionPiece> junctions;
    if (o_.centres) cutCentres(out.sites, areas, junctions);
    Region taken;
    for (const RegionPiece& a : areas) taken.push_back(a.polygon);
    for (const RegionPiece& j : junctions) taken.push_back(j.polygon);
    const bool full = o_.pathWidth <= 0 && o_.smoothing.kind == Smoothing::Kind::None &&
                      o_.orphans != Orphans::Path;
    out.pieces = std::move(areas);
    if (!full) {
      const EdgeOrigin made{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
      uint32_t index = 0;
      for (RegionPiece& p : combineTraced(BooleanOp::Difference, wholePiece(p_), taken, made)) {
        p.kind = PieceKind::Path;
        p.ix = index++;
        p.part = 0;
        out.pieces.push_back(std::move(p));
      }
    }
    for (RegionPiece& j : junctions) out.pieces.push_back(std::move(j));
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
        p.kind = PieceKind::Junction;
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
          free.kind = PieceKind::Junction;
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
