// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Locator: `locate` for many points of one polygon, with the same answers. Built in O(n) for
// outlines that do not run to and fro, a look takes the edges at the point's height.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/work.h"
#include "geom/region/crossing.h"
#include "geom/region/region.h"
#include "geom/region/segment_grid.h"

namespace gable {

class Locator {
 public:
  explicit Locator(const Polygon& p) {
    const std::vector<Segment> edges = edgesOf(p);
    for (const Segment& s : edges) {
      box_.include(s.a);
      box_.include(s.b);
    }
    rows_ = std::clamp<size_t>(edges.size() / 2, 1, 4096);
    const double height = box_.size().y;
    inverse_ = height > 0 ? static_cast<double>(rows_) / height : 0;
    starts_.assign(rows_ + 1, 0);
    const auto forRows = [&](const Segment& s, const auto& put) {
      const size_t last = row(std::max(s.a.y, s.b.y));
      const size_t first = row(std::min(s.a.y, s.b.y));
      work(1 + last - first);
      for (size_t y = first; y <= last; ++y) put(y);
    };
    for (const Segment& s : edges) forRows(s, [&](size_t y) { ++starts_[y + 1]; });
    for (size_t y = 0; y < rows_; ++y) starts_[y + 1] += starts_[y];
    edges_.resize(starts_[rows_]);
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (const Segment& s : edges) forRows(s, [&](size_t y) { edges_[next[y]++] = s; });
  }

  /// True when all points within `slack` of p lie outside; may say false of some such.
  bool surelyOutside(Vec2 p, double slack) const {
    const Vec2 d{slack, slack}, lo = p - d, hi = p + d;
    if (hi.x < box_.min.x || lo.x > box_.max.x || hi.y < box_.min.y || lo.y > box_.max.y) {
      return true;
    }
    const size_t y = row(p.y);
    work(1 + starts_[y + 1] - starts_[y]);
    if (row(lo.y) != y || row(hi.y) != y) return false;
    bool outside = true;
    for (uint32_t k = starts_[y]; k < starts_[y + 1]; ++k) {
      const auto [a, b] = edges_[k];
      if (std::max(a.x, b.x) < lo.x || std::max(a.y, b.y) < lo.y || std::min(a.y, b.y) > hi.y) {
        continue;
      }
      // Its height must be beyond doubt, and on which side of the point it is.
      const bool ends = (a.y >= lo.y && a.y <= hi.y) || (b.y >= lo.y && b.y <= hi.y);
      const double turn = cross(b - a, p - a);
      if (ends || std::fabs(turn) <= 2 * slack * (std::fabs(b.x - a.x) + std::fabs(b.y - a.y))) {
        return false;
      }
      if ((turn > 0) == (b.y > a.y)) outside = !outside;
    }
    return outside;
  }

  Where at(Vec2 p) const {
    if (!box_.contains(p)) return Where::Outside;
    bool inside = false;
    const size_t y = row(p.y);
    work(1 + starts_[y + 1] - starts_[y]);
    for (uint32_t k = starts_[y]; k < starts_[y + 1]; ++k) {
      const Crossing crossing = crossingOf(edges_[k].a, edges_[k].b, p);
      if (crossing == Crossing::Touches) return Where::Boundary;
      if (crossing == Crossing::Crosses) inside = !inside;
    }
    return inside ? Where::Inside : Where::Outside;
  }

 private:
  size_t row(double y) const {
    const double at = (y - box_.min.y) * inverse_;
    return at > 0 ? static_cast<size_t>(std::min(at, static_cast<double>(rows_ - 1))) : 0;
  }
  Box2 box_;
  size_t rows_ = 1;
  double inverse_ = 0;
  std::vector<uint32_t> starts_;
  std::vector<Segment> edges_;
};

}  // namespace gable
