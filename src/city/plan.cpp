// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>

#include "base/check.h"
#include "base/json.h"
#include "base/measure.h"
#include "base/work.h"
#include "city/bridges.h"
#include "city/building_kind.h"
#include "city/building_points.h"
#include "city/buildings.h"
#include "city/country.h"
#include "city/ribbon.h"
#include "city/rows.h"
#include "city/soil.h"
#include "city/street_grade.h"
#include "city/terrain.h"
#include "city/walls.h"
#include "geom/curve/curve.h"
#include "geom/region/boolean.h"

namespace gable {
namespace {

constexpr double kLeastBuilding = 3;
constexpr double kLeastPart = 0.5;
constexpr double kLeastKerb = 0.2;
// No building reaches farther beyond the place, in metres.
constexpr double kMostBeyond = 2000;

PlainValue plain(double v) { return {PlainValue::Kind::Number, v, {}}; }
AttributeValue number(const char* name, double v) { return {name, {plain(v)}, 0, 0}; }
AttributeValue truth(const char* name, bool v) {
  return {name, {{PlainValue::Kind::Bool, v ? 1.0 : 0.0, {}}}, 0, 0};
}
PlainValue text(std::string v) { return {PlainValue::Kind::Text, 0, std::move(v)}; }

std::vector<AttributeValue> tagsOf(const MapFeature& f) {
  std::vector<AttributeValue> out;
  for (const auto& [name, value] : f.tags) {
    std::optional<std::string> plain = plainTag(name, value);
    if (plain) out.push_back({name, {text(std::move(*plain))}, 0, 0});
  }
  return out;
}

// A value for each edge.
AttributeValue list(const char* name, std::vector<PlainValue> values) {
  AttributeValue out{name, std::move(values), 1, 0};
  out.columns = static_cast<uint32_t>(out.values.size());
  return out;
}

bool isRoadway(Surface s) { return s == Surface::Carriageway || s == Surface::Junction; }

// What people walk on is higher than roadways, and those than water.
int stepOf(Surface s) {
  if (s == Surface::Water || s == Surface::Sea) return 0;
  return isRoadway(s) || s == Surface::ParkingLot ? 1 : 2;
}

constexpr const char* kColourTags[] = {"building:colour", "roof:colour"};
bool isColourTag(std::string_view name) {
  return std::find(std::begin(kColourTags), std::end(kColourTags), name) != std::end(kColourTags);
}

class Planner {
 public:
  Planner(const MapFeatures& map, const std::string& country, const HeightField* heights,
          std::optional<double> soil)
      : map_(map),
        country_(country.empty() ? countryOf(map) : country),
        streets_(streetsOf(map.features)),
        facts_(buildingFactsOf(map.features)),
        points_(buildingPointsOf(map.features)) {
    out_.area = map.area;
    out_.skips = map.skips;
    out_.doubts = doubtsOf(map.features);
    leftOut_ = buildingsBeyond(map.features, facts_, map.area);
    out_.ground = groundOf(map.features, streets_, map.area, leftOut_);
    index_ = std::make_unique<GroundIndex>(out_.ground);
    const Box2 whole = wholeArea();
    if (!(whole.min == map.area.min && whole.max == map.area.max)) {
      standing_ = groundOf(map.features, streets_, whole, leftOut_);
      standingIndex_ = std::make_unique<GroundIndex>(standing_);
    }
    joinRows(under(), map.features, facts_);
    if (heights) makeTerrain(*heights);
    if (heights && soil.value_or(1) > 0) soil_ = soilBelow(*out_.terrain, soil);
  }

  CityPlan plan() {
    for (const GroundPiece& p : out_.ground) addGround(p);
    for (const GroundPiece& p : under()) {
      if (p.surface == Surface::Footprint && p.feature != GroundPiece::kNothing) addBuilding(p);
    }
    for (uint32_t i = 0; i < map_.features.size(); ++i) {
      work();
      addAbove(i);
      addLine(map_.features[i]);
      addThing(map_.features[i]);
    }
    addStreets();
    addCrossings();
    for (uint32_t i = 0; i < streets_.stretches.size(); ++i) addParking(streets_.stretches[i], i);
    addBridges();
    addTerrainWalls();
    addSoil();
    return std::move(out_);
  }

