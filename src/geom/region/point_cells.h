// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// PointCells: points that are kept apart. What comes near a kept point becomes that point; the
// first kept one of several. O(1) a point where they lie evenly.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/work.h"
#include "math/cell.h"
#include "math/vec.h"

namespace gable {

class PointCells {
 public:
  PointCells(double tolerance, size_t expected)
      : tolerance_(tolerance),
        // Some times the tolerance: the places near a point then lie in one cell, mostly.
        inverse_(1 / (8 * std::max(tolerance, 1e-12))),
        heads_(std::bit_ceil(2 * expected + 8), kNone) {}

  /// The number of the kept point within the tolerance of p; else p is kept and gets the next one.
  uint32_t snap(Vec2 p) {
    const int64_t x0 = cellIndex((p.x - tolerance_) * inverse_);
    const int64_t x1 = cellIndex((p.x + tolerance_) * inverse_);
    const int64_t y0 = cellIndex((p.y - tolerance_) * inverse_);
    const int64_t y1 = cellIndex((p.y + tolerance_) * inverse_);
    uint32_t best = kNone;
    size_t looks = 1;
    for (int64_t y = y0; y <= y1; ++y) {
      for (int64_t x = x0; x <= x1; ++x) {
        for (uint32_t i = heads_[slot(x, y)]; i != kNone; i = next_[i]) {
          ++looks;
          if (i < best && length(points_[i] - p) <= tolerance_) best = i;
        }
      }
    }
    work(looks);
    if (best != kNone) return best;
    const auto index = static_cast<uint32_t>(points_.size());
    uint32_t& head = heads_[slot(cellIndex(p.x * inverse_), cellIndex(p.y * inverse_))];
    points_.push_back(p);
    next_.push_back(head);
    head = index;
    return index;
  }
  const std::vector<Vec2>& points() const { return points_; }

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  // Distinct cells in one slot only cost time.
  size_t slot(int64_t x, int64_t y) const {
    const uint64_t h = hashCombine(static_cast<uint64_t>(x), static_cast<uint64_t>(y));
    return static_cast<size_t>(h) & (heads_.size() - 1);
  }
  double tolerance_, inverse_;
  std::vector<Vec2> points_;
  // Chains of the points of one slot.
  std::vector<uint32_t> heads_, next_;
};

}  // namespace gable
