// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What single points of a map say of the building that they lie in or on: addresses, entrances,
// shops and other things with a name. A point goes to one building, and to one part of a building:
// to that which has it inside, else on its outline; of several to the smallest.
//
// What several points say is put in one order: addresses by main entrance, street, number and id,
// all else by id. So the order of the map's rows changes nothing.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/importers/map_features.h"

namespace gable {

struct BuildingPoints {
  /// Tags for a building that lacks them: addr:* of the first address; shop, amenity, office, craft
  /// and tourism of all, each value once, with ; between; `name` where just one thing has one.
  std::vector<std::pair<std::string, std::string>> tags;
  /// Each once, with ; between: "Main Street 1;Main Street 3", and the names of what is within.
  std::string addresses, names;
  /// Doors, main ones first. Where the map has none, the first address that lies on the outline.
  std::vector<Vec2> entrances;
  /// What has its front on the ground floor: shops, and what is open to the street as they are.
  std::vector<Vec2> shops;
};

/// By feature; those that no point says anything of are not there. O(n log n), mostly.
std::map<uint32_t, BuildingPoints> buildingPointsOf(const std::vector<MapFeature>& features);

}  // namespace gable
