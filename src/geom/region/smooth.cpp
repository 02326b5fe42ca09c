// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/smooth.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/piece.h"
#include "geom/region/places.h"

namespace gable {
namespace {

// A point in a thousand parts of its edge at most.
constexpr double kMostParts = 1000;
constexpr int kArcParts = 8;
// Edges are divided before averaging: no longer than this, nor than a tenth of the outline.
constexpr double kLongest = 6, kLongestShare = 0.1;

// One pass over a ring, or over a line, whose ends then stay.
std::vector<Vec2> averaged(const std::vector<Vec2>& r, double weight, bool closed) {
  std::vector<Vec2> out;
  const double side = (1 - weight) / 2;
  const size_t n = r.size();
  for (size_t i = 0; i < n; ++i) {
    work();
    const bool end = !closed && (i == 0 || i + 1 == n);
    out.push_back(end ? r[i] : (r[(i + n - 1) % n] + r[(i + 1) % n]) * side + r[i] * weight);
  }
  return out;
}

std::vector<Vec2> cornersCut(const std::vector<Vec2>& r, bool closed) {
  std::vector<Vec2> out;
  const size_t n = r.size(), edges = closed ? n : n - 1;
  if (!closed) out.push_back(r[0]);
  for (size_t i = 0; i < edges; ++i) {
    work();
    const Vec2 a = r[i], b = r[(i + 1) % n];
    if (closed || i > 0) out.push_back(a * 0.75 + b * 0.25);
    if (closed || i + 1 < edges) out.push_back(a * 0.25 + b * 0.75);
  }
  if (!closed) out.push_back(r.back());
  return out;
}

std::vector<Vec2> arcs(const std::vector<Vec2>& r, bool closed) {
  std::vector<Vec2> out;
  const size_t n = r.size();
  if (!closed) out.push_back(r[0]);
  for (size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
    work();
    const Vec2 c = r[i], a = (r[(i + n - 1) % n] + c) * 0.5, b = (c + r[(i + 1) % n]) * 0.5;
    for (int k = 0; k <= kArcParts; ++k) {
      work();
      const double t = static_cast<double>(k) / kArcParts, u = 1 - t;
      if (k < kArcParts || !closed) out.push_back(a * (u * u) + c * (2 * u * t) + b * (t * t));
    }
  }
  if (!closed) out.push_back(r.back());
  return out;
}

std::vector<Vec2> bent(const std::vector<Vec2>& r, const Smoothing& s, double whole, bool closed) {
  if (s.kind == Smoothing::Kind::None || r.size() < 3) return r;
  if (s.kind == Smoothing::Kind::Bezier || s.kind == Smoothing::Kind::Round) {
    return arcs(r, closed);
  }
  std::vector<Vec2> out = r;
  const bool average = s.kind == Smoothing::Kind::Average;
  if (average) {
    out = subdivided(r, std::max(std::min(kLongest, kLongestShare * whole), 1e-6), closed);
  }
  for (uint32_t k = 0; k < std::min(s.times, 6u); ++k) {
    out = average ? averaged(out, s.weight, closed) : cornersCut(out, closed);
  }
  return out;
}

}  // namespace

Ring subdivided(const Ring& r, double most, bool closed) {
  Ring out;
  const size_t edges = closed ? r.size() : r.size() - 1;
  for (size_t i = 0; i < edges; ++i) {
    const Vec2 a = r[i], b = r[(i + 1) % r.size()];
    const double n = std::clamp(std::ceil(length(b - a) / most), 1.0, kMostParts);
    reserveWork(out, n);
    for (double k = 0; k < n; ++k) {
      work();
      out.push_back(a + (b - a) * (k / n));
    }
  }
  if (!closed) out.push_back(r.back());
  return out;
}

Region smoothed(const Polygon& p, const Smoothing& s) {
  if (s.kind == Smoothing::Kind::None) return {p};
  if (s.kind == Smoothing::Kind::Round) {
    OffsetOptions round;
    round.join = OffsetJoin::Round;
    return intersect(offset(offset({p}, -s.radius, round), s.radius, round), {p});
  }
  if (isConvex(p)) {
    // It stays convex, and within.
    Region within;
    const Ring ring = bent(p.outer, s, perimeter(p), true);
    if (nestClear({ring}, 2 * kRegionGrid, within)) return within;
  }
  Polygon out{bent(p.outer, s, perimeter(p.outer), true), {}};
  for (const Ring& h : p.holes) out.holes.push_back(bent(h, s, perimeter(h), true));
  return intersect({out}, {p});
}

std::vector<Vec2> smoothed(const std::vector<Vec2>& line, const Smoothing& s) {
  if (line.size() < 3) return line;
  double whole = 0;
  for (size_t i = 1; i < line.size(); ++i) whole += length(line[i] - line[i - 1]);
  return bent(line, s, whole, false);
}

}  // namespace gable
