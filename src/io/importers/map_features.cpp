// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/map_features.h"

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "base/json.h"
#include "base/number.h"
#include "base/work.h"
#include "io/geo/geo_frames.h"
#include "io/geo/transverse_mercator.h"
#include "io/importers/city_json.h"
#include "io/importers/city_json_sequence.h"
#include "io/importers/geojson_root.h"
#include "io/importers/map_file.h"
#include "io/importers/other_tags.h"

namespace gable {
namespace {

constexpr size_t kMostRows = 1000;
constexpr int kDeepestCollection = 16;
// Room around the buildings, in metres.
constexpr double kAround = 15;
constexpr double kMetresOfDegree = 111320;

std::string textOf(const JsonValue& v) {
  if (v.isNumber()) return shortestText(v.number(0));
  if (v.isBool()) return v.boolean(false) ? "yes" : "no";
  return v.text();
}

class Reader {
 public:
  explicit Reader(const std::optional<MapBox>& wanted) : wanted_(wanted) {}

  void collect(const JsonValue& v) {
    if (v["type"].text() == "FeatureCollection") {
      for (const JsonValue& f : v["features"].items()) {
        work();
        if (f.isObject()) collect(f);
      }
      return;
    }
    ++number_;
    const bool feature = v["type"].text() == "Feature";
    MapFeature out;
    out.id = feature ? textOf(v["id"]) : std::string();
    if (feature) {
      for (const auto& [name, value] : v["properties"].members()) {
        std::string text = textOf(value);
        if (!text.empty() && name != kOtherTags) out.tags.emplace_back(name, std::move(text));
      }
      for (auto& tag : otherTags(v["properties"][kOtherTags].text())) {
        out.tags.push_back(std::move(tag));
      }
    }
    for (const char* key : {"osm_id", "osm_way_id", "id", "@id", "fid", "OBJECTID"}) {
      if (out.id.empty()) out.id = out.tag(key);
    }
    if (out.id.empty()) out.id = "feature/" + std::to_string(number_);
    place_ = out.id;
    addGeometry(feature ? v["geometry"] : v, out, 0);
  }

  // What the program that read the map could not assemble.
  void addLeftOut(const JsonValue& root) {
    const std::vector<JsonValue>& rows = root["leftOut"].items();
    for (const JsonValue& row : rows) {
      work();
      out_.skips.add(row.at(0).text(), row.at(1).text());
    }
    const double all = root["passedOver"].number(0);
    const auto named = static_cast<double>(rows.size());
    if (all > named && all < 1e15) out_.skips.count += static_cast<uint64_t>(all - named);
  }

  // Of a city model.
  std::optional<Error> addModel(const JsonValue& root, const std::string& path) {
    Result<CityJsonMap> model = readCityJson(root, path, out_.skips);
    if (!model.ok()) return model.error();
    out_.features = std::move(model->features);
    system_ = std::move(model->system);
    degrees_ = system_ == "EPSG:4326" || system_ == "EPSG:4979" || system_ == "EPSG:4258";
    return std::nullopt;
  }
  void addMap(const JsonValue& root) {
    collect(root);
    addLeftOut(root);
    system_ = root["crs"]["properties"]["name"].text();
    degrees_ = namesDegrees(root);
  }

  // Degrees become metres about the middle of the area.
  Result<MapFeatures> finish(const std::string& path) {
    const Box2 box = extent();
    if (box.empty()) {
      return Error{
          "shapes-empty", "'" + path + "' has no feature that could be a part of a place", {}};
    }
    out_.box = {box.min.x, box.min.y, box.max.x, box.max.y};
    if (wanted_) {
      if (auto e = missed(box, path)) return *e;
    }
    const bool degrees =
        degrees_ && box.min.x >= -180 && box.max.x <= 180 && box.min.y >= -90 && box.max.y <= 90;
    const Vec2 middle = box.center();
    if (degrees) {
      const TransverseMercator projection({middle.x, middle.y});
      out_.geoOrigin = {true, projection.center().longitude, projection.center().latitude};
      out_.geo = localGeoFrame(projection.center());
      move([&](Vec2 p) { return projection.forward({p.x, p.y}); });
      out_.area.include(projection.forward({box.min.x, box.min.y}));
      out_.area.include(projection.forward({box.max.x, box.max.y}));
    } else {
      const Vec2 shift{std::floor(middle.x), std::floor(middle.y)};
      out_.geo = mapGeoFrame(system_, shift);
      move([&](Vec2 p) { return p - shift; });
      out_.area.include(box.min - shift);
      out_.area.include(box.max - shift);
    }
    return std::move(out_);
  }

 private:
  // A box beside the map is a slip, of coordinates in the other order perhaps.
  std::optional<Error> missed(const Box2& box, const std::string& path) const {
    Box2 all;
    for (const MapFeature& f : out_.features) {
      work(f.points.size());
      for (const Vec2 p : f.points) all.include(p);
      for (const Ring& r : f.rings) {
        work(r.size());
        for (const Vec2 p : r) all.include(p);
      }
    }
    if (all.meets(box) || all.empty()) return std::nullopt;
    const auto text = [](double v) { return shortestText(std::round(v * 1e6) / 1e6); };
    return Error{"map-box", "nothing of '" + path + "' lies in the box",
                 "the map goes from " + text(all.min.x) + "," + text(all.min.y) + " to " +
                     text(all.max.x) + "," + text(all.max.y) + "; give west,south,east,north"};
  }

  bool point(const JsonValue& v, Vec2& p) {
    if (positionOf(v, p)) return true;
    skip("a position is not two numbers");
    return false;
  }
  bool points(const JsonValue& v, std::vector<Vec2>& out) {
    for (const JsonValue& p : v.items()) {
      work();
      Vec2 at;
      if (!point(p, at)) return false;
      out.push_back(at);
    }
    return true;
  }
  void skip(const std::string& reason) { out_.skips.add(place_, reason); }

