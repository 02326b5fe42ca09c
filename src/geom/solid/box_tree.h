// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// BoxTree: finds the boxes that meet a box. A binary tree, halved along the longest axis of the
// centres. Built in O(n log n).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/work.h"
#include "math/box.h"

namespace gable::solid {

class BoxTree {
 public:
  explicit BoxTree(std::span<const Box3> boxes) : boxes_(boxes.begin(), boxes.end()) {
    order_.resize(boxes_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, static_cast<uint32_t>(order_.size()));
  }

  /// Calls visit(index) for each box that meets `box`, in a fixed order.
  template <class Visit>
  void query(const Box3& box, const Visit& visit) const {
    if (nodes_.empty()) return;
    uint32_t stack[64] = {0};
    uint32_t depth = 1;
    while (depth > 0) {
      work();
      const Node& node = nodes_[stack[--depth]];
      if (!node.box.meets(box)) continue;
      if (node.right == 0) {
        for (uint32_t k = node.first; k < node.last; ++k) {
          if (boxes_[order_[k]].meets(box)) visit(order_[k]);
        }
      } else {
        stack[depth++] = node.right;
        stack[depth++] = static_cast<uint32_t>(&node - nodes_.data()) + 1;
      }
    }
  }

 private:
  static constexpr uint32_t kLeaf = 4;

  struct Node {
    Box3 box;
    uint32_t first = 0, last = 0;
    /// The left child follows its parent; 0 for a leaf.
    uint32_t right = 0;
  };

  void build(uint32_t first, uint32_t last) {
    work(last - first);
    const auto at = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box3 all, centers;
    for (uint32_t k = first; k < last; ++k) {
      all.include(boxes_[order_[k]]);
      centers.include(boxes_[order_[k]].center());
    }
    nodes_[at].box = all;
    nodes_[at].first = first;
    nodes_[at].last = last;
    if (last - first <= kLeaf) return;
    const Vec3 size = centers.size();
    const size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t middle = first + (last - first) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + first, begin + middle, begin + last, [&](uint32_t a, uint32_t b) {
      const double ca = boxes_[a].center()[axis], cb = boxes_[b].center()[axis];
      return ca < cb || (ca == cb && a < b);
    });
    build(first, middle);
    nodes_[at].right = static_cast<uint32_t>(nodes_.size());
    build(middle, last);
  }

  std::vector<Box3> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace gable::solid
