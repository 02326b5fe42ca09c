// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/outline.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/clean.h"
#include "math/noise.h"

namespace gable {

namespace {

// Six points a wave follow it well enough to look smooth once corners are cut.
constexpr double kPointsPerWave = 6;

double piecesOf(Vec2 a, Vec2 b, double step) {
  return std::max(1.0, std::ceil(length(b - a) / step));
}

Ring divided(const Ring& r, double step) {
  Ring out;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 a = r[i], b = r[(i + 1) % r.size()];
    const double n = piecesOf(a, b, step);
    workMemory(static_cast<uint64_t>(std::min(n, 1e15)) * sizeof(Vec2));
    for (double k = 0; k < n; ++k) {
      work();
      out.push_back(a + (b - a) * (k / n));
    }
  }
  return out;
}

// Every point goes along the outward normal of its two edges.
Ring moved(const Ring& r, double amount, double wavelength, uint64_t address) {
  Ring out;
  const size_t n = r.size();
  for (size_t i = 0; i < n; ++i) {
    work(8);
    const Vec2 along = normalized(r[(i + 1) % n] - r[i]) + normalized(r[i] - r[(i + n - 1) % n]);
    const Vec2 outward = normalized(Vec2{along.y, -along.x});
    out.push_back(r[i] + outward * (amount * fractalNoise(r[i] * (1 / wavelength), 2, address)));
  }
  return out;
}

// Where the edges before and after edge i meet beyond it; false when that is too far away.
bool meetingBeyond(const Ring& r, size_t i, double reach, Vec2& out) {
  const size_t n = r.size();
  const Vec2 a = r[i], b = r[(i + 1) % n];
  const Vec2 d = normalized(a - r[(i + n - 1) % n]), e = normalized(r[(i + 2) % n] - b);
  const double turn = cross(d, e);
  if (!(turn > 0)) return false;
  const double along = cross(b - a, e) / turn;
  out = a + d * along;
  return along <= reach && length(out - b) <= reach;
}

}  // namespace

Ring withoutShortEdges(Ring convex, double shortest) {
  while (convex.size() > 3) {
    double least = shortest;
    size_t edge = convex.size();
    Vec2 corner;
    for (size_t i = 0; i < convex.size(); ++i) {
      work();
      const double l = length(convex[(i + 1) % convex.size()] - convex[i]);
      Vec2 p;
      if (l >= least || !meetingBeyond(convex, i, shortest, p)) continue;
      least = l;
      edge = i;
      corner = p;
    }
    if (edge == convex.size()) break;
    convex[edge] = corner;
    convex.erase(convex.begin() + static_cast<std::ptrdiff_t>((edge + 1) % convex.size()));
  }
  return convex;
}

Region bandAround(const Region& r, double from, double to, OffsetJoin join) {
  OffsetOptions options;
  options.join = join;
  const double inner = std::min(from, to), outer = std::max(from, to);
  return subtract(offset(r, outer, options), offset(r, inner, options));
}

double roughenedSize(const Polygon& p, double wavelength) {
  const double step = wavelength / kPointsPerWave;
  double count = 0;
  for (const Ring& r : ringsOf({p})) {
    for (size_t i = 0; i < r.size(); ++i) count += piecesOf(r[i], r[(i + 1) % r.size()], step);
  }
  return count;
}

Region roughened(const Polygon& p, double amount, double wavelength, uint64_t address) {
  std::vector<Ring> rings;
  for (const Ring& r : ringsOf({p})) {
    rings.push_back(moved(divided(r, wavelength / kPointsPerWave), amount, wavelength, address));
  }
  return repaired(rings, FillRule::Positive);
}

}  // namespace gable
