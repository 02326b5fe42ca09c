// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The outline of a building without what surveys and grids have added, and what each of its walls
// looks at: a neighbour that stands against it, a street some way off, or neither. One wall that
// looks at a street has the entrance. Plan coordinates, metres.
//
// Promises:
//   1. The outline is valid, and begins with its longest edge.
//   2. A wall that a neighbour covers in part is divided where the neighbour ends.
//   3. Equal input gives equal output. O(edges) and the look-ups of the index.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "city/ground.h"

namespace gable {

struct Wall {
  /// The piece of ground at its foot; GroundPiece::kNothing at the border, and where none is known.
  uint32_t beyond = GroundPiece::kNothing;
  /// Metres to the street that it looks at; 0 where it looks at none.
  double street = 0;
  bool entrance = false;
  /// Shops of the map that have their front in it.
  uint32_t shops = 0;
};

struct BuildingOutline {
  Polygon polygon;
  /// By edge, through the outer ring and the holes.
  std::vector<Wall> walls;
};

/// Of a part of a building, or what stands on others: its walls know nothing yet.
BuildingOutline outlineOf(const Polygon& polygon);
/// Of a piece of the ground: its walls know what is beyond.
BuildingOutline outlineOf(const GroundPiece& piece, const std::vector<GroundPiece>& ground);

/// Finds the streets that walls look at, and the entrance. `climb` tells the metres between the
/// floor and the ground at a place.
void findStreets(BuildingOutline& outline, const std::vector<GroundPiece>& ground,
                 GroundIndex& index, const std::function<double(Vec2)>& climb = {});

/// Of a wall each: the entrances that the map has, in place of what was found, and its shops. After
/// findStreets(): shops look at a street where a wall does.
void placeDoors(BuildingOutline& outline, const std::vector<GroundPiece>& ground,
                const std::vector<Vec2>& entrances, const std::vector<Vec2>& shops);

/// The share of the walls' length that neighbours stand against.
double attachedShare(const BuildingOutline& outline, const std::vector<GroundPiece>& ground);

/// The edge of the outer ring that a ridge runs along, or that a single slope rises from: as
/// `roof:direction` and `roof:orientation` say, else the entrance of an attached building, else the
/// longest.
uint32_t roofEdgeOf(const BuildingOutline& outline, const MapFeature& f, bool attached);

}  // namespace gable
