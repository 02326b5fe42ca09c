// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Clipper keeps no account of where edges come from. It need not: an edge of the result lies on its
// source within two grid units, so it is found again by place and direction (traceEdges).
#include "geom/region/piece.h"

#include <algorithm>
#include <cmath>

#include "geom/region/segment_grid.h"

namespace gable {
namespace {

// Vertices move by up to one unit when they are put on the grid and by one more when welded.
constexpr double kTrace = 3 * kRegionGrid;

Box2 grown(Box2 b, double by) {
  b.min = b.min - Vec2{by, by};
  b.max = b.max + Vec2{by, by};
  return b;
}

bool overlap(const Box2& a, const Box2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

// The length of the edges of `a` that lie on edges of `b`.
double commonBorder(const Polygon& a, const Polygon& b) {
  const std::vector<Ring> rings = ringsOf(a), others = ringsOf(b);
  double sum = 0;
  size_t i = 0;
  const std::vector<Segment> edges = edgesOf(rings);
  for (const uint32_t t : traceEdges(rings, others, kTrace)) {
    if (t != kNoEdge) sum += length(edges[i].b - edges[i].a);
    ++i;
  }
  // Long edges of the sliver may have several neighbours' edges on them, and no middle on any.
  i = 0;
  const std::vector<Segment> back = edgesOf(others);
  double sumBack = 0;
  for (const uint32_t t : traceEdges(others, rings, kTrace)) {
    if (t != kNoEdge) sumBack += length(back[i].b - back[i].a);
    ++i;
  }
  return std::max(sum, sumBack);
}

// Puts `small` into `large`; false when they have no area in common sides.
bool absorb(RegionPiece& large, const RegionPiece& small) {
  const Region sum = unite({large.polygon}, {small.polygon});
  if (sum.size() != 1) return false;
  const EdgeSource sources[] = {sourceOf(large), sourceOf(small)};
  RegionPiece out = large;
  out.polygon = sum[0];
  out.edges = originsOf(out.polygon, sources);
  large = std::move(out);
  return true;
}

}  // namespace

std::vector<Ring> ringsOf(const Polygon& p) {
  std::vector<Ring> out{p.outer};
  out.insert(out.end(), p.holes.begin(), p.holes.end());
  return out;
}

size_t edgeCount(const Polygon& p) {
  size_t n = p.outer.size();
  for (const Ring& h : p.holes) n += h.size();
  return n;
}

EdgeSource sourceOf(const Polygon& p) { return sourceOf(wholePiece(p)); }

EdgeSource sourceOf(const Polygon& p, std::vector<EdgeOrigin> origins) {
  return {ringsOf(p), std::move(origins)};
}

EdgeSource sourceOf(const Ring& r, EdgeOrigin origin) {
  return {{r}, std::vector<EdgeOrigin>(r.size(), origin)};
}

RegionPiece wholePiece(const Polygon& p) {
  RegionPiece out;
  out.polygon = p;
  const size_t n = edgeCount(p);
  for (uint32_t i = 0; i < n; ++i) out.edges.push_back({i, EdgeRole::Kept, EdgeOrigin::kNoSide});
  return out;
}

namespace {

std::vector<EdgeOrigin> originsOfRings(const std::vector<Ring>& rings,
                                       std::span<const EdgeSource> sources, EdgeOrigin otherwise) {
  size_t count = 0;
  for (const Ring& r : rings) count += r.size();
  std::vector<EdgeOrigin> out(count, otherwise);
  std::vector<bool> known(out.size(), false);
  for (const EdgeSource& s : sources) {
    const std::vector<uint32_t> traced = traceEdges(rings, s.rings, kTrace);
    for (size_t i = 0; i < out.size(); ++i) {
      if (known[i] || traced[i] == kNoEdge) continue;
      out[i] = s.origins[traced[i]];
      known[i] = true;
    }
  }
  return out;
}

}  // namespace

std::vector<EdgeOrigin> originsOf(const Polygon& p, std::span<const EdgeSource> sources,
                                  EdgeOrigin otherwise) {
  return originsOfRings(ringsOf(p), sources, otherwise);
}

std::vector<RegionPiece> combineTraced(BooleanOp op, const RegionPiece& a, const Region& b,
                                       EdgeOrigin made) {
  // All of b is one source, and all results are traced at once: there may be hundreds of each.
  EdgeSource other;
  for (const Polygon& p : b) {
    for (Ring& r : ringsOf(p)) other.rings.push_back(std::move(r));
    other.origins.resize(other.origins.size() + edgeCount(p), made);
  }
  const EdgeSource sources[] = {sourceOf(a), std::move(other)};
  Region all = combine(op, {a.polygon}, b);
  const std::vector<EdgeOrigin> origins = originsOfRings(ringsOf(all), sources, made);
  std::vector<RegionPiece> out;
  uint32_t part = a.part;
  auto first = origins.begin();
  for (Polygon& p : all) {
    RegionPiece piece = a;
    const auto last = first + static_cast<std::ptrdiff_t>(edgeCount(p));
    piece.edges.assign(first, last);
    first = last;
    piece.polygon = std::move(p);
    piece.part = part++;
    out.push_back(std::move(piece));
  }
  return out;
}

double perimeter(const Polygon& p) {
  double sum = perimeter(p.outer);
  for (const Ring& h : p.holes) sum += perimeter(h);
  return sum;
}

double thickness(const Polygon& p) {
  const double round = perimeter(p);
  return round > 0 ? 2 * area(p) / round : 0;
}

bool absorbSliver(std::vector<RegionPiece>& pieces, const RegionPiece& sliver) {
  const Box2 box = grown(bounds(sliver.polygon), kTrace);
  struct Neighbour {
    size_t index;
    double border;
    bool path;
  };
  std::vector<Neighbour> found;
  for (size_t k = 0; k < pieces.size(); ++k) {
    if (&pieces[k] == &sliver || !overlap(box, bounds(pieces[k].polygon))) continue;
    const double border = commonBorder(sliver.polygon, pieces[k].polygon);
    if (border > kTrace) found.push_back({k, border, pieces[k].kind == PieceKind::Path});
  }
  std::stable_sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.path != b.path ? a.path : a.border > b.border;
  });
  return std::any_of(found.begin(), found.end(),
                     [&](const Neighbour& n) { return absorb(pieces[n.index], sliver); });
}

void mergeSlivers(std::vector<RegionPiece>& pieces, double sliver, double minArea) {
  for (size_t i = 0; i < pieces.size();) {
    const RegionPiece& s = pieces[i];
    const bool small = area(s.polygon) < minArea || thickness(s.polygon) < sliver;
    if (small && absorbSliver(pieces, s)) {
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
}

}  // namespace gable
