// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From a map to initial shapes.

#include "gable/city.h"

#include <algorithm>
#include <map>

#include "base/files.h"
#include "city/plan.h"
#include "engine/footprint.h"
#include "engine/guard.h"
#include "geom/mesh/face_plane.h"

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
  if (s.line.empty()) return meshOf({s.polygon}, groundFrame());
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
  std::map<std::pair<std::string, std::string>, uint32_t> seen;
  for (const CityShape& s : plan.shapes) {
    work();
    ShapeInput input;
    input.name = s.rule;
    const uint32_t before = seen[{s.rule, s.id}]++;
    input.id = s.rule + '/' + s.id + (before > 0 ? '/' + std::to_string(before) : "");
    input.mesh = meshOf(s);
    input.attributes = s.attributes;
    input.attributes.push_back({kStartRuleAttribute, {{PlainValue::Kind::Text, 0, s.rule}}, 0, 0});
    out->footprints.push_back(footprint(std::move(input)));
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
  return out;
}

// What was left out: the first of it by name.
void tellSkipped(const MapSkips& skips, const std::string& path, DiagnosticList& out) {
  constexpr size_t kNamed = 20;
  Diagnostics list;
  for (size_t i = 0; i < std::min(skips.first.size(), kNamed); ++i) {
    list.warning(
        "map-row", {},
        "'" + skips.first[i].place + "' of '" + path + "' is left out: " + skips.first[i].reason);
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
      named += (named.empty() ? "" : ", ") + id + " ('" + value + "')";
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
  impl->plan = planCity(impl->map, settings.country);
  impl->shapes = shapesOf(impl->plan, impl->map);
  impl->statistics = statisticsOf(impl->plan, impl->map);
  tellSkipped(impl->plan.skips, name, impl->diagnostics);
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

Shapes City::shapes() const { return Shapes(impl_->shapes); }
std::string City::groundGeoJson() const {
  return guardedValue<std::string>([&] { return planGeoJson(impl_->plan, impl_->map); });
}
const CityStatistics& City::statistics() const { return impl_->statistics; }
bool City::ok() const { return !hasErrors(impl_->diagnostics); }
bool City::found() const { return impl_->found; }
const DiagnosticList& City::diagnostics() const { return impl_->diagnostics; }

}  // namespace gable
