// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "geom/region/along.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/grid_partition.h"
namespace gable {

double Polyline::length() const {
  double sum = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) sum += gable::length(points[i + 1] - points[i]);
  if (closed && points.size() > 1) sum += gable::length(points.front() - points.back());
  return sum;
}

namespace {

constexpr double kJoined = 1e-9;

void addPoint(Polyline& line, Vec2 p) {
  if (line.points.empty() || !(line.points.back() == p)) line.points.push_back(p);
}

// The points of a line, the first again where it is closed.
std::vector<Vec2> opened(const Polyline& line) {
  std::vector<Vec2> out = line.points;
  if (line.closed && !out.empty()) out.push_back(out.front());
  return out;
}

Station at(const std::vector<Vec2>& points, double distance) {
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    work();
    const Vec2 d = points[i + 1] - points[i];
    const double l = length(d);
    if (distance <= l || i + 2 == points.size()) {
      const double t = l > 0 ? std::clamp(distance / l, 0.0, 1.0) : 0;
      return {points[i] + d * t, normalized(d)};
    }
    distance -= l;
  }
  return points.empty() ? Station{} : Station{points[0], {1, 0}};
}

}  // namespace

std::vector<Polyline> runsOf(const Polygon& p, std::span<const EdgePart> parts,
                             std::span<const uint32_t> group) {
  const std::vector<Ring> rings = ringsOf(p);
  std::vector<Polyline> out;
  uint32_t first = 0;
  for (const Ring& r : rings) {
    const auto n = static_cast<uint32_t>(r.size());
    std::vector<Polyline> runs;
    uint32_t last = kNoEdge, lastGroup = 0;
    bool open = false;
    uint32_t firstGroup = 0;
    for (const EdgePart& e : parts) {
      work();
      if (e.edge < first || e.edge >= first + n || !(e.to > e.from)) continue;
      const Vec2 a = r[e.edge - first], b = r[(e.edge - first + 1) % n];
      const uint32_t g = e.edge < group.size() ? group[e.edge] : 0;
      const bool follows = open && last + 1 == e.edge && e.from <= 0 && g == lastGroup;
      if (!follows) runs.emplace_back();
      if (runs.size() == 1 && !follows) firstGroup = g;
      addPoint(runs.back(), e.from <= 0 ? a : a + (b - a) * e.from);
      addPoint(runs.back(), e.to >= 1 ? b : a + (b - a) * e.to);
      last = e.edge;
      lastGroup = g;
      open = e.to >= 1;
    }
    // The run that the ring's start divides is one.
    if (!runs.empty() && open && last == first + n - 1 && runs.front().points.front() == r[0] &&
        firstGroup == lastGroup) {
      if (runs.size() == 1) {
        runs[0].closed = true;
        if (runs[0].points.back() == runs[0].points.front()) runs[0].points.pop_back();
      } else {
        for (const Vec2 q : runs.front().points) addPoint(runs.back(), q);
        runs.front() = std::move(runs.back());
        runs.pop_back();
      }
    }
    out.insert(out.end(), runs.begin(), runs.end());
    first += n;
  }
  return out;
}

std::vector<Station> evenly(const Polyline& line, uint32_t count, bool start, bool end) {
  std::vector<Station> out;
  const std::vector<Vec2> points = opened(line);
  const double whole = line.length();
  if (count == 0 || points.size() < 2) return out;
  for (uint32_t k = 0; k <= count; ++k) {
    work();
    if (k == 0 && !start && !line.closed) continue;
    if (k == count && (!end || line.closed)) continue;
    out.push_back(at(points, whole * k / count));
  }
  return out;
}

std::vector<Station> spaced(const Polyline& line, double spacing) {
  std::vector<Station> out;
  const double whole = line.length();
  const std::vector<Vec2> points = opened(line);
  if (!(spacing > 0) || points.size() < 2) return out;
  const double fits = std::floor(whole / spacing * (1 + 1e-12));
  constexpr double kMost = 100000;
  if (!(fits <= kMost)) return out;
  if (line.closed) {
    const auto n = static_cast<uint32_t>(std::max(1.0, std::round(whole / spacing)));
    return evenly(line, n, true, false);
  }
  const double margin = (whole - fits * spacing) / 2;
  for (double k = 0; k <= fits; ++k) {
    work(points.size());
    out.push_back(at(points, margin + k * spacing));
  }
  return out;
}

Station stationAt(const Polyline& line, double share) {
  return at(opened(line), line.length() * share);
}

Polyline partOf(const Polyline& line, double a, double b) {
  std::vector<Vec2> points = opened(line);
  if (a > b) {
    std::reverse(points.begin(), points.end());
    a = 1 - a;
    b = 1 - b;
  }
  Polyline out;
  const double whole = line.length();
  const double from = whole * std::clamp(a, 0.0, 1.0), to = whole * std::clamp(b, 0.0, 1.0);
  if (points.size() < 2 || !(to > from)) return out;
  addPoint(out, at(points, from).at);
  double run = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    work();
    run += length(points[i + 1] - points[i]);
    if (run > from && run < to) addPoint(out, points[i + 1]);
  }
  addPoint(out, at(points, to).at);
  return out;
}

