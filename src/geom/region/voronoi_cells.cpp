// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A convex cell in the plane is found by halving the box with the bisectors of the nearest sites
// (until those left are too far to reach it); the region is then cut by the few bisectors that
// bound the cell.
#include "geom/region/voronoi_cells.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/line.h"

namespace gable {
namespace {

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

}  // namespace

std::vector<RegionPiece> voronoiCells(const Polygon& region, std::span<const Disc> sites) {
  const Box2 box = bounds(region);
  const Buckets buckets(sites, box);
  const RegionPiece whole = wholePiece(region);
  std::vector<RegionPiece> cells;
  for (size_t i = 0; i < sites.size(); ++i) {
    for (RegionPiece& p : cellOf(whole, i, sites, buckets, box)) cells.push_back(std::move(p));
  }
  return cells;
}

std::vector<RegionPiece> bendBorders(const Polygon& region, std::span<const Disc> sites,
                                     const VoronoiOptions& options,
                                     std::vector<RegionPiece>& cells) {
  const double step = bendLength(region, options.jitter);
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
          addBent(a, b, c.ix, e.source - kSite, sites, options, step, ring);
        } else {
          ring.push_back(a);
        }
        source.origins.resize(before + ring.size(), e);
      }
      source.rings.push_back(std::move(ring));
    }
    const EdgeSource sources[] = {sourceOf(region), source};
    Region others;
    for (const Polygon& t : taken) {
      if (bounds(t).meets(bounds(c.polygon))) others.push_back(t);
    }
    for (Polygon& p :
         subtract(intersect(repaired(source.rings, FillRule::NonZero), {region}), others)) {
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
  std::vector<RegionPiece> left = leftBeside(wholePiece(region), taken, beside);
  cells = std::move(out);
  return left;
}

}  // namespace gable
