// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/map_file.h"

#include <gtest/gtest.h>

#include "base/child_process.h"
#include "base/files.h"
#include "base/random.h"
#include "base/temporary_folder.h"
#include "io/importers/shape_input.h"

namespace gable {
namespace {

// A house with a court, drawn in an editor (negative numbers), a church, a lawn, a street round a
// block and a way that names a node which the extract lacks.
constexpr const char* kOsm = R"(<?xml version='1.0' encoding='UTF-8'?>
<osm version='0.6' generator='test'>
 <node id='-1' lat='43.7300' lon='7.4200'/><node id='-2' lat='43.7300' lon='7.4204'/>
 <node id='-3' lat='43.7303' lon='7.4204'/><node id='-4' lat='43.7303' lon='7.4200'/>
 <node id='-5' lat='43.7301' lon='7.4201'/><node id='-6' lat='43.7301' lon='7.4202'/>
 <node id='-7' lat='43.7302' lon='7.4202'/><node id='-8' lat='43.7302' lon='7.4201'/>
 <node id='1' lat='43.7310' lon='7.4200'/><node id='2' lat='43.7310' lon='7.4202'/>
 <node id='3' lat='43.7311' lon='7.4202'/>
 <node id='4' lat='43.7312' lon='7.4202'><tag k='natural' v='tree'/></node>
 <way id='-10'><nd ref='-1'/><nd ref='-2'/><nd ref='-3'/><nd ref='-4'/><nd ref='-1'/></way>
 <way id='-11'><nd ref='-5'/><nd ref='-6'/><nd ref='-7'/><nd ref='-8'/><nd ref='-5'/></way>
 <way id='20'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='1'/>
  <tag k='building' v='church'/><tag k='building:levels' v='2'/><tag k='name' v='&quot;Old&quot; one'/></way>
 <way id='21'><nd ref='1'/><nd ref='2'/><nd ref='4'/><nd ref='1'/><tag k='landuse' v='grass'/></way>
 <way id='22'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='1'/><tag k='highway' v='service'/></way>
 <way id='23'><nd ref='1'/><nd ref='99'/><tag k='highway' v='path'/></way>
 <relation id='-30'><member type='way' ref='-10' role='outer'/><member type='way' ref='-11' role='inner'/>
  <tag k='type' v='multipolygon'/><tag k='building' v='house'/></relation>
</osm>
)";

Result<ShapeFile> osmShapes(const FeatureFilter& filter = {}) {
  return readShapes(kOsm, {"a.osm", {}, false}, filter);
}

class OpenStreetMap : public ::testing::Test {
 protected:
  void SetUp() override {
    if (programBeside("gable-maps").empty()) GTEST_SKIP() << "gable-maps is not built";
  }
};

TEST_F(OpenStreetMap, givesItsBuildingsWithTheirCourts) {
  Result<ShapeFile> r = osmShapes();
  ASSERT_TRUE(r.ok()) << r.error().message;
  ASSERT_EQ(r->shapes.size(), 2u);
  const ShapeInput& church = r->shapes[1];
  EXPECT_EQ(church.name, "\"Old\" one");
  EXPECT_EQ(church.id, "way/20");
  ASSERT_EQ(church.attributes.size(), 3u);
  EXPECT_EQ(church.attributes[1].name, "building_levels");
  // An area is there when its last way is.
  const ShapeInput& house = r->shapes[0];
  EXPECT_EQ(house.id, "relation/-30");
  EXPECT_EQ(house.mesh.loopsOf(0).size(), 2u);
  // 4 by 3 ten-thousandths of a degree less 1 by 1: 32.2 m x 33.3 m less 8.05 m x 11.1 m.
  EXPECT_NEAR(house.mesh.area(), 1074 - 89.5, 2);
  EXPECT_TRUE(r->geoOrigin.present);
}

TEST_F(OpenStreetMap, givesWhatIsAskedFor) {
  Result<ShapeFile> lawns = osmShapes({"", "landuse", "grass"});
  ASSERT_TRUE(lawns.ok()) << lawns.error().message;
  ASSERT_EQ(lawns->shapes.size(), 1u);
  EXPECT_EQ(lawns->shapes[0].id, "way/21");
  // A closed street is a line: a face of two corners for each stretch.
  Result<ShapeFile> streets = osmShapes({"", "highway", ""});
  ASSERT_TRUE(streets.ok()) << streets.error().message;
  EXPECT_EQ(streets->shapes[0].mesh.faceCount(), 3u);
  Result<ShapeFile> trees = osmShapes({"", "natural", "tree"});
  ASSERT_FALSE(trees.ok());
  EXPECT_EQ(trees.error().code, std::string("shapes-empty"));
  Result<ShapeFile> none = osmShapes({"", "water", ""});
  EXPECT_NE(none.error().message.find("'water'"), std::string::npos) << none.error().message;
  EXPECT_EQ(osmShapes({"", "natral", ""}).error().hint, "did you mean --only natural?");
  EXPECT_EQ(osmShapes({"lots", "", ""}).error().code, std::string("shapes-layer"));
  Result<ShapeFile> model = readShapes("v 0 0 0\n", {"a.obj", {}, false}, {"", "use", ""});
  EXPECT_EQ(model.error().code, std::string("shapes-layer"));
}

TEST_F(OpenStreetMap, brokenFilesEndInAnError) {
  const std::string text = kOsm;
  for (size_t length : {size_t{0}, size_t{10}, text.size() / 2, text.size() - 20}) {
    Result<ShapeFile> r = readShapes(text.substr(0, length), {"a.osm", {}, false});
    ASSERT_FALSE(r.ok()) << length;
    EXPECT_TRUE(r.error().code == std::string("shapes-broken") ||
                r.error().code == std::string("shapes-empty"))
        << r.error().code;
  }
  EXPECT_FALSE(readShapes(text, {"a.pbf", {}, false}).ok());
  for (uint64_t seed = 0; seed < 40; ++seed) {
    std::string broken = text;
    for (uint64_t k = 0; k < 4; ++k) {
      const uint64_t bits = randomBits(hashCombine(seed, k));
      broken[bits % broken.size()] = static_cast<char>(bits >> 56);
    }
    // An answer, whatever it is.
    Result<ShapeFile> r = readShapes(broken, {"a.osm", {}, false});
    EXPECT_TRUE(r.ok() || !r.error().message.empty());
  }
}

class Gdal : public ::testing::Test {
 protected:
  void SetUp() override {
    if (programBeside("ogr2ogr").empty()) GTEST_SKIP() << "GDAL's programs are not installed";
    const std::string lots = R"({"type":"FeatureCollection","features":[{"type":"Feature",
      "properties":{"kind":"shop","roof:shape":"flat","height":7.5},"geometry":{"type":"Polygon",
      "coordinates":[[[7.42,43.73],[7.421,43.73],[7.421,43.731],[7.42,43.731],[7.42,43.73]]]}}]})";
    ASSERT_TRUE(writeFile(path("lots.geojson"), lots).ok());
  }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  void make(const std::vector<std::string>& arguments) {
    Result<std::string> r = runChild(programBeside("ogr2ogr"), arguments, {}, {});
    ASSERT_TRUE(r.ok()) << r.error().message;
  }
  Result<ShapeFile> read(const std::string& name, const FeatureFilter& filter = {}) {
    Result<std::string> bytes = readFile(path(name));
    if (!bytes.ok()) return bytes.error();
    return readShapes(*bytes, {path(name), [](const std::string& p) { return readFile(p); }, false},
                      filter);
  }

  TemporaryFolder folder_;
};

