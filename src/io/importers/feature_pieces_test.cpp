// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include "base/files.h"
#include "base/temporary_folder.h"
#include "io/importers/shape_input.h"

namespace gable {
namespace {

std::string lot(double x, const std::string& properties = "{}") {
  const auto at = [&](double dx, double dy) {
    return "[" + std::to_string(8 + (x + dx) * 1e-5) + "," + std::to_string(50 + dy * 1e-5) + "]";
  };
  return R"({"type":"Feature","properties":)" + properties +
         R"(,"geometry":{"type":"Polygon","coordinates":[[)" + at(0, 0) + "," + at(5, 0) + "," +
         at(5, 5) + "," + at(0, 5) + "," + at(0, 0) + "]]}}";
}

// What both readers make of a text: shapes, messages and place, or the error.
std::string whole(const Result<ShapeFile>& file, const std::vector<ShapeInput>& shapes) {
  if (!file.ok()) return "error " + file.error().code;
  std::string out = file.value().geo ? file.value().geo->text() : "nowhere";
  for (const ShapeInput& s : shapes) {
    out += "\n" + s.name + " " + s.id + " " + std::to_string(s.mesh.contentHash());
    for (const AttributeValue& a : s.attributes) out += " " + a.name;
  }
  for (const Diagnostics::Entry& e : file.value().diagnostics.all()) out += "\n" + e.message;
  return out;
}

std::string inPieces(const std::string& text, const FeatureFilter& filter = {}) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/a.geojson";
  EXPECT_TRUE(writeFile(path, text).ok());
  std::vector<ShapeInput> shapes;
  const Result<ShapeFile> file = streamGeoJsonShapes(
      path, "a.geojson", filter, [&](ShapeInput&& s) { shapes.push_back(std::move(s)); });
  return whole(file, shapes);
}

std::string atOnce(const std::string& text, const FeatureFilter& filter = {}) {
  const Result<ShapeFile> file = readGeoJsonShapes(text, "a.geojson", filter);
  return whole(file, file.ok() ? file.value().shapes : std::vector<ShapeInput>());
}

std::string collection(const std::string& features, const std::string& more = "") {
  return R"({"type":"FeatureCollection",)" + more + "\"features\" : [" + features + "\n]}";
}

TEST(FeaturePieces, giveTheShapesOfTheWholeFile) {
  std::string many;
  // More than a piece.
  for (int i = 0; i < 6000; ++i) {
    many += (i ? ",\n" : "") + lot(i * 10, R"({"id":)" + std::to_string(i) +
                                               R"(,"note":"a \"quoted\" ]} text \\","levels":2})");
  }
  const std::string line =
      R"({"type":"Feature","properties":null,"geometry":{"type":"LineString","coordinates":[[8,50],[8.1,50]]}})";
  const std::string metres = R"("crs":{"type":"name","properties":{"name":"EPSG:25832"}},)";
  for (const std::string& text :
       {collection(many), collection(lot(0), metres), collection(lot(0) + "," + line),
        collection(line + "," + line), collection(line + "," + lot(3)),
        collection(R"({"type":"Feature","geometry":null},)" + lot(1)),
        R"({"features":[)" + lot(0) + R"(],"type":"FeatureCollection","name":"features"})"}) {
    EXPECT_EQ(inPieces(text), atOnce(text)) << text.substr(0, 300);
  }
  const FeatureFilter filter{{}, "levels", "2"};
  EXPECT_EQ(inPieces(collection(many + "," + lot(-9)), filter),
            atOnce(collection(many + "," + lot(-9)), filter));
}

TEST(FeaturePieces, oneFeatureAndOneGeometryAreShapes) {
  const std::string geometry =
      R"({"type":"Polygon","coordinates":[[[0,0],[0.001,0],[0.001,0.001],[0,0]]]})";
  const std::string feature =
      R"({"type":"Feature","id":7,"properties":{"name":"a"},"geometry":)" + geometry + "}";
  for (const std::string& text : {geometry, feature, collection(feature)}) {
    EXPECT_EQ(inPieces(text), atOnce(text)) << text;
    EXPECT_FALSE(inPieces(text).starts_with("error")) << text;
  }
  EXPECT_EQ(inPieces("{}"), "error shapes-broken");
}

TEST(FeaturePieces, whatIsNoCollectionIsAnError) {
  const std::string good = collection(lot(0) + "," + lot(9));
  for (size_t end = 0; end < good.size(); end += 7) {
    EXPECT_TRUE(inPieces(good.substr(0, end)).starts_with("error shapes-")) << end;
  }
  for (const char* text : {"", "[]", "{", "\"", "{\"features\":[", "{\"features\":[{]}", "nonsense",
                           "{\"type\":\"FeatureCollection\",\"features\":[1,2,{}x]}", "}}]]"}) {
    EXPECT_TRUE(inPieces(text).starts_with("error shapes-")) << text << inPieces(text);
  }
}

}  // namespace
}  // namespace gable
