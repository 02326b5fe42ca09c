// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Clipper keeps no account of where edges come from. It need not: an edge of the result lies on its
// source within two grid units, so it is found again by place and direction (traceEdges).
#include "geom/region/piece.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/faces.h"
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

// The edges of a polygon that reach into a box.
std::vector<Segment> edgesWithin(const Polygon& p, const Box2& box) {
  std::vector<Segment> out;
  const auto add = [&](const Ring& r) {
    for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
      work();
      const Vec2 a = r[j], b = r[i];
      if (std::max(a.x, b.x) < box.min.x || std::min(a.x, b.x) > box.max.x ||
          std::max(a.y, b.y) < box.min.y || std::min(a.y, b.y) > box.max.y) {
        continue;
      }
      out.push_back({a, b});
    }
  };
  add(p.outer);
  for (const Ring& h : p.holes) add(h);
  return out;
}

// The length of the edges that lie on others.
double lengthOn(std::span<const Segment> edges, std::span<const Segment> others) {
  double sum = 0;
  size_t i = 0;
  for (const uint32_t t : traceSegments(edges, others, kTrace)) {
    if (t != kNoEdge) sum += length(edges[i].b - edges[i].a);
    ++i;
  }
  return sum;
}

// The length of border that a polygon within `box` shares with another.
double commonBorder(const Polygon& a, const Box2& box, const Polygon& b) {
  const std::vector<Segment> near = edgesWithin(b, box);
  if (near.empty()) return 0;
  const std::vector<Segment> edges = edgesOf(a);
  // Long edges of the sliver may have several neighbours' edges on them, and no middle on any.
  return std::max(lengthOn(edges, near), lengthOn(near, edges));
}

