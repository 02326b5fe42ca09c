// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// RoomTree: boxes that are put into a tree one after the other, and found by what they meet. All
// that may ever come are known beforehand, so the tree is balanced from the start; a node knows the
// box of those that have come. To put one takes O(log n).
#pragma once

#include <cstdint>
#include <vector>

#include "math/box.h"

namespace gable {

class RoomTree {
 public:
  /// Items are numbered as the boxes are. `byHeight`: heights tell some of them apart.
  RoomTree(std::vector<Box3> boxes, bool byHeight);

  /// `box` may be larger than the one given before. `anyHeight`: it meets what is above and below.
  void put(uint32_t item, const Box3& box, bool anyHeight);
  /// Calls visit(item) for those put whose boxes meet this one, until it returns true.
  template <class Visit>
  bool any(const Box3& box, bool anyHeight, Visit&& visit);

 private:
  struct Node {
    /// Of those that were put.
    Box3 box;
    bool anyHeight = false;
    uint32_t parent = 0;
    /// Children, or for a leaf (right == 0) the range of the order.
    uint32_t left = 0, right = 0, begin = 0, end = 0;
  };
  struct Item {
    Box3 box;
    uint32_t node = 0;
    bool put = false, anyHeight = false;
  };
  uint32_t build(uint32_t begin, uint32_t end, uint32_t parent, bool byHeight);
  static bool meet(const Box3& a, const Box3& b, bool anyHeight);

  std::vector<Item> items_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
  /// Reused.
  std::vector<uint32_t> open_;
};

template <class Visit>
bool RoomTree::any(const Box3& box, bool anyHeight, Visit&& visit) {
  open_.clear();
  if (!nodes_.empty()) open_.push_back(0);
  while (!open_.empty()) {
    const Node& n = nodes_[open_.back()];
    open_.pop_back();
    if (n.box.empty() || !meet(n.box, box, anyHeight || n.anyHeight)) continue;
    if (n.right != 0) {
      open_.push_back(n.right);
      open_.push_back(n.left);
      continue;
    }
    for (uint32_t i = n.begin; i < n.end; ++i) {
      const Item& item = items_[order_[i]];
      if (item.put && meet(item.box, box, anyHeight || item.anyHeight) && visit(order_[i])) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace gable
