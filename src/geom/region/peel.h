// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Peeling strips off a boundary, and contracting. Plan coordinates, metres.
//
// Promises:
//   1. Strip and rest of a peel make up the region; every part of a strip touches the boundary that
//      it was peeled from.
//   2. Every edge has its origin: Base and Inner edges name the input edge that was peeled, those
//   of
//      a contracted region the edge that was moved.
//   3. What is contracted lies in the region.
// O(n log n) mostly; a peel of all n edges is O(n^2) at worst.
#pragma once

#include <vector>

#include "geom/region/piece.h"
#include "geom/region/smooth.h"

namespace gable {

/// An edge, or a part of it, that is to move inward.
struct PeelEdge {
  uint32_t edge = 0;
  /// Shares of the edge's length.
  double from = 0, to = 1;
  double distance = 0;
};

/// How a strip ends beside an edge that stays: along that edge's line, or square to its own edge.
/// Parts of edges always end square.
enum class PeelEnds : uint8_t { Follow, Orthogonal };

struct PeelResult {
  /// Several when the selection is not contiguous or the region is not convex.
  std::vector<RegionPiece> strips, rest;
};

/// Distances that are not above zero, and edges out of range, do not move. The border between
/// strips and rest may be smoothed, once for both.
PeelResult peel(const Polygon& p, std::span<const PeelEdge> edges, PeelEnds ends,
                const Smoothing& smoothing = {});

/// Inset by a distance with mitered corners. Empty when nothing is left.
std::vector<RegionPiece> contract(const Polygon& p, double distance);

/// Every vertex moved by a share (0 to 0.9) of its way to a centre, then cut to the region.
std::vector<RegionPiece> contractTowards(const Polygon& p, double share, Vec2 centre);

}  // namespace gable
