// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The plan of a place: its ground, and the initial shapes that rules make the place from. Plan
// coordinates, metres.
//
//   shape          is                                                      begins with the rule
//   ground         a piece of the ground                                   Lot, Lawn, Carriageway,
//   .. buildings      the part of a footprint that no other building has      Building
//                  a building:part; a roof on posts                        BuildingPart, Canopy
//   lines          a stretch of a street between junctions, rails, ..      Street, Rails, TreeRow,
//                                                                          Barrier
//                  where cars can stand along a kerb, in their middle      ParkingLane
//   steps          where the ground goes down to a roadway or to water, the higher
//                  piece on the left                                       Kerb
//   crossings      a rectangle across the carriageway, x across it         Crossing
//   bridges        faces in space: the upper side of a deck, strips along     BridgeDeck,
//   BridgeParapet,
//                  its edges and its rails, sides of ramps, feet of piers  BridgeRail, BridgeWall,
//                                                                          BridgePier
//   single things  a square of a metre                                     Tree, StreetLamp
//   on terrain     faces in space: below floors, and where a piece lies
//                  above another                                           Plinth, RetainingWall
//                  sides and bottom of the block that it is; the uppermost
//                  part of the sides, flat on the ground                   Soil, SoilRim
//
// Attributes are the tags of the feature, numbers without their units, and what is said in
// docs/guide/city.md. Promises: equal input gives equal output. O(n log n), mostly.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "city/ground.h"
#include "city/tag_values.h"
#include "city/terrain_surface.h"
#include "io/geo/height_field.h"
#include "io/importers/map_features.h"

namespace gable {

struct CityShape {
  /// The rule that it begins with.
  std::string rule;
  /// Of its feature; several shapes may have one.
  std::string id;
  Polygon polygon;
  /// In place of a polygon.
  std::vector<Vec2> line;
  /// In place of both: faces in space, points of the plan with their heights.
  std::vector<std::vector<Vec3>> faces;
  /// Of the polygon.
  double height = 0;
  std::vector<AttributeValue> attributes;
};

struct CityPlan {
  Box2 area;
  std::vector<GroundPiece> ground;
  std::vector<CityShape> shapes;
  MapSkips skips;
  std::vector<MapDoubt> doubts;
  /// Null for a flat place. Shapes that lie on the ground are flat also where there is one: what
  /// rules make of them is laid on it (city/drape.h). The others are where they stand.
  std::shared_ptr<const TerrainSurface> terrain;
};

/// `country` as countryOf() gives it, which is asked where it is empty; without `heights` the place
/// is flat. On heights it is a block of soil that goes so many metres below its lowest ground: 0
/// for none, absent for what suits its size.
CityPlan planCity(const MapFeatures& map, const std::string& country = {},
                  const HeightField* heights = nullptr, std::optional<double> soil = {});

/// The names of all rules that shapes of plans begin with, sorted.
const std::vector<std::string_view>& cityRules();

/// Whether shapes that begin with a rule lie on the ground.
bool liesOnGround(std::string_view rule);

/// The ground as GeoJSON for map programs: a feature a piece, with `surface`, `id` and `area`.
std::string planGeoJson(const CityPlan& plan, const MapFeatures& map);

}  // namespace gable
