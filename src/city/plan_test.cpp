// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The ground of small hostile maps and of two real ones.

#include "city/plan.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include "base/child_process.h"
#include "base/files.h"
#include "geom/region/clean.h"
#include "geom/region/segment_grid.h"

namespace gable {
namespace {

// A feature of GeoJSON in metres.
std::string feature(const std::string& tags, const std::string& kind, const std::string& at) {
  return R"({"type":"Feature","properties":{)" + tags + R"(},"geometry":{"type":")" + kind +
         R"(","coordinates":)" + at + "}}";
}

Result<MapFeatures> mapOf(const std::vector<std::string>& features) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"properties":{"name":"EPSG:32632"}},"features":[)";
  for (size_t i = 0; i < features.size(); ++i) text += (i ? "," : "") + features[i];
  return readMapFeatures(text + "]}", {"a.geojson", {}, false}, {}, MapBox{0, 0, 200, 200});
}

double areaOf(const CityPlan& plan, Surface s) {
  double sum = 0;
  for (const GroundPiece& p : plan.ground) sum += p.surface == s ? area(p.polygon) : 0;
  return sum;
}
size_t countOf(const CityPlan& plan, const std::string& rule) {
  size_t n = 0;
  for (const CityShape& s : plan.shapes) n += s.rule == rule;
  return n;
}

// Areas add up, polygons are valid, and each edge within has its counterpart in one neighbour.
void expectWhole(const CityPlan& plan) {
  const double whole = plan.area.size().x * plan.area.size().y;
  double sum = 0;
  std::map<std::tuple<double, double, double, double>, uint32_t> edges;
  for (uint32_t i = 0; i < plan.ground.size(); ++i) {
    const Polygon& p = plan.ground[i].polygon;
    sum += area(p);
    EXPECT_TRUE(isValid(p)) << surfaceName(plan.ground[i].surface) << ' ' << i;
    for (const Segment& s : edgesOf(p)) {
      EXPECT_TRUE(edges.emplace(std::tuple(s.a.x, s.a.y, s.b.x, s.b.y), i).second);
    }
  }
  // Corners of the area lie on a grid of four millimetres.
  EXPECT_NEAR(sum, whole, 1e-4 * whole);
  size_t atBorder = 0;
  for (const GroundPiece& p : plan.ground) {
    const std::vector<Segment> own = edgesOf(p.polygon);
    ASSERT_EQ(own.size(), p.beyond.size());
    for (size_t k = 0; k < own.size(); ++k) {
      const auto at = edges.find({own[k].b.x, own[k].b.y, own[k].a.x, own[k].a.y});
      EXPECT_EQ(p.beyond[k], at == edges.end() ? GroundPiece::kNothing : at->second);
      if (at != edges.end()) continue;
      ++atBorder;
      const auto near = [](double v, double w) { return std::fabs(v - w) < 0.01; };
      const Vec2 a = own[k].a, b = own[k].b;
      EXPECT_TRUE((near(a.x, b.x) && (near(a.x, plan.area.min.x) || near(a.x, plan.area.max.x))) ||
                  (near(a.y, b.y) && (near(a.y, plan.area.min.y) || near(a.y, plan.area.max.y))));
    }
  }
  EXPECT_GE(atBorder, 4u);
}

TEST(CityPlan, EachPlaceHasOneSurface) {
  auto map = mapOf(
      {feature(R"("highway":"residential")", "LineString", "[[0,100],[200,100]]"),
       feature(R"("leisure":"park")", "Polygon", "[[[0,90],[80,90],[80,190],[0,190],[0,90]]]"),
       feature(R"("natural":"water")", "Polygon",
               "[[[10,120],[20,120],[20,130],[10,130],[10,120]]]"),
       feature(R"("building":"yes")", "Polygon",
               "[[[100,101],[120,101],[120,121],[100,121],[100,101]]]")});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  expectWhole(plan);
  EXPECT_NEAR(areaOf(plan, Surface::Footprint), 400, 0.1);
  EXPECT_NEAR(areaOf(plan, Surface::Water), 100, 0.1);
  // The house stands two metres in a street of six.
  EXPECT_NEAR(areaOf(plan, Surface::Carriageway), 200 * 6 - 20 * 2, 0.5);
  EXPECT_NEAR(areaOf(plan, Surface::Park), 80 * 90 - 100, 0.5);
  EXPECT_EQ(countOf(plan, "Building"), 1u);
  EXPECT_EQ(countOf(plan, "Street"), 1u);
}

