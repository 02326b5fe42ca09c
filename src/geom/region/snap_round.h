// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Snap rounding: segments on an integer grid become segments that meet in grid points only. It
// makes plane divisions exact: what two neighbours share, they share to the last bit.
//
// Promises:
//   1. No two pieces cross or overlap; a piece has no point of the result between its ends.
//   2. A piece is no farther than one unit from its segment.
//   3. Equal input gives equal output, whatever the order of equal segments.
// O((n + k) log n) for k crossings, where segments do not crowd in one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/cell_grid.h"

namespace gable {

struct GridSegment {
  GridPoint a, b;
};

struct SnappedPiece {
  /// Points of the result, in the direction of the segment.
  uint32_t from = 0, to = 0;
  /// The segment that it is a part of.
  uint32_t segment = 0;
};

struct Snapped {
  /// Sorted.
  std::vector<GridPoint> points;
  std::vector<SnappedPiece> pieces;
};

Snapped snapRound(std::span<const GridSegment> segments);

}  // namespace gable
