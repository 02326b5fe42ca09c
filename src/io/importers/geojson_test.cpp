// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/files.h"
#include "base/random.h"
#include "io/importers/shape_input.h"

namespace gable {
namespace {

std::string feature(const std::string& geometry, const std::string& properties = "{}") {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":)" + geometry + "}";
}
std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}
std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

// About 80 x 111 m near Monaco.
constexpr const char* kRing =
    "[[7.42,43.73],[7.421,43.73],[7.421,43.731],[7.42,43.731],[7.42,43.73]]";

TEST(GeoJson, degreesBecomeMetresFacingUp) {
  auto r = readGeoJsonShapes(
      feature(polygon(kRing), R"({"name":"A","height":"12","n":3,"f":true,"x":null})"),
      "a.geojson");
  ASSERT_TRUE(r.ok()) << r.error().message;
  ASSERT_EQ(r->shapes.size(), 1u);
  const ShapeInput& s = r->shapes[0];
  EXPECT_EQ(s.mesh.faceCount(), 1u);
  EXPECT_EQ(s.mesh.positions.size(), 4u);
  EXPECT_NEAR(s.mesh.bounds().size().x, 80.5, 0.5);
  EXPECT_NEAR(s.mesh.bounds().size().z, 111.1, 0.2);
  EXPECT_GT(s.mesh.normal(0).y, 0.999);
  EXPECT_NEAR(s.mesh.bounds().center().x, 0, 1e-2);
  EXPECT_TRUE(r->geoOrigin.present);
  EXPECT_NEAR(r->geoOrigin.latitude, 43.7305, 1e-9);
  EXPECT_EQ(s.name, "A");
  ASSERT_EQ(s.attributes.size(), 4u);
  EXPECT_EQ(s.attributes[1].values[0].kind, PlainValue::Kind::Text);
  double height = 0;
  EXPECT_TRUE(numericValue(s.attributes[1].values[0], height));
  EXPECT_EQ(height, 12);
  EXPECT_EQ(s.attributes[3].values[0].kind, PlainValue::Kind::Bool);
}

TEST(GeoJson, ringDirectionsDoNotMatterAndHolesStay) {
  const std::string hole =
      "[[7.4202,43.7302],[7.4208,43.7302],[7.4208,43.7308],[7.4202,43.7308],[7.4202,43.7302]]";
  const std::string clockwise =
      "[[7.42,43.73],[7.42,43.731],[7.421,43.731],[7.421,43.73],[7.42,43.73]]";
  double area = 0;
  for (const std::string& outer : {std::string(kRing), clockwise}) {
    auto r = readGeoJsonShapes(feature(polygon(outer + "," + hole)), "a.geojson");
    ASSERT_TRUE(r.ok());
    const Mesh& m = r->shapes[0].mesh;
    ASSERT_EQ(m.loopsOf(0).size(), 2u);
    EXPECT_GT(m.normal(0).y, 0.999);
    EXPECT_TRUE(area == 0 || std::abs(area - m.area()) < 1e-6);
    area = m.area();
    EXPECT_NEAR(area, 80.5 * 111.1 * (1 - 0.36), 60);
  }
}

// Without a word in the file, numbers within the degrees of the Earth are degrees; lots of metres
// would be countries then.
TEST(GeoJson, metresThatLookLikeDegreesAreRefused) {
  const std::string lot = polygon("[[0,0],[30,0],[30,40],[0,40],[0,0]]");
  auto r = readGeoJsonShapes(feature(lot), "a.geojson");
  ASSERT_TRUE(r.ok());
  ASSERT_TRUE(r->diagnostics.hasErrors());
  EXPECT_EQ(r->diagnostics.all()[0].code, "geojson-metres");
  EXPECT_TRUE(r->shapes.empty());
  const std::string crs =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3857"}},"features":[)";
  r = readGeoJsonShapes(crs + feature(lot) + "]}", "a.geojson");
  ASSERT_TRUE(r.ok());
  EXPECT_NEAR(r->shapes[0].mesh.area(), 1200, 1e-6);
}

TEST(GeoJson, latitudesBeyondThePoleAreToldToBeSwapped) {
  const std::string lot = polygon(
      "[[-33.86,151.2],[-33.86,151.2003],[-33.8603,151.2003],[-33.8603,151.2],[-33.86,151.2]]");
  const auto r = readGeoJsonShapes(collection(feature(lot)), "a.geojson");
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, std::string("shapes-empty"));
  EXPECT_NE(r.error().hint.find("151.2003, and latitudes end at 90"), std::string::npos);
}