 private:
  // The area, and what of its buildings reaches beyond it.
  Box2 wholeArea() const {
    Box2 out = map_.area;
    for (uint32_t i = 0; i < map_.features.size(); ++i) {
      const MapFeature& f = map_.features[i];
      if (leftOut_[i] || (!isBuilding(f) && !isBuildingPart(f))) continue;
      for (const Ring& r : f.rings) {
        work(r.size());
        for (const Vec2 p : r) out.include(p);
      }
    }
    const Vec2 most{kMostBeyond, kMostBeyond};
    const Vec2 low = map_.area.min - most, high = map_.area.max + most;
    out.min = {std::max(out.min.x, low.x), std::max(out.min.y, low.y)};
    out.max = {std::min(out.max.x, high.x), std::min(out.max.y, high.y)};
    return out;
  }
  // The ground that buildings stand on, whole: that of the place where none reaches beyond it.
  const std::vector<GroundPiece>& under() const { return standingIndex_ ? standing_ : out_.ground; }
  GroundIndex& underIndex() const { return standingIndex_ ? *standingIndex_ : *index_; }

  CityShape& add(const char* rule, const std::string& id) {
    GABLE_DCHECK(std::binary_search(cityRules().begin(), cityRules().end(), rule));
    out_.shapes.emplace_back();
    out_.shapes.back().rule = rule;
    out_.shapes.back().id = id;
    return out_.shapes.back();
  }

  void makeTerrain(const HeightField& heights) {
    const StreetGrade grade(heights, map_.features, streets_, map_.area);
    Terrain terrain = terrainOf(heights, grade, map_.features, out_.ground);
    out_.terrain = std::move(terrain.surface);
    for (size_t i = 0; i < out_.ground.size(); ++i) {
      const GroundPiece& p = out_.ground[i];
      if (p.surface == Surface::Footprint) floors_.try_emplace(p.feature, i);
    }
    terrainWalls_ = std::move(terrain.walls);
  }
  double groundAt(Vec2 p) const { return out_.terrain ? out_.terrain->heightAt(p) : 0; }

  // Below floors, and beside what lies level.
  void addTerrainWalls() {
    for (TerrainWall& w : terrainWalls_) {
      const GroundPiece &piece = out_.ground[w.piece], &beyond = out_.ground[w.beyond];
      const bool isPlinth = piece.surface == Surface::Footprint;
      const bool known = piece.feature != GroundPiece::kNothing;
      CityShape& shape = add(isPlinth ? "Plinth" : "RetainingWall",
                             known ? map_.features[piece.feature].id : std::string());
      shape.faces = std::move(w.faces);
      shape.attributes.push_back({"of", {text(surfaceName(piece.surface))}, 0, 0});
      shape.attributes.push_back({"beyond", {text(surfaceName(beyond.surface))}, 0, 0});
    }
  }

  void addSoil() {
    for (SoilSide& s : soil_.sides) {
      const std::string surface = surfaceName(out_.ground[s.piece].surface);
      for (auto [rule, faces] : {std::pair("Soil", &s.side), std::pair("SoilRim", &s.rim)}) {
        CityShape& shape = add(rule, std::string());
        shape.faces = std::move(*faces);
        shape.attributes.push_back({"of", {text(surface)}, 0, 0});
      }
    }
    if (!soil_.bottom.empty()) add("Soil", "bottom").faces.push_back(std::move(soil_.bottom));
  }