TEST(CityPlan, BadRowsAreCountedAndNamed) {
  auto map = mapOf(
      {feature(R"("highway":"residential")", "LineString", "[[5,5],[5,5]]"),
       feature(R"("building":"yes")", "Polygon", "[[[1,1],[2,2]]]"),
       feature(R"("building":"yes")", "Polygon", R"([[[1,1],["x",2],[3,3]]])"),
       feature(R"("building":"yes")", "Polygon", "[[[50,50],[60,50],[60,60],[50,60]],[[1,1]]]"),
       feature(R"("building":"yes")", "Blob", "[]"), "7", R"({"type":"Feature"})"});
  ASSERT_TRUE(map.ok());
  EXPECT_EQ(map->skips.count, 7u);
  EXPECT_EQ(map->skips.first[0].reason, "a line has no length");
  expectWhole(planCity(*map));
}

TEST(CityPlan, WhatIsNoBuildingHasNeitherWallsNorGround) {
  const std::string square = "[[[10,10],[30,10],[30,30],[10,30],[10,10]]]";
  for (const char* tag : {"no", "false", "0"}) {
    Result<MapFeatures> map =
        mapOf({feature(R"("building":")" + std::string(tag) + '"', "Polygon", square)});
    ASSERT_TRUE(map.ok());
    const CityPlan plan = planCity(*map);
    EXPECT_EQ(areaOf(plan, Surface::Footprint), 0) << tag;
    EXPECT_EQ(countOf(plan, "Building"), 0u) << tag;
  }
}

TEST(CityPlan, HostileMapsKeepThePromise) {
  std::vector<std::string> rows;
  for (const char* kind : {"primary", "service", "residential", "footway", "steps"}) {
    const std::string tags = R"("highway":")" + std::string(kind) + '"';
    // On top of each other, across themselves, to and fro, repeated nodes, a needle's bend.
    rows.push_back(feature(tags, "LineString", "[[-50,100],[100,100],[250,100]]"));
    rows.push_back(feature(tags, "LineString", "[[20,20],[180,180],[180,20],[20,180],[20,20]]"));
    rows.push_back(feature(tags, "LineString", "[[50,100],[60,100],[50,100],[60,100],[60,100]]"));
    rows.push_back(feature(tags, "LineString", "[[30,60],[90,60.001],[30,60.002],[90,60.003]]"));
    rows.push_back(feature(tags, "LineString", "[[100,100],[100,150]]"));
  }
  // Crossing itself; holes that overlap and leave the outline; on the border; far outside.
  rows.push_back(
      feature(R"("building":"yes")", "Polygon", "[[[90,90],[110,110],[110,90],[90,110],[90,90]]]"));
  rows.push_back(feature(R"("landuse":"grass")", "MultiPolygon",
                         "[[[[5,5],[70,5],[70,70],[5,70],[5,5]],[[20,20],[90,20],[90,40],[20,40]],"
                         "[[30,10],[40,10],[40,60],[30,60]]],[[[60,60],[80,60],[80,80]]]]"));
  rows.push_back(
      feature(R"("natural":"water")", "Polygon", "[[[-9,150],[30,150],[30,209],[-9,209]]]"));
  rows.push_back(feature(R"("leisure":"park")", "Polygon", "[[[1e7,1e7],[2e7,1e7],[2e7,2e7]]]"));
  rows.push_back(
      feature(R"("natural":"wood")", "Polygon", "[[[-1e7,-1e7],[140,-1e7],[140,1e7],[-1e7,1e7]]]"));
  rows.push_back(
      feature(R"("natural":"coastline")", "LineString", "[[150,-20],[150,60],[230,60]]"));
  auto map = mapOf(rows);
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  expectWhole(plan);
  EXPECT_GT(areaOf(plan, Surface::Junction), 10);
  EXPECT_GT(areaOf(plan, Surface::Sea), 1000);
}

TEST(CityPlan, UnknownStoreysAreThoseOfTheNeighbours) {
  const auto house = [](int x, const std::string& tags) {
    const std::string a = std::to_string(x), b = std::to_string(x + 10);
    return feature(R"("building":"yes")" + tags, "Polygon",
                   "[[[" + a + ",50],[" + b + ",50],[" + b + ",60],[" + a + ",60]]]");
  };
  auto map = mapOf({house(10, R"(,"building:levels":"5")"), house(30, ""),
                    house(50, R"(,"building:levels":"5")"), house(70, R"(,"height":"6.4 m")")});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  std::vector<double> known, guessed;
  for (const CityShape& s : plan.shapes) {
    if (s.rule != "Building") continue;
    for (const AttributeValue& a : s.attributes) {
      if (a.name == "known_levels") known.push_back(a.values[0].number);
      if (a.name == "guessed_levels") guessed.push_back(a.values[0].number);
    }
  }
  std::sort(known.begin(), known.end());
  EXPECT_EQ(known, (std::vector<double>{0, 2, 5, 5}));
  EXPECT_EQ(*std::max_element(guessed.begin(), guessed.end()), 5);
}

TEST(CityPlan, PartsHaveTheStoreysOfTheirBuildingWhereTheyHaveNone) {
  auto map =
      mapOf({feature(R"("building":"yes","building:levels":"6")", "Polygon",
                     "[[[10,10],[40,10],[40,20],[10,20]]]"),
             feature(R"("building:part":"yes")", "Polygon", "[[[10,10],[20,10],[20,20],[10,20]]]"),
             feature(R"("building:part":"yes","building:levels":"2")", "Polygon",
                     "[[[20,10],[30,10],[30,20],[20,20]]]"),
             feature(R"("building:part":"yes","height":"9")", "Polygon",
                     "[[[30,10],[40,10],[40,20],[30,20]]]")});
  ASSERT_TRUE(map.ok());
  std::multiset<double> known;
  for (const CityShape& s : planCity(*map).shapes) {
    for (const AttributeValue& a : s.attributes) {
      if (s.rule == "BuildingPart" && a.name == "known_levels") known.insert(a.values[0].number);
    }
  }
  EXPECT_EQ(known, (std::multiset<double>{2, 3, 6}));
}

TEST(CityPlan, PartsStandForTheirBuilding) {
  auto map = mapOf(
      {feature(R"("building":"yes")", "Polygon", "[[[10,10],[30,10],[30,20],[10,20]]]"),
       feature(R"("building:part":"yes","min_height":"3")", "Polygon",
               "[[[10,10],[20,10],[20,20],[10,20]]]"),
       feature(R"("building:part":"yes")", "Polygon", "[[[20,10],[30,10],[30,20],[20,20]]]")});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  EXPECT_EQ(countOf(plan, "BuildingPart"), 2u);
  for (const CityShape& s : plan.shapes) {
    if (s.rule != "Building") continue;
    for (const AttributeValue& a : s.attributes) {
      if (a.name == "has_parts") {
        EXPECT_EQ(a.values[0].number, 1);
      }
    }
  }
  // Parts take no ground of their own.
  EXPECT_NEAR(areaOf(plan, Surface::Footprint), 200, 0.1);
}

// Of the first shape of a rule whose feature has a name.
const AttributeValue* attributeOf(const CityPlan& plan, const std::string& rule,
                                  const std::string& name, const std::string& attribute) {
  const auto find = [](const CityShape& s, const std::string& wanted) -> const AttributeValue* {
    for (const AttributeValue& a : s.attributes) {
      if (a.name == wanted) return &a;
    }
    return nullptr;
  };
  for (const CityShape& s : plan.shapes) {
    const AttributeValue* own = s.rule == rule ? find(s, "name") : nullptr;
    if (own && own->values[0].text == name) return find(s, attribute);
  }
  return nullptr;
}

// Two houses wall to wall, one of them half as deep, and a street before both.
TEST(CityPlan, WallsKnowNeighboursStreetsAndTheEntrance) {
  auto map = mapOf(
      {feature(R"("highway":"residential")", "LineString", "[[0,40],[200,40]]"),
       feature(R"("building":"yes","name":"a","building:levels":"5","roof:direction":"N")",
               "Polygon", "[[[50,50],[70,50],[70,62],[50,62],[50,50]]]"),
       feature(R"("building":"yes","name":"b","building:levels":"2","roof:colour":"Dark_Red")",
               "Polygon", "[[[70,50],[85,50],[85,56],[70,56],[70,50]]]")});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map, "CZ");
  expectWhole(plan);
  const auto* beyond = attributeOf(plan, "Building", "a", "/edgeattr/beyond");
  const auto* levels = attributeOf(plan, "Building", "a", "/edgeattr/beyond_levels");
  const auto* street = attributeOf(plan, "Building", "a", "/edgeattr/street");
  const auto* entrance = attributeOf(plan, "Building", "a", "/edgeattr/entrance");
  ASSERT_TRUE(beyond && levels && street && entrance);
  // The wall towards the neighbour is divided where that ends.
  ASSERT_EQ(beyond->values.size(), 5u);
  size_t party = 0, toStreet = 0, entrances = 0;
  for (size_t i = 0; i < 5; ++i) {
    const bool isParty = beyond->values[i].text == "Footprint";
    party += isParty;
    EXPECT_EQ(levels->values[i].number, isParty ? 2 : 0);
    toStreet += street->values[i].number > 0;
    if (entrance->values[i].number == 0) continue;
    ++entrances;
    EXPECT_GT(street->values[i].number, 0);
  }
  EXPECT_EQ(party, 1u);
  EXPECT_EQ(toStreet, 1u);
  EXPECT_EQ(entrances, 1u);
  EXPECT_EQ(attributeOf(plan, "Building", "a", "country")->values[0].text, "CZ");
  EXPECT_EQ(attributeOf(plan, "Building", "a", "kind")->values[0].text, "apartments");
  EXPECT_EQ(attributeOf(plan, "Building", "b", "roof:colour")->values[0].text, "#8b0000");
  EXPECT_NEAR(attributeOf(plan, "Building", "b", "attached_share")->values[0].number, 6.0 / 42,
              0.01);
  // The longest edges are those in the south and the north; the first is one of them.
  const double edge = attributeOf(plan, "Building", "a", "roof_edge")->values[0].number;
  EXPECT_EQ(street->values[static_cast<size_t>(edge)].number, 0);
  EXPECT_EQ(beyond->values[static_cast<size_t>(edge)].text, "Lot");
}

