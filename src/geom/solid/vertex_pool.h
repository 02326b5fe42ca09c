// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// VertexPool: points in space that are kept apart. What comes near a kept point becomes that point,
// the nearest of several. O(1) a point where they lie evenly.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/work.h"
#include "math/cell.h"
#include "math/vec.h"

namespace gable::solid {

class VertexPool {
 public:
  VertexPool(double tolerance, size_t expected)
      : tolerance_(tolerance),
        // Some times the tolerance: the places near a point then lie in one cell, mostly.
        inverse_(1 / (8 * tolerance)),
        heads_(std::bit_ceil(2 * expected + 8), kNone) {}

  double tolerance() const { return tolerance_; }
  size_t size() const { return points_.size(); }
  const Vec3& operator[](uint32_t i) const { return points_[i]; }

  /// The number of the kept point nearest to p within the tolerance; else p is kept and gets the
  /// next one.
  uint32_t snap(const Vec3& p) {
    uint32_t best = kNone;
    double least = tolerance_;
    size_t looks = 1;
    const auto look = [&](uint32_t i) {
      ++looks;
      const double d = length(points_[i] - p);
      if (d < least || (d == least && i < best)) {
        least = d;
        best = i;
      }
    };
    forCells(p, [&](size_t slot) {
      for (uint32_t i = heads_[slot]; i != kNone; i = next_[i]) look(i);
    });
    work(looks);
    return best != kNone ? best : keep(p);
  }

 private:
  static constexpr uint32_t kNone = 0xffffffff;

  int64_t cell(double v) const { return cellIndex(v * inverse_); }
  // Distinct cells in one slot only cost time.
  size_t slot(int64_t x, int64_t y, int64_t z) const {
    const uint64_t xy = hashCombine(static_cast<uint64_t>(x), static_cast<uint64_t>(y));
    return static_cast<size_t>(hashCombine(xy, static_cast<uint64_t>(z))) & (heads_.size() - 1);
  }
  template <class Visit>
  void forCells(const Vec3& p, const Visit& visit) const {
    const int64_t x1 = cell(p.x + tolerance_), y1 = cell(p.y + tolerance_);
    const int64_t z1 = cell(p.z + tolerance_);
    for (int64_t z = cell(p.z - tolerance_); z <= z1; ++z) {
      for (int64_t y = cell(p.y - tolerance_); y <= y1; ++y) {
        for (int64_t x = cell(p.x - tolerance_); x <= x1; ++x) visit(slot(x, y, z));
      }
    }
  }
  uint32_t keep(const Vec3& p) {
    const auto index = static_cast<uint32_t>(points_.size());
    uint32_t& head = heads_[slot(cell(p.x), cell(p.y), cell(p.z))];
    points_.push_back(p);
    next_.push_back(head);
    head = index;
    return index;
  }

  double tolerance_, inverse_;
  std::vector<Vec3> points_;
  // Chains of the points of one slot.
  std::vector<uint32_t> heads_, next_;
};

}  // namespace gable::solid