TEST(GeoJson, whatIsNoPlaceOnTheEarthAndTinyIsTold) {
  const std::string lot =
      polygon("[[200,95],[200.0002,95],[200.0002,95.0002],[200,95.0002],[200,95]]");
  const auto r = readGeoJsonShapes(collection(feature(lot)), "a.geojson");
  ASSERT_FALSE(r.ok());
  EXPECT_NE(r.error().hint.find("around 200, 95 are no longitude"), std::string::npos);
}

TEST(GeoJson, heightsOfCoordinatesAreToldToBeLeftOut) {
  for (const char* height : {",520", ",0", ""}) {
    const std::string z = height;
    const std::string lot = polygon("[[0,0" + z + "],[0.0002,0" + z + "],[0.0002,0.0002" + z +
                                    "],[0,0.0002" + z + "],[0,0" + z + "]]");
    auto r = readGeoJsonShapes(collection(feature(lot)), "a.geojson");
    ASSERT_TRUE(r.ok());
    size_t told = 0;
    for (const auto& d : r->diagnostics.all()) told += std::string(d.code) == "geojson-heights";
    EXPECT_EQ(told, z == ",520" ? 1u : 0u);
  }
}

// Hundreds of holes in one place meet each other at more points than time allows.
TEST(GeoJson, holesOverEachOtherAreMerged) {
  std::string rings = kRing;
  for (int i = 0; i < 400; ++i) {
    rings +=
        ",[[7.4202,43.7302],[7.4208,43.7302],[7.4208,43.7308],[7.4202,43.7308],[7.4202,43.7302]]";
  }
  auto r = readGeoJsonShapes(feature(polygon(rings)), "a.geojson");
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 1u);
  EXPECT_NEAR(r->shapes[0].mesh.area(), 80.5 * 111.1 * (1 - 0.36), 20);
}

TEST(GeoJson, metresAreKept) {
  const std::string crs =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"features":[)" +
      feature(polygon("[[0,0],[10,0],[10,5],[0,5],[0,0]]")) + "]}";
  auto r = readGeoJsonShapes(crs, "a.geojson");
  ASSERT_TRUE(r.ok());
  EXPECT_FALSE(r->geoOrigin.present);
  EXPECT_EQ(r->shapes[0].mesh.area(), 50);
  // Numbers that cannot be degrees, far from the origin.
  r = readGeoJsonShapes(
      feature(polygon("[[500000,4800000],[500010,4800000],[500010,4800005],[500000,4800005]]")),
      "a.json");
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->shapes[0].mesh.area(), 50);
  EXPECT_LT(length(r->shapes[0].mesh.bounds().center()), 20);
}

TEST(GeoJson, multiPolygonsAreOneShapeAndCollectionsAreOpened) {
  const std::string two = R"({"type":"MultiPolygon","coordinates":[[)" + std::string(kRing) +
                          "],[[[7.43,43.73],[7.431,43.73],[7.431,43.731],[7.43,43.73]]]]}";
  auto r = readGeoJsonShapes(
      collection(feature(two) + "," +
                 feature(R"({"type":"GeometryCollection","geometries":[)" + polygon(kRing) +
                         R"(,{"type":"Point","coordinates":[1,2]}]})")),
      "a.json");
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 2u);
  EXPECT_EQ(r->shapes[0].mesh.faceCount(), 2u);
  EXPECT_EQ(r->shapes[1].mesh.faceCount(), 1u);
  ASSERT_EQ(r->diagnostics.all().size(), 1u);
  EXPECT_EQ(r->diagnostics.all()[0].severity, Severity::Note);
}

