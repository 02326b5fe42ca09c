// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Half-edges between numbered points. Those that run opposite each other are struck out; the rest
// are followed round: at a point where several leave, the one next in clockwise turn from where the
// way came in bounds the same face. Rings are then nested, and the sum of areas is compared.
#include "geom/region/faces.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/point_cells.h"
#include "math/predicates.h"

namespace gable {
namespace {

struct HalfEdge {
  uint32_t from, to, source;
};

bool lessEnds(const HalfEdge& a, const HalfEdge& b) {
  return a.from != b.from ? a.from < b.from : a.to < b.to;
}

class Faces {
 public:
  Faces(std::span<const Segment> edges, std::span<const Segment> chords, double tolerance)
      : tolerance_(tolerance), cells_(tolerance, 2 * (edges.size() + chords.size())) {
    for (const Segment& s : edges) {
      const Vec2 o = edges[0].a;
      twice_ += cross(s.a - o, s.b - o);
      round_ += length(s.b - s.a);
      add(s, static_cast<uint32_t>(half_.size()));
    }
    chordsFrom_ = static_cast<uint32_t>(edges.size());
    for (const Segment& s : chords) {
      round_ += length(s.b - s.a);
      add(s, static_cast<uint32_t>(half_.size()));
    }
    chordsTo_ = static_cast<uint32_t>(half_.size());
  }

  bool run(std::vector<Face>& out) {
    if (!std::isfinite(round_) || !leadThroughPoints() || !strikeOpposites()) return false;
    std::vector<Ring> rings;
    if (!follow(rings)) return false;
    // A face may touch itself in a point.
    splitAtRepeats(rings);
    const size_t count = rings.size();
    Region region = nest(std::move(rings));
    // Neighbours across a chord share it, so that they are valid one by one only.
    if (chordsFrom_ == chordsTo_ && !isValid(region)) return false;
    std::vector<Face> faces;
    size_t nested = 0;
    double sum = 0;
    for (Polygon& p : region) {
      nested += 1 + p.holes.size();
      sum += area(p);
      if (chordsFrom_ < chordsTo_ && !isValid(p)) return false;
      Face f;
      f.polygon = std::move(p);
      nameEdges(f);
      faces.push_back(std::move(f));
    }
    if (nested != count) return false;
    if (!(std::fabs(sum - twice_ / 2) <= 4 * tolerance_ * round_ + 1e-9 * std::fabs(twice_))) {
      return false;
    }
    out = std::move(faces);
    return true;
  }

 private:
  void add(const Segment& s, uint32_t source) {
    work();
    half_.push_back({cells_.snap(s.a), cells_.snap(s.b), source});
  }

  // Cuts every edge at the points that lie on it; chords get their other half. False when a chord
  // crosses anything.
  bool leadThroughPoints() {
    const std::vector<Vec2>& points = cells_.points();
    std::vector<Segment> segments;
    for (const HalfEdge& h : half_) segments.push_back({points[h.from], points[h.to]});
    SegmentGrid grid(segments);
    struct OnEdge {
      uint32_t edge;
      double along;
      uint32_t point;
    };
    std::vector<OnEdge> found;
    for (uint32_t i = 0; i < points.size(); ++i) {
      const Vec2 p = points[i];
      Box2 box;
      box.include(p - Vec2{tolerance_, tolerance_});
      box.include(p + Vec2{tolerance_, tolerance_});
      grid.query(box, [&](uint32_t e) {
        if (half_[e].from == i || half_[e].to == i) return;
        const Segment& s = segments[e];
        const Vec2 d = s.b - s.a, off = p - s.a;
        const double l2 = dot(d, d), along = dot(off, d), away = cross(d, off);
        if (along <= 0 || along >= l2 || away * away > tolerance_ * tolerance_ * l2) return;
        found.push_back({e, along / l2, i});
      });
    }
    bool crossed = false;
    for (uint32_t c = chordsFrom_; c < chordsTo_ && !crossed; ++c) {
      const Segment& s = segments[c];
      Box2 box;
      box.include(s.a);
      box.include(s.b);
      grid.query(
          box, [&](uint32_t e) { crossed = crossed || segmentsCross(s, segments[e], tolerance_); });
    }
    if (crossed) return false;
    std::sort(found.begin(), found.end(), [](const OnEdge& a, const OnEdge& b) {
      if (a.edge != b.edge) return a.edge < b.edge;
      return a.along != b.along ? a.along < b.along : a.point < b.point;
    });
    std::vector<HalfEdge> cut;
    cut.reserve(half_.size() + found.size());
    size_t next = 0;
    for (uint32_t e = 0; e < half_.size(); ++e) {
      const HalfEdge& h = half_[e];
      const bool chord = e >= chordsFrom_;
      const uint32_t name = chord ? chordsFrom_ + 2 * (e - chordsFrom_) : e;
      uint32_t from = h.from;
      const auto upTo = [&](uint32_t to) {
        if (from == to) return;
        cut.push_back({from, to, name});
        if (chord) cut.push_back({to, from, name + 1});
        from = to;
      };
      for (; next < found.size() && found[next].edge == e; ++next) upTo(found[next].point);
      upTo(h.to);
    }
    half_ = std::move(cut);
    return true;
  }

