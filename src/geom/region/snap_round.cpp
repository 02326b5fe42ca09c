// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Hobby, "Practical segment intersection with finite precision output" (1999): every end and every
// crossing makes the unit square around its grid point hot, and each segment is led through the
// middle of all hot squares that it passes. Squares hold their left and lower sides only, so that
// they tile the plane; then no two pieces cross. All signs are exact in 64 bits, crossings in 128.
#include "geom/region/snap_round.h"

#include <algorithm>

namespace gable {
namespace {

__extension__ using Wide = __int128;

// The quotient, rounded to the nearest; halves upwards. The divisor is positive.
int64_t rounded(Wide dividend, Wide divisor) {
  const Wide twice = 2 * dividend + divisor, by = 2 * divisor;
  Wide q = twice / by;
  if (q * by > twice) --q;
  return static_cast<int64_t>(q);
}

// Where the insides of both segments cross, as the nearest grid point.
bool crossingOf(const GridSegment& s, const GridSegment& t, GridPoint& at) {
  const int64_t c = turn(s.a, s.b, t.a), d = turn(s.a, s.b, t.b);
  if ((c <= 0 && d <= 0) || (c >= 0 && d >= 0)) return false;
  const int64_t e = turn(t.a, t.b, s.a), f = turn(t.a, t.b, s.b);
  if ((e <= 0 && f <= 0) || (e >= 0 && f >= 0)) return false;
  // The share of s is e / (e - f).
  Wide num = e, den = static_cast<Wide>(e) - f;
  if (den < 0) {
    num = -num;
    den = -den;
  }
  at = {s.a.x + rounded(num * (s.b.x - s.a.x), den), s.a.y + rounded(num * (s.b.y - s.a.y), den)};
  return true;
}

int signOf(int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

// Whether a segment passes the square around p, whose right and upper sides are not part of it:
// those corners count as a trifle nearer to the middle.
bool passes(const GridSegment& s, GridPoint p) {
  if (2 * std::max(s.a.x, s.b.x) < 2 * p.x - 1 || 2 * std::min(s.a.x, s.b.x) >= 2 * p.x + 1 ||
      2 * std::max(s.a.y, s.b.y) < 2 * p.y - 1 || 2 * std::min(s.a.y, s.b.y) >= 2 * p.y + 1) {
    return false;
  }
  const int64_t dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  bool left = false, right = false;
  for (const int right_ : {0, 1}) {
    for (const int upper : {0, 1}) {
      const int64_t cx = 2 * (p.x - s.a.x) + (right_ ? 1 : -1);
      const int64_t cy = 2 * (p.y - s.a.y) + (upper ? 1 : -1);
      int sign = signOf(dx * cy - dy * cx);
      if (sign == 0) sign = signOf((right_ ? dy : 0) - (upper ? dx : 0));
      if (sign == 0) return true;
      (sign > 0 ? left : right) = true;
    }
  }
  return left && right;
}

void addCrossings(std::span<const GridSegment> segments, const CellGrid& grid,
                  std::vector<GridPoint>& points) {
  const CellLists lists(grid.size(), [&](const auto& put) {
    for (uint32_t i = 0; i < segments.size(); ++i) {
      grid.along(segments[i].a, segments[i].b, 0, [&](size_t cell) { put(cell, i); });
    }
  });
  for (size_t cell = 0; cell < grid.size(); ++cell) {
    for (const uint32_t* i = lists.begin(cell); i != lists.end(cell); ++i) {
      const GridSegment& s = segments[*i];
      work(static_cast<size_t>(lists.end(cell) - i));
      for (const uint32_t* k = i + 1; k != lists.end(cell); ++k) {
        GridPoint at;
        // Pairs that share several cells are found in each; points are told apart later.
        if (crossingOf(s, segments[*k], at)) points.push_back(at);
      }
    }
  }
}

}  // namespace

Snapped snapRound(std::span<const GridSegment> segments) {
  Snapped out;
  if (segments.empty()) return out;
  GridPoint low = segments[0].a, high = low;
  for (const GridSegment& s : segments) {
    for (const GridPoint p : {s.a, s.b}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      out.points.push_back(p);
    }
  }
  const CellGrid grid(low, high, segments.size());
  addCrossings(segments, grid, out.points);
  std::sort(out.points.begin(), out.points.end());
  out.points.erase(std::unique(out.points.begin(), out.points.end()), out.points.end());

  const CellLists hot(grid.size(), [&](const auto& put) {
    for (uint32_t p = 0; p < out.points.size(); ++p) put(grid.cellOf(out.points[p]), p);
  });
  struct Passed {
    int64_t along;
    uint32_t point;
  };
  std::vector<Passed> passed;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const GridSegment& s = segments[i];
    passed.clear();
    grid.along(s.a, s.b, 1, [&](size_t cell) {
      work(1 + static_cast<size_t>(hot.end(cell) - hot.begin(cell)));
      for (const uint32_t* p = hot.begin(cell); p != hot.end(cell); ++p) {
        const GridPoint at = out.points[*p];
        if (!passes(s, at)) continue;
        const int64_t along = (at.x - s.a.x) * (s.b.x - s.a.x) + (at.y - s.a.y) * (s.b.y - s.a.y);
        passed.push_back({along, *p});
      }
    });
    std::sort(passed.begin(), passed.end(), [](const Passed& a, const Passed& b) {
      return a.along != b.along ? a.along < b.along : a.point < b.point;
    });
    for (size_t k = 1; k < passed.size(); ++k) {
      if (passed[k].point == passed[k - 1].point) continue;
      out.pieces.push_back({passed[k - 1].point, passed[k].point, i});
    }
  }
  return out;
}

}  // namespace gable
