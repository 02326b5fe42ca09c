// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_place.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/number.h"
#include "io/geo/geo_frames.h"

namespace gable {
namespace {

// Of UTM: scale, and what is added to eastings and, south of the equator, to northings.
constexpr double kScale = 0.9996, kEast = 5e5, kNorth = 1e7;

// The number at the end of the text of a frame of a map projection; 0 for any other.
int systemOf(const std::string& text) {
  double code = 0;
  if (!text.starts_with("map ") || !parseNumber(text.substr(text.rfind(' ') + 1), code)) return 0;
  return code > 0 && code < 1e6 ? static_cast<int>(code) : 0;
}

}  // namespace

CityPlace::CityPlace(const GeoFrame* geo, const GeoOrigin& origin) : geo_(geo) {
  if (!geo_ && origin.present) {
    own_ = localGeoFrame({origin.longitude, origin.latitude});
    geo_ = own_.get();
  }
  if (!geo_) {
    shift_ = Vec2{};
    return;
  }
  const GeoPlace place = geo_->at({0, 0});
  degrees_ = place.degrees;
  const std::string text = geo_->text();
  system_ = systemOf(text);
  if (!text.starts_with("local ") || !degrees_) {
    shift_ = Vec2{place.x, place.y};
    return;
  }
  const double turned = degrees_->longitude + 180;
  const double whole = turned - 360 * std::floor(turned / 360);
  const int zone = std::clamp(static_cast<int>(whole / 6) + 1, 1, 60);
  const bool north = degrees_->latitude >= 0;
  utm_.emplace(LonLat{6.0 * zone - 183, 0});
  south_ = north ? 0 : kNorth;
  system_ = (north ? 32600 : 32700) + zone;
}

Vec2 CityPlace::projected(Vec2 flat) const {
  const GeoPlace place = geo_->at(flat);
  if (!place.degrees) return {place.x, place.y};
  const Vec2 on = utm_->forward({place.degrees->longitude, place.degrees->latitude});
  return {kEast + kScale * on.x, south_ + kScale * on.y};
}

// By central differences of half a tile. The third derivatives of a projection are about 1 by the
// square of the Earth's radius, so that nothing is left of them at this distance.
const CityPlace::Tile& CityPlace::tileAt(Vec2 flat) {
  const double column = std::floor(flat.x / kCityTile), row = std::floor(flat.y / kCityTile);
  const auto [at, isNew] =
      tiles_.try_emplace({static_cast<int64_t>(column), static_cast<int64_t>(row)});
  Tile& t = at->second;
  if (!isNew) return t;
  const double h = kCityTile / 2;
  t.middle = {column * kCityTile + h, row * kCityTile + h};
  const auto value = [&](double x, double y) { return projected(t.middle + Vec2{x * h, y * h}); };
  t.value = value(0, 0);
  const Vec2 east = value(1, 0), west = value(-1, 0), north = value(0, 1), south = value(0, -1);
  t.byX = (east - west) * (0.5 / h);
  t.byY = (north - south) * (0.5 / h);
  t.byXX = (east + west - t.value * 2) * (1 / (h * h));
  t.byYY = (north + south - t.value * 2) * (1 / (h * h));
  t.byXY = (value(1, 1) - value(1, -1) - value(-1, 1) + value(-1, -1)) * (0.25 / (h * h));
  return t;
}

Vec3 CityPlace::at(const Vec3& world) {
  const Vec2 flat{world.x, -world.z};
  if (shift_) return {flat.x + shift_->x, flat.y + shift_->y, world.y};
  const Tile& t = tileAt(flat);
  const Vec2 d = flat - t.middle;
  const Vec2 p = t.value + t.byX * d.x + t.byY * d.y + t.byXX * (d.x * d.x / 2) +
                 t.byYY * (d.y * d.y / 2) + t.byXY * (d.x * d.y);
  return {p.x, p.y, world.y};
}

void CityPlace::axesAt(const Vec3& world, Vec3& east, Vec3& north) {
  const Vec3 from = at(world);
  east = at(world + Vec3{1, 0, 0}) - from;
  north = at(world + Vec3{0, 0, -1}) - from;
}

}  // namespace gable