  // Edges that run opposite each other go, pair by pair: of what is thinner than the tolerance
  // several may run either way. False when two that run the same way are left, and when a chord
  // runs along an edge.
  bool strikeOpposites() {
    std::sort(half_.begin(), half_.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.from != b.from ? a.from < b.from : a.to != b.to ? a.to < b.to : a.source < b.source;
    });
    std::vector<HalfEdge> kept;
    kept.reserve(half_.size());
    for (auto first = half_.begin(); first != half_.end();) {
      work();
      const auto last = std::upper_bound(first, half_.end(), *first, lessEnds);
      const auto against = std::equal_range(half_.begin(), half_.end(),
                                            HalfEdge{first->to, first->from, 0}, lessEnds);
      const auto here = last - first, there = against.second - against.first;
      // Sources ascend, and chords have the highest.
      const bool chord = (last - 1)->source >= chordsFrom_;
      if (here - there > 1 || (chord && here > 1)) return false;
      if (here > there || chord) kept.push_back(*first);
      first = last;
    }
    half_ = std::move(kept);
    return true;
  }

  bool follow(std::vector<Ring>& rings) const {
    const std::vector<Vec2>& points = cells_.points();
    std::vector<uint32_t> first(points.size() + 1, 0);
    for (const HalfEdge& h : half_) ++first[h.from + 1];
    for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<bool> used(half_.size(), false);
    for (uint32_t start = 0; start < half_.size(); ++start) {
      if (used[start]) continue;
      Ring ring;
      uint32_t e = start;
      do {
        used[e] = true;
        const HalfEdge& h = half_[e];
        ring.push_back(points[h.from]);
        const uint32_t lo = first[h.to], hi = first[h.to + 1];
        work(1 + hi - lo);
        uint32_t next = hi;
        for (uint32_t k = lo; k < hi; ++k) {
          if (next == hi ||
              isBefore(points[h.to], points[h.from], points[half_[k].to], points[half_[next].to])) {
            next = k;
          }
        }
        if (next == hi || (used[next] && next != start)) return false;
        e = next;
      } while (e != start);
      if (ring.size() < 3) return false;
      rings.push_back(std::move(ring));
    }
    return true;
  }

  // Turning clockwise around `at` from `back`, `a` comes before `b`; `back` itself comes last.
  static bool isBefore(Vec2 at, Vec2 back, Vec2 a, Vec2 b) {
    // 0: in the half turn to the right of at -> back, 1: straight on, 2: to the left, 3: back.
    const auto quarter = [&](Vec2 p) {
      const int side = orientation(at, back, p);
      if (side != 0) return side < 0 ? 0 : 2;
      return dot(p - at, back - at) < 0 ? 1 : 3;
    };
    const int qa = quarter(a), qb = quarter(b);
    return qa != qb ? qa < qb : orientation(at, a, b) < 0;
  }

  void nameEdges(Face& f) {
    const auto name = [&](const Ring& r) {
      work(4 * r.size());
      for (size_t i = 0; i < r.size(); ++i) {
        const HalfEdge key{cells_.snap(r[i]), cells_.snap(r[i + 1 == r.size() ? 0 : i + 1]), 0};
        f.edges.push_back(std::lower_bound(half_.begin(), half_.end(), key, lessEnds)->source);
      }
    };
    name(f.polygon.outer);
    for (const Ring& h : f.polygon.holes) name(h);
  }

  double tolerance_;
  PointCells cells_;
  std::vector<HalfEdge> half_;
  uint32_t chordsFrom_ = 0, chordsTo_ = 0;
  double twice_ = 0, round_ = 0;
};

}  // namespace

bool segmentsCross(const Segment& s, const Segment& t, double tolerance) {
  const auto divides = [&](const Segment& u, const Segment& v) {
    const Vec2 d = u.b - u.a;
    const double a = cross(d, v.a - u.a), b = cross(d, v.b - u.a);
    const double least = tolerance * length(d);
    return std::fabs(a) > least && std::fabs(b) > least && (a > 0) != (b > 0);
  };
  return divides(s, t) && divides(t, s);
}

bool facesOf(std::span<const Segment> edges, std::span<const Segment> chords, double tolerance,
             std::vector<Face>& out) {
  if (edges.empty()) return false;
  return Faces(edges, chords, tolerance).run(out);
}

}  // namespace gable