TEST(GeoJson, wrongFeaturesAreNamedAndTheOthersRead) {
  const std::string bow = "[[7.42,43.73],[7.421,43.731],[7.421,43.73],[7.42,43.731],[7.42,43.73]]";
  const std::string thin = "[[7.42,43.73],[7.421,43.73],[7.42,43.73]]";
  const std::string outside =
      std::string(kRing) + ",[[7.43,43.73],[7.431,43.73],[7.431,43.731],[7.43,43.73]]";
  auto r =
      readGeoJsonShapes(collection(feature(polygon(bow), R"({"osm_id":17,"name":"Bow"})") + "," +
                                   feature(polygon(thin)) + "," + feature(polygon(outside)) + "," +
                                   feature(polygon("[[7.42,\"x\"],[7.42,43.73],[7.43,43.73]]")) +
                                   "," + feature("null") + "," +
                                   feature(R"({"type":"LineString","coordinates":[[1,2],[3,4]]})") +
                                   "," + feature(polygon(kRing)) + ",7,null,[]"),
                        "town.geojson");
  ASSERT_TRUE(r.ok());
  // The one with a hole outside of it loses no more than the hole.
  EXPECT_EQ(r->shapes.size(), 2u);
  const auto& all = r->diagnostics.all();
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[0].code, "geojson-crossing");
  EXPECT_NE(all[0].message.find("feature 1 (id 17) 'Bow'"), std::string::npos);
  EXPECT_EQ(all[1].code, "geojson-empty");
  EXPECT_EQ(all[2].code, "geojson-holes");
  EXPECT_EQ(all[3].code, "geojson-coordinates");
  EXPECT_NE(all[3].message.find("feature 4 of 'town.geojson' is left out"), std::string::npos);
  EXPECT_FALSE(r->diagnostics.hasErrors());
  EXPECT_EQ(r->shapes[1].name, "feature 7");
  EXPECT_EQ(r->shapes[1].feature, 7u);
}

TEST(GeoJson, ofPartsTheOthersStay) {
  const std::string bow = "[[7.42,43.73],[7.421,43.731],[7.421,43.73],[7.42,43.731],[7.42,43.73]]";
  const std::string two =
      R"({"type":"MultiPolygon","coordinates":[[)" + bow + "],[" + std::string(kRing) + "]]}";
  auto r = readGeoJsonShapes(collection(feature(two)), "town.geojson");
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->shapes.size(), 1u);
  ASSERT_EQ(r->diagnostics.all().size(), 1u);
  EXPECT_EQ(r->diagnostics.all()[0].message.find("a part of feature 1 of "), 0u);
}

TEST(GeoJson, whereNothingIsLeftTheReasonsAreToldAsWell) {
  const std::string bow = "[[7.42,43.73],[7.421,43.731],[7.421,43.73],[7.42,43.731],[7.42,43.73]]";
  auto r = readGeoJsonShapes(collection(feature(polygon(bow))), "town.geojson");
  ASSERT_TRUE(r.ok());
  EXPECT_TRUE(r->shapes.empty());
  ASSERT_EQ(r->diagnostics.all().size(), 2u);
  EXPECT_EQ(r->diagnostics.all()[0].code, "geojson-crossing");
  EXPECT_EQ(r->diagnostics.all()[1].code, "shapes-empty");
}

TEST(GeoJson, linesAloneBecomeOneShape) {
  const std::string a = R"({"type":"LineString","coordinates":[[0,0],[50,0],[50,50]]})",
                    b = R"({"type":"MultiLineString","coordinates":[[[0,9],[9,9]],[[1,1],[1,1]]]})";
  auto r = readGeoJsonShapes(R"({"type":"FeatureCollection","crs":{"properties":{"name":"x"}},)"
                             R"("features":[)" +
                                 feature(a, R"({"width":7.5})") + "," + feature(b) + "]}",
                             "roads.geojson");
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 1u);
  const ShapeInput& s = r->shapes[0];
  EXPECT_EQ(s.name, "lines");
  ASSERT_EQ(s.mesh.faceCount(), 3u);
  EXPECT_TRUE(s.mesh.valid());
  EXPECT_EQ(s.streetWidths, (std::vector<double>{7.5, 7.5, 0}));
  // Stretches of a line share their points.
  EXPECT_EQ(s.mesh.corners[1], s.mesh.corners[2]);
  EXPECT_EQ(s.mesh.positions.size(), 5u);
}

