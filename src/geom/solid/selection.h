// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selection: which pieces of an arrangement bound the result of a boolean.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/solid/boolean.h"
#include "geom/solid/cells.h"

namespace gable::solid {

struct Kept {
  uint32_t piece = 0;
  /// It bounds the result from its other side.
  bool turned = false;
  /// The other pieces that lie on it.
  std::vector<uint32_t> others;
};

struct Selection {
  std::vector<Kept> kept;
  /// All that the operands consist of is closed, so the result must be.
  bool closed = false;
  /// The edges at which several operands meet, as edgeKey, in ascending order.
  std::vector<uint64_t> cuts;
};

Selection select(const Facets& facets, const Splits& splits, const std::vector<Piece>& pieces,
                 SolidOp op);

}  // namespace gable::solid