  void addGround(const GroundPiece& p) {
    const MapFeature* f = p.feature == GroundPiece::kNothing ? nullptr : &map_.features[p.feature];
    CityShape& shape = add(surfaceName(p.surface), f ? f->id : std::string());
    shape.polygon = p.polygon;
    if (f) shape.attributes = tagsOf(*f);
    std::vector<PlainValue> beyond, widths;
    bool hasPaths = false;
    for (const uint32_t b : p.beyond) {
      const bool known = b != GroundPiece::kNothing;
      const Surface s = known ? out_.ground[b].surface : Surface::Lot;
      beyond.push_back(text(known ? surfaceName(s) : ""));
      hasPaths = hasPaths || (known && s == Surface::Path);
      PlainValue width;
      width.number = known && isRoadway(s) && !isRoadway(p.surface) ? 1 : 0;
      widths.push_back(width);
    }
    shape.attributes.push_back(list("/edgeattr/beyond", std::move(beyond)));
    shape.attributes.push_back(list("streetWidth", std::move(widths)));
    if (p.surface == Surface::Lot) shape.attributes.push_back(truth("is_court", isCourt(p)));
    if (p.surface == Surface::Park) shape.attributes.push_back(truth("has_paths", hasPaths));
    addKerbs(p, f);
  }

  // Whether buildings stand along most of a piece's border.
  bool isCourt(const GroundPiece& p) const {
    double all = 0, built = 0;
    size_t edge = 0;
    const auto ring = [&](const Ring& r) {
      for (size_t i = 0; i < r.size(); ++i, ++edge) {
        const double l = length(r[(i + 1) % r.size()] - r[i]);
        const uint32_t b = p.beyond[edge];
        all += l;
        if (b != GroundPiece::kNothing && out_.ground[b].surface == Surface::Footprint) built += l;
      }
    };
    ring(p.polygon.outer);
    for (const Ring& h : p.polygon.holes) ring(h);
    return built > 0.6 * all;
  }

  // The surface beyond an edge that lies lower; nothing where there is no step.
  std::optional<Surface> lowerBeyond(const GroundPiece& p, size_t edge) const {
    const uint32_t b = p.beyond[edge];
    if (b == GroundPiece::kNothing) return std::nullopt;
    const Surface s = out_.ground[b].surface;
    // Walls of buildings reach down to the roadway.
    const bool hidden = p.surface == Surface::Footprint && stepOf(s) == 1;
    return stepOf(s) < stepOf(p.surface) && !hidden ? std::optional(s) : std::nullopt;
  }

  // Steps down from a piece: lines along its border, the piece on their left.
  void addKerbs(const GroundPiece& p, const MapFeature* f) {
    size_t first = 0;
    const auto ring = [&](const Ring& r) {
      const size_t n = r.size();
      const auto beyond = [&](size_t i) { return lowerBeyond(p, first + i % n); };
      // Lines begin where the one before ends; without such a place they go round.
      size_t start = 0;
      while (start < n && beyond(start) == beyond(start + n - 1)) ++start;
      start %= n;
      for (size_t i = 0; i < n;) {
        work();
        const std::optional<Surface> lower = beyond(start + i);
        std::vector<Vec2> line{r[(start + i) % n]};
        for (; i < n && beyond(start + i) == lower; ++i) line.push_back(r[(start + i + 1) % n]);
        if (lower && lineLength(line) >= kLeastKerb) addKerb(p, f, *lower, std::move(line));
      }
      first += n;
    };
    ring(p.polygon.outer);
    for (const Ring& h : p.polygon.holes) ring(h);
  }
  void addKerb(const GroundPiece& p, const MapFeature* f, Surface lower, std::vector<Vec2> line) {
    CityShape& shape = add("Kerb", f ? f->id : std::string());
    shape.line = std::move(line);
    if (f) shape.attributes = tagsOf(*f);
    shape.attributes.push_back({"of", {text(surfaceName(p.surface))}, 0, 0});
    shape.attributes.push_back({"beyond", {text(surfaceName(lower))}, 0, 0});
  }

