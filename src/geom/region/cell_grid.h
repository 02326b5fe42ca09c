// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// CellGrid: square cells over points of an integer grid, about one for each thing that lies in
// them. It finds the cells that a segment passes, with a margin, so that what is near a segment is
// found in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/work.h"

namespace gable {

/// A place on an integer grid; coordinates stay below kMostGrid.
struct GridPoint {
  int64_t x = 0, y = 0;
  bool operator==(const GridPoint&) const = default;
  bool operator<(const GridPoint& o) const { return x != o.x ? x < o.x : y < o.y; }
};
/// So that cross products of doubled differences fit into 64 bits.
constexpr int64_t kMostGrid = int64_t{1} << 28;

/// Twice the area of the triangle o a b; positive where it turns left.
inline int64_t turn(GridPoint o, GridPoint a, GridPoint b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

class CellGrid {
 public:
  /// Over the box of some points, for `count` things.
  CellGrid(GridPoint low, GridPoint high, size_t count) : low_(low) {
    const double area =
        static_cast<double>(high.x - low.x + 1) * static_cast<double>(high.y - low.y + 1);
    const double side = std::sqrt(area / static_cast<double>(std::max<size_t>(count, 1)));
    while (static_cast<double>(int64_t{1} << shift_) < side) ++shift_;
    // A long thin box has no more cells than things.
    const auto cells = [&] {
      return static_cast<double>(((high.x - low.x) >> shift_) + 1) *
             static_cast<double>(((high.y - low.y) >> shift_) + 1);
    };
    while (cells() > 4.0 * static_cast<double>(count) + 64) ++shift_;
    columns_ = ((high.x - low.x) >> shift_) + 1;
    rows_ = ((high.y - low.y) >> shift_) + 1;
  }

  size_t size() const { return static_cast<size_t>(columns_ * rows_); }
  int64_t column(int64_t x) const {
    return std::clamp<int64_t>((x - low_.x) >> shift_, 0, columns_ - 1);
  }
  int64_t row(int64_t y) const { return std::clamp<int64_t>((y - low_.y) >> shift_, 0, rows_ - 1); }
  size_t cell(int64_t column, int64_t row) const {
    return static_cast<size_t>(row * columns_ + column);
  }
  size_t cellOf(GridPoint p) const { return cell(column(p.x), row(p.y)); }
  /// The lowest y of a row.
  int64_t bottom(int64_t row) const { return low_.y + (row << shift_); }

  /// Calls visit(cell) for every cell within `margin` units of the segment, and some near it.
  template <class Visit>
  void along(GridPoint a, GridPoint b, int64_t margin, Visit&& visit) const {
    if (b < a) std::swap(a, b);
    const int64_t first = column(a.x - margin), last = column(b.x + margin);
    const double slope =
        b.x > a.x ? static_cast<double>(b.y - a.y) / static_cast<double>(b.x - a.x) : 0;
    for (int64_t c = first; c <= last; ++c) {
      int64_t y0 = std::min(a.y, b.y), y1 = std::max(a.y, b.y);
      if (b.x > a.x) {
        // The heights at both sides of the column, no farther than the segment reaches.
        const int64_t left = std::clamp(low_.x + (c << shift_) - margin, a.x, b.x);
        const int64_t right = std::clamp(low_.x + ((c + 1) << shift_) + margin, a.x, b.x);
        const double at0 = static_cast<double>(a.y) + slope * static_cast<double>(left - a.x);
        const double at1 = static_cast<double>(a.y) + slope * static_cast<double>(right - a.x);
        y0 = static_cast<int64_t>(std::floor(std::min(at0, at1))) - 1;
        y1 = static_cast<int64_t>(std::floor(std::max(at0, at1))) + 2;
      }
      const int64_t r1 = row(y1 + margin);
      for (int64_t r = row(y0 - margin); r <= r1; ++r) {
        work();
        visit(cell(c, r));
      }
    }
  }

 private:
  GridPoint low_;
  int shift_ = 0;
  int64_t columns_ = 1, rows_ = 1;
};

/// Numbers by cell, in the order in which they were put in.
class CellLists {
 public:
  /// `each(put)` calls put(cell, number) for everything; it is called twice.
  template <class Each>
  CellLists(size_t cells, Each&& each) : starts_(cells + 1, 0) {
    each([&](size_t cell, uint32_t) { ++starts_[cell + 1]; });
    for (size_t c = 0; c < cells; ++c) starts_[c + 1] += starts_[c];
    workMemory(static_cast<uint64_t>(starts_.back()) * sizeof(uint32_t));
    items_.resize(starts_.back());
    std::vector<size_t> next(starts_.begin(), starts_.end() - 1);
    each([&](size_t cell, uint32_t number) { items_[next[cell]++] = number; });
  }
  const uint32_t* begin(size_t cell) const { return items_.data() + starts_[cell]; }
  const uint32_t* end(size_t cell) const { return items_.data() + starts_[cell + 1]; }

 private:
  std::vector<size_t> starts_;
  std::vector<uint32_t> items_;
};

}  // namespace gable
