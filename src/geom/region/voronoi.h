// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Voronoi cells of a region, with paths between them, and the smoothing of outlines. Plan
// coordinates, metres.
//
// Promises:
//   1. The pieces make up the region; a cell is one piece and holds its site (orphans are merged or
//      named).
//   2. Smoothed outlines stay within their cell.
//   3. Every edge has its origin; Kept edges lie on the input's boundary.
//   4. Paths are sections along borders of cells and junctions where three cells, or two cells and
//      the region's boundary, meet.
// O(k * n log n) for k sites that lie evenly.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/piece.h"
#include "geom/region/places.h"
#include "geom/region/smooth.h"

namespace gable {

/// A part of a cell that its site is not in: goes to the neighbour with the longest border, is a
/// cell of its own, or becomes path.
enum class Orphans : uint8_t { Merge, Own, Path };

struct VoronoiOptions {
  double pathWidth = 0;
  /// Half a path along the region's own boundary as well.
  bool borderPath = true;
  Orphans orphans = Orphans::Merge;
  Smoothing smoothing;
  /// Borders between cells are bent by up to this many metres, the same on both sides.
  double jitter = 0;
  uint64_t seed = 0;
  /// Discs at the sites, by their radius, are cut out and given out as remainders.
  bool centres = false;
};

struct VoronoiResult {
  /// Cells in the order of their sites (ix; iy counts the cells to cross to the boundary), then
  /// paths (cells, sections and junctions of their kinds), then the discs at the sites.
  std::vector<RegionPiece> pieces;
  /// Of the sites given those that lie in the region and apart from others.
  std::vector<Disc> sites;
};

/// No sites: no pieces.
VoronoiResult voronoiPartition(const Polygon& p, std::span<const Disc> sites,
                               const VoronoiOptions& options);

}  // namespace gable
