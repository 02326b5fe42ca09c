// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Coons 1967: each point is the sum of two ruled surfaces between opposite sides, less the bilinear
// one of the corners. The map is taken when its area element is positive on a lattice of 16 by 16.
#include "geom/region/quad_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"
#include "geom/region/along.h"
#include "geom/region/autoindex.h"

namespace gable {
namespace {

constexpr int kLattice = 16;
constexpr uint32_t kPartsPerCell = 8;

Vec2 lerp(Vec2 a, Vec2 b, double t) { return a + (b - a) * t; }

// A side from one corner to the next, with the share of the length at each of its points.
struct Side {
  std::vector<Vec2> points;
  std::vector<double> shares;

  Vec2 at(double t) const {
    const auto next = std::upper_bound(shares.begin(), shares.end(), t);
    if (next == shares.begin()) return points.front();
    if (next == shares.end()) return points.back();
    const auto i = static_cast<size_t>(next - shares.begin());
    const double whole = shares[i] - shares[i - 1];
    return lerp(points[i - 1], points[i], whole > 0 ? (t - shares[i - 1]) / whole : 0);
  }
};

Side sideThrough(std::vector<Vec2> points) {
  Side s;
  double sum = 0;
  s.shares.push_back(0);
  for (size_t i = 1; i < points.size(); ++i) {
    sum += length(points[i] - points[i - 1]);
    s.shares.push_back(sum);
  }
  for (double& v : s.shares) v = sum > 0 ? v / sum : 0;
  if (s.shares.size() > 1) s.shares.back() = 1;
  s.points = std::move(points);
  return s;
}

class Patch {
 public:
  // South and north run east, west and east run north.
  bool takeSides(const Ring& outer) {
    const LogicalEdges l = sidesOf(outer);
    if (l.count != 4) return false;
    const size_t n = outer.size();
    std::array<std::vector<Vec2>, 4> chain;
    for (uint32_t side = 0; side < 4; ++side) {
      size_t begin = n;
      for (size_t i = 0; i < n; ++i) {
        if (l.of[i] == side && l.of[(i + n - 1) % n] != side) begin = i;
      }
      if (begin == n) return false;
      chain[side].push_back(outer[begin]);
      for (size_t k = begin; l.of[k % n] == side && k < begin + n; ++k) {
        chain[side].push_back(outer[(k + 1) % n]);
      }
    }
    std::reverse(chain[0].begin(), chain[0].end());
    std::reverse(chain[1].begin(), chain[1].end());
    for (uint32_t side = 0; side < 4; ++side) side_[side] = sideThrough(std::move(chain[side]));
    return true;
  }
  void straighten() {
    for (Side& s : side_) s = sideThrough({s.points.front(), s.points.back()});
  }

  Vec2 at(double u, double v) const {
    const Vec2 ruledV = lerp(side_[3].at(u), side_[1].at(u), v);
    const Vec2 ruledU = lerp(side_[0].at(v), side_[2].at(v), u);
    const Vec2 south = lerp(side_[3].points.front(), side_[3].points.back(), u);
    const Vec2 north = lerp(side_[1].points.front(), side_[1].points.back(), u);
    return ruledV + ruledU - lerp(south, north, v);
  }
  bool folds() const {
    for (int i = 0; i < kLattice; ++i) {
      for (int k = 0; k < kLattice; ++k) {
        work();
        const double u = static_cast<double>(i) / kLattice, v = static_cast<double>(k) / kLattice;
        const double s = 1.0 / kLattice;
        const Vec2 a = at(u, v), b = at(u + s, v), c = at(u + s, v + s), d = at(u, v + s);
        if (!(cross(b - a, d - a) > 0 && cross(c - b, a - b) > 0 && cross(d - c, b - c) > 0)) {
          return true;
        }
      }
    }
    return false;
  }
  const Side& side(uint32_t k) const { return side_[k]; }

