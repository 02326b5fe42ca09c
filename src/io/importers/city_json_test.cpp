// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/city_json.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/files.h"

namespace gable {
namespace {

// A box of 10 by 6 by 5 metres at (100, 200) under a gabled roof of 2 metres, whose ridge runs
// east.
constexpr const char* kVertices =
    "[[0,0,0],[10,0,0],[10,6,0],[0,6,0],[0,0,5],[10,0,5],[10,6,5],[0,6,5],[0,3,7],[10,3,7]]";
constexpr const char* kHouse =
    R"({"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[0,1,5,4]],[[1,2,6,9,5]],[[2,3,7,6]],)"
    R"([[3,0,4,8,7]],[[4,5,9,8]],[[6,7,8,9]]]]})";

std::string model(const std::string& objects, const std::string& vertices = kVertices) {
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],)"
         R"("translate":[100,200,3]},"metadata":{"referenceSystem":)"
         R"("https://www.opengis.net/def/crs/EPSG/0/7415"},"CityObjects":{)" +
         objects + R"(},"vertices":)" + vertices + "}";
}

Result<MapFeatures> mapOf(const std::string& text) {
  return readMapFeatures(text, {"a.city.json", {}, false});
}

double areaOf(const MapFeature& f) {
  double sum = 0;
  for (const Ring& r : f.rings) sum += signedArea(r);
  return sum;
}

