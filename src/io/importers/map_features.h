// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// All features of a map with their own tags: points, lines and areas, in local metres. Where
// readShapes() takes footprints of one kind for initial shapes, this gives out everything, for who
// makes a place of it.
//
// Promises: coordinates are finite; equal positions of the file are equal here; what cannot be
// read is left out, counted and, the first of it, named with a reason.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "geom/region/region.h"
#include "io/importers/asset.h"
#include "math/box.h"
#include "scene/scene.h"
#include "shape/geo_frame.h"

namespace gable {

struct MapFeature {
  enum class Kind : uint8_t { Point, Line, Area };
  Kind kind = Kind::Point;
  /// "way/123", or what the file calls it; may be empty.
  std::string id;
  /// The properties that are texts, numbers or truth values.
  std::vector<std::pair<std::string, std::string>> tags;
  /// Of a point or a line.
  std::vector<Vec2> points;
  /// Of an area: even-odd over all rings. They may be wrong in any way.
  std::vector<Ring> rings;

  /// Empty where there is none.
  std::string_view tag(std::string_view name) const;
};

/// A part of a map: degrees, or the file's own metres.
struct MapBox {
  double west = 0, south = 0, east = 0, north = 0;
};

/// What was left out.
struct MapSkips {
  struct Row {
    std::string place, reason;
  };
  uint64_t count = 0;
  /// The first of them.
  std::vector<Row> first;
  void add(const std::string& place, const std::string& reason);
};

struct MapFeatures {
  std::vector<MapFeature> features;
  /// What `box` asked for, else the box around all buildings, else around all lines and areas; in
  /// local metres, whose origin is its middle.
  Box2 area;
  /// The same as it would be asked for.
  MapBox box;
  GeoOrigin geoOrigin;
  std::shared_ptr<const GeoFrame> geo;
  MapSkips skips;
};

/// By extension: .geojson .json (also CityJSON) .osm .pbf .gpkg .fgb .shp .kml .dxf. Codes:
/// shapes-unknown, shapes-broken, shapes-empty, map-box and those of maps.
Result<MapFeatures> readMapFeatures(std::string_view bytes, const AssetOptions& options,
                                    const std::string& layer = {},
                                    const std::optional<MapBox>& box = {});

}  // namespace gable
