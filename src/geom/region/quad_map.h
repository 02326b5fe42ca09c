// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A region as the image of a square: cells that follow its four sides. Plan coordinates, metres.
//
// Promises: the pieces make up the region; neighbours share the same points; each edge has its
// origin, and the side of the cell that it is. O(cells * n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/piece.h"

namespace gable {

struct QuadMapResult {
  /// Cells row by row, then what the map does not reach.
  std::vector<RegionPiece> pieces;
  /// False when the sides are too bent for a map without folds: the cells are then those of the
  /// quadrilateral of the corners, cut to the region.
  bool curved = false;
};

/// By the Coons patch over the four logical sides.
QuadMapResult quadMap(const Polygon& p, uint32_t nx, uint32_t ny);

}  // namespace gable
