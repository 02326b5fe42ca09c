// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/surface.h"

#include <array>

#include "base/measure.h"

namespace gable {
namespace {

struct Meaning {
  std::string_view key, value;
  Surface surface;
};
// https://wiki.openstreetmap.org/wiki/Map_features; the first that fits counts. An empty value
// stands for any.
constexpr Meaning kMeanings[] = {
    {"natural", "water", Surface::Water},
    {"waterway", "riverbank", Surface::Water},
    {"waterway", "dock", Surface::Water},
    {"leisure", "swimming_pool", Surface::Water},
    {"landuse", "reservoir", Surface::Water},
    {"landuse", "basin", Surface::Water},
    {"amenity", "fountain", Surface::Water},
    {"man_made", "pier", Surface::Pier},
    {"man_made", "breakwater", Surface::Pier},
    {"leisure", "pitch", Surface::Pitch},
    {"leisure", "track", Surface::Pitch},
    {"leisure", "playground", Surface::Sand},
    {"natural", "beach", Surface::Sand},
    {"natural", "sand", Surface::Sand},
    {"natural", "shingle", Surface::Sand},
    {"natural", "bare_rock", Surface::Sand},
    {"amenity", "parking", Surface::ParkingLot},
    {"amenity", "parking_space", Surface::ParkingLot},
    {"highway", "pedestrian", Surface::Square},
    {"highway", "footway", Surface::Square},
    {"area:highway", "footway", Surface::Square},
    {"area:highway", "pedestrian", Surface::Square},
    {"area:highway", "cycleway", Surface::Path},
    {"area:highway", "road", Surface::Carriageway},
    {"highway", "platform", Surface::Square},
    {"railway", "platform", Surface::Square},
    {"public_transport", "platform", Surface::Square},
    {"place", "square", Surface::Square},
    {"amenity", "marketplace", Surface::Square},
    {"leisure", "park", Surface::Park},
    {"leisure", "garden", Surface::Park},
    {"landuse", "cemetery", Surface::Park},
    {"leisure", "golf_course", Surface::Park},
    {"leisure", "dog_park", Surface::Lawn},
    {"landuse", "grass", Surface::Lawn},
    {"landuse", "village_green", Surface::Lawn},
    {"landuse", "recreation_ground", Surface::Lawn},
    {"landuse", "meadow", Surface::Lawn},
    {"landuse", "flowerbed", Surface::Lawn},
    {"natural", "grassland", Surface::Lawn},
    {"natural", "heath", Surface::Lawn},
    {"natural", "scrub", Surface::Forest},
    {"natural", "wood", Surface::Forest},
    {"landuse", "forest", Surface::Forest},
    {"landuse", "farmland", Surface::Field},
    {"landuse", "orchard", Surface::Field},
    {"landuse", "vineyard", Surface::Field},
    {"landuse", "allotments", Surface::Field},
    {"landuse", "railway", Surface::Track},
};

}  // namespace

bool isTrue(std::string_view v) { return !v.empty() && v != "no" && v != "false" && v != "0"; }

const char* surfaceName(Surface s) {
  static constexpr std::array<const char*, kSurfaceCount> kNames{
      "Lot",  "Field",      "Forest",   "Sea",         "Lawn",     "Park",
      "Sand", "ParkingLot", "Square",   "Pitch",       "Water",    "Pier",
      "Path", "Track",      "Sidewalk", "Carriageway", "Junction", "Footprint"};
  return kNames[static_cast<size_t>(s)];
}

bool isOnGround(const MapFeature& f) {
  if (isTrue(f.tag("tunnel")) || isTrue(f.tag("bridge")) || isTrue(f.tag("covered")) ||
      isTrue(f.tag("indoor"))) {
    return false;
  }
  const std::string_view location = f.tag("location");
  if (location == "underground" || location == "roof" || location == "indoor" ||
      location == "overground") {
    return false;
  }
  const std::string_view kind = f.tag("building");
  if (kind == "roof" || f.tag("parking") == "underground" || f.tag("parking") == "multi-storey") {
    return false;
  }
  return writtenNumber(f.tag("layer")).value_or(0) == 0;
}

std::optional<Surface> surfaceOfArea(const MapFeature& f) {
  if (f.kind != MapFeature::Kind::Area || !isOnGround(f)) return std::nullopt;
  if (isTrue(f.tag("building"))) return Surface::Footprint;
  for (const Meaning& m : kMeanings) {
    if (f.tag(m.key) == m.value) return m.surface;
  }
  return std::nullopt;
}

}  // namespace gable
