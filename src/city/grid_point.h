// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The square metre that a place of the plan lies in, for grids over a place (CellGrid).
#pragma once

#include <algorithm>
#include <cmath>

#include "geom/region/cell_grid.h"
#include "math/vec.h"

namespace gable {

/// Of a finite place; beyond a hundred thousand kilometres the last one.
inline GridPoint gridPoint(Vec2 p) {
  constexpr double kMost = 1e8;
  return {static_cast<int64_t>(std::clamp(std::floor(p.x), -kMost, kMost)),
          static_cast<int64_t>(std::clamp(std::floor(p.y), -kMost, kMost))};
}

}  // namespace gable
