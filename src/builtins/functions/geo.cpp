// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "shape/geo_frame.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class GeoCoordinate : uint8_t { X, Y, Lon, Lat };

}  // namespace

template <>
struct WordsOf<GeoCoordinate> {
  static constexpr const char* text = "X Y lon lat";
};

namespace {

struct GeoArguments {
  GeoCoordinate coordinate;
};

Value getGeoCoord(FunctionCall& call, const GeoArguments& args) {
  const Services& services = call.services();
  const Vec3 at = services.world().point(call.shape().scope.origin);
  const GeoFrame* frame = services.initialShape().geo;
  // Without a frame the world is all the map there is.
  const GeoPlace place = frame ? frame->at({at.x, -at.z}) : GeoPlace{at.x, -at.z, {}};
  if (args.coordinate == GeoCoordinate::X) return Value::of(place.x);
  if (args.coordinate == GeoCoordinate::Y) return Value::of(place.y);
  if (!place.degrees) {
    return call.fail("no-geo", "nothing tells where on the Earth the shape lies",
                     "give shapes in longitude and latitude, or in UTM with its `crs`",
                     Value::of(0.0));
  }
  return Value::of(args.coordinate == GeoCoordinate::Lon ? place.degrees->longitude
                                                         : place.degrees->latitude);
}

constexpr ParamSpec kParams[] = {param<&GeoArguments::coordinate>(
    "geoCoordinate",
    "X or Y: metres to the east or north; lon or lat: degrees of longitude or latitude.")};
constexpr Signature kSignatures[] = {{kParams, ValueType::Float}};

constexpr FunctionSpec kFunctions[] = {
    {"getGeoCoord", "geo", "A coordinate of the scope's origin on the map or on the Earth.",
     kSignatures, typed<getGeoCoord>, kReadsWorld | kReadsInitialShape},
};

}  // namespace

extern const FunctionList kFunctions_geo;
const FunctionList kFunctions_geo = {kFunctions, {}};

}  // namespace gable