TEST(GeoJson, linesBesideAPolygonBelongToItsShape) {
  const std::string line = R"({"type":"LineString","coordinates":[[7.42,43.73],[7.421,43.731]]})";
  auto r = readGeoJsonShapes(collection(feature(R"({"type":"GeometryCollection","geometries":[)" +
                                                polygon(kRing) + "," + line + "]}") +
                                        "," + feature(line)),
                             "town.geojson");
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 1u);
  EXPECT_EQ(r->shapes[0].mesh.faceCount(), 2u);
  // The other line is passed over.
  ASSERT_EQ(r->diagnostics.all().size(), 1u);
  EXPECT_EQ(r->diagnostics.all()[0].code, "geojson-no-polygon");
}

TEST(GeoJson, closingPointsDuplicatesAndStraightCornersGo) {
  auto r = readGeoJsonShapes(feature(polygon("[[7.42,43.73],[7.4205,43.73],[7.4205,43.73],[7.421,"
                                             "43.73],[7.421,43.731],[7.42,43.731],[7.42,43.73]]")),
                             "a.json");
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->shapes[0].mesh.positions.size(), 4u);
}

TEST(GeoJson, bothSidesOfTheDateLineAreNeighbours) {
  auto r = readGeoJsonShapes(
      collection(feature(polygon("[[179.9995,10],[179.9999,10],[179.9999,10.001]]")) + "," +
                 feature(polygon("[[-179.9999,10],[-179.9995,10],[-179.9995,10.001]]"))),
      "a.json");
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 2u);
  EXPECT_LT(std::abs(r->shapes[0].mesh.bounds().min.x), 100);
  EXPECT_LT(std::abs(r->shapes[1].mesh.bounds().max.x), 100);
}

TEST(GeoJson, aFilterThatNothingPassesNamesWhatThereIs) {
  std::string features;
  for (const char* p : {R"({"building":"house"})", R"({"building":"barn","roof":"flat"})",
                        R"({"building":"house","landuse":null})"}) {
    features += (features.empty() ? "" : ",") + feature(polygon(kRing), p);
  }
  const auto hint = [&](const char* key, const char* value) {
    return readGeoJsonShapes(collection(features), "a.geojson", {"", key, value}).error().hint;
  };
  EXPECT_EQ(hint("buildng", ""), "did you mean --only building?");
  EXPECT_EQ(hint("building", "huose"), "did you mean --only building=house?");
  EXPECT_EQ(hint("surface", "x"),
            "its properties are building (3), roof (1); write --only building");
  EXPECT_EQ(hint("building", "castle"),
            "the values of 'building' are house (2), barn (1); write --only building=house");
}

TEST(GeoJson, aFilterThatOnlyPointsPassSaysSo) {
  const auto point = [](const char* street) {
    return feature(R"({"type":"Point","coordinates":[7.42,43.73]})",
                   (R"({"street":")" + std::string(street) + "\"}").c_str());
  };
  const std::string all = feature(polygon(kRing), R"({"building":"house"})") + "," +
                          point("Z\u00e1h\u0159ebsk\u00e1") + "," +
                          point("Z\u00e1h\u0159ebsk\u00e1") + "," + point("Mala");
  const auto error = [&](const char* value) {
    return readGeoJsonShapes(collection(all), "a.geojson", {"", "street", value}).error();
  };
  const Error points = error("Z\u00e1h\u0159ebsk\u00e1");
  EXPECT_EQ(
      points.message,
      "2 of the 4 features of 'a.geojson' have 'street=Z\u00e1h\u0159ebsk\u00e1', and all are "
      "points");
  EXPECT_NE(points.hint.find("polygons and lines"), std::string::npos);
  EXPECT_EQ(error("Mala").message,
            "1 of the 4 features of 'a.geojson' has 'street=Mala', and it is a point");
  EXPECT_EQ(error("Zahrebska").hint, "did you mean --only street=Z\u00e1h\u0159ebsk\u00e1?");
}

TEST(GeoJson, whatIsNoGeoJsonIsAnError) {
  for (const char* text :
       {"", "[]", "{}", "{\"type\":5}", "{\"type\":\"FeatureCollection\"}", "not json",
        "{\"type\":\"Point\",\"coordinates\":[1,2]}", "{\"type\":\"Polygon\"}"}) {
    EXPECT_FALSE(readGeoJsonShapes(text, "a.json").ok()) << text;
  }
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += R"({"type":"GeometryCollection","geometries":[)";
  EXPECT_FALSE(readGeoJsonShapes(deep, "a.json").ok());
  EXPECT_FALSE(readGeoJsonShapes(std::string(1 << 20, '['), "a.json").ok());
}

