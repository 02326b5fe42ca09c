// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the bridges from holes to what is around them are looked up in: points of which more and
// more are known, from the nearest on, and segments that grow in number. Both take O(log n) a step
// where points and segments are spread; where they are not, callers of work() can end it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "base/work.h"
#include "geom/region/segment_grid.h"
#include "math/box.h"
#include "math/vec.h"

namespace gable {

/// A k-d tree over all points that there will be. What is known is put in by name; a point can have
/// several names.
class NearestNames {
 public:
  explicit NearestNames(std::vector<Vec2> points);

  /// The point of that number is known, under its number.
  void add(uint32_t point);
  /// A further name of a point that is known by another.
  void addCopy(uint32_t name, uint32_t of);

  /// Calls visit(name) for what is known and does not lie to the left of `from`, the nearest first
  /// and the lower name first where distances are equal, until it returns true.
  template <class Visit>
  void visitFrom(Vec2 from, Visit&& visit) const;

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  // Points order_[begin] to order_[end]; children k and k + 1, or none.
  struct Cell {
    Box2 box;
    uint32_t begin = 0, end = 0, children = kNone, parent = kNone;
    bool known = false;
  };
  // A cell, or a name, at the square of its distance. Cells come first, so that no name nearer or
  // lower is in one that is still closed.
  struct Waiting {
    double distance = 0;
    bool isName = false;
    uint32_t index = 0;
    bool operator>(const Waiting& o) const {
      if (distance != o.distance) return distance > o.distance;
      return isName != o.isName ? isName : index > o.index;
    }
  };
  using Queue = std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>>;
  void put(uint32_t name, uint32_t point);
  void divide(uint32_t cell);
  void open(uint32_t cell, Vec2 from, Queue& queue) const;

  std::vector<Vec2> points_;
  std::vector<uint32_t> order_;
  std::vector<Cell> cells_;
  /// By point: its cell, and the first of its names.
  std::vector<uint32_t> cellOf_, first_;
  /// By name: its point, and the next name of that.
  std::vector<uint32_t> pointOf_, next_;
};

template <class Visit>
void NearestNames::visitFrom(Vec2 from, Visit&& visit) const {
  Queue queue;
  if (!cells_.empty()) open(0, from, queue);
  while (!queue.empty()) {
    work();
    const Waiting nearest = queue.top();
    queue.pop();
    if (!nearest.isName) {
      open(nearest.index, from, queue);
    } else if (visit(nearest.index)) {
      return;
    }
  }
}

/// Segments in grids, each twice as large as the one behind it, and the last few in none.
class GrowingSegments {
 public:
  void add(const Segment& s);

  /// Calls visit(segment) for all that may meet the box, and some others.
  template <class Visit>
  void query(const Box2& box, Visit&& visit) {
    for (Part& part : parts_)
      part.grid.query(box, [&](uint32_t i) { visit(all_[part.begin + i]); });
    work(all_.size() - inParts_);
    for (size_t i = inParts_; i < all_.size(); ++i) visit(all_[i]);
  }

 private:
  struct Part {
    size_t begin = 0, count = 0;
    SegmentGrid grid;
  };
  std::vector<Segment> all_;
  std::vector<Part> parts_;
  size_t inParts_ = 0;
};

}  // namespace gable
