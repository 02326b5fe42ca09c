// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Functions of the shape and of what lies around it: geometry, context, files.

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "builtins/catalogue.h"
#include "builtins/shared/materials.h"
#include "builtins/testing/op_fixture.h"
#include "math/trig.h"

namespace gable {
namespace {

struct Shapes : testing::Test {
  FakeServices services;
  double number(const char* name, const Shape& s, const std::vector<Arg>& args = {}) {
    return callNumber(name, args, services, s);
  }
  std::string text(const char* name, const Shape& s, const std::vector<Arg>& args = {}) {
    return callText(name, args, services, s);
  }
};

Shape lShape() { return polygonShape({{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}}); }

TEST_F(Shapes, areaCountsAllOrSomeFaces) {
  const Shape box = boxShape({2, 3, 4});
  const Shape mesh = meshShape(makeBoxMesh({2, 3, 4}, true));
  for (const Shape& s : {box, mesh}) {
    EXPECT_EQ(number("geometry.area", s), 52);
    EXPECT_EQ(number("geometry.area", s, {word("top")}), 8);
    EXPECT_EQ(number("geometry.area", s, {word("front")}), 6);
    EXPECT_EQ(number("geometry.area", s, {word("side")}), 36);
    EXPECT_EQ(number("geometry.area", s, {word("all")}), 52);
    EXPECT_EQ(number("geometry.area", s, {word("world.south")}), 6);
  }
  EXPECT_EQ(number("geometry.area", quadShape(2, 3)), 6);
  EXPECT_EQ(number("geometry.area", lShape()), 12);
  EXPECT_EQ(number("geometry.area", emptyShape({1, 1, 1})), 0);
}

TEST_F(Shapes, areaFollowsTheScope) {
  Shape s = lShape();
  s.size = {8, 0, 4};
  EXPECT_EQ(number("geometry.area", s), 24);
}

TEST_F(Shapes, orientationIsTold) {
  EXPECT_EQ(text("geometry.isOriented", wallShape(1, 1), {word("front")}), "true");
  EXPECT_EQ(text("geometry.isOriented", wallShape(1, 1), {word("top")}), "false");
  services.worldFrame = rotationXyz(0, 90, 0);
  EXPECT_EQ(text("geometry.isOriented", wallShape(1, 1), {word("world.east")}), "true");
}

TEST_F(Shapes, slopesAreMeasuredInTheWorld) {
  Shape roof = quadShape(4, 4);
  // Tilted about x: the upper side leans to +z, the south.
  roof.scope = rotationXyz(30, 0, 0);
  EXPECT_NEAR(number("geometry.angle", roof, {word("maxSlope")}), 30, 1e-9);
  EXPECT_NEAR(number("geometry.angle", roof, {word("zenith")}), 60, 1e-9);
  EXPECT_NEAR(number("geometry.angle", roof, {word("azimuth")}), 180, 1e-9);
  services.worldFrame = rotationXyz(0, 90, 0);
  EXPECT_NEAR(number("geometry.angle", roof, {word("azimuth")}), 90, 1e-9);
  EXPECT_EQ(number("geometry.angle", quadShape(1, 1), {word("maxSlope")}), 0);
  EXPECT_EQ(number("geometry.angle", wallShape(1, 1), {word("maxSlope")}), 90);
  EXPECT_NEAR(number("geometry.height", roof), 4 * sinDeg(30), 1e-9);
}

TEST_F(Shapes, countsAndKindsAgreeForPrimitivesAndMeshes) {
  const Shape box = boxShape({2, 3, 4});
  const Shape mesh = meshShape(makeBoxMesh({2, 3, 4}, true));
  for (const Shape& s : {box, mesh}) {
    EXPECT_EQ(number("geometry.nFaces", s), 6);
    EXPECT_EQ(number("geometry.nEdges", s), 12);
    EXPECT_EQ(number("geometry.nVertices", s), 8);
    EXPECT_EQ(number("geometry.nHoles", s), 0);
    EXPECT_EQ(number("geometry.volume", s), 24);
    EXPECT_EQ(number("geometry.boundaryLength", s), 0);
    EXPECT_EQ(text("geometry.isClosedSurface", s), "true");
    EXPECT_EQ(text("geometry.isConcave", s), "false");
    EXPECT_EQ(text("geometry.isPlanar", s, {0.25}), "true");
    EXPECT_EQ(text("geometry.isRectangular", s, {1}), "true");
  }
}

TEST_F(Shapes, formsOfFacesAreTold) {
  const Shape holed =
      polygonShape({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {6, 3}, {6, 6}, {3, 6}}});
  EXPECT_EQ(number("geometry.nHoles", holed), 1);
  EXPECT_EQ(number("geometry.boundaryLength", holed), 48);
  EXPECT_EQ(text("geometry.isConcave", lShape()), "true");
  EXPECT_EQ(text("geometry.isRectangular", lShape(), {1}), "false");
  EXPECT_EQ(text("geometry.isClosedSurface", quadShape(1, 1)), "false");
  const Shape slanted = polygonShape({{{0, 0}, {4, 0.1}, {4, 3}, {0, 3}}});
  EXPECT_EQ(text("geometry.isRectangular", slanted, {0.5}), "false");
  EXPECT_EQ(text("geometry.isRectangular", slanted, {3}), "true");
  EXPECT_EQ(text("geometry.isPlanar", emptyShape({1, 1, 1}), {1}), "false");
}

TEST_F(Shapes, textureRangesAreTold) {
  Shape s = wallShape(6, 3);
  EXPECT_EQ(text("geometry.hasUVs", s), "false");
  EXPECT_EQ(number("geometry.uMax", s), 0);
  s.geometry.uv = true;
  EXPECT_EQ(text("geometry.hasUVs", s), "true");
  EXPECT_EQ(text("geometry.hasUVs", s, {2}), "false");
  EXPECT_EQ(number("geometry.uMin", s), 0);
  EXPECT_EQ(number("geometry.vMax", s, {0}), 1);
  EXPECT_EQ(number("geometry.du", s, {0, word("uvSpace")}), 1);
  EXPECT_NEAR(number("geometry.du", s, {0, word("unitSpace")}), 6, 1e-9);
  EXPECT_NEAR(number("geometry.dv", s, {0, word("unitSpace")}), 3, 1e-9);
  EXPECT_EQ(number("geometry.uMax", s, {99}), 0);
}

TEST_F(Shapes, instancesMaterialsAndTagsAreNamed) {
  const Shape cube = Op("primitiveCube").on(emptyShape({1, 1, 1}), services).shape;
  EXPECT_EQ(text("geometry.isInstanced", cube), "true");
  EXPECT_EQ(text("geometry.isInstanced", boxShape({1, 1, 1})), "false");
  Shape s = cube;
  EXPECT_EQ(text("geometry.materials", s), "(1)[]");
  ASSERT_TRUE(setAttribute("material.name", "Brick", s, services).ok());
  EXPECT_EQ(text("geometry.materials", s), "(1)[Brick]");
  EXPECT_EQ(text("geometry.groups", s), "(0)[]");

  Mesh m = makeBoxMesh({1, 1, 1}, false);
  m.faces[1].tags = services.tags().of("roof.top");
  m.edgeTags.assign(m.corners.size(), 0);
  m.edgeTags[3] = services.tags().of("eave");
  const Shape tagged = meshShape(m);
  EXPECT_EQ(text("geometry.tags", tagged), "(2)[eave,roof.top]");
  EXPECT_EQ(text("geometry.tags", tagged, {"roof"}), "(1)[roof.top]");
  EXPECT_EQ(text("geometry.tags", tagged, {"", word("edges")}), "(1)[eave]");
  EXPECT_EQ(text("geometry.hasTags", tagged, {"?.top", word("faces")}), "true");
  EXPECT_EQ(text("geometry.hasTags", tagged, {"wall"}), "false");
  EXPECT_EQ(text("geometry.hasTags", cube), "false");
}

TEST_F(Shapes, convertGoesThereAndBack) {
  Shape s = boxShape({1, 2, 3});
  s.scope = rotationXyz(10, 20, 30);
  s.scope.origin = {5, 6, 7};
  s.pivot = rotationXyz(0, 0, 40);
  services.worldFrame = rotationXyz(0, 50, 0);
  services.worldFrame.origin = {100, 0, 50};
  services.initial.origin = rotationXyz(0, 15, 0);
  const char* systems[] = {"scope", "pivot", "object", "world"};
  for (const char* from : systems) {
    for (const char* to : systems) {
      for (const char* type : {"pos", "orient"}) {
        const auto go = [&](const char* a, const char* b, double x, double y, double z) {
          Vec3 v;
          for (size_t i = 0; i < 3; ++i) {
            const std::string axis(1, static_cast<char>('x' + i));
            v[i] = number("convert", s, {word(axis), word(a), word(b), word(type), x, y, z});
          }
          return v;
        };
        const Vec3 there = go(from, to, 3, 4, 5);
        const Vec3 back = go(to, from, there.x, there.y, there.z);
        EXPECT_NEAR(length(back - Vec3{3, 4, 5}), 0, 1e-9) << from << " " << to << " " << type;
      }
    }
  }
  const Vec3 world = services.worldFrame.point(s.scope.origin);
  EXPECT_NEAR(number("convert", s, {word("x"), word("scope"), word("world"), word("pos"), 0, 0, 0}),
              world.x, 1e-9);
  EXPECT_EQ(text("convert", s, {word("scope"), word("scope"), word("pos"), floats({1, 2, 3})}),
            "(3)[1,2,3]");
  text("convert", s, {word("moon"), word("scope"), word("pos"), floats({1, 2, 3})});
  text("convert", s, {word("scope"), word("scope"), word("pos"), floats({1})});
  EXPECT_EQ(services.warnings.size(), 2u);
}

TEST_F(Shapes, convertFollowsTheReferencesExample) {
  // A scope turned by (-10, 70, 0) on a pivot whose own turn the world takes back in part.
  Shape s = boxShape({1, 1, 1});
  s.scope = rotationXyz(-10, 70, 0);
  EXPECT_EQ(text("convert", s, {word("scope"), word("pivot"), word("orient"), floats({0, 0, 0})})
                .substr(0, 10),
            "(3)[-10,70");
}

TEST_F(Shapes, contextQueriesAskTheServices) {
  const Shape s = boxShape({1, 1, 1});
  services.queryAnswer = true;
  services.distanceAnswer = 4;
  services.countAnswer = 3;
  EXPECT_EQ(text("inside", s), "true");
  EXPECT_EQ(text("overlaps", s, {word("intra")}), "true");
  EXPECT_EQ(text("touches", s, {word("inter"), "block"}), "true");
  EXPECT_EQ(number("minimumDistance", s, {word("all"), "block"}), 4);
  EXPECT_EQ(number("minimumDistance", s, {word("all"), ""}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(number("contextCount", s, {word("all"), "block"}), 3);
  EXPECT_EQ(number("contextCount", s, {word("all"), ""}), 0);
  EXPECT_EQ(number("contextCompare", s, {word("all"), "block", word("world.highest")}), 4);
  EXPECT_EQ(number("contextCompare", s, {word("all"), "", word("world.highest")}), 0);
  EXPECT_EQ(text("getTreeKey", s), "0;");
  EXPECT_EQ(number("print", s, {5}), 5);
  EXPECT_EQ(services.prints, std::vector<std::string>{"5"});
}

TEST_F(Shapes, pathsAreTakenApart) {
  const Shape s;
  const char* path = "assets/obj/mygeometry.01.obj";
  EXPECT_EQ(text("fileName", s, {path}), "mygeometry.01.obj");
  EXPECT_EQ(text("fileBasename", s, {path}), "mygeometry.01");
  EXPECT_EQ(text("fileDirectory", s, {path}), "assets/obj/");
  EXPECT_EQ(text("fileExtension", s, {path}), "obj");
  EXPECT_EQ(text("fileExtension", s, {"a.b/noext"}), "");
  EXPECT_EQ(text("fileBasename", s, {"noext"}), "noext");
}

TEST_F(Shapes, filesAreFoundAndRead) {
  const Shape s;
  services.files.texts["a/one.csv"] = "h1;h2;h3\r\n1;2;\"x;\"\"y\"\"\"\r\n3;4\r\n";
  services.files.texts["a/two.txt"] = "\xef\xbb\xbfline\r\nnext\x01";
  services.files.texts["a/wide.txt"] = std::string(
      "\xff\xfe"
      "a\0\n\0\x3d\xd8\x00\xde",
      10);
  EXPECT_EQ(text("fileSearch", s, {"a/*"}), "a/one.csv;a/two.txt;a/wide.txt;");
  EXPECT_EQ(text("filesSearch", s, {"*.csv"}), "(1)[a/one.csv]");
  EXPECT_EQ(text("fileExists", s, {"a/one.csv"}), "true");
  EXPECT_EQ(text("fileExists", s, {"a/none.csv"}), "false");
  EXPECT_EQ(text("fileRandom", s, {"none"}), "");
  EXPECT_EQ(text("fileRandom", s, {"*.csv"}), "a/one.csv");
  EXPECT_EQ(text("readStringTable", s, {"a/one.csv"}), "(3x3)[h1,h2,h3;1,2,x;\"y\";3,4,]");
  EXPECT_EQ(text("readFloatTable", s, {"a/one.csv"}), "(3x3)[nan,nan,nan;1,2,nan;3,4,nan]");
  EXPECT_EQ(text("readTextFile", s, {"a/two.txt"}), "line\nnext?");
  EXPECT_EQ(text("readTextFile", s, {"a/wide.txt"}), "a\n\xf0\x9f\x98\x80");
  EXPECT_TRUE(services.warnings.empty());
  EXPECT_EQ(text("readTextFile", s, {"none.txt"}), "");
  EXPECT_EQ(text("readStringTable", s, {"none.csv"}), "(0)[]");
  EXPECT_EQ(services.warnings.size(), 2u);
}

TEST_F(Shapes, assetsTellTheirSizeAndSortByFit) {
  const auto box = [](double x, double y, double z) {
    Mesh m = makeBoxMesh({x, y, z}, false);
    for (Vec3& p : m.positions) p += {0.5, 0.55, 0.6};
    return m;
  };
  Material bark;
  bark.name = "Bark";
  services.files.addModel("square.obj", box(1, 1, 1), {bark});
  services.files.addModel("wide.obj", box(4, 1, 2));
  services.files.addModel("tall.obj", box(1, 4, 1));
  services.files.addImage("wide.png", 400, 100);
  services.files.addImage("tall.png", 100, 400);
  const Shape s = emptyShape({4.2, 1, 2});
  EXPECT_EQ(number("assetInfo", s, {"wide.obj", word("sx")}), 4);
  EXPECT_EQ(number("assetInfo", s, {"wide.obj", word("tz")}), 0.6);
  EXPECT_EQ(text("assetNamingInfos", s, {"square.obj", word("m")}), "(1)[Bark]");
  EXPECT_EQ(text("assetNamingInfo", s, {"square.obj", word("m")}), "Bark;");
  EXPECT_EQ(number("assetMetadata", s, {"square.obj", "height", 7}), 7);
  EXPECT_EQ(number("imageInfo", s, {"wide.png", word("sx")}), 400);
  EXPECT_EQ(number("imageInfo", s, {"wide.png", word("sy")}), 100);
  const char* all = "square.obj;tall.obj;wide.obj;";
  EXPECT_EQ(text("assetsSortRatio", s, {all, word("xy")}), "wide.obj;square.obj;tall.obj;");
  EXPECT_EQ(text("assetsSortRatio", s, {strings({"tall.obj", "wide.obj"}), word("xyz")}),
            "(2)[wide.obj,tall.obj]");
  EXPECT_EQ(text("assetsSortSize", s, {all, word("xyz"), 0}), "wide.obj;square.obj;tall.obj;");
  EXPECT_EQ(text("assetsSortSize", s, {all, word("xyz"), 0.1}), "wide.obj;");
  EXPECT_EQ(text("imagesSortRatio", s, {"tall.png;wide.png;", word("xy")}), "wide.png;tall.png;");
  EXPECT_EQ(text("assetBestRatio", s, {"*.obj", "xy"}), "wide.obj");
  EXPECT_EQ(text("assetBestSize", s, {"*.obj", "xyz"}), "wide.obj");
  EXPECT_EQ(text("assetApproxSize", s, {"*.obj", "xyz", 1}), "wide.obj");
  EXPECT_EQ(text("assetFitSize", s, {"*.obj", "xyz", 0.1}), "wide.obj");
  EXPECT_EQ(text("assetFitSize", s, {"*.obj", "xyz", 0.001}), "");
  EXPECT_EQ(text("imageBestRatio", s, {"*.png", "yx"}), "tall.png");
  EXPECT_EQ(text("imageApproxRatio", s, {"*.png", "xy", 1}), "wide.png");
  std::set<std::string> seen;
  for (uint64_t site = 0; site < 60; ++site) {
    seen.insert(std::string(services.pool().text(
        callFunction("assetApproxRatio", {"*.obj", "xy", 2}, services, s, site).id)));
  }
  EXPECT_EQ(seen, (std::set<std::string>{"wide.obj", "square.obj"}));
  EXPECT_TRUE(services.warnings.empty());
  EXPECT_EQ(number("assetInfo", s, {"none.obj", word("sx")}), 0);
  EXPECT_EQ(number("imageInfo", s, {"none.png", word("sx")}), 0);
  EXPECT_EQ(services.warnings.size(), 2u);
}

TEST(Catalogue, everySpecSpeaksForItself) {
  const Catalogue& catalogue = builtinCatalogue();
  const auto sentence = [](const char* name, const char* text) {
    const std::string_view s = text ? text : "";
    EXPECT_GT(s.size(), 10u) << name;
    EXPECT_TRUE(s.ends_with('.')) << name << ": " << s;
  };
  const auto signatures = [&](const char* name, std::span<const Signature> list) {
    EXPECT_FALSE(list.empty()) << name;
    for (const Signature& s : list) {
      for (const ParamSpec& p : s.params) {
        EXPECT_NE(p.doc, nullptr) << name;
        if (p.doc) {
          EXPECT_TRUE(std::string_view(p.doc).ends_with('.')) << name << ": " << p.doc;
        }
      }
    }
  };
  for (const OpSpec* op : catalogue.operations) {
    sentence(op->name, op->summary);
    signatures(op->name, op->signatures);
  }
  for (const FunctionSpec* f : catalogue.functions) {
    sentence(f->name, f->summary);
    signatures(f->name, f->signatures);
  }
  for (const AttributeSpec* a : catalogue.attributes) sentence(a->name, a->doc);
}

}  // namespace
}  // namespace gable
