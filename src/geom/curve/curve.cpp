// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Centripetal parametrisation: C. Yuksel, S. Schaefer, J. Keyser, "Parameterization and
// applications of Catmull-Rom curves", Computer-Aided Design 43 (2011). Each span becomes a Bezier
// cubic, which is divided uniformly by the bound of G. Wang (1984): n pieces of a cubic whose
// second differences are at most M stay within 3/4 M / n^2 of it.
#include "geom/curve/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/work.h"
#include "math/trig.h"

namespace gable {

namespace {

constexpr size_t kMostStations = 100000;

bool isPlace(Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }

Line withoutRepeats(std::span<const Vec2> points, bool closed) {
  Line out;
  for (const Vec2 p : points) {
    if (isPlace(p) && (out.empty() || !(out.back() == p))) out.push_back(p);
  }
  while (closed && out.size() > 1 && out.back() == out.front()) out.pop_back();
  return out;
}

uint32_t piecesFor(double secondDifference, double tolerance) {
  const double n = std::sqrt(0.75 * secondDifference / std::max(tolerance, 1e-6));
  return static_cast<uint32_t>(std::clamp(std::ceil(n), 1.0, double{kMostPieces}));
}

using Cubic = std::array<Vec2, 4>;

Vec2 pointOf(const Cubic& b, double t) {
  const double u = 1 - t;
  return b[0] * (u * u * u) + b[1] * (3 * u * u * t) + b[2] * (3 * u * t * t) + b[3] * (t * t * t);
}

// All points of a cubic but its first.
void append(const Cubic& b, double tolerance, Line& out) {
  const double bend = std::max(length(b[0] - b[1] * 2 + b[2]), length(b[1] - b[2] * 2 + b[3]));
  const uint32_t n = piecesFor(bend, tolerance);
  work(n);
  workMemory(n * sizeof(Vec2));
  for (uint32_t i = 1; i < n; ++i) out.push_back(pointOf(b, static_cast<double>(i) / n));
  out.push_back(b[3]);
}

// The span from b to c of a centripetal curve that comes from a and goes on to d.
Cubic spanOf(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto knot = [](Vec2 p, Vec2 q) { return std::sqrt(length(q - p)); };
  const double t1 = knot(b, c), t0 = knot(a, b) > 0 ? knot(a, b) : t1,
               t2 = knot(c, d) > 0 ? knot(c, d) : t1;
  const auto slope = [](Vec2 p, Vec2 q, Vec2 r, double before, double after) {
    return (q - p) * (1 / before) - (r - p) * (1 / (before + after)) + (r - q) * (1 / after);
  };
  const Vec2 atB = slope(a, b, c, t0, t1) * t1, atC = slope(b, c, d, t1, t2) * t1;
  return {b, b + atB * (1.0 / 3), c - atC * (1.0 / 3), c};
}

}  // namespace

Line catmullRom(std::span<const Vec2> points, bool closed, double tolerance) {
  const Line p = withoutRepeats(points, closed);
  if (p.size() < 3) return p;
  const size_t n = p.size(), spans = closed ? n : n - 1;
  Line out{p[0]};
  for (size_t i = 0; i < spans; ++i) {
    const Vec2 b = p[i], c = p[(i + 1) % n];
    // Beyond the ends of an open curve the line goes straight on.
    const Vec2 a = i > 0 ? p[i - 1] : closed ? p[n - 1] : b + (b - c);
    const Vec2 d = i + 2 < n ? p[i + 2] : closed ? p[(i + 2) % n] : c + (c - b);
    append(spanOf(a, b, c, d), tolerance, out);
  }
  if (closed) out.pop_back();
  return out;
}

Line bezier(std::span<const Vec2> controls, double tolerance) {
  Line out;
  if (controls.empty() || !std::all_of(controls.begin(), controls.end(), isPlace)) return out;
  out.push_back(controls[0]);
  for (size_t i = 0; i + 3 < controls.size(); i += 3) {
    append({controls[i], controls[i + 1], controls[i + 2], controls[i + 3]}, tolerance, out);
  }
  return out;
}

Line arc(Vec2 center, double radius, double fromDegrees, double toDegrees, double tolerance) {
  const double turn = toDegrees - fromDegrees;
  if (!isPlace(center) || !std::isfinite(radius) || !std::isfinite(turn)) return {};
  // The height of a chord over a small angle a is r a^2 / 8.
  const double angle = toRadians(std::fabs(turn));
  const double wanted = angle * std::sqrt(std::fabs(radius) / (8 * std::max(tolerance, 1e-6)));
  const double n =
      std::clamp(std::ceil(wanted), std::ceil(std::fabs(turn) / 90 + 1e-9), double{kMostPieces});
  Line out;
  work(static_cast<size_t>(8 * n));
  for (double i = 0; i <= n; ++i) {
    const double a = fromDegrees + turn * (i / n);
    out.push_back(center + Vec2{cosDeg(a), sinDeg(a)} * radius);
  }
  return out;
}

// D. Douglas, T. Peucker (1973), on a stack.
Line simplified(const Line& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<size_t, size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    work(1 + to - from);
    const Vec2 a = line[from], d = line[to] - a;
    double worst = tolerance;
    size_t at = from;
    for (size_t i = from + 1; i < to; ++i) {
      const double t = dot(d, d) > 0 ? std::clamp(dot(line[i] - a, d) / dot(d, d), 0.0, 1.0) : 0;
      const double off = length(line[i] - (a + d * t));
      if (off > worst) {
        worst = off;
        at = i;
      }
    }
    if (at == from) continue;
    kept[at] = true;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
  Line out;
  for (size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) out.push_back(line[i]);
  }
  return out;
}