// Of the attribute whose name begins so; an empty text where there is none.
PlainValue valueOf(const ShapeInput& s, const std::string& name) {
  for (const AttributeValue& a : s.attributes) {
    if (a.name.starts_with(name)) return a.values[0];
  }
  return {PlainValue::Kind::Text, 0, {}};
}

TEST_F(Gdal, givesTheSameLotInEveryFormatAndProjection) {
  const std::string lots = path("lots.geojson");
  make({"-f", "GPKG", path("a.gpkg"), lots, "-t_srs", "EPSG:32632", "-nln", "lots"});
  make({"-f", "FlatGeobuf", path("a.fgb"), lots});
  make({path("a.shp"), lots, "-t_srs", "EPSG:32632"});
  make({"-f", "KML", path("a.kml"), lots});
  for (const char* name : {"lots.geojson", "a.gpkg", "a.fgb", "a.shp", "a.kml"}) {
    Result<ShapeFile> r = read(name);
    ASSERT_TRUE(r.ok()) << name << ": " << r.error().message;
    ASSERT_EQ(r->shapes.size(), 1u) << name;
    // 80.57 m by 111.10 m.
    EXPECT_NEAR(r->shapes[0].mesh.area(), 8951.7, 0.5) << name;
    // Names in shapefiles have ten letters; KML has texts for numbers.
    EXPECT_EQ(valueOf(r->shapes[0], "kind").text, "shop") << name;
    EXPECT_EQ(valueOf(r->shapes[0], "roof_shap").text, "flat") << name;
    double height = 0;
    EXPECT_TRUE(numericValue(valueOf(r->shapes[0], "height"), height)) << name;
    EXPECT_EQ(height, 7.5) << name;
  }
}