TEST(CityPlan, GroundWithinABlockIsACourt) {
  auto map = mapOf({feature(R"("building":"yes")", "Polygon",
                            "[[[50,50],[90,50],[90,90],[50,90],[50,50]],"
                            "[[60,60],[80,60],[80,80],[60,80],[60,60]]]")});
  ASSERT_TRUE(map.ok());
  size_t courts = 0, lots = 0;
  for (const CityShape& s : planCity(*map).shapes) {
    for (const AttributeValue& a : s.attributes) {
      if (a.name != "is_court") continue;
      ++lots;
      if (a.values[0].number == 0) continue;
      ++courts;
      EXPECT_NEAR(area(s.polygon), 400, 0.5);
    }
  }
  EXPECT_EQ(lots, 2u);
  EXPECT_EQ(courts, 1u);
}

// Of each shape of a rule, the text or number of an attribute.
std::string valueOf(const CityShape& s, const std::string& name) {
  for (const AttributeValue& a : s.attributes) {
    if (a.name != name) continue;
    return a.values[0].text.empty() ? std::to_string(std::lround(a.values[0].number))
                                    : a.values[0].text;
  }
  return "-";
}
const CityShape* shapeOf(const CityPlan& plan, const std::string& rule, const std::string& id) {
  for (const CityShape& s : plan.shapes) {
    if (s.rule == rule && s.id == id) return &s;
  }
  return nullptr;
}
std::string square(int x, int y, int size) {
  const auto at = [](int u, int v) {
    return "[" + std::to_string(u) + "," + std::to_string(v) + "]";
  };
  return "[[" + at(x, y) + "," + at(x + size, y) + "," + at(x + size, y + size) + "," +
         at(x, y + size) + "," + at(x, y) + "]]";
}

