// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A place from its map: the ground, divided so that every square metre has one surface, and initial
// shapes for rules (docs/guide/city.md).
//
//   gable::City city = gable::City::load("monaco.osm.pbf");
//   gable::Rules rules = gable::Rules::load("city.cga");
//   gable::derive(rules, city.shapes()).write("monaco.glb");
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/shapes.h"

namespace gable {

struct CitySettings {
  /// Of a map with several layers.
  std::string layer;
  /// The part of the map to make: west, south, east, north, in degrees or in the map's own metres.
  /// Absent: the box around its buildings.
  std::optional<std::array<double, 4>> box;
  /// A file of heights, a GeoTIFF (.tif) or a tile of SRTM (.hgt): the place lies on its terrain.
  /// Empty: the place is flat.
  std::string terrain;
  /// On terrain the place is a block of soil that goes so many metres below its lowest ground, at
  /// least 2; 0: no block. Absent: as suits its size.
  std::optional<double> soil;
  /// Two capitals of ISO 3166-1, such as "MC": how houses look. Empty: by addresses of the map,
  /// else by its place.
  std::string country;
};

struct CityStatistics {
  struct Surface {
    std::string name;
    uint64_t pieces = 0;
    /// Square metres.
    double area = 0;
  };
  /// Of the place, and of the pieces of its ground together.
  double area = 0, groundArea = 0;
  /// All there are, whether the place has them or not.
  std::vector<Surface> surfaces;
  /// How many shapes begin with which rule.
  std::vector<std::pair<std::string, uint64_t>> shapes;
  uint64_t features = 0;
  /// Features, or parts of them, that could not be read.
  uint64_t skipped = 0;
  struct Skip {
    /// The id of a feature, such as way/123, and why.
    std::string place, reason;
  };
  /// The first thousand of them.
  std::vector<Skip> skips;
  /// The same as CitySettings::box.
  std::array<double, 4> box{};
  /// Heights of the ground, in metres; 0 in a flat place.
  double lowest = 0, highest = 0;
};

class City {
 public:
  /// By extension: .osm .pbf .geojson .json (also CityJSON) .gpkg .fgb .shp .kml .dxf; see
  /// Shapes::load.
  static City load(const std::string& path, const CitySettings& settings = {},
                   const FileLimits& limits = {});
  /// The same for a file's content in memory; `name` gives the extension.
  static City parse(const std::string& content, const std::string& name,
                    const CitySettings& settings = {}, const FileLimits& limits = {});

  /// Whether CitySettings::country takes it: two capitals of ISO 3166-1, "GB" and not "UK".
  static bool isCountry(std::string_view code);

  /// Each begins with the rule of its name, where the rules have it.
  Shapes shapes() const;
  /// The ground as GeoJSON: a polygon a piece, with its surface, its area and the feature's id.
  std::string groundGeoJson() const;
  const CityStatistics& statistics() const;

  bool ok() const;
  /// False when the file itself could not be read.
  bool found() const;
  /// What could not be read, among them.
  const DiagnosticList& diagnostics() const;

  struct Impl;
  explicit City(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace gable
