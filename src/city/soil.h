// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The block of soil that a place on terrain is cut out as: sides along its border and a bottom, so
// that it is no sheet in the air. Plan coordinates and heights, metres.
//
//   bottom        level, below the lowest ground
//   sides         from there up to kSoilRim below the ground at the border
//   rims          the rest, which rules end where the surface is that they have made. They lie on
//                 the ground as other flat shapes do, from -kSoilRim to 0
//
// Promises: with rims laid on the ground, the sides and the bottom close the surface of the ground
// and its walls along the whole border of the place. O(n log n).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "city/terrain_surface.h"

namespace gable {

constexpr double kSoilRim = 1.5;

/// Along a piece of the ground; faces look outwards.
struct SoilSide {
  uint32_t piece = 0;
  std::vector<std::vector<Vec3>> side, rim;
};

struct SoilBlock {
  std::vector<SoilSide> sides;
  std::vector<Vec3> bottom;
};

/// `depth` metres below the lowest ground, at least 2; absent: as suits a place of that size.
SoilBlock soilBelow(const TerrainSurface& ground, std::optional<double> depth);

}  // namespace gable