TEST(GeoJson, garbageNeverHurts) {
  const std::string good = collection(feature(polygon(kRing), R"({"a":[1,2],"name":"x","id":3})") +
                                      "," + feature(polygon("[[0,0],[1,0],[1,1],[0,0]]")));
  size_t read = 0;
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    std::string text = good;
    for (uint64_t k = 0; k < 3; ++k) {
      const uint64_t bits = randomBits(hashCombine(seed, k));
      const size_t at = bits % text.size();
      // Mostly digits, so that much of it is JSON still.
      text[at] = bits >> 62 == 0 ? static_cast<char>(bits >> 32)
                                 : static_cast<char>('0' + (bits >> 32) % 10);
    }
    const auto r = readGeoJsonShapes(text, "a.json");
    if (!r.ok()) continue;
    for (const ShapeInput& s : r.value().shapes) EXPECT_TRUE(s.mesh.valid());
    ++read;
  }
  EXPECT_GT(read, 100u);
}

TEST(GeoJson, monacoIsReadWhole) {
  const char* shared = std::getenv("GABLE_SHARED");
  const std::string folder = shared ? shared : std::string(GABLE_SOURCE_DIR) + "/../shared";
  const auto text = readFile(folder + "/data/gis/monaco_buildings.geojson");
  if (!text.ok()) GTEST_SKIP() << "the shared data is not here";
  auto r = readGeoJsonShapes(text.value(), "monaco_buildings.geojson");
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->shapes.size(), 1218u);
  // One building has two holes side by side.
  ASSERT_EQ(r->diagnostics.all().size(), 1u);
  EXPECT_EQ(r->diagnostics.all()[0].code, "geojson-holes");
  size_t holed = 0;
  for (const ShapeInput& s : r->shapes) {
    ASSERT_TRUE(s.mesh.valid());
    ASSERT_EQ(s.mesh.faceCount(), 1u);
    EXPECT_GT(s.mesh.normal(0).y, 0.999);
    EXPECT_GT(s.mesh.area(), 0.5);
    holed += s.mesh.loopsOf(0).size() > 1 ? 1 : 0;
    EXPECT_FALSE(s.id.empty());
  }
  EXPECT_EQ(holed, 22u);
}

TEST(Lot, liesAsTheFramesSay) {
  const ShapeInput lot = lotShape(30, 40);
  const Mesh& m = lot.mesh;
  EXPECT_EQ(m.positions[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(m.positions[1], (Vec3{30, 0, 0}));
  EXPECT_EQ(m.normal(0), (Vec3{0, 1, 0}));
  EXPECT_EQ(m.area(), 1200);
  // To the north, which is -z.
  EXPECT_EQ(m.bounds().min.z, -40);
  double w = 0, d = 0;
  EXPECT_TRUE(parseLot("12.5X8", w, d));
  EXPECT_EQ(w, 12.5);
  EXPECT_EQ(d, 8);
  for (const char* text :
       {"", "30", "30x", "x40", "0x1", "-1x2", "1x2x3", "axb", "1e9x1", "nanx1"}) {
    EXPECT_FALSE(parseLot(text, w, d)) << text;
  }
}

TEST(NumericValue, readsTextsThatMeanNumbers) {
  double v = 0;
  const auto text = [](const char* t) { return PlainValue{PlainValue::Kind::Text, 0, t}; };
  EXPECT_TRUE(numericValue(text(" 7.5 m"), v));
  EXPECT_EQ(v, 7.5);
  EXPECT_TRUE(numericValue(text("3,5"), v));
  EXPECT_EQ(v, 3.5);
  EXPECT_TRUE(numericValue({PlainValue::Kind::Number, 4, ""}, v));
  for (const char* t : {"", "m", "3 floors", "nan", "1,2,3"})
    EXPECT_FALSE(numericValue(text(t), v)) << t;
  EXPECT_FALSE(numericValue({PlainValue::Kind::Bool, 1, ""}, v));
}

}  // namespace
}  // namespace gable
