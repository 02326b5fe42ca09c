// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Outlines: pieces of one face put together again, as polygons with holes.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/solid/selection.h"

namespace gable::solid {

/// A polygon over vertices: the outer loop first, then its holes.
struct Outline {
  /// The face of the input.
  uint32_t face = 0;
  bool turned = false;
  /// The faces that lie on it besides.
  std::vector<uint32_t> others;
  std::vector<std::vector<uint32_t>> loops;
};

/// Edges between two kept pieces of a face go, unless another face ends there. Where the pieces do
/// not close, false.
bool outlinesOf(const Facets& facets, const std::vector<Piece>& pieces, const Selection& selection,
                std::vector<Outline>& out);

}  // namespace gable::solid
