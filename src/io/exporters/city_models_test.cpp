// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// CityJSON and IFC of small scenes. What is written here is read again by
// tests/written/city_check.py and, with other programs' readers, by tools/validate.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "base/files.h"
#include "base/json.h"
#include "io/exporters/city_kinds.h"
#include "io/exporters/city_place.h"
#include "io/exporters/step_text.h"
#include "io/exporters/write_model.h"
#include "io/geo/geo_frames.h"
#include "io/importers/shape_input.h"
#include "io/testing/scenes.h"

namespace gable {
namespace {

using testing::SceneBuilder;

class City : public SceneBuilder {
 public:
  City() { scene.attributeSets.emplace_back(); }
  uint32_t says(const std::string& attribute, const std::string& value) {
    const auto place = static_cast<uint32_t>(scene.attributeValues.size());
    scene.attributeValues.push_back({attribute, {{PlainValue::Kind::Text, 0, value}}, 0, 0});
    scene.attributeSets.push_back({place});
    return static_cast<uint32_t>(scene.attributeSets.size() - 1);
  }
  Leaf& box(const std::string& named, const Vec3& at, const Vec3& size, uint32_t attributes = 0) {
    Leaf& l = leaf(kUnitBox, Frame::moved(at), size);
    l.name = name(named);
    l.source = 1;
    l.attributes = attributes;
    if (scene.sources.size() < 2) scene.sources.push_back({"rules.cga", 9, 1, "Mass"});
    return l;
  }
};

// A house of a body, a roof slab, a door, two windows that stand apart, with a tree in two places
// and a path.
City houseWithGarden() {
  City c;
  c.box("Trunk", {0, 0, 0}, {0.4, 2, 0.4});
  c.box("Crown", {-1, 2, -1}, {2.4, 3, 2.4});
  const uint32_t tree = c.prototype("Tree");
  c.box("Plaster", {0, 0, 0}, {10, 6, 8});
  c.box("FrontDoor", {1, 0, 8}, {1, 2, 0.1});
  c.box("Glass", {4, 1, 8}, {1, 1.5, 0.1});
  c.box("Glass", {7, 1, 8}, {1, 1.5, 0.1});
  c.box("Slab", {-0.5, 6, -0.5}, {11, 0.4, 9}, c.says("cityPart", "Roof"));
  c.box("Path", {1, 0, 8.2}, {1, 0.05, 5});
  c.instance(tree, testing::turned(30, {15, 0, 3}));
  c.instance(tree, testing::turned(75, {19, 0, 5}));
  c.root("Long Street 5", c.prototype("Lot"), testing::turned(20, {100, 2, -50}));
  return c;
}

std::string inWritten(const std::string& name) {
  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  return std::string(GABLE_WRITTEN_DIR) + "/" + name;
}

JsonValue written(const Scene& scene, const std::string& name, const WriteOptions& options = {},
                  WriteReport* report = nullptr) {
  const std::string path = inWritten(name);
  auto r = writeModel(scene, path, options);
  EXPECT_TRUE(r.ok()) << r.error().message;
  if (report && r.ok()) *report = *r;
  auto json = parseJson(readFile(path).value());
  EXPECT_TRUE(json.ok()) << json.error().message;
  return json.ok() ? std::move(*json) : JsonValue();
}

std::set<std::string> typesOf(const JsonValue& geometry) {
  std::set<std::string> out;
  for (const JsonValue& s : geometry["semantics"]["surfaces"].items()) out.insert(s["type"].text());
  return out;
}

size_t countOf(const std::string& text, const std::string& word) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(CityKinds, lastTellingWordOfAName) {
  EXPECT_EQ(cityKindOfIdentifier("FrontDoor"), CityKind::Door);
  EXPECT_EQ(cityKindOfIdentifier("DoorWall"), CityKind::Wall);
  EXPECT_EQ(cityKindOfIdentifier("house.WindowFrame"), CityKind::Window);
  EXPECT_EQ(cityKindOfIdentifier("roof_2"), CityKind::Roof);
  EXPECT_EQ(cityKindOfIdentifier("Wood"), CityKind::Unknown);
  EXPECT_EQ(cityKindOfIdentifier(""), CityKind::Unknown);
  EXPECT_EQ(cityKindNamed("wallsurface"), CityKind::Wall);
  EXPECT_EQ(cityKindNamed("IfcSlab"), CityKind::Floor);
  EXPECT_EQ(cityKindNamed("SolitaryVegetationObject"), CityKind::Tree);
  EXPECT_EQ(cityKindNamed("Wal"), CityKind::Unknown);
}

TEST(CityKinds, whatLabelsAndTagsSay) {
  EXPECT_EQ(cityKindOfLabel("window"), CityKind::Window);
  EXPECT_EQ(cityKindOfLabel("IfcStair"), CityKind::Stair);
  EXPECT_EQ(cityKindOfLabel("front door"), CityKind::Door);
  EXPECT_EQ(cityKindOfLabel("Facade.North"), CityKind::Wall);
  EXPECT_EQ(cityKindOfLabel("RoofSurface"), CityKind::Roof);
  // The sides of a roof are walls.
  EXPECT_EQ(cityKindOfLabel("roof.side"), CityKind::Unknown);
  EXPECT_EQ(cityKindOfLabel("extrude.top"), CityKind::Unknown);
  EXPECT_EQ(cityKindOfLabel(""), CityKind::Unknown);
}

// A wall with two windows of one prototype, of a frame and a pane that say nothing, and what is
// said of them: they touch, and the second has a handle apart.
City labelledWall(std::vector<LabelledLeaves>& labels) {
  City c;
  c.box("A", {0, 0, 0}, {1, 1, 0.1});
  c.box("B", {0.1, 0.1, 0}, {0.8, 0.8, 0.05});
  const uint32_t window = c.prototype("Opening");
  c.box("C", {0, 0, -0.2}, {8, 4, 0.2});
  c.instance(window, Frame::moved({1, 1, 0}));
  c.instance(window, Frame::moved({2, 1, 0}));
  c.box("D", {6, 1, 0}, {0.1, 0.1, 0.1});
  c.box("E", {0, 4, -4}, {8, 0.2, 4.2}, c.says("cityPart", "Floor"));
  c.root("Long Street 6", c.prototype("Lot"), Frame{});
  labels = {{0, 1, 1, "wall"}, {1, 3, 2, "window"}, {3, 6, 3, "window"}, {6, 7, 4, "door"}};
  return c;
}

TEST(CityJsonWriter, labelsSayWhatSurfacesAre) {
  WriteOptions options;
  options.detail = WriteOptions::Detail::Three;
  std::vector<LabelledLeaves> labels;
  const City c = labelledWall(labels);
  options.labelsOf = [&](size_t) { return labels; };
  const JsonValue json = written(c.scene, "labelled.city.json", options);
  std::map<std::string, int> types;
  for (const auto& [id, object] : json["CityObjects"].members()) {
    for (const JsonValue& g : object["geometry"].items()) {
      for (const JsonValue& s : g["semantics"]["surfaces"].items()) ++types[s["type"].text()];
    }
  }
  // Two windows, though they touch, and the attribute goes before the label.
  EXPECT_EQ(types["Window"], 2);
  EXPECT_EQ(types["Door"], 0);
  EXPECT_GE(types["WallSurface"], 1);
}

// The panes of a dormer.
TEST(Ifc, namesSayOpeningsInLabelledWallsAndRoofs) {
  City c;
  c.box("Tiles", {0, 0, 0}, {2, 2, 2});
  c.box("Glass", {0.5, 0.5, 2}, {1, 1, 0.1});
  const uint32_t dormer = c.prototype("Dormer");
  c.instance(dormer, Frame::moved({1, 1, 0}));
  c.instance(dormer, Frame::moved({5, 1, 0}));
  c.root("Long Street 7", c.prototype("Lot"), Frame{});
  WriteOptions options;
  options.labelsOf = [](size_t) {
    return std::vector<LabelledLeaves>{{0, 2, 1, "roof"}, {2, 4, 2, "roof"}};
  };
  const std::string path = inWritten("dormers.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCROOF("), 2u);
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 2u);
}

