// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the ground of a place is made of, and what a map says about it. A surface is also the name
// of the rule that its pieces begin with: Surface::ParkingLot is `ParkingLot`.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/importers/map_features.h"

namespace gable {

enum class Surface : uint8_t {
  Lot,
  Field,
  Forest,
  Sea,
  Lawn,
  Park,
  Sand,
  ParkingLot,
  Square,
  Pitch,
  Water,
  Pier,
  Path,
  Track,
  Sidewalk,
  Carriageway,
  Junction,
  Footprint,
};
constexpr size_t kSurfaceCount = static_cast<size_t>(Surface::Footprint) + 1;

/// "Carriageway".
const char* surfaceName(Surface s);

/// Whether a tag says that something is there: "yes", or of what kind.
bool isTrue(std::string_view tag);

/// Whether something lies on the ground, and neither above nor below it.
bool isOnGround(const MapFeature& f);

/// What an area of the map makes of the ground; nothing where it says nothing of it.
std::optional<Surface> surfaceOfArea(const MapFeature& f);

}  // namespace gable