  void addGeometry(const JsonValue& g, const MapFeature& f, int depth) {
    const std::string& type = g["type"].text();
    const JsonValue& at = g["coordinates"];
    if (type == "Point") {
      addPoint(at, f);
    } else if (type == "LineString") {
      addLine(at, f);
    } else if (type == "Polygon") {
      MapFeature area = f;
      if (addRings(at, area)) addArea(std::move(area));
    } else if (type == "MultiPolygon") {
      MapFeature area = f;
      for (const JsonValue& p : at.items()) {
        if (!addRings(p, area)) return;
      }
      addArea(std::move(area));
    } else if (type == "MultiPoint" || type == "MultiLineString") {
      for (const JsonValue& part : at.items()) {
        if (type == "MultiPoint") {
          addPoint(part, f);
        } else {
          addLine(part, f);
        }
      }
    } else if (type == "GeometryCollection" && depth < kDeepestCollection) {
      for (const JsonValue& part : g["geometries"].items()) addGeometry(part, f, depth + 1);
    } else {
      skip(type.empty() ? "it has no geometry" : "its geometry is a '" + type + "'");
    }
  }
  void addPoint(const JsonValue& at, MapFeature f) {
    f.kind = MapFeature::Kind::Point;
    f.points.resize(1);
    if (point(at, f.points[0])) out_.features.push_back(std::move(f));
  }
  void addLine(const JsonValue& at, MapFeature f) {
    f.kind = MapFeature::Kind::Line;
    if (!points(at, f.points)) return;
    f.points.erase(std::unique(f.points.begin(), f.points.end()), f.points.end());
    if (f.points.size() < 2) return skip("a line has no length");
    out_.features.push_back(std::move(f));
  }
  bool addRings(const JsonValue& rings, MapFeature& f) {
    for (const JsonValue& r : rings.items()) {
      Ring ring;
      if (!points(r, ring)) return false;
      ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
      if (ring.size() >= 3) {
        f.rings.push_back(std::move(ring));
      } else {
        skip("a ring has fewer than three corners");
      }
    }
    return true;
  }
  void addArea(MapFeature f) {
    f.kind = MapFeature::Kind::Area;
    if (f.rings.empty()) return skip("an area has no ring");
    out_.features.push_back(std::move(f));
  }

  // In the coordinates of the file.
  Box2 extent() const {
    Box2 box;
    if (wanted_) {
      box.include({wanted_->west, wanted_->south});
      box.include({wanted_->east, wanted_->north});
      return box;
    }
    for (const bool all : {false, true}) {
      for (const MapFeature& f : out_.features) {
        work();
        if (f.kind == MapFeature::Kind::Point) continue;
        if (!all && (f.kind != MapFeature::Kind::Area || f.tag("building").empty())) continue;
        for (const Ring& r : f.rings) {
          for (const Vec2 p : r) box.include(p);
        }
        for (const Vec2 p : f.points) box.include(p);
      }
      if (!box.empty()) break;
    }
    if (box.empty()) return box;
    const bool degrees = box.min.x >= -180 && box.max.x <= 180 && std::fabs(box.center().y) < 89;
    const double north = degrees ? kAround / kMetresOfDegree : kAround;
    const Vec2 around{degrees ? 1.4 * north : north, north};
    box.min = box.min - around;
    box.max = box.max + around;
    return box;
  }
  template <class To>
  void move(To&& to) {
    for (MapFeature& f : out_.features) {
      work(f.points.size());
      for (Vec2& p : f.points) p = to(p);
      for (Ring& r : f.rings) {
        work(r.size());
        for (Vec2& p : r) p = to(p);
      }
    }
  }

  const std::optional<MapBox>& wanted_;
  MapFeatures out_;
  // What the numbers of the file are.
  std::string system_;
  bool degrees_ = false;
  std::string place_;
  size_t number_ = 0;
};

}  // namespace

std::string_view MapFeature::tag(std::string_view name) const {
  for (const auto& [key, value] : tags) {
    if (key == name) return value;
  }
  return {};
}

void MapSkips::add(const std::string& place, const std::string& reason) {
  ++count;
  if (first.size() < kMostRows) first.push_back({place, reason});
}

Result<MapFeatures> readMapFeatures(std::string_view bytes, const AssetOptions& options,
                                    const std::string& layer, const std::optional<MapBox>& box) {
  if (box && !(box->west < box->east && box->south < box->north)) {
    return Error{
        "map-box",
        "the box of the map is empty: its west is not west of its east, or its south not south "
        "of its north",
        "give west,south,east,north, such as 7.41,43.72,7.44,43.75"};
  }
  const std::string extension = extensionOf(options.path);
  std::string converted;
  if (isMap(options.path)) {
    Result<std::string> text = mapAsGeoJson(bytes, options, layer);
    if (!text.ok()) return text.error();
    converted = std::move(*text);
    bytes = converted;
  } else if (extension != "geojson" && extension != "json" && !isCityJsonSequence(options.path)) {
    return Error{
        "shapes-unknown", "'" + options.path + "' is no map that can be read",
        "use GeoJSON, CityJSON, OpenStreetMap, GeoPackage, FlatGeobuf, a shapefile, KML or DXF"};
  }
  const Result<JsonValue> root = parseGeometries(bytes, options.path);
  if (!root.ok()) return root.error();
  Reader reader(box);
  if (isCityJson(root.value())) {
    if (auto e = reader.addModel(root.value(), options.path)) return *e;
  } else {
    reader.addMap(root.value());
  }
  return reader.finish(options.path);
}

}  // namespace gable