TEST(Ifc, labelsSayWhatElementsAre) {
  WriteOptions options;
  std::vector<LabelledLeaves> labels;
  const City c = labelledWall(labels);
  options.labelsOf = [&](size_t) { return labels; };
  const std::string path = inWritten("labelled.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 2u);
  EXPECT_EQ(countOf(text, "=IFCWALL("), 1u);
  EXPECT_EQ(countOf(text, "=IFCSLAB("), 1u);
  EXPECT_EQ(countOf(text, "=IFCDOOR("), 0u);
  // The first is all of its shape and is mapped; the second has more than the prototype.
  EXPECT_EQ(countOf(text, "=IFCMAPPEDITEM("), 1u);
  EXPECT_EQ(countOf(text, "=IFCBUILDINGELEMENTPROXY("), 0u);
}

TEST(CityJsonWriter, aLotBecomesABuildingTreesAndAPath) {
  const City c = houseWithGarden();
  WriteOptions options;
  options.attributesOf = [](size_t) {
    return std::vector<AttributeValue>{
        {"owner", {{PlainValue::Kind::Text, 0, "O'Neil \"x\" \\ \xc3\xa9"}}, 0, 0},
        {"owner", {{PlainValue::Kind::Text, 0, "another"}}, 0, 0},
        {"area", {{PlainValue::Kind::Number, 80.5, {}}}, 0, 0}};
  };
  const JsonValue model = written(c.scene, "house.city.json", options);
  const JsonValue& objects = model["CityObjects"];
  ASSERT_EQ(objects.members().size(), 4u);
  const JsonValue& house = objects["Long Street 5"];
  EXPECT_EQ(house["type"].text(), "Building");
  EXPECT_EQ(house["attributes"]["owner"].text(), "O'Neil \"x\" \\ \xc3\xa9");
  EXPECT_EQ(house["attributes"]["area"].number(0), 80.5);
  EXPECT_NEAR(house["attributes"]["measuredHeight"].number(0), 6.4, 1e-9);
  ASSERT_EQ(house["geometry"].size(), 3u);
  EXPECT_EQ(house["geometry"].at(0)["type"].text(), "Solid");
  EXPECT_EQ(house["geometry"].at(0)["lod"].text(), "1.2");
  EXPECT_EQ(house["geometry"].at(1)["lod"].text(), "2.2");
  const JsonValue& full = house["geometry"].at(2);
  EXPECT_EQ(full["type"].text(), "MultiSurface");
  EXPECT_EQ(full["boundaries"].size(), 5u * 6);
  EXPECT_EQ(typesOf(full), (std::set<std::string>{"Door", "GroundSurface", "RoofSurface",
                                                  "WallSurface", "Window"}));
  // Two windows are two semantic surfaces.
  size_t windows = 0;
  for (const JsonValue& s : full["semantics"]["surfaces"].items()) {
    windows += s["type"].text() == "Window" ? 1 : 0;
  }
  EXPECT_EQ(windows, 2u);
  EXPECT_EQ(objects["Long Street 5/Road"]["type"].text(), "Road");
  EXPECT_EQ(objects["Long Street 5/Tree"]["type"].text(), "SolitaryVegetationObject");
  EXPECT_EQ(objects["Long Street 5/Tree-2"]["geometry"].at(0)["type"].text(), "GeometryInstance");
  EXPECT_EQ(model["geometry-templates"]["templates"].size(), 1u);
}

TEST(CityJsonWriter, templatesStandWhereTheLeavesStand) {
  const City c = houseWithGarden();
  const JsonValue model = written(c.scene, "trees.city.json");
  // A corner of the crown, by the scene and by the file.
  const Frame lot = c.scene.roots[0].instance.frame;
  const Vec3 corner = (lot * testing::turned(30, {15, 0, 3})).point({-1, 2, -1});
  const JsonValue& g = model["CityObjects"]["Long Street 5/Tree"]["geometry"].at(0);
  const JsonValue& m = g["transformationMatrix"];
  const JsonValue& v = model["vertices"].at(static_cast<size_t>(g["boundaries"].at(0).number(0)));
  double nearest = 1e9;
  for (const JsonValue& t : model["geometry-templates"]["vertices-templates"].items()) {
    std::array<double, 3> at{};
    for (size_t row = 0; row < 3; ++row) {
      for (size_t k = 0; k < 3; ++k) at[row] += m.at(4 * row + k).number(0) * t.at(k).number(0);
      at[row] += v.at(row).number(0) * 0.001 + model["transform"]["translate"].at(row).number(0);
    }
    nearest = std::min(nearest, length(Vec3{at[0], at[2], -at[1]} - corner));
  }
  EXPECT_LT(nearest, 0.002);
}

TEST(CityJsonWriter, levelsOfDetailAreChosen) {
  const City c = houseWithGarden();
  WriteOptions options;
  options.detail = WriteOptions::Detail::Two;
  const JsonValue two = written(c.scene, "two.city.json", options);
  EXPECT_EQ(two["CityObjects"].members().size(), 2u);
  EXPECT_EQ(two["CityObjects"]["Long Street 5"]["geometry"].size(), 1u);
  EXPECT_EQ(typesOf(two["CityObjects"]["Long Street 5"]["geometry"].at(0)),
            (std::set<std::string>{"GroundSurface", "RoofSurface", "WallSurface"}));
  // What the path shows from above.
  EXPECT_EQ(two["CityObjects"]["Long Street 5/Road"]["geometry"].at(0)["boundaries"].size(), 1u);
  options.detail = WriteOptions::Detail::One;
  written(c.scene, "one.city.json", options);
  options.detail = WriteOptions::Detail::Three;
  written(c.scene, "three.city.json", options);
}

TEST(CityJsonWriter, partsAndInstallationsAreChildren) {
  City c;
  c.box("Plaster", {0, 0, 0}, {10, 6, 8});
  c.box("Plaster", {10, 0, 0}, {5, 4, 8}, c.says("cityObject", "West wing"));
  c.box("Chimney", {3, 6, 3}, {0.5, 2, 0.5});
  c.box("Anything", {0, 0, 9}, {1, 1, 1}, c.says("houses.cityPart", "IfcStair"));
  c.box("Anything", {0, 0, 20}, {1, 1, 1}, c.says("cityPart", "Widget"));
  c.root("a", c.prototype("Lot"), Frame{});
  WriteReport report;
  const JsonValue model = written(c.scene, "parts.city.json", {}, &report);
  const JsonValue& objects = model["CityObjects"];
  EXPECT_EQ(objects["a"]["children"].size(), 3u);
  EXPECT_EQ(objects["a/West wing"]["type"].text(), "BuildingPart");
  EXPECT_EQ(objects["a/West wing"]["parents"].at(0).text(), "a");
  EXPECT_EQ(objects["a/Chimney"]["type"].text(), "BuildingInstallation");
  EXPECT_EQ(objects["a/Stair"]["type"].text(), "BuildingInstallation");
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("'Widget' is no cityPart"), std::string::npos);
}

