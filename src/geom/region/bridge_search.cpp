// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/bridge_search.h"

namespace gable {

namespace {

constexpr uint32_t kMostInCell = 8;
constexpr size_t kMostInList = 64;

// At most the rounded square of the distance to any point of the box: differences, squares and sums
// of doubles keep their order when they are rounded.
double squareOfDistance(const Box2& box, Vec2 from) {
  const Vec2 d{std::max({box.min.x - from.x, from.x - box.max.x, 0.0}),
               std::max({box.min.y - from.y, from.y - box.max.y, 0.0})};
  return dot(d, d);
}

}  // namespace

NearestNames::NearestNames(std::vector<Vec2> points)
    : points_(std::move(points)),
      order_(points_.size()),
      cellOf_(points_.size()),
      first_(points_.size(), kNone),
      pointOf_(points_.size(), kNone),
      next_(points_.size(), kNone) {
  if (points_.empty()) return;
  for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  cells_.push_back({{}, 0, static_cast<uint32_t>(order_.size()), kNone, kNone, false});
  // Children are put behind, so the list is its own queue.
  for (uint32_t cell = 0; cell < cells_.size(); ++cell) divide(cell);
}

void NearestNames::divide(uint32_t cell) {
  Cell& c = cells_[cell];
  work(c.end - c.begin);
  for (uint32_t i = c.begin; i < c.end; ++i) {
    c.box.include(points_[order_[i]]);
    cellOf_[order_[i]] = cell;
  }
  if (c.end - c.begin <= kMostInCell) return;
  const Vec2 size = c.box.size();
  const size_t axis = size.x >= size.y ? 0 : 1;
  const uint32_t middle = c.begin + (c.end - c.begin) / 2;
  std::nth_element(order_.begin() + c.begin, order_.begin() + middle, order_.begin() + c.end,
                   [&](uint32_t a, uint32_t b) {
                     const double p = axis == 0 ? points_[a].x : points_[a].y;
                     const double q = axis == 0 ? points_[b].x : points_[b].y;
                     return p != q ? p < q : a < b;
                   });
  c.children = static_cast<uint32_t>(cells_.size());
  const uint32_t begin = c.begin, end = c.end;
  cells_.push_back({{}, begin, middle, kNone, cell, false});
  cells_.push_back({{}, middle, end, kNone, cell, false});
}

void NearestNames::add(uint32_t point) { put(point, point); }

void NearestNames::addCopy(uint32_t name, uint32_t of) { put(name, pointOf_[of]); }

void NearestNames::put(uint32_t name, uint32_t point) {
  if (name >= next_.size()) {
    next_.resize(name + size_t{1}, kNone);
    pointOf_.resize(name + size_t{1}, kNone);
  }
  pointOf_[name] = point;
  next_[name] = first_[point];
  first_[point] = name;
  for (uint32_t c = cellOf_[point]; c != kNone && !cells_[c].known; c = cells_[c].parent) {
    cells_[c].known = true;
  }
}

void NearestNames::open(uint32_t cell, Vec2 from, Queue& queue) const {
  const Cell& c = cells_[cell];
  if (c.children != kNone) {
    for (const uint32_t child : {c.children, c.children + 1}) {
      const Box2& box = cells_[child].box;
      if (!cells_[child].known || box.max.x < from.x) continue;
      queue.push({squareOfDistance(box, from), false, child});
    }
    return;
  }
  for (uint32_t i = c.begin; i < c.end; ++i) {
    const Vec2 d = points_[order_[i]] - from;
    if (!(d.x >= 0)) continue;
    for (uint32_t name = first_[order_[i]]; name != kNone; name = next_[name]) {
      work();
      queue.push({dot(d, d), true, name});
    }
  }
}

void GrowingSegments::add(const Segment& s) {
  all_.push_back(s);
  if (all_.size() - inParts_ < kMostInList) return;
  size_t begin = inParts_;
  while (!parts_.empty() && parts_.back().count <= all_.size() - begin) {
    begin = parts_.back().begin;
    parts_.pop_back();
  }
  inParts_ = all_.size();
  const size_t count = all_.size() - begin;
  parts_.push_back({begin, count, SegmentGrid(std::span(all_).subspan(begin, count))});
}

}  // namespace gable