  // Tags of colours as colours; those of a part that it lacks are its building's.
  void describe(CityShape& shape, uint32_t feature, double attached) const {
    const BuildingFacts& facts = facts_[feature];
    const MapFeature& f = map_.features[feature];
    const bool isPart = facts.owner != BuildingFacts::kNone;
    const uint32_t whole = isPart ? facts.owner : feature;
    const MapFeature& owner = map_.features[whole];
    for (AttributeValue& a : tagsOf(f)) {
      if (!isColourTag(a.name)) shape.attributes.push_back(std::move(a));
    }
    for (const char* name : kColourTags) {
      const std::string_view own = f.tag(name);
      std::string colour = colourOfTag(own.empty() ? owner.tag(name) : own);
      if (!colour.empty()) shape.attributes.push_back({name, {text(std::move(colour))}, 0, 0});
    }
    const double levels = facts_[whole].levels;
    const BuildingSize size{facts_[whole].area, levels > 0 ? levels : facts_[whole].guessedLevels,
                            attached};
    const std::string_view kind = buildingKindOf(owner, size, facts_[whole].landUse);
    shape.attributes.push_back({"kind", {text(std::string(kind))}, 0, 0});
    if (!country_.empty()) shape.attributes.push_back({"country", {text(country_)}, 0, 0});
    shape.attributes.push_back(number("known_levels", facts.levels));
    shape.attributes.push_back(number("guessed_levels", facts.guessedLevels));
    shape.attributes.push_back(truth("has_parts", facts.hasParts));
    describePoints(shape, feature);
  }

  // What the map has as points in a building, where the building itself does not say it.
  void describePoints(CityShape& shape, uint32_t feature) const {
    const auto at = points_.find(feature);
    const double count = at == points_.end() ? 0 : static_cast<double>(at->second.shops.size());
    shape.attributes.push_back(number("shops", count));
    if (at == points_.end()) return;
    const BuildingPoints& points = at->second;
    for (const auto& [name, value] : points.tags) {
      if (map_.features[feature].tag(name).empty()) {
        shape.attributes.push_back({name, {text(value)}, 0, 0});
      }
    }
    shape.attributes.push_back({"addresses", {text(points.addresses)}, 0, 0});
    shape.attributes.push_back({"names", {text(points.names)}, 0, 0});
  }

  // What each wall looks at: `beyond`, the storeys of a neighbour there, metres to the street.
  void describeWalls(CityShape& shape, const BuildingOutline& outline) const {
    std::vector<PlainValue> beyond, levels, street, widths, entrance, shops;
    for (const Wall& w : outline.walls) {
      const bool known = w.beyond != GroundPiece::kNothing;
      const GroundPiece* piece = known ? &under()[w.beyond] : nullptr;
      beyond.push_back(text(known ? surfaceName(piece->surface) : ""));
      const bool party = known && piece->surface == Surface::Footprint;
      double storeys = 0;
      if (party && piece->feature != GroundPiece::kNothing) {
        const BuildingFacts& other = facts_[piece->feature];
        storeys = other.levels > 0 ? other.levels : other.guessedLevels;
      }
      levels.push_back(plain(storeys));
      street.push_back(plain(w.street));
      widths.push_back(plain(w.street > 0 ? 1 : 0));
      entrance.push_back(plain(w.entrance ? 1 : 0));
      shops.push_back(plain(w.shops));
    }
    // Walls beside each other have different numbers, so that rules can tell them apart.
    std::vector<PlainValue> turn;
    const auto count = [&](const Ring& r) {
      for (size_t i = 0; i < r.size(); ++i) {
        turn.push_back(plain(i + 1 == r.size() && i % 2 == 0 ? 2 : static_cast<double>(i % 2)));
      }
    };
    count(outline.polygon.outer);
    for (const Ring& h : outline.polygon.holes) count(h);
    shape.attributes.push_back(list("/edgeattr/turn", std::move(turn)));
    shape.attributes.push_back(list("/edgeattr/beyond", std::move(beyond)));
    shape.attributes.push_back(list("/edgeattr/beyond_levels", std::move(levels)));
    shape.attributes.push_back(list("/edgeattr/street", std::move(street)));
    shape.attributes.push_back(list("/edgeattr/entrance", std::move(entrance)));
    shape.attributes.push_back(list("/edgeattr/shops", std::move(shops)));
    shape.attributes.push_back(list("streetWidth", std::move(widths)));
  }

