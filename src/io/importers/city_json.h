// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// City models as maps: the objects of a CityJSON file (https://www.cityjson.org/specs, 1.0 to 2.0)
// as features with the tags that maps have, so that rules make a place of them. A building gives
// its footprint, its height and, from models with roofs, the shape of its roof; what stands between
// is made by rules.
//
//   object                                    becomes
//   Building, BuildingPart                    building, building:part: height, roof:shape, ..
//   Road                                      area:highway, or amenity=parking, by its function
//   TransportSquare, Railway                  place=square, landuse=railway
//   WaterBody, Waterway                       natural=water
//   PlantCover, SolitaryVegetationObject      landuse=grass or forest; natural=tree
//   LandUse                                   landuse
//
// Attributes become tags of their names. Coordinates are the file's.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "io/importers/map_features.h"

namespace gable {

bool isCityJson(const JsonValue& root);

struct CityJsonMap {
  std::vector<MapFeature> features;
  /// "EPSG:7415"; empty where the file does not say it.
  std::string system;
};

/// What a place is not made from, and what cannot be read, goes to `skips`. Codes: shapes-broken.
Result<CityJsonMap> readCityJson(const JsonValue& root, const std::string& path, MapSkips& skips);

}  // namespace gable
