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
// O(k^2 + k * n log n) for k sites.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/piece.h"
#include "geom/region/places.h"

namespace gable {

struct Smoothing {
  enum class Kind : uint8_t { None, Average, Chaikin, Round } kind = Kind::None;
  /// Average and Chaikin: how often.
  uint32_t times = 2;
  /// Average: what a vertex keeps of itself.
  double weight = 1.0 / 3;
  /// Round: the radius.
  double radius = 0;
};

/// The smoothed outline within `p`; several where it falls apart, empty where nothing is left.
Region smoothed(const Polygon& p, const Smoothing& s);

/// A part of a cell that its site is not in: goes to the neighbour with the longest border, is a
/// cell of its own, or becomes path.
enum class Orphans : uint8_t { Merge, Own, Path };

struct VoronoiOptions {
  double pathWidth = 0;
  /// Half a path along the region's own boundary as well.
  bool borderPath = true;
  Orphans orphans = Orphans::Merge;
  Smoothing smoothing;
  /// Discs at the sites, by their radius, are cut out and given out as junctions.
  bool centres = false;
};

struct VoronoiResult {
  /// Cells in the order of their sites (ix), then paths, then junctions.
  std::vector<RegionPiece> pieces;
  /// Of the sites given those that lie in the region and apart from others.
  std::vector<Disc> sites;
};

/// No sites: no pieces.
VoronoiResult voronoiPartition(const Polygon& p, std::span<const Disc> sites,
                               const VoronoiOptions& options);

}  // namespace gable