  double floorOf(const GroundPiece& piece) const {
    if (!out_.terrain) return 0;
    size_t number = static_cast<size_t>(&piece - out_.ground.data());
    if (standingIndex_) {
      // What reaches beyond the place has the floor of what lies within.
      const auto within = floors_.find(piece.feature);
      if (within == floors_.end()) return groundAt(bounds(piece.polygon).center());
      number = within->second;
    }
    return out_.terrain->points()[out_.terrain->pieces()[number].firstPoint].z;
  }

  void addBuilding(const GroundPiece& piece) {
    if (area(piece.polygon) < kLeastBuilding) return;
    BuildingOutline outline = outlineOf(piece, under());
    const double floor = floorOf(piece);
    const auto climb = [&](Vec2 p) { return std::fabs(groundAt(p) - floor); };
    findStreets(outline, under(), underIndex(), climb);
    findDoors(outline, piece.feature);
    CityShape& shape = add("Building", map_.features[piece.feature].id);
    shape.height = floor;
    const double attached = attachedShare(outline, under());
    describe(shape, piece.feature, attached);
    shape.attributes.push_back(number("attached_share", attached));
    const uint32_t edge = roofEdgeOf(outline, map_.features[piece.feature], attached > 0.1);
    shape.attributes.push_back(number("roof_edge", edge));
    shape.attributes.push_back(number("row_chance", facts_[piece.feature].rowChance));
    if (!facts_[piece.feature].rowRoof.empty()) {
      std::string roof(facts_[piece.feature].rowRoof);
      shape.attributes.push_back({"row_roof", {text(std::move(roof))}, 0, 0});
    }
    describeWalls(shape, outline);
    shape.polygon = std::move(outline.polygon);
  }

  // Doors and shops of a building that is divided stand at the piece that is nearest to them.
  void findDoors(BuildingOutline& outline, uint32_t feature) const {
    const auto at = points_.find(feature);
    if (at == points_.end()) return;
    const auto near = [&](std::vector<Vec2> list) {
      list.erase(std::remove_if(list.begin(), list.end(),
                                [&](Vec2 p) { return !isNear(outline.polygon, p); }),
                 list.end());
      return list;
    };
    placeDoors(outline, under(), near(at->second.entrances), near(at->second.shops));
  }
  static bool isNear(const Polygon& polygon, Vec2 p) {
    constexpr double kNear = 1;
    const Box2 box = bounds(polygon);
    return p.x >= box.min.x - kNear && p.x <= box.max.x + kNear && p.y >= box.min.y - kNear &&
           p.y <= box.max.y + kNear;
  }

  // Parts of buildings, and buildings that take no ground: roofs on posts, what stands on others.
  void addAbove(uint32_t feature) {
    const MapFeature& f = map_.features[feature];
    const bool part = isBuildingPart(f);
    if (leftOut_[feature] || (!part && (!isBuilding(f) || isOnGround(f)))) return;
    if (writtenNumber(f.tag("layer")).value_or(0) < 0 || f.tag("location") == "underground") return;
    const bool roof = f.tag("building") == "roof" || f.tag("building:part") == "roof";
    for (const Polygon& p : repaired(f.rings, FillRule::EvenOdd)) {
      if (area(p) < kLeastPart) continue;
      CityShape& shape = add(roof ? "Canopy" : part ? "BuildingPart" : "Building", f.id);
      BuildingOutline outline = outlineOf(p);
      findStreets(outline, under(), underIndex());
      findDoors(outline, feature);
      describe(shape, feature, 0);
      shape.attributes.push_back(number("roof_edge", roofEdgeOf(outline, f, false)));
      shape.height = groundAt(bounds(p).center());
      describeWalls(shape, outline);
      shape.polygon = std::move(outline.polygon);
    }
  }

