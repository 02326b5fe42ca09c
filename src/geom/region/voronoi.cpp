// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The region is divided into cells (voronoi_cells.h), each cell is shrunk by half a path and
// smoothed, and what the cells leave free is the path (voronoi_paths.h).
#include "geom/region/voronoi.h"

#include <algorithm>
#include <map>

#include "base/work.h"
#include "geom/region/grid_partition.h"
#include "geom/region/peel.h"
#include "geom/region/voronoi_cells.h"
#include "geom/region/voronoi_paths.h"

namespace gable {
namespace {

constexpr double kSameSite = 1e-3;

class Voronoi {
 public:
  Voronoi(const Polygon& p, const VoronoiOptions& o) : p_(p), o_(o) {}

  VoronoiResult run(std::span<const Disc> sites) {
    VoronoiResult out;
    addSites(sites, out.sites);
    if (out.sites.empty()) return out;
    std::vector<RegionPiece> cells = voronoiCells(p_, out.sites);
    if (o_.jitter > 0) {
      // What the bends leave goes to a neighbour.
      std::vector<RegionPiece> left = bendBorders(p_, out.sites, o_, cells);
      mergeInto(cells, left);
    }
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
    if (!full) out.pieces = voronoiPaths(p_, o_, taken, cells, o_.centres ? uncut : areas);
    areas.insert(areas.end(), std::make_move_iterator(out.pieces.begin()),
                 std::make_move_iterator(out.pieces.end()));
    areas.insert(areas.end(), std::make_move_iterator(centres.begin()),
                 std::make_move_iterator(centres.end()));
    out.pieces = std::move(areas);
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