TEST(CityJsonWriter, whatHasNoRoofIsNoBuilding) {
  City c;
  c.box("Anything", {0, 0, 0}, {3, 1, 2});
  c.box("Step", {3, 0, 0}, {1, 0.2, 2});
  c.root("a", c.prototype("Lot"), Frame{});
  const JsonValue model = written(c.scene, "low.city.json");
  for (const auto& [id, object] : model["CityObjects"].members()) {
    EXPECT_EQ(object["type"].text(), "OtherConstruction") << id;
    EXPECT_TRUE(object["parents"].isNull());
    EXPECT_EQ(object["geometry"].size(), 1u);
  }
  EXPECT_EQ(model["CityObjects"].members().size(), 2u);
}

TEST(CityJsonWriter, groundWithoutABuildingIsLand) {
  City c;
  c.box("Ground", {0, 0, 0}, {9, 0.1, 9});
  c.root("bare", c.prototype("Lot"), Frame{});
  c.box("Ground", {0, 0, 0}, {9, 0.1, 9});
  c.box("Wall", {0, 0, 0}, {9, 6, 9});
  c.root("built", c.prototype("Lot"), Frame{});
  const JsonValue model = written(c.scene, "ground.city.json");
  EXPECT_EQ(model["CityObjects"].members().size(), 2u);
  EXPECT_EQ(model["CityObjects"]["bare"]["type"].text(), "LandUse");
  EXPECT_EQ(typesOf(model["CityObjects"]["built"]["geometry"].at(2)).count("GroundSurface"), 1u);
}

