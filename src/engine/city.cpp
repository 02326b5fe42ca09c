// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From a map to initial shapes.

#include "gable/city.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "city/buildings.h"
#include "city/country.h"
#include "city/plan.h"
#include "engine/footprint.h"
#include "engine/guard.h"
#include "geom/mesh/face_plane.h"
#include "io/geo/height_field.h"

namespace gable {

struct City::Impl {
  bool found = true;
  DiagnosticList diagnostics;
  std::shared_ptr<const Shapes::Impl> shapes = std::make_shared<Shapes::Impl>();
  CityStatistics statistics;
  CityPlan plan;
  // Without its features, which the plan's texts replace.
  MapFeatures map;
};

namespace {

// Of files of heights, in bytes.
constexpr uint64_t kLargestHeightFile = uint64_t{1} << 30;

std::shared_ptr<City::Impl> refused(const Error& e) {
  auto impl = std::make_shared<City::Impl>();
  impl->diagnostics.push_back(diagnosticOf(e));
  return impl;
}

Mesh meshOf(const CityShape& s) {
  MeshBuilder b;
  if (!s.faces.empty()) {
    for (const std::vector<Vec3>& face : s.faces) {
      work();
      std::vector<uint32_t> corners;
      for (const Vec3& p : face) corners.push_back(b.addPosition(fromPlan({p.x, p.y}, p.z)));
      b.addPolygon(corners);
    }
    return b.take();
  }
  if (s.line.empty()) return meshOf({s.polygon}, groundFrame(s.height));
  uint32_t from = b.addPosition(fromPlan(s.line[0]));
  for (size_t i = 1; i < s.line.size(); ++i) {
    const uint32_t to = b.addPosition(fromPlan(s.line[i]));
    const uint32_t ends[2] = {from, to};
    b.addPolygon(ends);
    from = to;
  }
  return b.take();
}

// Two shapes of one feature draw as two: the number of the second is part of its name.
std::shared_ptr<const Shapes::Impl> shapesOf(const CityPlan& plan, const MapFeatures& map) {
  auto out = std::make_shared<Shapes::Impl>();
  out->geoOrigin = map.geoOrigin;
  out->geo = map.geo;
  out->terrain = plan.terrain;
  out->ofMap = true;
  // A list that grows copies meshes, and hears nothing meanwhile.
  out->footprints.reserve(plan.shapes.size());
  std::map<std::pair<std::string, std::string>, uint32_t> seen;
  for (const CityShape& s : plan.shapes) {
    work();
    ShapeInput input;
    input.name = s.rule;
    const uint32_t before = seen[{s.rule, s.id}]++;
    input.id = s.rule + '/' + s.id + (before > 0 ? '/' + std::to_string(before) : "");
    input.mesh = meshOf(s);
    input.attributes = s.attributes;
    if (!s.id.empty())
      input.attributes.push_back({"id", {{PlainValue::Kind::Text, 0, s.id}}, 0, 0});
    input.attributes.push_back({kStartRuleAttribute, {{PlainValue::Kind::Text, 0, s.rule}}, 0, 0});
    out->footprints.push_back(footprint(std::move(input)));
    out->footprints.back().reachesImports = true;
  }
  return out;
}

CityStatistics statisticsOf(const CityPlan& plan, const MapFeatures& map) {
  CityStatistics out;
  out.area = plan.area.size().x * plan.area.size().y;
  for (size_t s = 0; s < kSurfaceCount; ++s) {
    out.surfaces.push_back({surfaceName(static_cast<Surface>(s)), 0, 0});
  }
  for (const GroundPiece& p : plan.ground) {
    CityStatistics::Surface& s = out.surfaces[static_cast<size_t>(p.surface)];
    ++s.pieces;
    s.area += area(p.polygon);
  }
  for (const CityStatistics::Surface& s : out.surfaces) out.groundArea += s.area;
  std::map<std::string, uint64_t> counts;
  for (const CityShape& s : plan.shapes) ++counts[s.rule];
  out.shapes.assign(counts.begin(), counts.end());
  out.features = map.features.size();
  out.skipped = map.skips.count;
  for (const MapSkips::Row& row : map.skips.first) out.skips.push_back({row.place, row.reason});
  out.box = {map.box.west, map.box.south, map.box.east, map.box.north};
  if (plan.terrain && !plan.terrain->points().empty()) {
    out.lowest = out.highest = plan.terrain->points()[0].z;
    for (const Vec3& p : plan.terrain->points()) {
      out.lowest = std::min(out.lowest, p.z);
      out.highest = std::max(out.highest, p.z);
    }
  }
  return out;
}

// Those without an id are counted.
std::string calledOf(const std::string& id) {
  constexpr std::string_view kCounted = "feature/";
  return "feature " + (id.starts_with(kCounted) ? id.substr(kCounted.size()) : id);
}

// What was left out: the first of it by name.
void tellSkipped(const MapSkips& skips, const std::string& path, DiagnosticList& out) {
  constexpr size_t kNamed = 20;
  Diagnostics list;
  for (size_t i = 0; i < std::min(skips.first.size(), kNamed); ++i) {
    list.warning("map-row", {},
                 calledOf(skips.first[i].place) + " of '" + path +
                     "' is left out: " + skips.first[i].reason);
  }
  if (skips.count > kNamed) {
    list.warning("map-rows", {},
                 std::to_string(skips.count) + " features or parts of them of '" + path +
                     "' are left out, of which the first " + std::to_string(kNamed) + " are named",
                 "mend them in a map editor where they matter");
  }
  for (Diagnostic& d : listOf(list, Sources{})) out.push_back(std::move(d));
}

// Once for each name, with the first of the features.
void tellDoubts(const std::vector<MapDoubt>& doubts, const std::string& path, DiagnosticList& out) {
  constexpr size_t kTold = 30;
  Diagnostics list;
  const auto features = [](const MapDoubt& d) {
    return std::to_string(d.count) + (d.count == 1 ? " feature" : " features");
  };
  for (size_t i = 0; i < std::min(doubts.size(), kTold); ++i) {
    const MapDoubt& d = doubts[i];
    std::string named;
    for (const auto& [id, value] : d.first) {
      named += (named.empty() ? "" : ", ") + calledOf(id) + " ('" + value + "')";
    }
    if (d.count > d.first.size()) named += ", ..";
    const std::string where = "' of " + features(d) + " of '" + path + "' ";
    if (d.meant.empty()) {
      list.warning("map-value", {},
                   "'" + d.key + where + "says no number and is not used: " + named,
                   "write a number, such as 3 or 3.5; lengths in metres, or as 12 ft or 12'6\"");
    } else {
      list.warning("map-name", {}, "'" + d.key + where + "has a name that is not known: " + named,
                   "did you mean '" + d.meant + "'?");
    }
  }
  if (doubts.size() > kTold) {
    list.warning("map-names", {},
                 std::to_string(doubts.size() - kTold) + " more names or values of '" + path +
                     "' are in doubt",
                 "mend those that are named first");
  }
  for (Diagnostic& d : listOf(list, Sources{})) out.push_back(std::move(d));
}

// A map whose columns have other names than OpenStreetMap's makes a place without a house.
void tellNoBuildings(const MapFeatures& map, const std::string& path, DiagnosticList& out) {
  constexpr size_t kTold = 12;
  std::set<std::string_view> names;
  bool more = false;
  for (const MapFeature& f : map.features) {
    if (isBuilding(f)) return;
    for (const auto& [name, value] : f.tags) {
      work();
      if (names.size() < kTold) {
        names.insert(name);
      } else {
        more = more || !names.contains(name);
      }
    }
  }
  std::string told;
  for (const std::string_view name : names) {
    told += (told.empty() ? "; their properties are '" : ", '") + std::string(name) + "'";
  }
  const std::string features = map.features.size() == 1 ? " feature" : " features";
  Diagnostics list;
  list.warning("map-no-buildings", {},
               "'" + path + "' has " + std::to_string(map.features.size()) + features +
                   " and no building" + told + (more ? ", .." : ""),
               "buildings are areas with the property 'building', such as building=yes");
  for (Diagnostic& d : listOf(list, Sources{})) out.push_back(std::move(d));
}

// A box beside all buildings of its map is a slip.
void tellBoxBesideBuildings(const MapFeatures& map, const std::string& path, DiagnosticList& out) {
  Box2 all;
  for (const MapFeature& f : map.features) {
    if (!isBuilding(f)) continue;
    Box2 own;
    for (const Ring& r : f.rings) {
      for (const Vec2 p : r) own.include(p);
    }
    if (own.empty()) continue;
    if (own.meets(map.area)) return;
    all.include(own.min);
    all.include(own.max);
  }
  if (all.empty()) return;
  // As boxes are asked for, in degrees mostly.
  const Vec2 local = map.area.max - map.area.min;
  const auto text = [&](const Vec2& p) {
    const Vec2 at = p - map.area.min;
    const auto rounded = [](double v) { return shortestText(std::round(v * 1e5) / 1e5); };
    return rounded(map.box.west + at.x / local.x * (map.box.east - map.box.west)) + "," +
           rounded(map.box.south + at.y / local.y * (map.box.north - map.box.south));
  };
  Diagnostics list;
  list.warning("map-box", {}, "no building of '" + path + "' lies in the box",
               "its buildings go from " + text(all.min) + " to " + text(all.max) +
                   "; give west,south,east,north");
  for (Diagnostic& d : listOf(list, Sources{})) out.push_back(std::move(d));
}

Result<HeightField> heightsOf(const MapFeatures& map, const std::string& path, bool& found) {
  Result<std::string> content = readFile(path, kLargestHeightFile);
  found = content.ok();
  if (!found) return content.error();
  Result<HeightRaster> raster = HeightRaster::read(*content, path);
  if (!raster.ok()) return raster.error();
  return HeightField::of(*raster, *map.geo, map.area);
}

void tellFilled(double share, const std::string& path, DiagnosticList& out) {
  if (!(share > 0)) return;
  Diagnostics list;
  const double percent = std::max(0.1, std::round(1000 * share) / 10);
  list.warning("heights-void", {},
               "'" + path + "' has no heights for " + shortestText(percent) +
                   " % of the place: they are filled from those around",
               "take a file that covers the place where that matters");
  for (Diagnostic& d : listOf(list, Sources{})) out.push_back(std::move(d));
}

std::shared_ptr<City::Impl> parsed(const std::string& content, const std::string& name,
                                   const CitySettings& settings) {
  std::optional<MapBox> box;
  if (settings.box) {
    const auto& [west, south, east, north] = *settings.box;
    box = MapBox{west, south, east, north};
  }
  Result<MapFeatures> map = readMapFeatures(content, shapeFileOptions(name), settings.layer, box);
  if (!map.ok()) return refused(map.error());
  auto impl = std::make_shared<City::Impl>();
  impl->map = std::move(*map);
  std::optional<HeightField> heights;
  if (!settings.terrain.empty()) {
    bool found = true;
    Result<HeightField> field = heightsOf(impl->map, settings.terrain, found);
    if (!field.ok()) {
      impl = refused(field.error());
      impl->found = found;
      return impl;
    }
    heights.emplace(std::move(*field));
    tellFilled(heights->filled(), settings.terrain, impl->diagnostics);
  }
  impl->plan = planCity(impl->map, settings.country, heights ? &*heights : nullptr, settings.soil);
  impl->shapes = shapesOf(impl->plan, impl->map);
  impl->statistics = statisticsOf(impl->plan, impl->map);
  tellSkipped(impl->plan.skips, name, impl->diagnostics);
  tellNoBuildings(impl->map, name, impl->diagnostics);
  if (box) tellBoxBesideBuildings(impl->map, name, impl->diagnostics);
  tellDoubts(impl->plan.doubts, name, impl->diagnostics);
  return impl;
}

}  // namespace

City City::load(const std::string& path, const CitySettings& settings, const FileLimits& limits) {
  return City(guarded<Impl>(Task("planning", path, limits), [&] {
    Result<std::string> content = readFile(path, kLargestShapeFile);
    if (content.ok()) return parsed(content.value(), path, settings);
    auto impl = refused(content.error());
    impl->found = false;
    return impl;
  }));
}

City City::parse(const std::string& content, const std::string& name, const CitySettings& settings,
                 const FileLimits& limits) {
  return City(guarded<Impl>(Task("planning", name, limits),
                            [&] { return parsed(content, name, settings); }));
}

bool City::isCountry(std::string_view code) { return isCountryCode(code); }

Shapes City::shapes() const { return Shapes(impl_->shapes); }
std::string City::groundGeoJson() const {
  return guardedValue<std::string>([&] { return planGeoJson(impl_->plan, impl_->map); });
}
const CityStatistics& City::statistics() const { return impl_->statistics; }
bool City::ok() const { return !hasErrors(impl_->diagnostics); }
bool City::found() const { return impl_->found; }
const DiagnosticList& City::diagnostics() const { return impl_->diagnostics; }

}  // namespace gable