TEST(CityPlan, BuildingsAtTheBorderAreWholeOrNotThere) {
  const auto house = [](const char* id, int x, int y) {
    return feature(R"("building":"yes","id":")" + std::string(id) + '"', "Polygon",
                   square(x, y, 20));
  };
  // Beside a neighbour within; with its middle just outside; its middle on either border.
  auto map = mapOf({house("in", -9, 50), house("beside", 11, 50), house("out", 100, -11),
                    house("low", -10, 150), house("high", 190, 150),
                    feature(R"("building:part":"yes","id":"part")", "Polygon", square(-9, 50, 8))});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  expectWhole(plan);
  EXPECT_NEAR(areaOf(plan, Surface::Footprint), 11 * 20 + 400 + 10 * 20, 0.5);
  for (const char* id : {"in", "beside", "low"}) {
    const CityShape* shape = shapeOf(plan, "Building", id);
    ASSERT_TRUE(shape) << id;
    EXPECT_NEAR(area(shape->polygon), 400, 0.5) << id;
  }
  EXPECT_EQ(countOf(plan, "Building"), 3u);
  // A part goes with its building, and walls know the neighbour within.
  EXPECT_EQ(countOf(plan, "BuildingPart"), 1u);
  EXPECT_EQ(valueOf(*shapeOf(plan, "Building", "in"), "attached_share"), "0");
  const CityShape* in = shapeOf(plan, "Building", "in");
  size_t party = 0;
  for (const AttributeValue& a : in->attributes) {
    if (a.name != "/edgeattr/beyond") continue;
    for (const PlainValue& v : a.values) party += v.text == "Footprint";
  }
  EXPECT_EQ(party, 1u);
}

