// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The paths between the areas that voronoi.h makes of cells. Plan coordinates, metres.
#pragma once

#include <vector>

#include "geom/region/voronoi.h"

namespace gable {

/// What of the region is not `taken`, as sections and junctions. `cells` meet at the junctions;
/// `areas` are what is left of them, by the same `ix`.
std::vector<RegionPiece> voronoiPaths(const Polygon& region, const VoronoiOptions& options,
                                      const Region& taken, const std::vector<RegionPiece>& cells,
                                      const std::vector<RegionPiece>& areas);

}  // namespace gable