 private:
  std::array<Side, 4> side_;
};

// Where a line of the map has points: some for each cell, and the vertices of the sides that the
// first and the last line are.
std::vector<double> placesOn(uint32_t line, uint32_t lines, uint32_t cells, const Side& first,
                             const Side& last) {
  std::vector<double> out;
  for (uint32_t k = 0; k <= cells * kPartsPerCell; ++k) {
    work();
    out.push_back(static_cast<double>(k) / (cells * kPartsPerCell));
  }
  const Side* own = line == 0 ? &first : line == lines ? &last : nullptr;
  if (own) out.insert(out.end(), own->shares.begin(), own->shares.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

struct CellRing {
  Ring ring;
  std::vector<EdgeOrigin> origins;
};

class Cells {
 public:
  Cells(const Patch& patch, uint32_t nx, uint32_t ny) : patch_(patch), nx_(nx), ny_(ny) {
    for (uint32_t k = 0; k <= ny; ++k) {
      rows_.push_back(placesOn(k, ny, nx, patch.side(3), patch.side(1)));
    }
    for (uint32_t k = 0; k <= nx; ++k) {
      columns_.push_back(placesOn(k, nx, ny, patch.side(0), patch.side(2)));
    }
  }

  CellRing ringOfCell(uint32_t ix, uint32_t iy) const {
    CellRing out;
    const double u0 = share(ix, nx_), u1 = share(ix + 1, nx_);
    const double v0 = share(iy, ny_), v1 = share(iy + 1, ny_);
    add(out, 3, rows_[iy], u0, u1, [&](double u) { return patch_.at(u, v0); });
    add(out, 2, columns_[ix + 1], v0, v1, [&](double v) { return patch_.at(u1, v); });
    addBack(out, 1, rows_[iy + 1], u0, u1, [&](double u) { return patch_.at(u, v1); });
    addBack(out, 0, columns_[ix], v0, v1, [&](double v) { return patch_.at(u0, v); });
    return out;
  }

 private:
  static double share(uint32_t i, uint32_t n) { return static_cast<double>(i) / n; }
  template <class At>
  static void add(CellRing& out, uint8_t side, const std::vector<double>& places, double from,
                  double to, At&& at) {
    for (const double t : places) {
      work();
      if (t < from || t >= to) continue;
      out.ring.push_back(at(t));
      out.origins.push_back({kNoEdge, EdgeRole::Cut, side});
    }
  }
  template <class At>
  static void addBack(CellRing& out, uint8_t side, const std::vector<double>& places, double from,
                      double to, At&& at) {
    for (auto t = places.rbegin(); t != places.rend(); ++t) {
      work();
      if (*t <= from || *t > to) continue;
      out.ring.push_back(at(*t));
      out.origins.push_back({kNoEdge, EdgeRole::Cut, side});
    }
  }
  const Patch& patch_;
  uint32_t nx_, ny_;
  std::vector<std::vector<double>> rows_, columns_;
};

}  // namespace

QuadMapResult quadMap(const Polygon& p, uint32_t nx, uint32_t ny) {
  QuadMapResult out;
  Patch patch;
  if (!patch.takeSides(p.outer)) {
    out.pieces.push_back(wholePiece(p));
    return out;
  }
  out.curved = !patch.folds();
  if (!out.curved) patch.straighten();
  const Cells cells(patch, nx, ny);
  const EdgeSource whole[] = {sourceOf(p)};
  Region taken;
  for (uint32_t iy = 0; iy < ny; ++iy) {
    for (uint32_t ix = 0; ix < nx; ++ix) {
      const CellRing cell = cells.ringOfCell(ix, iy);
      const EdgeSource own[] = {{{cell.ring}, cell.origins}};
      const Region area = repaired({cell.ring}, FillRule::NonZero);
      uint32_t part = 0;
      for (Polygon& q : subtract(intersect(area, {p}), taken)) {
        RegionPiece piece;
        piece.ix = ix;
        piece.iy = iy;
        piece.part = part++;
        const Box2 box = bounds(q);
        piece.width = box.size().x;
        piece.height = box.size().y;
        const std::vector<EdgeOrigin> sides = originsOf(q, own);
        piece.edges = originsOf(q, whole);
        for (size_t i = 0; i < sides.size(); ++i) piece.edges[i].side = sides[i].side;
        piece.polygon = std::move(q);
        out.pieces.push_back(std::move(piece));
      }
      taken.push_back({cell.ring, {}});
    }
    taken = repaired(ringsOf(taken), FillRule::NonZero);
  }
  const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
  for (RegionPiece& r : combineTraced(BooleanOp::Difference, wholePiece(p), taken, made)) {
    r.kind = PieceKind::Remainder;
    r.part = 0;
    out.pieces.push_back(std::move(r));
  }
  const double mean = area(p) / (static_cast<double>(nx) * ny);
  mergeSlivers(out.pieces, std::min(0.02, std::sqrt(mean) / 50), std::min(0.25, mean / 50));
  return out;
}

}  // namespace gable