TEST(CityPlan, CarsCanStandAlongKerbsOnly) {
  auto map =
      mapOf({feature(R"("highway":"residential","parking:left":"no","width":"7","id":"w")",
                     "LineString", "[[0,100],[60,100],[100,100],[200,100]]"),
             feature(R"("highway":"residential","id":"x")", "LineString", "[[100,0],[100,100]]"),
             feature(R"("highway":"crossing")", "Point", "[60,100]"),
             feature(R"("building":"yes")", "Polygon", square(150, 90, 8))});
  ASSERT_TRUE(map.ok());
  CityPlan plan = planCity(*map);
  GroundIndex index(plan.ground);
  size_t left = 0, right = 0;
  for (const CityShape& s : plan.shapes) {
    if (s.rule != "ParkingLane") continue;
    const bool isLeft = valueOf(s, "side") == "left";
    ++(isLeft ? left : right);
    if (s.id == "w") {
      EXPECT_EQ(valueOf(s, "parking") == "no", isLeft);
      EXPECT_EQ(valueOf(s, "width"), "7");
    }
    for (const Vec2 p : s.line) {
      // Two metres wide, beside the kerb.
      for (const double x : {-0.9, 0.9}) {
        for (const double y : {-0.9, 0.9}) {
          const uint32_t piece = index.pieceAt(p + Vec2{s.id == "w" ? 0 : x, s.id == "w" ? y : 0});
          ASSERT_NE(piece, GroundPiece::kNothing);
          EXPECT_EQ(plan.ground[piece].surface, Surface::Carriageway);
        }
      }
      // The plan's origin is the middle of the box: the crossing lies at (-40, 0).
      EXPECT_GT(length(p - Vec2{-40, 0}), 5.5);
    }
  }
  EXPECT_GE(left, 3u);
  // The house takes a part of the right side.
  EXPECT_GE(right, 4u);
}

