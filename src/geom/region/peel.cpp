// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Every moved edge sweeps a quadrilateral; where two moved edges meet at a reflex corner a kite
// fills the gap. Their union, cut to the region, is the strip, less what leaked through thin walls.
#include "geom/region/peel.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/segment_grid.h"

namespace gable {
namespace {

constexpr double kTrace = 3 * kRegionGrid;
// Beyond this a miter is beveled, and an end beside a nearly parallel edge is square.
constexpr double kMiterLimit = 4;
constexpr double kLeastSine = 0.17;

struct Ends {
  uint32_t previous, next;
};

// By edge of all rings: its neighbours.
std::vector<Ends> neighbours(const std::vector<Ring>& rings) {
  std::vector<Ends> out;
  uint32_t first = 0;
  for (const Ring& r : rings) {
    const auto n = static_cast<uint32_t>(r.size());
    for (uint32_t i = 0; i < n; ++i) out.push_back({first + (i + n - 1) % n, first + (i + 1) % n});
    first += n;
  }
  return out;
}

class Peel {
 public:
  Peel(const Polygon& p, std::span<const PeelEdge> edges, PeelEnds ends)
      : p_(p),
        ends_(ends),
        rings_(ringsOf(p)),
        segments_(edgesOf(rings_)),
        around_(neighbours(rings_)),
        whole_(segments_.size(), 0) {
    for (const PeelEdge& e : edges) {
      work();
      if (e.edge >= segments_.size() || !(e.distance > 0) || !std::isfinite(e.distance)) continue;
      if (!(e.to > e.from) || segments_[e.edge].a == segments_[e.edge].b) continue;
      jobs_.push_back(e);
      if (e.from <= 0 && e.to >= 1) whole_[e.edge] = e.distance;
    }
  }

  PeelResult run() {
    PeelResult out;
    if (jobs_.empty()) {
      out.rest.push_back(wholePiece(p_));
      return out;
    }
    std::vector<Ring> shapes;
    for (const PeelEdge& e : jobs_) sweep(e, shapes);
    const RegionPiece whole = wholePiece(p_);
    Region strips;
    EdgeSource beside;
    Region swept = intersect(repaired(shapes, FillRule::NonZero), {p_});
    std::vector<std::vector<EdgeOrigin>> edges = stripOrigins(swept);
    for (size_t i = 0; i < swept.size(); ++i) {
      const bool base = std::any_of(edges[i].begin(), edges[i].end(),
                                    [](const EdgeOrigin& e) { return e.role == EdgeRole::Base; });
      if (!base) continue;
      RegionPiece strip;
      strip.polygon = swept[i];
      strip.edges = std::move(edges[i]);
      for (Ring& r : ringsOf(strip.polygon)) beside.rings.push_back(std::move(r));
      beside.origins.insert(beside.origins.end(), strip.edges.begin(), strip.edges.end());
      strips.push_back(std::move(swept[i]));
      out.strips.push_back(std::move(strip));
    }
    for (RegionPiece& left : leftBeside(whole, strips, beside)) out.rest.push_back(std::move(left));
    for (uint32_t i = 0; i < out.strips.size(); ++i) out.strips[i].part = out.strips[i].ix = i;
    for (uint32_t i = 0; i < out.rest.size(); ++i) out.rest[i].part = out.rest[i].ix = i;
    return out;
  }

 private:
  // Where the offset line of an edge meets the line of a neighbour that stays, or its square end.
  Vec2 endPoint(const PeelEdge& e, Vec2 corner, Vec2 along, uint32_t other, bool atEnd) const {
    const Vec2 square = corner + perpendicular(along) * e.distance;
    if (ends_ == PeelEnds::Orthogonal || (atEnd ? e.to < 1 : e.from > 0)) return square;
    if (whole_[other] > 0) return square;
    const Vec2 d = normalized(segments_[other].b - segments_[other].a);
    const double sine = cross(along, d);
    if (std::fabs(sine) < kLeastSine) return square;
    // corner + d * t lies at `distance` to the left of the edge.
    const double t = e.distance / sine;
    if (std::fabs(t) > kMiterLimit * e.distance) return square;
    return corner + d * t;
  }