TEST(CityJson, takesFootprintHeightAndRoofOfBuildings) {
  auto map =
      mapOf(model(R"("b":{"type":"Building","attributes":{"storeysAboveGround":2,"owner":"me"},)"
                  R"("address":[{"ThoroughfareName":"Long"}],"geometry":[)" +
                  std::string(kHouse) + "]}"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  ASSERT_EQ(map->features.size(), 1u);
  const MapFeature& f = map->features[0];
  EXPECT_EQ(f.id, "b");
  EXPECT_NEAR(areaOf(f), 60, 1e-9);
  EXPECT_EQ(f.tag("height"), "7");
  EXPECT_EQ(f.tag("roof:shape"), "gabled");
  EXPECT_EQ(f.tag("roof:height"), "2");
  EXPECT_EQ(f.tag("building:levels"), "2");
  EXPECT_EQ(f.tag("addr:street"), "Long");
  EXPECT_EQ(f.tag("owner"), "me");
  EXPECT_EQ(map->skips.count, 0u);
  // The place lies where the file says, but for its origin.
  ASSERT_TRUE(map->geo);
  const GeoPlace corner = map->geo->at(f.rings[0][0]);
  EXPECT_GE(corner.x, 100);
  EXPECT_LE(corner.x, 110);
}

TEST(CityJson, buildingsOfPartsHaveThemAsParts) {
  const std::string part = R"({"type":"BuildingPart","parents":["b"],"geometry":[)";
  auto map =
      mapOf(model(R"("b":{"type":"Building","children":["p","q"],"geometry":[]},"p":)" + part +
                  kHouse + R"(]},"q":)" + part +
                  R"({"type":"MultiSurface","lod":"1","boundaries":[[[1,2,6,5]],[[0,1,2]]]}]})"));
  ASSERT_TRUE(map.ok()) << map.error().message;
  ASSERT_EQ(map->features.size(), 3u);
  EXPECT_EQ(map->features[0].tag("building"), "yes");
  EXPECT_NEAR(areaOf(map->features[0]), 60, 1e-9);
  EXPECT_EQ(map->features[1].tag("building:part"), "yes");
  EXPECT_NEAR(areaOf(map->features[2]), 30, 1e-9);
}

TEST(CityJson, groundHasTheTagsOfMaps) {
  const auto surface = [](const std::string& id, const std::string& type, const std::string& own) {
    return '"' + id + R"(":{"type":")" + type + R"(","attributes":{)" + own +
           R"(},"geometry":[{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}]})";
  };
  auto map = mapOf(
      model(surface("a", "Road", "") + ',' + surface("b", "Road", R"("function":"voetpad")") + ',' +
            surface("c", "WaterBody", "") + ',' + surface("d", "PlantCover", R"("class":"bos")") +
            ',' + surface("e", "Tunnel", "")));
  ASSERT_TRUE(map.ok()) << map.error().message;
  ASSERT_EQ(map->features.size(), 4u);
  EXPECT_EQ(map->features[0].tag("area:highway"), "road");
  EXPECT_EQ(map->features[1].tag("area:highway"), "footway");
  EXPECT_EQ(map->features[2].tag("natural"), "water");
  EXPECT_EQ(map->features[3].tag("landuse"), "forest");
  ASSERT_EQ(map->skips.count, 1u);
  EXPECT_EQ(map->skips.first[0].place, "e");
}

TEST(CityJson, wrongObjectsAreLeftOutAndNamed) {
  const std::string good = R"("b":{"type":"Building","geometry":[)" + std::string(kHouse) + "]}";
  for (const char* geometry :
       {R"({"type":"MultiSurface","lod":"1","boundaries":[[[0,1,99]]]})",
        R"({"type":"MultiSurface","lod":"1","boundaries":[[[0,1,-1]]]})",
        R"({"type":"MultiSurface","lod":"1","boundaries":[[[0,1]]]})",
        R"({"type":"MultiSurface","lod":"1","boundaries":[[[0,1,5,4]]]})",
        R"({"type":"Solid","lod":"1","boundaries":[[0,1,2]]})", R"({"type":"Solid","lod":1})",
        R"({"type":"MultiSurface","lod":[],"boundaries":{"a":1}})", "7", ""}) {
    auto map = mapOf(
        model(good + R"(,"w":{"type":"Building","geometry":[)" + std::string(geometry) + "]}"));
    ASSERT_TRUE(map.ok()) << map.error().message;
    EXPECT_EQ(map->features.size(), 1u) << geometry;
    ASSERT_GE(map->skips.count, 1u) << geometry;
    EXPECT_EQ(map->skips.first[0].place, "w") << geometry;
  }
  auto broken = mapOf(model(good, R"([["x",0,0],[1e400,0,0],[10,6,0],[0,6,0]])"));
  EXPECT_FALSE(broken.ok());
  for (const char* text : {R"({"type":"CityJSON"})", R"({"type":"CityJSON","CityObjects":[]})",
                           R"({"type":"CityJSON","CityObjects":{},"vertices":[]})"}) {
    EXPECT_FALSE(mapOf(text).ok()) << text;
  }
}

// Each line has vertices of its own, by the transform of the first.
TEST(CityJson, aFeatureALineIsOneModel) {
  const auto feature = [](const std::string& id, const std::string& vertices) {
    return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
           R"(":{"type":"Building","geometry":[)" + kHouse + R"(]}},"vertices":)" + vertices +
           "}\n";
  };
  std::string head = model("", "[]");
  const std::string low =
      "[[50,0,0],[52,0,0],[52,6,0],[50,6,0],[50,0,2],[52,0,2],[52,6,2],[50,6,2],[50,3,3],[52,3,3]]";
  const auto read = [](const std::string& text) {
    return readMapFeatures(text, {"a.city.jsonl", {}, false});
  };
  auto map = read(head + "\n" + feature("a", kVertices) + "\n" + feature("b", low));
  ASSERT_TRUE(map.ok()) << map.error().message;
  ASSERT_EQ(map->features.size(), 2u);
  EXPECT_NEAR(areaOf(map->features[0]), 60, 1e-9);
  EXPECT_NEAR(areaOf(map->features[1]), 12, 1e-9);
  EXPECT_EQ(map->features[1].tag("height"), "3");
  for (const auto& [text, why] :
       {std::pair(feature("a", kVertices), "line 1: it does not begin with a CityJSON object"),
        std::pair(head + "\n" + head, "line 2: it is no CityJSONFeature"),
        std::pair(head + "\n{", "line 2: "), std::pair(std::string(" \n"), "it has no line")}) {
    map = read(text);
    ASSERT_FALSE(map.ok());
    EXPECT_NE(map.error().message.find(why), std::string::npos) << map.error().message;
  }
}

TEST(CityJson, readsTheModelsThatAreAbout) {
  const char* shared = std::getenv("GABLE_SHARED");
  if (!shared) GTEST_SKIP() << "GABLE_SHARED names no folder";
  for (const auto& [name, count] : {std::pair("delft", 373u), std::pair("rotterdam_subset", 16u)}) {
    const std::string path = std::string(shared) + "/data/gis/" + name + ".city.json";
    Result<std::string> text = readFile(path, uint64_t{1} << 30);
    if (!text.ok()) GTEST_SKIP() << path << " is not there";
    auto map = readMapFeatures(*text, {path, {}, false});
    ASSERT_TRUE(map.ok()) << map.error().message;
    EXPECT_GE(map->features.size(), count) << name;
    for (const MapFeature& f : map->features) {
      if (f.tag("building").empty()) continue;
      EXPECT_FALSE(f.tag("height").empty()) << f.id;
    }
  }
}

}  // namespace
}  // namespace gable