  void addLine(const MapFeature& f) {
    if (f.kind != MapFeature::Kind::Line || !isOnGround(f)) return;
    const char* rule = nullptr;
    const std::string_view rail = f.tag("railway");
    if (rail == "rail" || rail == "tram" || rail == "light_rail" || rail == "narrow_gauge") {
      rule = "Rails";
    } else if (f.tag("natural") == "tree_row") {
      rule = "TreeRow";
    } else {
      for (const char* kind : {"wall", "city_wall", "retaining_wall", "fence", "hedge"}) {
        if (f.tag("barrier") == kind) rule = "Barrier";
      }
    }
    if (!rule) return;
    // What lies in the area, as far as points tell.
    std::vector<Vec2> line;
    const auto finish = [&] {
      if (line.size() > 1) {
        CityShape& shape = add(rule, f.id);
        shape.line = line;
        shape.attributes = tagsOf(f);
      }
      line.clear();
    };
    for (const Vec2 p : f.points) {
      if (out_.area.contains(p)) {
        line.push_back(p);
      } else {
        finish();
      }
    }
    finish();
  }

  void addThing(const MapFeature& f) {
    if (f.kind != MapFeature::Kind::Point || !isOnGround(f)) return;
    const bool tree = f.tag("natural") == "tree", lamp = f.tag("highway") == "street_lamp";
    if (!tree && !lamp) return;
    const uint32_t piece = index_->pieceAt(f.points[0]);
    if (piece == GroundPiece::kNothing) return;
    const Surface s = out_.ground[piece].surface;
    // Streets are as wide as usual here, and may be narrower there.
    if (isRoadway(s) || s == Surface::Footprint || s == Surface::Sea || s == Surface::Water) return;
    CityShape& shape = add(tree ? "Tree" : "StreetLamp", f.id);
    const Vec2 p = f.points[0];
    shape.polygon.outer = {{p.x - 0.5, p.y - 0.5},
                           {p.x + 0.5, p.y - 0.5},
                           {p.x + 0.5, p.y + 0.5},
                           {p.x - 0.5, p.y + 0.5}};
    shape.attributes = tagsOf(f);
  }

  void addStreets() {
    for (const Stretch& s : streets_.stretches) {
      const double whole = lineLength(s.line);
      const std::vector<Vec2> middle = linePart(s.line, s.cutBegin, whole - s.cutEnd);
      // In the area, whole.
      const bool inside =
          std::all_of(middle.begin(), middle.end(), [&](Vec2 p) { return out_.area.contains(p); });
      if (!inside || whole - s.cutBegin - s.cutEnd < 1) continue;
      CityShape& shape = add("Street", map_.features[s.feature].id);
      shape.line = middle;
      describeStreet(shape, s);
      shape.attributes.push_back(number("left_walk", s.profile.leftWalk));
      shape.attributes.push_back(number("right_walk", s.profile.rightWalk));
      shape.attributes.push_back(truth("at_junction", s.cutEnd > 0));
    }
  }

  // What the map says of parking at a side of a street; empty where it says nothing.
  static std::string_view parkingAt(const MapFeature& f, const std::string& side) {
    for (const std::string& key : {"parking:" + side, std::string("parking:both"),
                                   "parking:lane:" + side, std::string("parking:lane:both")}) {
      const std::string_view value = f.tag(key);
      if (!value.empty()) return value;
    }
    return {};
  }