  void sweep(const PeelEdge& e, std::vector<Ring>& shapes) {
    const Segment& s = segments_[e.edge];
    const Vec2 along = normalized(s.b - s.a);
    const Vec2 a = s.a + (s.b - s.a) * std::max(0.0, e.from);
    const Vec2 b = e.to >= 1 ? s.b : s.a + (s.b - s.a) * e.to;
    const Vec2 a2 = endPoint(e, a, along, around_[e.edge].previous, false);
    const Vec2 b2 = endPoint(e, b, along, around_[e.edge].next, true);
    Ring r{a, b, b2, a2};
    if (dot(b2 - a2, along) <= 0) {
      // The ends cross before they reach the distance.
      const Vec2 u = a2 - a, v = b2 - b;
      const double det = cross(u, v);
      r = {a, b};
      if (std::fabs(det) > 0) r.push_back(a + u * (cross(b - a, v) / det));
    }
    if (r.size() >= 3) shapes.push_back(std::move(r));
    const Vec2 shift = perpendicular(along) * e.distance;
    inner_.push_back({{a + shift, b + shift}, e.edge});
    if (e.to >= 1 && whole_[around_[e.edge].next] > 0) kite(e, shapes);
  }

  // Between an edge and the next at a reflex corner.
  void kite(const PeelEdge& e, std::vector<Ring>& shapes) {
    const Segment& s = segments_[e.edge];
    const Segment& t = segments_[around_[e.edge].next];
    const Vec2 u = normalized(s.b - s.a), v = normalized(t.b - t.a);
    const double turn = cross(u, v);
    if (!(turn < -1e-9)) return;
    const double d = e.distance, f = whole_[around_[e.edge].next];
    const Vec2 p = s.b + perpendicular(u) * d, q = s.b + perpendicular(v) * f;
    Ring r{s.b, q, p};
    const uint32_t next = around_[e.edge].next;
    // Where both offset lines meet.
    const double along = cross(q - p, v) / turn;
    const Vec2 tip = p + u * along;
    if (length(tip - s.b) <= kMiterLimit * std::max(d, f) && along > 0) {
      r = {s.b, q, tip, p};
      inner_.push_back({{p, tip}, e.edge});
      inner_.push_back({{tip, q}, next});
    } else {
      inner_.push_back({{p, q}, e.edge});
    }
    if (signedArea(r) < 0) std::reverse(r.begin(), r.end());
    shapes.push_back(std::move(r));
  }

  std::vector<std::vector<EdgeOrigin>> stripOrigins(const Region& strips) const {
    EdgeSource input = sourceOf(p_);
    for (const PeelEdge& e : jobs_) input.origins[e.edge].role = EdgeRole::Base;
    EdgeSource moved;
    for (const auto& [segment, edge] : inner_) {
      moved.rings.push_back({segment.a, segment.b});
      for (int k = 0; k < 2; ++k) {
        moved.origins.push_back({edge, EdgeRole::Inner, EdgeOrigin::kNoSide});
      }
    }
    const EdgeSource sources[] = {std::move(input), std::move(moved)};
    return originsOf(strips, sources, {kNoEdge, EdgeRole::Cap, EdgeOrigin::kNoSide});
  }

