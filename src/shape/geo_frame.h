// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// GeoFrame: where the world of a derivation lies on the Earth. Whoever reads the shapes knows it
// and implements this; rules ask through getGeoCoord().
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "math/vec.h"

namespace gable {

struct GeoPlace {
  /// Easting and northing in metres: in the coordinate system of the shapes' file where that has
  /// metres, else from the origin of the world.
  double x = 0, y = 0;
  /// Degrees on WGS 84, where they can be told.
  struct Degrees {
    double longitude = 0, latitude = 0;
  };
  std::optional<Degrees> degrees;
};

class GeoFrame {
 public:
  virtual ~GeoFrame() = default;
  /// Of a place seen from above: metres to the east and to the north.
  virtual GeoPlace at(Vec2 place) const = 0;
  /// Equal for frames that give the same.
  virtual uint64_t hash() const = 0;
  /// A text by which geoFrameOf() of io/geo/geo_frames.h makes an equal one.
  virtual std::string text() const = 0;
};

}  // namespace gable
