// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SegmentGrid: finds the segments near a box. A uniform grid of about one cell a segment; built in
// O(n + cells covered), a query visits the cells of its box. Results come in a fixed order that is
// not ascending. Not for use by two threads at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/work.h"
#include "geom/region/region.h"
#include "math/box.h"
#include "math/vec.h"

namespace gable {

struct Segment {
  Vec2 a, b;
};

/// All edges of rings, concatenated ring by ring; edge i of a ring runs from vertex i to the next.
std::vector<Segment> edgesOf(const std::vector<Ring>& rings);
std::vector<Segment> edgesOf(const Polygon& p);

/// Distance from a point to a closed segment.
double distanceTo(const Segment& s, Vec2 p);

class SegmentGrid {
 public:
  explicit SegmentGrid(std::span<const Segment> segments);

  /// Calls visit(index) once for each segment that may meet `box`, and for some others near it.
  template <class Visit>
  void query(const Box2& box, Visit&& visit) {
    if (nx_ == 0) return;
    ++stamp_;
    const int x0 = column(box.min.x), x1 = column(box.max.x);
    const int y0 = row(box.min.y), y1 = row(box.max.y);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const size_t c = cell(x, y);
        work(1 + starts_[c + 1] - starts_[c]);
        for (uint32_t k = starts_[c]; k < starts_[c + 1]; ++k) {
          const uint32_t i = items_[k];
          if (seen_[i] == stamp_) continue;
          seen_[i] = stamp_;
          visit(i);
        }
      }
    }
  }

 private:
  int column(double x) const { return clampCell((x - origin_.x) * inverse_.x, nx_); }
  int row(double y) const { return clampCell((y - origin_.y) * inverse_.y, ny_); }
  static int clampCell(double v, int n) {
    if (!(v > 0)) return 0;
    return v >= n ? n - 1 : static_cast<int>(v);
  }
  size_t cell(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(nx_) + static_cast<size_t>(x);
  }
  template <class Put>
  void rasterize(const Segment& s, Put&& put) const;

  Vec2 origin_, inverse_;
  int nx_ = 0, ny_ = 0;
  std::vector<uint32_t> starts_, items_, seen_;
  uint32_t stamp_ = 0;
};

}  // namespace gable
