// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// UTM is the transverse Mercator projection about the equator and the middle of a zone of 6
// degrees, scaled by 0.9996, with 500 km added to eastings and, in the south, 10000 km to
// northings. ETRS89 and WGS 84 differ by less than a metre. The web's Mercator takes the Earth as a
// sphere.
#include "io/geo/geo_frames.h"

#include <algorithm>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/number.h"
#include "math/trig.h"

namespace gable {
namespace {

constexpr double kUtmScale = 0.9996, kFalseEasting = 5e5, kFalseNorthing = 1e7;
constexpr double kWebRadius = 6378137.0;
constexpr int kWebMercator = 3857;

GeoPlace::Degrees degreesOf(const LonLat& p) { return {p.longitude, p.latitude}; }

class LocalFrame : public GeoFrame {
 public:
  explicit LocalFrame(const LonLat& center) : projection_(center) {}
  GeoPlace at(Vec2 p) const override { return {p.x, p.y, degreesOf(projection_.inverse(p))}; }
  uint64_t hash() const override {
    return hashCombine(hashDouble(projection_.center().longitude),
                       hashDouble(projection_.center().latitude));
  }
  std::string text() const override {
    return "local " + shortestText(projection_.center().longitude) + " " +
           shortestText(projection_.center().latitude);
  }

 private:
  TransverseMercator projection_;
};

class MapFrame : public GeoFrame {
 public:
  MapFrame(int code, Vec2 origin) : code_(code), origin_(origin) {}
  GeoPlace at(Vec2 p) const override {
    const Vec2 map = p + origin_;
    return {map.x, map.y, degreesAt(map)};
  }
  uint64_t hash() const override {
    const uint64_t place = hashCombine(hashDouble(origin_.x), hashDouble(origin_.y));
    return hashCombine(place, static_cast<uint64_t>(code_));
  }
  std::string text() const override {
    return "map " + shortestText(origin_.x) + " " + shortestText(origin_.y) + " " +
           std::to_string(code_);
  }

 private:
  std::optional<GeoPlace::Degrees> degreesAt(Vec2 map) const {
    if (code_ == kWebMercator) {
      const double latitude = 2 * atan2Deg(expOf(map.y / kWebRadius), 1) - 90;
      return GeoPlace::Degrees{toDegrees(map.x / kWebRadius), latitude};
    }
    const int zone = code_ % 100, series = code_ / 100;
    const bool isUtm = series == 326 || series == 327 || series == 258;
    if (!isUtm || zone < 1 || zone > 60) return std::nullopt;
    const double south = series == 327 ? kFalseNorthing : 0;
    const TransverseMercator about({6.0 * zone - 183, 0});
    return degreesOf(
        about.inverse({(map.x - kFalseEasting) / kUtmScale, (map.y - south) / kUtmScale}));
  }

  int code_;
  Vec2 origin_;
};

// The number at the end of a name with EPSG in it; 0 for none.
int codeOf(std::string_view system) {
  if (system.find("EPSG") == std::string_view::npos) return 0;
  const size_t colon = system.rfind(':');
  double code = 0;
  if (colon == std::string_view::npos || !parseNumber(system.substr(colon + 1), code)) return 0;
  return code > 0 && code < 1e6 ? static_cast<int>(code) : 0;
}

}  // namespace

std::shared_ptr<const GeoFrame> localGeoFrame(const LonLat& center) {
  return std::make_shared<LocalFrame>(center);
}

std::shared_ptr<const GeoFrame> mapGeoFrame(std::string_view system, Vec2 origin) {
  return std::make_shared<MapFrame>(codeOf(system), origin);
}

std::shared_ptr<const GeoFrame> geoFrameOf(std::string_view text) {
  // A word and its numbers.
  const auto next = [&text] {
    const size_t space = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(std::min(space + 1, text.size()));
    return word;
  };
  const std::string_view kind = next();
  double a = 0, b = 0, code = 0;
  if (!parseNumber(next(), a) || !parseNumber(next(), b)) return nullptr;
  if (kind == "local") return localGeoFrame({a, b});
  if (kind != "map" || !parseNumber(next(), code)) return nullptr;
  return std::make_shared<MapFrame>(static_cast<int>(std::clamp(code, 0.0, 1e6)), Vec2{a, b});
}

}  // namespace gable