TEST(CityPlan, PointsOfABuildingReachIt) {
  const std::string street =
      feature(R"("highway":"residential")", "LineString", "[[0,40],[200,40]]");
  const std::vector<std::string> points = {
      feature(R"("addr:street":"Long","addr:housenumber":"12","id":"n3")", "Point", "[55,55]"),
      feature(R"("addr:street":"Long","addr:housenumber":"9a","id":"n1")", "Point", "[60,56]"),
      feature(R"("shop":"bakery","name":"Bread","id":"n2")", "Point", "[69,55]"),
      feature(R"("shop":"books","name":"Leaves","id":"n5","level":"1")", "Point", "[69,56]"),
      // On the northern wall, where no street is.
      feature(R"("entrance":"main","id":"n4")", "Point", "[62,70]"),
      feature(R"("shop":"kiosk","id":"n6")", "Point", "[120,120]")};
  const std::string house =
      feature(R"("building":"yes","id":"house")", "Polygon", square(50, 50, 20));
  std::vector<std::string> rows = points;
  rows.push_back(street);
  rows.push_back(house);
  std::vector<std::string> turned(points.rbegin(), points.rend());
  turned.insert(turned.begin(), house);
  turned.push_back(street);
  for (const auto& order : {rows, turned}) {
    auto map = mapOf(order);
    ASSERT_TRUE(map.ok());
    const CityPlan plan = planCity(*map);
    const CityShape* shape = shapeOf(plan, "Building", "house");
    ASSERT_TRUE(shape);
    EXPECT_EQ(valueOf(*shape, "addr:street"), "Long");
    EXPECT_EQ(valueOf(*shape, "addr:housenumber"), "9a");
    EXPECT_EQ(valueOf(*shape, "addresses"), "Long 9a;Long 12");
    EXPECT_EQ(valueOf(*shape, "names"), "Bread;Leaves");
    EXPECT_EQ(valueOf(*shape, "name"), "-");
    EXPECT_EQ(valueOf(*shape, "shop"), "bakery;books");
    EXPECT_EQ(valueOf(*shape, "shops"), "1");
    for (const AttributeValue& a : shape->attributes) {
      if (a.name != "/edgeattr/entrance" && a.name != "/edgeattr/shops") continue;
      for (size_t i = 0; i < a.values.size(); ++i) {
        const Vec2 from = shape->polygon.outer[i], to = shape->polygon.outer[(i + 1) % 4];
        // The door is where the map has it; the shop looks at the street.
        const double y = a.name == "/edgeattr/entrance" ? 20 : 0;
        const bool here = std::fabs(from.y - to.y) < 1 &&
                          std::fabs(from.y - shape->polygon.outer[0].y) < 1e9 &&
                          std::fabs((from.y + to.y) / 2 - (y - 50)) < 1;
        EXPECT_EQ(a.values[i].number, here ? 1 : 0) << a.name << i;
      }
    }
  }
}

TEST(CityPlan, ADoorAddressIsAnEntrance) {
  auto map = mapOf({feature(R"("highway":"residential")", "LineString", "[[0,40],[200,40]]"),
                    feature(R"("addr:street":"Long","addr:housenumber":"1","name":"Old Mill")",
                            "Point", "[70,60]"),
                    feature(R"("building":"yes","id":"house")", "Polygon", square(50, 50, 20))});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  const CityShape* shape = shapeOf(plan, "Building", "house");
  ASSERT_TRUE(shape);
  EXPECT_EQ(valueOf(*shape, "name"), "Old Mill");
  for (const AttributeValue& a : shape->attributes) {
    if (a.name != "/edgeattr/entrance") continue;
    for (size_t i = 0; i < 4; ++i) {
      const Vec2 middle = (shape->polygon.outer[i] + shape->polygon.outer[(i + 1) % 4]) * 0.5;
      EXPECT_EQ(a.values[i].number > 0, std::fabs(middle.x - (70 - 100)) < 1) << i;
    }
  }
}

