// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where a scene lies in the coordinate systems of city models: x to the east, y to the north, z up.
// Shapes that came with longitude and latitude lie in the zone of UTM of their origin; those of a
// map projection lie in that; others keep their metres. Points within kCityTile of each other share
// what is costly about a projection; the error of that is below a micrometre.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "io/geo/transverse_mercator.h"
#include "scene/scene.h"
#include "shape/geo_frame.h"

namespace gable {

constexpr double kCityTile = 256;

class CityPlace {
 public:
  /// `geo` may be null: then the origin of the scene says where it lies, or nothing does. It must
  /// outlive the place.
  CityPlace(const GeoFrame* geo, const GeoOrigin& origin);

  /// The number that EPSG gives the coordinate system; 0 where nobody knows.
  int system() const { return system_; }
  /// Of the origin of the world, where they are known.
  const std::optional<GeoPlace::Degrees>& degrees() const { return degrees_; }
  /// A point of the world, whose y axis points up and whose z axis points to the south.
  Vec3 at(const Vec3& world);
  /// How far the place moves by a metre to the east and one to the north.
  void axesAt(const Vec3& world, Vec3& east, Vec3& north);

 private:
  /// Taylor's polynomial of the second degree about the middle of a tile.
  struct Tile {
    Vec2 middle, value, byX, byY, byXX, byXY, byYY;
  };
  Vec2 projected(Vec2 flat) const;
  const Tile& tileAt(Vec2 flat);

  const GeoFrame* geo_ = nullptr;
  std::shared_ptr<const GeoFrame> own_;
  /// Where the place is moved only: by how much.
  std::optional<Vec2> shift_;
  std::optional<TransverseMercator> utm_;
  double south_ = 0;
  std::map<std::pair<int64_t, int64_t>, Tile> tiles_;
  int system_ = 0;
  std::optional<GeoPlace::Degrees> degrees_;
};

}  // namespace gable
