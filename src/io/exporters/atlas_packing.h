// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rectangles into one: shelves from the top, each as high as its first rectangle, the highest
// first.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gable {

struct PackedSize {
  uint32_t width = 0, height = 0;
};

struct Packing {
  uint32_t width = 0, height = 0;
  struct Place {
    uint32_t x = 0, y = 0;
  };
  /// By rectangle; none for those without room.
  std::vector<std::optional<Place>> places;
};

/// The smallest sheet with sides of powers of two that takes all, or that of `side` by `side` with
/// what it takes. O(n^2) at worst.
Packing pack(const std::vector<PackedSize>& sizes, uint32_t side);

}  // namespace gable
