// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The integer cell of a coordinate on a grid of unit cells, for hash grids; coordinates beyond what
// an integer holds share the outermost cells.
#pragma once

#include <cmath>
#include <cstdint>

namespace gable {

inline int64_t cellIndex(double v) {
  constexpr double kMost = 4e18;
  if (!(v > -kMost)) return static_cast<int64_t>(-kMost);
  return static_cast<int64_t>(v < kMost ? std::floor(v) : kMost);
}

}  // namespace gable
