// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The ground of a place on its terrain: a height for each corner of each piece, the floors of
// buildings, and the walls where pieces lie beside each other at different heights.
// Plan coordinates and heights, metres.
//
//   piece                                  lies
//   streets, paths, lots, parks, ..        on the graded ground (city/street_grade.h)
//   under buildings                        level: nowhere below the ground around it
//   lakes, pools; the sea                  level: as low as their shore; as the sea of the heights
//   pitches                                level, where the ground falls little
//
// Promises:
//   1. Neighbours on the graded ground have the same heights along their border, to the bit; beside
//      a level piece a wall fills exactly what is between.
//   2. Along a building the ground is nowhere above its floor; a plinth fills what is between.
//   3. Areas in plan stay what they were. Equal input gives equal output. About O(n log n).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "city/ground.h"
#include "city/street_grade.h"
#include "city/terrain_surface.h"

namespace gable {

/// The side of a piece above another, upright, facing the lower one.
struct TerrainWall {
  uint32_t piece = 0, beyond = 0;
  std::vector<std::vector<Vec3>> faces;
};

struct Terrain {
  std::shared_ptr<const TerrainSurface> surface;
  std::vector<TerrainWall> walls;
};

Terrain terrainOf(const HeightField& field, const StreetGrade& grade,
                  const std::vector<MapFeature>& features, const std::vector<GroundPiece>& ground);

}  // namespace gable
