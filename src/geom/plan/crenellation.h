// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Crenellation: the band along the outline of a polygon, divided into merlons and the gaps between
// them, the crenels. Plan coordinates, metres.
//
// Promises
//  1. Merlons, crenels and rest make up the polygon; none overlap.
//  2. A side between two sharp corners begins and ends with a merlon and has
//     max(0, rint((length - merlon) / (merlon + gap))) gaps; merlon and gap are stretched alike to
//     meet both corners. The merlons at a corner are one. So a ring has as many merlons as gaps.
//  3. An outline without a sharp corner has max(1, rint(length / (merlon + gap))) of each, as far
//     as it is longer than merlon and gap together; else it is one merlon.
//  4. Where the polygon is thinner than the band, merlons that would overlap go to the first.
// O(n log n) for n merlons apart from each other, and a boolean over all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct CrenellationOptions {
  double merlon = 1.5, gap = 0.75;
  /// Of the band, measured inward.
  double thickness = 0.5;
};

struct CrenellationPart {
  Polygon polygon;
  /// Of the polygon's outer ring, the edge that lies on the outline; the longest of several.
  uint32_t front = 0;
};

struct Crenellation {
  /// Ring by ring, in the order of the outline.
  std::vector<CrenellationPart> merlons;
  std::vector<CrenellationPart> crenels;
  /// Within the band.
  Region rest;
};

/// How many merlons promises 2 and 3 give, all rings together.
double merlonCount(const Polygon& p, const CrenellationOptions& options);

/// `p` must be valid (region/clean.h); merlon, gap and thickness positive.
Crenellation crenellate(const Polygon& p, const CrenellationOptions& options);

}  // namespace gable