TEST(CityPlan, RowsGetTheStoreysOfThoseBesideThem) {
  const auto house = [](const char* id, int x, const std::string& tags) {
    return feature(R"("building":"yes","id":")" + std::string(id) + '"' + tags, "Polygon",
                   square(x, 50, 20));
  };
  // Five in a row, the middle three unknown; another that stands alone, nearer to low ones.
  auto map =
      mapOf({house("a", 0, R"(,"building:levels":"6","roof:shape":"gabled")"), house("b", 20, ""),
             house("c", 40, ""), house("d", 60, ""), house("e", 80, R"(,"building:levels":"6")"),
             house("f", 120, ""),
             feature(R"("building":"yes","building:levels":"2")", "Polygon", square(25, 80, 20)),
             feature(R"("building":"yes","building:levels":"2")", "Polygon", square(50, 80, 20)),
             feature(R"("building":"yes","building:levels":"2")", "Polygon", square(120, 80, 20))});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  std::string chance;
  for (const char* id : {"b", "c", "d"}) {
    const CityShape* shape = shapeOf(plan, "Building", id);
    ASSERT_TRUE(shape);
    EXPECT_EQ(valueOf(*shape, "guessed_levels"), "6") << id;
    EXPECT_EQ(valueOf(*shape, "row_roof"), "gabled");
  }
  const auto chanceOf = [&](const char* id) {
    for (const AttributeValue& a : shapeOf(plan, "Building", id)->attributes) {
      if (a.name == "row_chance") return a.values[0].number;
    }
    return -2.0;
  };
  EXPECT_EQ(chanceOf("a"), chanceOf("e"));
  EXPECT_GE(chanceOf("a"), 0);
  EXPECT_EQ(chanceOf("f"), -1);
}

TEST(CityPlan, ATowerSaysNothingOfALongRow) {
  std::vector<std::string> rows;
  for (int i = 0; i < 9; ++i) {
    rows.push_back(feature(R"("building":"yes","id":"h)" + std::to_string(i) + '"' +
                               (i == 0 ? R"(,"building:levels":"30")" : ""),
                           "Polygon", square(15 * i, 50, 15)));
    rows.push_back(
        feature(R"("building":"yes","building:levels":"4")", "Polygon", square(15 * i, 80, 14)));
  }
  auto map = mapOf(rows);
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  for (const char* id : {"h1", "h4", "h8"}) {
    EXPECT_EQ(valueOf(*shapeOf(plan, "Building", id), "guessed_levels"), "4") << id;
  }
}

TEST(CityPlan, ValuesAreNumbersForTheRulesOrTold) {
  auto map =
      mapOf({feature(R"("building":"yes","id":"a","height":"20 ft","building:levels":"6 floors",)"
                     R"("bulding:levels":"4")",
                     "Polygon", square(50, 50, 20))});
  ASSERT_TRUE(map.ok());
  const CityPlan plan = planCity(*map);
  const CityShape* shape = shapeOf(plan, "Building", "a");
  ASSERT_TRUE(shape);
  EXPECT_EQ(valueOf(*shape, "height"), "6.096");
  EXPECT_EQ(valueOf(*shape, "building:levels"), "-");
  EXPECT_EQ(valueOf(*shape, "known_levels"), "2");
  ASSERT_EQ(plan.doubts.size(), 2u);
  EXPECT_EQ(plan.doubts[0].meant, "building:levels");
  EXPECT_EQ(plan.doubts[1].key, "building:levels");
}

class RealMap : public ::testing::TestWithParam<const char*> {};

TEST_P(RealMap, KeepsThePromise) {
  const char* shared = std::getenv("GABLE_SHARED");
  const std::string path = std::string(shared ? shared : "../shared") + "/data/gis/" + GetParam();
  Result<std::string> bytes = readFile(path, uint64_t{1} << 30);
  if (!bytes.ok()) GTEST_SKIP() << path << " is not there";
  if (programBeside("gable-maps").empty()) GTEST_SKIP() << "gable-maps is not built";
  auto map = readMapFeatures(*bytes, {path, {}, false});
  ASSERT_TRUE(map.ok()) << map.error().message;
  const CityPlan plan = planCity(*map);
  expectWhole(plan);
  EXPECT_GT(countOf(plan, "Building"), 200u);
  EXPECT_GT(countOf(plan, "Street"), 30u);
  EXPECT_GT(areaOf(plan, Surface::Junction), 500);
}

INSTANTIATE_TEST_SUITE_P(Maps, RealMap,
                         ::testing::Values("monaco-latest.osm.pbf", "prague_vinohrady.osm"),
                         [](const auto& info) { return info.index == 0 ? "Monaco" : "Vinohrady"; });

}  // namespace
}  // namespace gable