TEST(CityJsonWriter, whatIsCalledLotIsLandWhereItIsFlat) {
  City c;
  c.box("Lot", {0, 0, 0}, {9, 0.1, 9});
  c.root("bare", c.prototype("Lot"), Frame{});
  c.box("Lot", {0, 0, 0}, {9, 6, 9});
  c.root("built", c.prototype("Lot"), Frame{});
  c.box("Soil", {0, -6, 0}, {9, 6, 9});
  c.root("soil", c.prototype("Lot"), Frame{});
  const JsonValue model = written(c.scene, "lots.city.json");
  EXPECT_EQ(model["CityObjects"]["bare"]["type"].text(), "LandUse");
  EXPECT_EQ(model["CityObjects"]["built"]["type"].text(), "Building");
  EXPECT_EQ(model["CityObjects"]["soil"]["type"].text(), "LandUse");
}

TEST(CityJsonWriter, whatStandsOnARoofHasNoGround) {
  City c;
  c.box("Wall", {0, 0, 0}, {9, 6, 9});
  c.box("Chimney", {4, 6.5, 4}, {1, 2, 1});
  c.root("a", c.prototype("House"), Frame{});
  const JsonValue model = written(c.scene, "chimney.city.json");
  for (const auto& [id, object] : model["CityObjects"].members()) {
    if (object["type"].text() != "BuildingInstallation") continue;
    const auto types = typesOf(object["geometry"].at(0));
    EXPECT_EQ(types.count("GroundSurface"), 0u);
    EXPECT_EQ(types.count("OuterCeilingSurface"), 1u);
    return;
  }
  ADD_FAILURE() << "there is no chimney";
}

TEST(CityJsonWriter, aFeatureALine) {
  City c = houseWithGarden();
  c.box("Water", {0, 0, 0}, {5, 1, 5});
  c.root("Pond", c.prototype("Pond"), Frame::moved({300, 0, 0}));
  const std::string path = inWritten("lines.city.jsonl");
  ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "\n"), 1u + 4 + 1);
  EXPECT_EQ(countOf(text, "\"CityJSONFeature\""), 5u);
  EXPECT_EQ(countOf(text, "GeometryInstance"), 0u);
  EXPECT_NE(text.find("\"Pond\":{\"type\":\"WaterBody\""), std::string::npos);
}

TEST(CityJsonWriter, liesWhereTheShapesLie) {
  City c = houseWithGarden();
  c.scene.geoOrigin = {true, 7.42, 43.73};
  const JsonValue model = written(c.scene, "monaco.city.json");
  EXPECT_EQ(model["metadata"]["referenceSystem"].text(),
            "https://www.opengis.net/def/crs/EPSG/0/32632");
  // 7.42 E, 43.73 N by the series of Krueger, computed apart from this.
  const JsonValue& shift = model["transform"]["translate"];
  EXPECT_NEAR(shift.at(0).number(0), 372751, 1);
  EXPECT_NEAR(shift.at(1).number(0), 4843098, 1);
  const auto frame = mapGeoFrame("EPSG:28992", {85000, 447000});
  CityPlace place(frame.get(), {});
  EXPECT_EQ(place.system(), 28992);
  EXPECT_EQ(place.at({10, 3, -20}), (Vec3{85010, 3, 447020} + Vec3{0, 447017, -447017}));
  EXPECT_EQ(CityPlace(nullptr, {}).system(), 0);
  // What tiles make of a projection is that projection, also across their borders.
  CityPlace tiled(nullptr, c.scene.geoOrigin);
  const TransverseMercator local({7.42, 43.73}), utm({9, 0});
  for (const Vec2 p : {Vec2{0, 0}, Vec2{255.99, -0.01}, Vec2{256.01, 1000}, Vec2{-7321, 4000}}) {
    const Vec2 on = utm.forward(local.inverse(p));
    const Vec3 at = tiled.at({p.x, 5, -p.y});
    EXPECT_NEAR(at.x, 5e5 + 0.9996 * on.x, 2e-6);
    EXPECT_NEAR(at.y, 0.9996 * on.y, 2e-6);
  }
}

TEST(CityModels, emptyAndHostileScenesAreModels) {
  for (const char* format : {"city.json", "city.jsonl", "ifc"}) {
    EXPECT_TRUE(writeModel(Scene{}, inWritten(std::string("none.") + format), {}).ok());
    City c;
    c.box("x", {0, 0, 0}, {0, 0, 0});
    c.box("y", {1e29, 0, 0}, {1, 1, 1});
    c.box("Wall\n'\"\\\xff\xf0\x9f\x8c\xb3", {0, 0, 0}, {1, 3, -1});
    Mesh bent = makeQuadMesh(2, 2, QuadPlane::Xy, false);
    bent.positions[2].z = 1;
    c.leaf(c.mesh(bent), Frame{}, {1, 1, 1});
    c.root("'); DROP\\\n\"", c.prototype("P"), Frame{});
    c.root("'); DROP\\\n\"", 0, Frame::moved({9, 0, 0}));
    c.prototype("Nothing");
    c.scene.prototypes.back().empty = true;
    c.root("", 1, Frame{});
    EXPECT_TRUE(writeModel(c.scene, inWritten(std::string("hostile.") + format), {}).ok());
  }
  const JsonValue hostile = parseJson(readFile(inWritten("hostile.city.json")).value()).value();
  EXPECT_EQ(hostile["CityObjects"].members().size(), 2u);
}

