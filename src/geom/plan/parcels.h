// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parcels: a block between streets, divided into lots to build on. Plan coordinates, metres.
//
// Promises, for a valid block:
//  1. The parcels make up the block: valid polygons that do not overlap, areas that add up.
//  2. Every parcel has at least `minFrontage` metres of street, unless the block itself has less;
//     it is at least `minArea` large, unless the block itself is smaller.
//  3. No parcel is narrower than `minWidth` where that can be had: a division that would make one
//  is
//     not made.
//  4. Equal input gives equal output; draws are addressed, so that one parcel's change leaves the
//     others alone.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct ParcelOptions {
  /// What is larger than one and a half times this is divided.
  double targetArea = 400;
  double minArea = 100;
  /// The shorter side of the smallest box around a parcel.
  double minWidth = 6;
  double minFrontage = 4;
  /// How far a division may lie from the middle, as a share of the length: 0 to 0.4.
  double irregularity = 0.1;
  /// Of the draws.
  uint64_t address = 0;
};

struct Parcel {
  Polygon polygon;
  /// For each edge (outer ring, then holes) the street edge of the block that it is a part of, or
  /// kNoStreet: a border with a neighbour, or an edge of the block without a street.
  std::vector<uint32_t> street;
  static constexpr uint32_t kNoStreet = 0xffffffff;

  /// Metres along streets.
  double frontage = 0;
  /// Two street edges meet in a convex corner of more than 30 degrees.
  bool corner = false;
};

/// Divides by the smallest box around each part, across its longer side where that leaves a street
/// to both halves, else along it. `street` tells which edges of the block (outer ring, then holes)
/// lie on a street; empty: all of the outer ring. O(n log n) for each division.
std::vector<Parcel> parcelsByBox(const Polygon& block, const std::vector<bool>& street,
                                 const ParcelOptions& options);

/// Lots in rows along the streets: the block is shared out among its street edges by the straight
/// skeleton, and each share is cut square to its street into lots of about targetArea / depth.
/// What falls short of the minima joins the neighbour with which it shares the longest border.
std::vector<Parcel> parcelsBySkeleton(const Polygon& block, const std::vector<bool>& street,
                                      const ParcelOptions& options);

}  // namespace gable
