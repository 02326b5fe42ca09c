// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each level halves its items at the median of the direction in which their middles spread most.

#include "runtime/room_tree.h"

#include <algorithm>

#include "base/work.h"

namespace gable {

namespace {

constexpr uint32_t kMostInLeaf = 4;

}  // namespace

RoomTree::RoomTree(std::vector<Box3> boxes, bool byHeight) {
  items_.resize(boxes.size());
  order_.resize(boxes.size());
  for (uint32_t i = 0; i < order_.size(); ++i) {
    items_[i].box = boxes[i];
    order_[i] = i;
  }
  if (!order_.empty()) build(0, static_cast<uint32_t>(order_.size()), 0, byHeight);
}

// Depth is logarithmic.
uint32_t RoomTree::build(uint32_t begin, uint32_t end, uint32_t parent, bool byHeight) {
  work(end - begin);
  const auto number = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({.parent = parent, .begin = begin, .end = end});
  if (end - begin <= kMostInLeaf) {
    for (uint32_t i = begin; i < end; ++i) items_[order_[i]].node = number;
    return number;
  }
  Box3 middles;
  for (uint32_t i = begin; i < end; ++i) middles.include(items_[order_[i]].box.center());
  const Vec3 spread = middles.size();
  const size_t axis = byHeight && spread.y > spread.x && spread.y > spread.z ? 1
                      : spread.x >= spread.z                                 ? 0
                                                                             : 2;
  const uint32_t middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](uint32_t a, uint32_t b) {
                     const double ca = items_[a].box.center()[axis];
                     const double cb = items_[b].box.center()[axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  const uint32_t left = build(begin, middle, number, byHeight);
  const uint32_t right = build(middle, end, number, byHeight);
  nodes_[number].left = left;
  nodes_[number].right = right;
  return number;
}

bool RoomTree::meet(const Box3& a, const Box3& b, bool anyHeight) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.z <= b.max.z && b.min.z <= a.max.z &&
         (anyHeight || (a.min.y <= b.max.y && b.min.y <= a.max.y));
}

void RoomTree::put(uint32_t number, const Box3& box, bool anyHeight) {
  Item& item = items_[number];
  item.box = box;
  item.put = true;
  item.anyHeight = anyHeight;
  for (uint32_t n = item.node;; n = nodes_[n].parent) {
    nodes_[n].box.include(box);
    nodes_[n].anyHeight = nodes_[n].anyHeight || anyHeight;
    if (n == 0) return;
  }
}

}  // namespace gable