TEST(Ifc, elementsLieInStoreys) {
  City c = houseWithGarden();
  const std::string path = inWritten("house.ifc");
  WriteOptions options;
  options.attributesOf = [](size_t) {
    return std::vector<AttributeValue>{{"floors", {{PlainValue::Kind::Number, 2, {}}}, 0, 0}};
  };
  auto report = writeModel(c.scene, path, options);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->triangles, 12u * (6 + 2 * 2));
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCBUILDING("), 1u);
  EXPECT_EQ(countOf(text, "=IFCBUILDINGSTOREY("), 2u);
  EXPECT_EQ(countOf(text, "=IFCWALL("), 1u);
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 2u);
  EXPECT_EQ(countOf(text, "=IFCDOOR("), 1u);
  EXPECT_EQ(countOf(text, "=IFCROOF("), 1u);
  EXPECT_EQ(countOf(text, "=IFCGEOGRAPHICELEMENT("), 3u);
  EXPECT_EQ(countOf(text, "=IFCMAPPEDITEM("), 2u);
  EXPECT_EQ(countOf(text, "=IFCREPRESENTATIONMAP("), 1u);
  // As wide as it is, though the house is turned.
  EXPECT_NE(text.find(",$,2.,1.,.NOTDEFINED."), std::string::npos);
  EXPECT_NE(text.find("IFCPROPERTYSINGLEVALUE('floors',$,IFCREAL(2.),$)"), std::string::npos);
}

