// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The cells of voronoi.h before paths are taken off them. Plan coordinates, metres.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/voronoi.h"

namespace gable {

/// The source of an edge between two cells is kSite + the index of the other cell's site.
constexpr uint32_t kSite = 0x80000000;

inline bool isBorder(const EdgeOrigin& e) { return e.source >= kSite && e.source != kNoEdge; }

/// What of the region is nearest to each site: `ix` is the site. A cell falls into several pieces
/// where the region is not convex. The sites lie in the region, apart from each other.
std::vector<RegionPiece> voronoiCells(const Polygon& region, std::span<const Disc> sites);

/// Bends the borders between the cells by options.jitter. What two cells would share stays with the
/// first. Returns what no cell has then.
std::vector<RegionPiece> bendBorders(const Polygon& region, std::span<const Disc> sites,
                                     const VoronoiOptions& options,
                                     std::vector<RegionPiece>& cells);

}  // namespace gable