std::vector<Polyline> parametrise(const Ring& outer, std::span<const uint32_t> logical,
                                  std::span<const LogicalRange> ranges, bool clockwise) {
  const auto n = static_cast<uint32_t>(outer.size());
  std::vector<Polyline> out;
  for (const LogicalRange& range : ranges) {
    // The logical edge as a line: from where it begins, once round.
    Polyline whole;
    uint32_t begin = n;
    for (uint32_t i = 0; i < n; ++i) {
      work();
      if (logical[i] == range.logical && logical[(i + n - 1) % n] != range.logical) begin = i;
    }
    if (begin == n) continue;
    for (uint32_t k = 0, i = begin; k < n && logical[i] == range.logical; ++k, i = (i + 1) % n) {
      work();
      addPoint(whole, outer[i]);
      addPoint(whole, outer[(i + 1) % n]);
    }
    if (clockwise) std::reverse(whole.points.begin(), whole.points.end());
    Polyline part = partOf(whole, range.from, range.to);
    if (part.points.size() < 2) continue;
    if (!out.empty() && length(out.back().points.back() - part.points.front()) < kJoined) {
      for (size_t i = 1; i < part.points.size(); ++i) addPoint(out.back(), part.points[i]);
    } else {
      out.push_back(std::move(part));
    }
  }
  for (Polyline& line : out) {
    if (line.points.size() > 3 && length(line.points.front() - line.points.back()) < kJoined) {
      line.points.pop_back();
      line.closed = true;
    }
  }
  return out;
}

Polyline movedLeft(const Polyline& line, double by) {
  Polyline out = line;
  const size_t n = line.points.size();
  if (n < 2 || by == 0) return out;
  for (size_t i = 0; i < n; ++i) {
    work();
    const bool first = i == 0 && !line.closed, last = i + 1 == n && !line.closed;
    const Vec2 p = line.points[i];
    const Vec2 in = first ? Vec2{} : normalized(p - line.points[(i + n - 1) % n]);
    const Vec2 next = last ? Vec2{} : normalized(line.points[(i + 1) % n] - p);
    const Vec2 u = perpendicular(first ? next : in), v = perpendicular(last ? in : next);
    const Vec2 mid = u + v;
    const double scale = dot(mid, u);
    constexpr double kSharpest = 0.125;  // A miter of four times the distance.
    out.points[i] = scale > kSharpest ? p + mid * (by / scale) : p + u * by;
  }
  return out;
}

std::vector<Polyline> insetLines(const Polyline& line, double by) {
  Polyline moved = movedLeft(line, by);
  const Ring& from = line.points;
  if (!line.closed || by == 0 || from.size() < 3 || !isSimple(from)) return {std::move(moved)};
  bool folds = !isSimple(moved.points);
  for (size_t i = 0, j = from.size() - 1; i < from.size(); j = i++) {
    folds = folds || dot(moved.points[i] - moved.points[j], from[i] - from[j]) < 0;
  }
  if (!folds) return {std::move(moved)};
  const double turn = signedArea(from);
  // To the left of a hole lies what is around it.
  OffsetOptions options;
  options.miterLimit = 4;
  Polygon within{from, {}};
  orient(within);
  std::vector<Polyline> out;
  for (Ring& r : ringsOf(offset({within}, turn > 0 ? -by : by, options))) {
    if (turn < 0) std::reverse(r.begin(), r.end());
    out.emplace_back();
    out.back().points = std::move(r);
    out.back().closed = true;
  }
  return out;
}

namespace {

// The band around an open line.
Region bandOf(std::vector<Vec2> line, double half, const RibbonOptions& o) {
  OffsetOptions options;
  options.miterLimit = 4;
  if (line.size() < 2) return {};
  if (o.ends == RibbonEnds::Square) {
    line[0] = line[0] - normalized(line[1] - line[0]) * half;
    const size_t last = line.size() - 1;
    line[last] = line[last] + normalized(line[last] - line[last - 1]) * half;
  }
  if (o.roundJoins && o.ends == RibbonEnds::Round) {
    options.join = OffsetJoin::Round;
    return thicken(line, half, options);
  }
  std::vector<Ring> parts;
  const auto disc = [&](Vec2 at) { parts.push_back(ringOf({PlanShape::Circle, half, 0, 24}, at)); };
  if (o.roundJoins) {
    for (size_t i = 1; i < line.size(); ++i) {
      work();
      for (const Polygon& p : thicken({line[i - 1], line[i]}, half, options)) {
        parts.push_back(p.outer);
      }
      if (i + 1 < line.size()) disc(line[i]);
    }
  } else {
    parts = ringsOf(thicken(line, half, options));
  }
  if (o.ends == RibbonEnds::Round) {
    disc(line.front());
    disc(line.back());
  }
  return repaired(parts, FillRule::NonZero);
}

}  // namespace

std::vector<RegionPiece> ribbons(const Polygon& p, std::span<const Polyline> lines, double width,
                                 const RibbonOptions& o) {
  std::vector<RegionPiece> out;
  OffsetOptions options;
  options.join = o.roundJoins ? OffsetJoin::Round : OffsetJoin::Miter;
  options.miterLimit = 4;
  for (const Polyline& line : lines) {
    Region band;
    if (line.closed && line.points.size() > 2) {
      const Region area = repaired({line.points}, FillRule::EvenOdd);
      band = subtract(offset(area, width / 2, options), offset(area, -width / 2, options));
    } else {
      band = bandOf(line.points, width / 2, o);
    }
    const EdgeSource sources[] = {sourceOf(p)};
    for (Polygon& b : intersect(band, {p})) {
      RegionPiece piece;
      piece.kind = PieceKind::Path;
      piece.ix = static_cast<uint32_t>(out.size());
      piece.width = line.length();
      piece.height = width;
      if (line.points.size() > 1) piece.axis = normalized(line.points[1] - line.points[0]);
      piece.edges = originsOf(b, sources);
      piece.polygon = std::move(b);
      out.push_back(std::move(piece));
    }
  }
  return out;
}

}  // namespace gable
