// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Disjoint sets of numbers: which of them were joined, directly or through others. Paths are halved
// on the way (R. E. Tarjan and J. van Leeuwen, 1984).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gable {

class DisjointSets {
 public:
  /// Each of 0 to n - 1 alone.
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The smallest number of the set.
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// The next number, alone.
  void addOne() { parent_.push_back(static_cast<uint32_t>(parent_.size())); }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace gable