  // Lines along kerbs where cars can stand: on the carriageway for all their width, away from
  // junctions and crossings.
  void addParking(const Stretch& s, uint32_t number) {
    constexpr double kCar = 2, kFromKerb = 0.15, kStep = 2, kFromEnds = 6, kLeast = 5;
    const Path path(s.line);
    const double from = s.cutBegin + kFromEnds, to = path.length() - s.cutEnd - kFromEnds;
    if (s.profile.width < kCar + 1 || !(to - from >= kLeast)) return;
    for (const double side : {1.0, -1.0}) {
      std::vector<Vec2> line;
      const auto end = [&] {
        if (line.size() >= 3) addParkingLane(s, side, std::move(line));
        line.clear();
      };
      for (double along = from; along <= to; along += kStep) {
        work();
        const Path::Place place = path.at(along);
        const Vec2 across{place.tangent.y * side, -place.tangent.x * side};
        const double kerb = 0.5 * s.profile.width - kFromKerb;
        const bool free = isCarriageway(place.point + across * kerb) &&
                          isCarriageway(place.point + across * (kerb - kCar)) &&
                          !isAtCrossing(number, along);
        if (!free) {
          end();
          continue;
        }
        line.push_back(place.point + across * (kerb - 0.5 * kCar));
      }
      end();
    }
  }
  bool isCarriageway(Vec2 p) const {
    const uint32_t piece = index_->pieceAt(p);
    return piece != GroundPiece::kNothing && out_.ground[piece].surface == Surface::Carriageway;
  }
  bool isAtCrossing(uint32_t stretch, double along) const {
    constexpr double kClear = 6;
    const auto next = crossings_.lower_bound({stretch, along - kClear});
    return next != crossings_.end() && next->first == stretch && next->second <= along + kClear;
  }
  void addParkingLane(const Stretch& s, double side, std::vector<Vec2> line) {
    const MapFeature& f = map_.features[s.feature];
    CityShape& shape = add("ParkingLane", f.id);
    shape.line = std::move(line);
    describeStreet(shape, s);
    const std::string name = side > 0 ? "right" : "left";
    shape.attributes.push_back({"side", {text(name)}, 0, 0});
    shape.attributes.push_back({"parking", {text(std::string(parkingAt(f, name)))}, 0, 0});
  }
  void describeStreet(CityShape& shape, const Stretch& s) const {
    for (AttributeValue& a : tagsOf(map_.features[s.feature])) {
      if (a.name != "width" && a.name != "lanes") shape.attributes.push_back(std::move(a));
    }
    shape.attributes.push_back(number("width", s.profile.width));
    shape.attributes.push_back(number("lanes", s.profile.lanes));
    shape.attributes.push_back(truth("one_way", s.profile.oneway));
  }

  void addBridges() {
    GroundHeight height;
    if (out_.terrain) height = [&](Vec2 p) { return groundAt(p); };
    for (const Bridge& b : bridgesOf(map_.features, streets_, height)) {
      const MapFeature& f = map_.features[b.feature];
      for (BridgeShape& s : shapesOf(b, out_.area, out_.ground, *index_, height)) {
        CityShape& shape = add(s.rule, f.id);
        shape.faces = std::move(s.faces);
        for (AttributeValue& a : tagsOf(f)) {
          if (a.name != "width" && a.name != "height") shape.attributes.push_back(std::move(a));
        }
        shape.attributes.push_back(number("width", b.width));
        shape.attributes.push_back(number("thickness", b.thickness));
        const char* const carries = b.isStreet ? "street" : b.isRail ? "rails" : "path";
        shape.attributes.push_back({"carries", {text(carries)}, 0, 0});
        if (s.height > 0) shape.attributes.push_back(number("height", s.height));
      }
    }
  }

  // Where the map has a crossing on a street: a rectangle from kerb to kerb, outside of junctions.
  void addCrossings() {
    std::map<std::pair<double, double>, std::pair<uint32_t, double>> places;
    for (uint32_t i = 0; i < streets_.stretches.size(); ++i) {
      const Stretch& s = streets_.stretches[i];
      double along = 0;
      for (size_t k = 0; k < s.line.size(); ++k) {
        work();
        if (k > 0) along += length(s.line[k] - s.line[k - 1]);
        places.emplace(std::pair(s.line[k].x, s.line[k].y), std::pair(i, along));
      }
    }
    for (const MapFeature& f : map_.features) {
      if (f.kind != MapFeature::Kind::Point || f.tag("highway") != "crossing") continue;
      const auto at = places.find({f.points[0].x, f.points[0].y});
      if (at == places.end() || !out_.area.contains(f.points[0])) continue;
      crossings_.insert(at->second);
      addCrossing(f, streets_.stretches[at->second.first], at->second.second);
    }
  }