  const Polygon& p_;
  PeelEnds ends_;
  std::vector<Ring> rings_;
  std::vector<Segment> segments_;
  std::vector<Ends> around_;
  // The distance of edges that move as a whole.
  std::vector<double> whole_;
  std::vector<PeelEdge> jobs_;
  std::vector<std::pair<Segment, uint32_t>> inner_;
};

// A ring of the rest with its runs of Inner edges smoothed; their ends stay.
Ring withSmoothRuns(const Ring& r, std::span<const EdgeOrigin> edges, const Smoothing& s) {
  const size_t n = r.size();
  const auto inner = [&](size_t i) { return edges[i % n].role == EdgeRole::Inner; };
  size_t start = 0;
  while (start < n && inner(start)) ++start;
  if (start == n) {
    const Region whole = smoothed(Polygon{r, {}}, s);
    return whole.size() == 1 ? whole[0].outer : r;
  }
  Ring out;
  for (size_t k = 0; k < n;) {
    work();
    const size_t i = start + k;
    if (!inner(i)) {
      out.push_back(r[i % n]);
      ++k;
      continue;
    }
    std::vector<Vec2> line{r[i % n]};
    for (; k < n && inner(start + k); ++k) line.push_back(r[(start + k + 1) % n]);
    line = smoothed(line, s);
    out.insert(out.end(), line.begin(), line.end() - 1);
  }
  return out;
}

// The same peel with the border between strips and rest smoothed.
PeelResult smoothedPeel(const Polygon& p, std::span<const PeelEdge> edges, const PeelResult& plain,
                        const Smoothing& s) {
  PeelResult out;
  Region taken;
  std::vector<EdgeSource> sources{sourceOf(p)};
  EdgeOrigin border{kNoEdge, EdgeRole::Inner, EdgeOrigin::kNoSide};
  for (const RegionPiece& rest : plain.rest) {
    std::vector<Ring> rings;
    size_t first = 0;
    for (const Ring& r : ringsOf(rest.polygon)) {
      const auto own = std::span(rest.edges).subspan(first, r.size());
      for (const EdgeOrigin& e : own) {
        if (e.role == EdgeRole::Inner && border.source == kNoEdge) border.source = e.source;
      }
      // Holes turn the other way; smoothed alone they would be outlines.
      rings.push_back(signedArea(r) > 0 ? withSmoothRuns(r, own, s) : r);
      first += r.size();
    }
    for (Polygon& inner : subtract(intersect(repaired(rings, FillRule::NonZero), {p}), taken)) {
      RegionPiece piece = rest;
      piece.edges = originsOf(inner, sources, border);
      taken.push_back(inner);
      piece.polygon = std::move(inner);
      piece.part = piece.ix = static_cast<uint32_t>(out.rest.size());
      out.rest.push_back(std::move(piece));
    }
  }
  for (const PeelEdge& e : edges) {
    if (e.edge < sources[0].origins.size()) sources[0].origins[e.edge].role = EdgeRole::Base;
  }
  for (const RegionPiece& r : out.rest) sources.push_back(sourceOf(r));
  const EdgeOrigin cap{kNoEdge, EdgeRole::Cap, EdgeOrigin::kNoSide};
  for (Polygon& strip : subtract({p}, taken)) {
    RegionPiece piece;
    piece.edges = originsOf(strip, sources, cap);
    piece.polygon = std::move(strip);
    piece.part = piece.ix = static_cast<uint32_t>(out.strips.size());
    out.strips.push_back(std::move(piece));
  }
  return out;
}

}  // namespace

PeelResult peel(const Polygon& p, std::span<const PeelEdge> edges, PeelEnds ends,
                const Smoothing& smoothing) {
  PeelResult plain = Peel(p, edges, ends).run();
  if (smoothing.kind == Smoothing::Kind::None) return plain;
  return smoothedPeel(p, edges, plain, smoothing);
}

std::vector<RegionPiece> contract(const Polygon& p, double distance) {
  std::vector<RegionPiece> out;
  if (!(distance > 0)) {
    out.push_back(wholePiece(p));
    return out;
  }
  OffsetOptions options;
  options.miterLimit = kMiterLimit;
  const std::vector<Ring> source = ringsOf(p);
  Region inner = offset({p}, -distance, options);
  // Rounding reaches over the boundary only where the distance is next to nothing.
  if (distance < 16 * kRegionGrid) inner = intersect(inner, {p});
  const std::vector<uint32_t> traced = traceEdges(ringsOf(inner), source, 2 * kTrace, distance);
  size_t next = 0;
  for (Polygon& inset : inner) {
    RegionPiece piece;
    piece.polygon = std::move(inset);
    for (size_t k = edgeCount(piece.polygon); k-- > 0; ++next) {
      // Bevels of long miters come of no edge.
      const EdgeRole role = traced[next] == kNoEdge ? EdgeRole::Cut : EdgeRole::Inner;
      piece.edges.push_back({traced[next], role, EdgeOrigin::kNoSide});
    }
    piece.part = piece.ix = static_cast<uint32_t>(out.size());
    out.push_back(std::move(piece));
  }
  return out;
}

std::vector<RegionPiece> contractTowards(const Polygon& p, double share, Vec2 centre) {
  const double keep = 1 - std::clamp(share, 0.0, 0.9);
  std::vector<Ring> rings = ringsOf(p);
  for (Ring& r : rings) {
    for (Vec2& v : r) v = centre + (v - centre) * keep;
  }
  EdgeSource moved{rings, wholePiece(p).edges};
  for (EdgeOrigin& e : moved.origins) e.role = EdgeRole::Inner;
  const EdgeSource sources[] = {sourceOf(p), std::move(moved)};
  std::vector<RegionPiece> out;
  for (const Polygon& inner : intersect(repaired(rings, FillRule::EvenOdd), {p})) {
    RegionPiece piece;
    piece.polygon = inner;
    piece.edges = originsOf(inner, sources);
    piece.part = piece.ix = static_cast<uint32_t>(out.size());
    out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace gable