TEST_F(Gdal, aFileWithoutACoordinateSystemIsInMetres) {
  make({path("a.shp"), path("lots.geojson"), "-t_srs", "EPSG:32632"});
  ASSERT_EQ(std::remove(path("a.prj").c_str()), 0);
  Result<ShapeFile> r = read("a.shp");
  ASSERT_TRUE(r.ok()) << r.error().message;
  // The grid of that zone is smaller than the ground here.
  EXPECT_NEAR(r->shapes[0].mesh.area(), 8951.7 * 0.9992, 5);
  EXPECT_FALSE(r->geoOrigin.present);
}

TEST_F(Gdal, aDrawingIsInMetres) {
  const std::string drawing =
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nLots\n90\n4\n70\n1\n10\n0\n20\n0\n10\n30\n20\n0\n"
      "10\n30\n20\n20\n10\n0\n20\n20\n0\nENDSEC\n0\nEOF\n";
  ASSERT_TRUE(writeFile(path("a.dxf"), drawing).ok());
  Result<ShapeFile> r = read("a.dxf", {"", "Layer", "Lots"});
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_NEAR(r->shapes[0].mesh.area(), 600, 1e-6);
  EXPECT_FALSE(r->geoOrigin.present);
}

TEST_F(Gdal, layersAreNamed) {
  make({"-f", "GPKG", path("a.gpkg"), path("lots.geojson"), "-nln", "lots"});
  make({"-f", "GPKG", "-update", path("a.gpkg"), path("lots.geojson"), "-nln", "old lots"});
  const Result<ShapeFile> several = read("a.gpkg");
  EXPECT_NE(several.error().message.find("several layers: lots, old lots"), std::string::npos);
  EXPECT_EQ(read("a.gpkg", {"new", "", ""}).error().code, std::string("shapes-layer"));
  Result<ShapeFile> r = read("a.gpkg", {"old lots", "", ""});
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_EQ(r->shapes.size(), 1u);
  EXPECT_EQ(read("a.gpkg", {"lots", "kind", "house"}).error().code, std::string("shapes-empty"));
}

TEST_F(Gdal, whatOnlyHasTheNameOfAFormatIsRefused) {
  ASSERT_TRUE(writeFile(path("a.gpkg"), "<OGRVRTDataSource><OGRVRTLayer name=\"x\">").ok());
  EXPECT_EQ(read("a.gpkg").error().code, std::string("shapes-broken"));
  ASSERT_TRUE(writeFile(path("b.gpkg"), std::string("SQLite format 3\0 and no more", 28)).ok());
  EXPECT_EQ(read("b.gpkg").error().code, std::string("shapes-broken"));
}

}  // namespace
}  // namespace gable