  void addCrossing(const MapFeature& f, const Stretch& s, double along) {
    constexpr double kLong = 3;
    const Path path(s.line);
    const double low = s.cutBegin + kLong / 2 + 0.3,
                 high = path.length() - s.cutEnd - kLong / 2 - 0.3;
    if (low > high) return;
    const Path::Place place = path.at(std::clamp(along, low, high));
    const Vec2 on = place.tangent * (kLong / 2);
    const Vec2 side = Vec2{-place.tangent.y, place.tangent.x} * (s.profile.width / 2);
    CityShape& shape = add("Crossing", f.id);
    // The first edge runs across the street.
    shape.polygon.outer = {place.point - side + on, place.point + side + on,
                           place.point + side - on, place.point - side - on};
    shape.attributes = tagsOf(f);
    shape.attributes.push_back(number("street_width", s.profile.width));
  }

  const MapFeatures& map_;
  std::string country_;
  Streets streets_;
  std::vector<BuildingFacts> facts_;
  std::map<uint32_t, BuildingPoints> points_;
  // Buildings that belong to the place beside.
  std::vector<bool> leftOut_;
  CityPlan out_;
  std::unique_ptr<GroundIndex> index_;
  // Of a larger area, so that buildings at the border are whole; only where there are such.
  std::vector<GroundPiece> standing_;
  std::unique_ptr<GroundIndex> standingIndex_;
  // Stretches, and how far along each.
  std::set<std::pair<uint32_t, double>> crossings_;
  std::vector<TerrainWall> terrainWalls_;
  SoilBlock soil_;
  // The first piece of the ground under each building.
  std::unordered_map<uint32_t, size_t> floors_;
};

}  // namespace

CityPlan planCity(const MapFeatures& map, const std::string& country, const HeightField* heights,
                  std::optional<double> soil) {
  return Planner(map, country, heights, soil).plan();
}

const std::vector<std::string_view>& cityRules() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> names{
        "Barrier",    "BridgeDeck",   "BridgeParapet", "BridgePier", "BridgeRail", "BridgeWall",
        "Building",   "BuildingPart", "Canopy",        "Crossing",   "Kerb",       "ParkingLane",
        "Plinth",     "Rails",        "RetainingWall", "Soil",       "SoilRim",    "Street",
        "StreetLamp", "Tree",         "TreeRow"};
    for (size_t s = 0; s < kSurfaceCount; ++s)
      names.push_back(surfaceName(static_cast<Surface>(s)));
    std::sort(names.begin(), names.end());
    return names;
  }();
  return all;
}

bool liesOnGround(std::string_view rule) {
  for (size_t s = 0; s < kSurfaceCount; ++s) {
    if (rule == surfaceName(static_cast<Surface>(s))) return true;
  }
  constexpr std::string_view kLying[] = {"Kerb",    "Street",     "Crossing", "Rails",
                                         "TreeRow", "Barrier",    "Tree",     "StreetLamp",
                                         "SoilRim", "ParkingLane"};
  return std::find(std::begin(kLying), std::end(kLying), rule) != std::end(kLying);
}

std::string planGeoJson(const CityPlan& plan, const MapFeatures& map) {
  std::string out;
  JsonWriter w(out);
  const auto ring = [&](const Ring& r) {
    w.beginArray();
    for (size_t i = 0; i <= r.size(); ++i) {
      work();
      const Vec2 p = r[i % r.size()];
      const GeoPlace at = map.geo ? map.geo->at(p) : GeoPlace{p.x, p.y, {}};
      w.beginArray();
      w.value(at.degrees ? at.degrees->longitude : at.x);
      w.value(at.degrees ? at.degrees->latitude : at.y).endArray();
    }
    w.endArray();
  };
  w.beginObject().field("type", "FeatureCollection").key("features").beginArray();
  for (const GroundPiece& p : plan.ground) {
    out += '\n';
    w.beginObject().field("type", "Feature").key("properties").beginObject();
    w.field("surface", surfaceName(p.surface));
    if (p.feature != GroundPiece::kNothing) w.field("id", map.features[p.feature].id);
    w.field("area", area(p.polygon)).endObject();
    w.key("geometry").beginObject().field("type", "Polygon").key("coordinates").beginArray();
    ring(p.polygon.outer);
    for (const Ring& h : p.polygon.holes) ring(h);
    w.endArray().endObject().endObject();
  }
  w.endArray().endObject();
  out += '\n';
  return out;
}

}  // namespace gable