Path::Path(std::span<const Vec2> line, bool closed)
    : points_(withoutRepeats(line, closed)), closed_(closed && points_.size() > 2) {
  work(points_.size());
  double sum = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    if (i > 0) sum += gable::length(points_[i] - points_[i - 1]);
    lengths_.push_back(sum);
  }
  if (closed_) lengths_.push_back(sum + gable::length(points_.front() - points_.back()));
}

Path::Place Path::at(double s) const {
  if (points_.empty()) return {};
  if (points_.size() == 1) return {points_[0], {1, 0}};
  const double whole = length();
  if (closed_) s -= std::floor(s / whole) * whole;
  s = std::clamp(s, 0.0, whole);
  const size_t n = points_.size(), segments = lengths_.size() - 1;
  const auto after = std::upper_bound(lengths_.begin(), lengths_.end(), s);
  const size_t i = std::min(
      static_cast<size_t>(std::max<std::ptrdiff_t>(after - lengths_.begin() - 1, 0)), segments - 1);
  const auto along = [&](size_t k) { return normalized(points_[(k + 1) % n] - points_[k % n]); };
  const double part = s - lengths_[i];
  const double whole1 = lengths_[i + 1] - lengths_[i];
  Place place{points_[i] + (points_[(i + 1) % n] - points_[i]) * (whole1 > 0 ? part / whole1 : 0),
              along(i)};
  if (part == 0 && (i > 0 || closed_)) {
    const Vec2 mean = normalized(along(i > 0 ? i - 1 : segments - 1) + place.tangent);
    if (!(mean == Vec2{})) place.tangent = mean;
  }
  return place;
}

double Path::nearest(Vec2 p) const {
  work(lengths_.size());
  double best = HUGE_VAL, where = 0;
  for (size_t i = 0; i + 1 < lengths_.size(); ++i) {
    const Vec2 a = points_[i], d = points_[(i + 1) % points_.size()] - a;
    const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    const double distance = gable::length(p - (a + d * t));
    if (distance < best) {
      best = distance;
      where = lengths_[i] + t * (lengths_[i + 1] - lengths_[i]);
    }
  }
  return where;
}

std::vector<double> stations(double length, const Spacing& spacing) {
  std::vector<double> out;
  const double room = length - spacing.startInset - spacing.endInset;
  if (!(room >= 0) || !(spacing.step > 0) || !std::isfinite(room)) return out;
  // Room that a whole number of steps fills up to rounding holds them all.
  double count = std::floor(room / spacing.step + 1e-9);
  double step = spacing.step, start = spacing.startInset;
  if (spacing.stretch) {
    count = std::max(1.0, std::nearbyint(room / spacing.step));
    step = room / count;
  } else if (spacing.centred) {
    start += std::max(0.0, room - count * step) / 2;
  }
  count = std::min(count, static_cast<double>(kMostStations - 1));
  work(static_cast<size_t>(count));
  for (double i = 0; i <= count; ++i) out.push_back(start + i * step);
  return out;
}

}  // namespace gable
