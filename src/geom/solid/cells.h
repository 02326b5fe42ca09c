// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Cells: the pieces into which the edges within a facet divide it.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/solid/splits.h"

namespace gable::solid {

/// A piece of a facet. Its edges have it on their left, seen against the facet's normal; none of
/// them is met twice.
struct Piece {
  uint32_t facet = 0;
  /// How often the facet's outline runs around it; negative where it runs the other way.
  int turns = 1;
  std::vector<Edge> edges;
};

/// Appends the pieces of a facet, whose edges meet at their ends only. O(n log n), and a pass over
/// all edges for each part that hangs together with no other.
void addPieces(const Facets& facets, uint32_t facet, const FacetEdges& edges,
               std::vector<Piece>& out);

}  // namespace gable::solid