// Puts `small` into `large`; false when they have no area in common sides.
bool absorb(RegionPiece& large, const RegionPiece& small) {
  std::vector<Segment> edges = edgesOf(large.polygon);
  const size_t own = edges.size();
  for (const Segment& s : edgesOf(small.polygon)) edges.push_back(s);
  std::vector<Face> faces;
  if (facesOf(edges, {}, 2 * kRegionGrid, faces)) {
    if (faces.size() != 1) return false;
    large.polygon = std::move(faces[0].polygon);
    std::vector<EdgeOrigin> named;
    for (const uint32_t e : faces[0].edges) {
      named.push_back(e < own ? large.edges[e] : small.edges[e - own]);
    }
    large.edges = std::move(named);
    return true;
  }
  const Region sum = unite({large.polygon}, {small.polygon});
  if (sum.size() != 1) return false;
  const EdgeSource sources[] = {sourceOf(large), sourceOf(small)};
  large.edges = originsOf(sum[0], sources);
  large.polygon = sum[0];
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
      work();
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

std::vector<std::vector<EdgeOrigin>> originsOf(const Region& r, std::span<const EdgeSource> sources,
                                               EdgeOrigin otherwise) {
  const std::vector<EdgeOrigin> all = originsOfRings(ringsOf(r), sources, otherwise);
  std::vector<std::vector<EdgeOrigin>> out;
  auto first = all.begin();
  for (const Polygon& p : r) {
    const auto last = first + static_cast<std::ptrdiff_t>(edgeCount(p));
    out.emplace_back(first, last);
    first = last;
  }
  return out;
}

namespace {

std::vector<RegionPiece> piecesLike(const RegionPiece& a, Region polygons,
                                    std::vector<std::vector<EdgeOrigin>> edges) {
  std::vector<RegionPiece> out;
  for (size_t i = 0; i < polygons.size(); ++i) {
    RegionPiece piece = a;
    piece.edges = std::move(edges[i]);
    piece.polygon = std::move(polygons[i]);
    piece.part = a.part + static_cast<uint32_t>(i);
    out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace

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
  std::vector<std::vector<EdgeOrigin>> edges = originsOf(all, sources, made);
  return piecesLike(a, std::move(all), std::move(edges));
}

std::vector<RegionPiece> leftBeside(const RegionPiece& whole, const Region& parts,
                                    const EdgeSource& beside) {
  std::vector<Segment> edges = edgesOf(whole.polygon);
  std::vector<EdgeOrigin> origins = whole.edges;
  size_t first = 0;
  for (const Ring& r : beside.rings) {
    // Turned round, and from the first point on, so that results start where booleans' do.
    for (size_t k = r.size(); k-- > 0;) {
      work();
      edges.push_back({r[k + 1 == r.size() ? 0 : k + 1], r[k]});
      origins.push_back(beside.origins[first + k]);
    }
    first += r.size();
  }
  std::vector<Face> faces;
  Region left;
  std::vector<std::vector<EdgeOrigin>> named;
  if (facesOf(edges, {}, 2 * kRegionGrid, faces)) {
    for (Face& f : faces) {
      named.emplace_back();
      for (const uint32_t e : f.edges) named.back().push_back(origins[e]);
      left.push_back(std::move(f.polygon));
    }
  } else {
    const EdgeSource sources[] = {sourceOf(whole), beside};
    left = subtract({whole.polygon}, parts);
    named = originsOf(left, sources, {kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
  }
  return piecesLike(whole, std::move(left), std::move(named));
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

namespace {

// `boxes`: those of the pieces, empty for pieces that are gone.
size_t absorbAmong(std::vector<RegionPiece>& pieces, const std::vector<Box2>& boxes,
                   const RegionPiece& sliver) {
  const Box2 box = grown(bounds(sliver.polygon), kTrace);
  struct Neighbour {
    size_t index;
    double border;
    bool path;
  };
  std::vector<Neighbour> found;
  work(pieces.size());
  for (size_t k = 0; k < pieces.size(); ++k) {
    if (!box.meets(boxes[k]) || &pieces[k] == &sliver) continue;
    const double border = commonBorder(sliver.polygon, box, pieces[k].polygon);
    if (border > kTrace) found.push_back({k, border, pieces[k].kind == PieceKind::Path});
  }
  std::stable_sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.path != b.path ? a.path : a.border > b.border;
  });
  for (const Neighbour& n : found) {
    if (absorb(pieces[n.index], sliver)) return n.index;
  }
  return pieces.size();
}

std::vector<Box2> boxesOf(const std::vector<RegionPiece>& pieces) {
  std::vector<Box2> out;
  for (const RegionPiece& p : pieces) out.push_back(bounds(p.polygon));
  return out;
}

}  // namespace

size_t absorbSliver(std::vector<RegionPiece>& pieces, const RegionPiece& sliver) {
  return absorbAmong(pieces, boxesOf(pieces), sliver);
}

void mergeSlivers(std::vector<RegionPiece>& pieces, double sliver, double minArea) {
  const auto isSmall = [&](const RegionPiece& p) {
    return area(p.polygon) < minArea || thickness(p.polygon) < sliver;
  };
  std::vector<char> small, gone(pieces.size(), 0);
  for (const RegionPiece& p : pieces) small.push_back(isSmall(p));
  std::vector<Box2> boxes = boxesOf(pieces);
  for (size_t i = 0; i < pieces.size();) {
    work();
    const bool merges = small[i] && !gone[i];
    const size_t into = merges ? absorbAmong(pieces, boxes, pieces[i]) : pieces.size();
    if (into == pieces.size()) {
      ++i;
      continue;
    }
    small[into] = isSmall(pieces[into]);
    boxes[into] = bounds(pieces[into].polygon);
    gone[i] = 1;
    boxes[i] = {};
    // What has grown may have become another sliver's neighbour.
    i = std::min(i + 1, into);
  }
  size_t kept = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (gone[i]) continue;
    if (kept != i) pieces[kept] = std::move(pieces[i]);
    ++kept;
  }
  pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(kept), pieces.end());
}

}  // namespace gable