// What is extruded has its height along z, and its depth along y.
TEST(Ifc, openingsAreAsHighAsTheyStand) {
  City c;
  c.box("Glass", {0, 0, 0}, {1.1, 0.06, 1.4});
  const Frame lying = Frame::of({3, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
  c.root("a", c.prototype("P"), lying);
  c.box("Gate", {0, 0, 0}, {2.25, 0.04, 1});
  c.root("b", c.prototype("Q"), Frame::of({9, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}));
  const std::string path = inWritten("lying.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
  const std::string text = readFile(path).value();
  EXPECT_NE(text.find(",$,1.4,1.1,.NOTDEFINED."), std::string::npos);
  EXPECT_NE(text.find(",$,2.25,1.,.NOTDEFINED."), std::string::npos);
}

TEST(Ifc, equalElementsShareTheirShape) {
  City c;
  for (const double x : {0.0, 3.0, 6.0}) c.box("Glass", {x, 1, 0}, {1, 1.5, 0.1});
  c.box("Glass", {9, 1, 0}, {1, 1.75, 0.1});
  c.root("a", c.prototype("P"), testing::turned(20, {100, 2, -50}));
  c.box("Glass", {0.3, 7, 0.1}, {1, 1.5, 0.1});
  c.root("b", c.prototype("Q"), testing::turned(75, {1e5, 0, 1e5}));
  // Whoever lies where no number reaches is left out, and spoils no other.
  c.box("Glass", {2e9, 0, 0}, {1, 1.5, 0.1});
  c.root("c", c.prototype("R"), Frame{});
  const std::string path = inWritten("shared.ifc");
  auto report = writeModel(c.scene, path, {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->triangles, 12u * 5);
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 5u);
  EXPECT_EQ(countOf(text, "=IFCTRIANGULATEDFACESET("), 2u);
  EXPECT_EQ(countOf(text, "=IFCPRODUCTDEFINITIONSHAPE("), 2u);
  // Two axes of each of both turns, of which one is upright.
  EXPECT_EQ(countOf(text, "=IFCDIRECTION("), 3u);
}

TEST(Ifc, storeysHaveTheNamesThatRulesGive) {
  City c;
  c.box("Wall", {0, 0, 0}, {9, 3, 1}, c.says("cityStorey", "Ground floor"));
  c.box("Wall", {0, 3, 0}, {9, 3, 1}, c.says("cityStorey", "Piano nobile"));
  c.root("a", c.prototype("Lot"), Frame{});
  const std::string path = inWritten("storeys.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
  const std::string text = readFile(path).value();
  EXPECT_NE(text.find("'Ground floor',$,$"), std::string::npos);
  EXPECT_NE(text.find("'Piano nobile',$,$"), std::string::npos);
  EXPECT_NE(text.find(".ELEMENT.,3.);"), std::string::npos);
}

TEST(Ifc, storeysEndAtTheEaves) {
  // Two storeys of three metres below a roof of nearly four, with a blank wall and windows above.
  City c;
  c.box("Wall", {0, 0, 0}, {10, 6, 8});
  c.box("Roof", {0, 6, 0}, {10, 3.78, 8});
  c.box("Pane", {1, 1, 8}, {1, 1.4, 0.1});
  c.box("Wall", {2, 0, 8}, {0.5, 5.9, 0.1});
  c.box("Pane", {1, 4, 8}, {1, 1.4, 0.1});
  c.root("a", c.prototype("Lot"), Frame{});
  WriteOptions options;
  options.attributesOf = [](size_t) {
    return std::vector<AttributeValue>{{"levels", {{PlainValue::Kind::Text, 0, "2"}}, 0, 0}};
  };
  const std::string path = inWritten("eaves.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCBUILDINGSTOREY("), 2u);
  EXPECT_EQ(countOf(text, "=IFCRELCONTAINEDINSPATIALSTRUCTURE("), 2u);
  EXPECT_NE(text.find(".ELEMENT.,3.);"), std::string::npos);
  EXPECT_NE(text.find(",$,'eaves',$"), std::string::npos);
}

TEST(Ifc, aHighWallDoesNotPullItsStoreyDown) {
  City c;
  const uint32_t first = c.says("cityStorey", "Storey 1"), zero = c.says("cityStorey", "Storey 0");
  c.box("Wall", {0, 3, 0}, {9, 3, 1}, first);
  c.box("Wall", {0, 0, 9}, {3, 6, 1}, first);
  c.box("Wall", {0, 0, 0}, {9, 3, 1}, zero);
  c.box("Roof", {0, 6, 0}, {9, 1, 1});
  c.root("a", c.prototype("Lot"), Frame{});
  const std::string path = inWritten("high.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
  const std::string text = readFile(path).value();
  // The storeys that the roof would make are those that have names.
  EXPECT_EQ(countOf(text, "=IFCBUILDINGSTOREY("), 2u);
  EXPECT_NE(text.find(".ELEMENT.,3.);"), std::string::npos);
  EXPECT_LT(text.find("'Storey 0'"), text.find("'Storey 1'"));
}

TEST(CityKinds, trimIsOfWhatItIsOn) {
  City c;
  c.scene.sources.resize(5);
  const char* rules[] = {"", "", "Wall", "Railing", "furniture.Make"};
  for (size_t i = 1; i < 5; ++i) c.scene.sources[i].rule = rules[i];
  const auto add = [&](const char* leaf, uint32_t rule) {
    c.box(leaf, {0, 0, 0}, {1, 1, 1}).source = rule;
  };
  add("Bars", 2);
  add("Sill", 1);
  add("Bars", 3);
  add("DoorFrame", 2);
  add("furniture.Wood", 1);
  add("Wood", 4);
  add("Step", 2);
  add("Ground", 1);
  c.prototype("Lot");
  ASSERT_GE(c.scene.leaves.size(), 8u);
  const CityParts parts(c.scene);
  const CityKind expected[] = {CityKind::Window, CityKind::Covering, CityKind::Railing,
                               CityKind::Door,   CityKind::Unknown,  CityKind::Unknown,
                               CityKind::Stair,  CityKind::Ground};
  for (size_t i = 0; i < 8; ++i) EXPECT_EQ(parts.of(c.scene.leaves[i]).kind, expected[i]) << i;
}

// Trim is of the element that it touches, whichever comes first, and no element of its own.
TEST(Ifc, trimIsOfWhatItTouches) {
  City c;
  // A window with its sill first, and one whose sill comes last.
  c.box("Sill", {0, 0.9, 0}, {1.2, 0.1, 0.3});
  c.box("Pane", {0.1, 1, 0.1}, {1, 1, 0.02});
  c.box("Pane", {4.1, 1, 0.1}, {1, 1, 0.02});
  c.box("Sill", {4, 0.9, 0}, {1.2, 0.1, 0.3});
  // Steps with an edge of stone, a door in its frame, and a moulding at a wall.
  c.box("Step", {8, 0, 0}, {2, 0.2, 1});
  c.box("Trim", {8, 0.2, 0}, {2, 0.02, 1});
  c.box("Frame", {12, 0, 0}, {1, 2.1, 0.1});
  c.box("Door", {12.1, 0, 0}, {0.8, 2, 0.1});
  c.box("Wall", {16, 0, 0}, {5, 3, 0.3});
  c.box("Trim", {16, 3, 0}, {5, 0.1, 0.4});
  c.root("a", c.prototype("Lot"), Frame{});
  const std::string path = inWritten("trim.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 2u);
  EXPECT_EQ(countOf(text, "=IFCSTAIR("), 1u);
  EXPECT_EQ(countOf(text, "=IFCDOOR("), 1u);
  EXPECT_EQ(countOf(text, "=IFCWALL("), 1u);
  EXPECT_EQ(countOf(text, "=IFCCOVERING("), 1u);
  EXPECT_NE(text.find(".MOLDING."), std::string::npos);
  // A window is called by its pane, and is as wide as its sill.
  EXPECT_EQ(countOf(text, ",'Pane',$,'Window'"), 2u);
  EXPECT_EQ(countOf(text, ",1.1,1.2,.NOTDEFINED."), 2u);
}

// A pane is set back behind its frame, and a rail holds balusters that stand apart; however the
// house is turned, in both formats, and whether parts are shared or not.
TEST(CityRuns, elementsAreThoseOfTheTurnedHouse) {
  for (const double degrees : {0.0, 10.0, 45.0}) {
    for (const bool shares : {false, true}) {
      City c;
      c.box("Frame", {0, 0, 0}, {0.07, 1.4, 0.04});
      const uint32_t bar = c.prototype("Bar");
      for (const double at : {0.0, 3.0}) {
        const auto frame = [&](double x) {
          if (shares)
            c.instance(bar, Frame::moved({at + x, 1, 0}));
          else
            c.box("Frame", {at + x, 1, 0}, {0.07, 1.4, 0.04});
        };
        c.box("Wall", {at - 1, 0, 0}, {1, 3, 0.3});
        frame(0);
        c.box("Pane", {at + 0.07, 1, -0.1}, {1.06, 1.4, 0.01});
        frame(1.13);
      }
      for (int i = 0; i < 10; ++i) c.box("Baluster", {i * 0.15, 0, 5}, {0.03, 0.9, 0.03});
      c.box("Handrail", {0, 0.9, 5}, {1.4, 0.05, 0.05});
      c.root("a", c.prototype("Lot"), testing::turned(degrees, {100, 2, -50}));
      const std::string path = inWritten("turned.ifc");
      ASSERT_TRUE(writeModel(c.scene, path, {}).ok());
      const std::string text = readFile(path).value();
      EXPECT_EQ(countOf(text, "=IFCWINDOW("), 2u) << degrees << shares;
      EXPECT_EQ(countOf(text, ",1.4,1.2,.NOTDEFINED."), 2u) << degrees << shares;
      EXPECT_EQ(countOf(text, "=IFCRAILING("), 1u) << degrees << shares;
      const JsonValue model = written(c.scene, "turned.city.json");
      size_t windows = 0;
      for (const auto& [id, object] : model["CityObjects"].members()) {
        for (const JsonValue& g : object["geometry"].items()) {
          for (const JsonValue& surface : g["semantics"]["surfaces"].items()) {
            if (g["lod"].text() != "3" || surface["type"].text() != "Window") continue;
            ++windows;
            EXPECT_EQ(surface["name"].text(), "Pane");
          }
        }
      }
      EXPECT_EQ(windows, 2u) << degrees << shares;
    }
  }
}

// A lawn without a name that says it is no roof, and what a rule called Lot makes in the air is no
// land.
TEST(CityJsonWriter, whatLiesAtTheFootIsLand) {
  City c;
  c.scene.sources = {{}, {"rules.cga", 9, 1, "Lot"}};
  c.box("Wall", {0, 0, 0}, {9, 6, 9});
  Leaf& lawn = c.leaf(kUnitQuadXz, Frame::moved({-5, 0, -5}), {20, 1, 20});
  lawn.name = c.name("Green");
  lawn.source = 1;
  c.box("Ramp", {3, 3, 9}, {2, 0.1, 1});
  Leaf& said = c.leaf(kUnitQuadXz, Frame::moved({0, 0, 0}), {9, 1, 9});
  said.name = c.name("Slab");
  said.attributes = c.says("cityPart", "Ground");
  c.root("a", c.prototype("Lot"), Frame{});
  const JsonValue model = written(c.scene, "lawn.city.json");
  ASSERT_EQ(model["CityObjects"].members().size(), 2u);
  EXPECT_EQ(model["CityObjects"]["a"]["type"].text(), "Building");
  EXPECT_EQ(model["CityObjects"]["a/Land"]["type"].text(), "LandUse");
}

TEST(CityJsonWriter, balconiesAreInstallations) {
  City c;
  c.box("Wall", {0, 0, 0}, {9, 6, 9});
  c.box("Balcony", {2, 3, 9}, {4, 0.2, 1.5});
  c.root("a", c.prototype("Lot"), Frame{});
  const JsonValue model = written(c.scene, "balcony.city.json");
  EXPECT_EQ(model["CityObjects"]["a/Balcony"]["type"].text(), "BuildingInstallation");
  // The block of the building ends at its walls: it has six faces.
  const JsonValue& block = model["CityObjects"]["a"]["geometry"].at(0);
  EXPECT_EQ(block["lod"].text(), "1.2");
  EXPECT_EQ(block["boundaries"].at(0).items().size(), 6u);
}

// In a labelled wall a sill is of the window that it touches, else of the wall.
TEST(Ifc, trimInALabelledWall) {
  City c;
  c.box("Brick", {0, 0, 0}, {5, 3, 0.3});
  c.box("Sill", {1, 0.9, 0.3}, {1.2, 0.1, 0.3});
  c.box("Pane", {1.1, 1, 0.3}, {1, 1, 0.02});
  c.box("Trim", {0, 2.8, 0.3}, {5, 0.1, 0.1});
  c.root("a", c.prototype("Lot"), Frame{});
  WriteOptions options;
  options.labelsOf = [](size_t) { return std::vector<LabelledLeaves>{{0, 4, 1, "wall"}}; };
  const std::string path = inWritten("labelled-trim.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCWINDOW("), 1u);
  EXPECT_EQ(countOf(text, "=IFCCOVERING("), 0u);
}

TEST(Ifc, whatNothingSaysIsToldOrSeen) {
  City c;
  c.box("Brick", {0, 0, 0}, {8, 6, 8});
  const uint32_t tiles = c.name("Tiles"), render = c.name("Render");
  const auto sheet = [&](uint32_t mesh, const Vec3& at, const Vec3& size, uint32_t named) {
    Leaf& l = c.leaf(mesh, Frame::moved(at), size);
    l.name = named;
    l.source = 1;
  };
  sheet(kUnitQuadXz, {0, 6, 0}, {8, 1, 8}, tiles);
  sheet(kUnitQuadXy, {0, 0, 9}, {8, 6, 1}, render);
  c.root("a", c.prototype("Lot"), Frame{});
  const std::string path = inWritten("seen.ifc");
  auto report = writeModel(c.scene, path, {});
  ASSERT_TRUE(report.ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCROOF("), 1u);
  EXPECT_EQ(countOf(text, "=IFCWALL("), 1u);
  EXPECT_EQ(countOf(text, "=IFCBUILDINGELEMENTPROXY("), 1u);
  ASSERT_EQ(report->warnings.size(), 1u);
  EXPECT_NE(report->warnings[0].find("nothing says what 1 part is"), std::string::npos);
  EXPECT_NE(report->warnings[0].find("Brick (1)"), std::string::npos);
}

// Sheets that stand several times are told by where they look, too.
TEST(Ifc, whatIsSharedIsSeenAsWell) {
  City c;
  Leaf& tiles = c.leaf(kUnitQuadXz, Frame{}, {4, 1, 4});
  tiles.name = c.name("Tiles");
  tiles.source = 1;
  const uint32_t slope = c.prototype("Slope");
  c.box("Wall", {0, 0, 0}, {8, 6, 4});
  c.instance(slope, Frame::moved({0, 6, 0}));
  c.instance(slope, Frame::moved({5, 6, 0}));
  c.root("a", c.prototype("Lot"), Frame{});
  const std::string path = inWritten("slopes.ifc");
  auto report = writeModel(c.scene, path, {});
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->warnings.empty());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "=IFCROOF("), 2u);
  EXPECT_EQ(countOf(text, "=IFCBUILDINGELEMENTPROXY("), 0u);
}

TEST(CityJsonWriter, objectsHaveTheIdsOfMaps) {
  City c = houseWithGarden();
  c.scene.roots[0].name = c.name("Building");
  WriteOptions options;
  options.attributesOf = [](size_t) {
    const auto text = [](const char* t) { return PlainValue{PlainValue::Kind::Text, 0, t}; };
    return std::vector<AttributeValue>{{"id", {text("way/7")}, 0, 0},
                                       {"id", {text("Building/way/7")}, 0, 0}};
  };
  const JsonValue model = written(c.scene, "ids.city.json", options);
  EXPECT_EQ(model["CityObjects"]["way/7"]["type"].text(), "Building");
  EXPECT_EQ(model["CityObjects"]["way/7"]["attributes"]["id"].text(), "way/7");
  const std::string path = inWritten("ids.ifc");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  EXPECT_NE(readFile(path).value().find(",$,'way/7',$,$,"), std::string::npos);
}

TEST(StepText, isEscaped) {
  EXPECT_EQ(stepText("a'b\\c"), "'a''b\\\\c'");
  EXPECT_EQ(stepText("\xc3\xa9\n"), "'\\X2\\00E9\\X0\\\\X2\\000A\\X0\\'");
  EXPECT_EQ(stepText("\xf0\x9f\x8c\xb3\xff"), "'\\X4\\0001F333\\X0\\\\X2\\FFFD\\X0\\'");
  EXPECT_EQ(stepText("abc", 2), "'ab'");
  EXPECT_EQ(stepReal(1), "1.");
  EXPECT_EQ(stepReal(-0.5), "-0.5");
  EXPECT_EQ(stepReal(1e300), "1.E+300");
  EXPECT_EQ(stepReal(std::numeric_limits<double>::quiet_NaN()), "0.");
  const std::string id = stepGuid(1, 2);
  EXPECT_EQ(id.size(), 22u);
  EXPECT_LE(id[0], '3');
  EXPECT_NE(id, stepGuid(2, 1));
}

TEST(CityJsonShapes, comeBackWithTagsAndAttributes) {
  const City c = houseWithGarden();
  WriteOptions options;
  options.detail = WriteOptions::Detail::Two;
  options.attributesOf = [](size_t) {
    return std::vector<AttributeValue>{{"floors", {{PlainValue::Kind::Number, 2, {}}}, 0, 0}};
  };
  const std::string path = inWritten("again.city.json");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  auto shapes = readShapes(text, {path, {}, false}, {{}, "type", "Building"});
  ASSERT_TRUE(shapes.ok()) << shapes.error().message;
  ASSERT_EQ(shapes->shapes.size(), 1u);
  const ShapeInput& house = shapes->shapes[0];
  EXPECT_EQ(house.id, "Long Street 5");
  EXPECT_NEAR(house.mesh.bounds().size().y, 6.4, 1e-6);
  EXPECT_NEAR(house.mesh.bounds().min.y, 2, 1e-6);
  ASSERT_EQ(house.faceTags.size(), house.mesh.faceCount());
  for (size_t f = 0; f < house.faceTags.size(); ++f) {
    const double up = house.mesh.normal(f).y;
    EXPECT_EQ(house.faceTags[f], up > 0.5    ? "RoofSurface"
                                 : up < -0.5 ? "GroundSurface"
                                             : "WallSurface");
  }
  ASSERT_GE(house.attributes.size(), 2u);
  EXPECT_EQ(house.attributes[0].name, "cityType");
  EXPECT_EQ(house.attributes[1].name, "floors");
  auto none = readShapes(text, {path, {}, false}, {{}, "type", "Bridge"});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, "shapes-empty");
}

// What hangs on a building has its attributes, so it is chosen by them as well.
TEST(CityJsonShapes, partsAreChosenByTheAttributesOfTheirBuilding) {
  City c;
  c.box("Wall", {0, 0, 0}, {9, 6, 9});
  c.box("Stairs", {2, 0, 9}, {2, 1, 1});
  c.root("a", c.prototype("Lot"), Frame{});
  WriteOptions options;
  options.attributesOf = [](size_t) {
    return std::vector<AttributeValue>{{"owner", {{PlainValue::Kind::Text, 0, "Ada"}}, 0, 0}};
  };
  const std::string path = inWritten("owned.city.json");
  ASSERT_TRUE(writeModel(c.scene, path, options).ok());
  const std::string text = readFile(path).value();
  for (const auto& [value, count] : {std::pair("Ada", 2u), std::pair("", 2u)}) {
    auto shapes = readShapes(text, {path, {}, false}, {{}, "owner", value});
    ASSERT_TRUE(shapes.ok()) << shapes.error().message;
    EXPECT_EQ(shapes->shapes.size(), count);
  }
  EXPECT_FALSE(readShapes(text, {path, {}, false}, {{}, "owner", "Bob"}).ok());
}

}  // namespace
}  // namespace gable
