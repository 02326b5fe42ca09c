// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the workshop, the chooser of shapes and exports promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "json/answers.h"
#include "studio/export.h"
#include "studio/workshop.h"
#include "studio/zip.h"

namespace gable::studio {
namespace {

namespace fs = std::filesystem;

/// A box of 2 x 4 x 1 with its least corner at (1, 0, 0).
constexpr const char* kBox =
    "v 1 0 0\nv 3 0 0\nv 3 4 0\nv 1 4 0\nv 1 0 1\nv 3 0 1\nv 3 4 1\nv 1 4 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

class Workshop : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = ::testing::TempDir() + "gable-workshop-" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(root_ + "/assets");
    put("box.obj", kBox);
    put("lots.geojson",
        R"({"type":"FeatureCollection","features":[)"
        R"({"type":"Feature","id":"a","properties":{},"geometry":{"type":"Polygon","coordinates":[[[7.42,43.73],[7.4202,43.73],[7.4202,43.7302],[7.42,43.7302],[7.42,43.73]]]}},)"
        R"({"type":"Feature","id":"b","properties":{},"geometry":{"type":"Polygon","coordinates":[[[7.4204,43.73],[7.4208,43.73],[7.4208,43.7302],[7.4204,43.7302],[7.4204,43.73]]]}}]})");
    put("a.cga", "@StartRule\nLot --> extrude(rand(3, 30)) Body\n");
  }
  void TearDown() override { fs::remove_all(root_); }
  void put(const std::string& path, const std::string& text) {
    std::ofstream(root_ + "/" + path) << text;
  }
  JsonValue json(const std::string& text) { return parseJson(text).value(); }
  Session::Cancel never() { return std::make_shared<std::atomic<bool>>(false); }
  std::string root_;
};

TEST_F(Workshop, preparesAnAssetThatFillsItsVolume) {
  ProjectFiles files(root_);
  const auto made = prepareAsset(
      files, json(R"({"path":"box.obj","to":"assets/Box.glb","pivot":[1,0,0],"size":[2,4,1]})"));
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_NE(made.value().find(R"("bounds":[0,0,0,1,1,1])"), std::string::npos) << made.value();
  const Model model = Model::load(root_ + "/assets/Box.glb");
  ASSERT_TRUE(model.bounds().has_value());
  EXPECT_NEAR(model.bounds()->max[1], 1, 1e-6);
}

TEST_F(Workshop, writesAssetsIntoTheProjectAlone) {
  ProjectFiles files(root_);
  const auto to = [&](const std::string& path) {
    return prepareAsset(files, json(R"({"path":"box.obj","to":")" + path + "\"}"));
  };
  EXPECT_EQ(to("../Box.glb").error().code, "path-outside");
  EXPECT_EQ(to("Box.obj").error().code, "kind-refused");
  EXPECT_EQ(to("").error().code, "kind-refused");
  EXPECT_EQ(prepareAsset(files, json(R"({"path":"none.obj","to":"a.glb"})")).error().code,
            "model-unreadable");
  EXPECT_EQ(
      prepareAsset(files, json(R"({"path":"box.obj","to":"a.glb","size":[1,0,1]})")).error().code,
      "asset-volume");
  ASSERT_TRUE(to("assets/Box.glb").ok());
  EXPECT_EQ(
      prepareAsset(files, json(R"({"path":"box.obj","to":"assets/Box.glb","expected":"none"})"))
          .error()
          .code,
      "version-differs");
}

TEST_F(Workshop, showsAModelAsItIs) {
  ProjectFiles files(root_);
  Session session(files);
  const auto seen = modelPreview(files, session, "box.obj");
  ASSERT_TRUE(seen.ok());
  EXPECT_EQ(seen.value().substr(0, 4), "GBM1");
  EXPECT_NE(seen.value().find(R"("bounds":[1,0,0,3,4,1])"), std::string::npos);
  EXPECT_NE(seen.value().find("GBL1"), std::string::npos);
  EXPECT_EQ(modelPreview(files, session, "../box.obj").error().code, "path-outside");
}

TEST_F(Workshop, aChosenShapeLooksAsAmongAll) {
  ProjectFiles files(root_);
  Session session(files);
  const auto request = [&](const std::string& only) {
    return json(R"({"file":"a.cga","text":"@StartRule\nLot --> extrude(rand(3, 30)) Body",)"
                R"("seed":5,"shapes":{"file":"lots.geojson")" +
                only + "}}");
  };
  const auto shapes = session.shapesOf(request(""));
  ASSERT_TRUE(shapes.ok());
  EXPECT_EQ(shapes.value()->size(), 2u);
  const std::string outlines = outlinesJson(*shapes.value());
  EXPECT_NE(outlines.find(R"("count":2)"), std::string::npos);
  EXPECT_NE(outlines.find(R"("name":"b")"), std::string::npos);
  const auto second = session.shapesOf(request(R"(,"only":[1,7,-1])"));
  ASSERT_TRUE(second.ok());
  ASSERT_EQ(second.value()->size(), 1u);
  const Rules rules = Rules::load(root_ + "/a.cga");
  DeriveSettings settings;
  settings.seed = 5;
  const Model all = derive(rules, *shapes.value(), settings);
  const Model one = derive(rules, *second.value(), settings);
  EXPECT_NE(all.dump().find(one.dump().substr(one.dump().find("Body"), 60)), std::string::npos)
      << all.dump() << one.dump();
}

TEST(Shapes, keepTheirDrawsWhenOthersAreLeftOut) {
  const Rules rules = Rules::parse("@StartRule\nLot --> extrude(rand(3, 30)) Body", "a.cga");
  // Without names the index is all that tells them apart.
  const auto square = [](const char* x, const char* y) {
    return std::string(R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon",)") +
           R"("coordinates":[[[)" + x + ",43.73],[" + y + ",43.73],[" + y + ",43.7302],[" + x +
           ",43.73]]]}}";
  };
  const Shapes both =
      Shapes::parse(R"({"type":"FeatureCollection","features":[)" + square("7.42", "7.4202") + "," +
                        square("7.4204", "7.4206") + "]}",
                    "lots.geojson");
  ASSERT_EQ(both.size(), 2u);
  const auto height = [&](const Shapes& shapes) {
    return derive(rules, shapes, {}).statistics().bounds.value_or(BoundingBox{}).max[1];
  };
  const double first = height(both.only({0})), second = height(both.only({1}));
  EXPECT_NE(first, second);
  EXPECT_EQ(height(both), std::max(first, second));
  EXPECT_EQ(height(both.only({1}).only({0})), second);
  EXPECT_EQ(both.outline(1).ring.size(), 3u);
  EXPECT_EQ(both.outline(7).ring.size(), 0u);
  EXPECT_EQ(both.only({9}).size(), 0u);
}

TEST(Shapes, mayHaveSeedsOfTheirOwn) {
  const Rules rules = Rules::parse("@StartRule\nLot --> extrude(rand(3, 30)) Body", "a.cga");
  const auto made = [&](double seed, std::vector<std::pair<size_t, double>> own) {
    DeriveSettings s;
    s.seed = seed;
    s.shapeSeeds = std::move(own);
    return derive(rules, Shapes::lot(5, 5), s).dump();
  };
  EXPECT_NE(made(1, {}), made(2, {}));
  EXPECT_EQ(made(1, {{0, 2}}), made(2, {}));
  EXPECT_EQ(made(1, {{7, 2}}), made(1, {}));
}

TEST_F(Workshop, exportsOneFileOrAnArchive) {
  const Rules rules = Rules::load(root_ + "/a.cga");
  const Model model = derive(rules, Shapes::lot(5, 5), {});
  Exports exports;
  EXPECT_EQ(exports.write(model, "glb", "p", never()).value().extension, "glb");
  const auto obj = exports.write(model, "obj", "p", never());
  ASSERT_TRUE(obj.ok());
  EXPECT_EQ(obj.value().extension, "obj.zip");
  EXPECT_EQ(obj.value().bytes.substr(0, 2), "PK");
  EXPECT_NE(obj.value().bytes.find("model.mtl"), std::string::npos);
  EXPECT_EQ(exports.write(model, "exe", "p", never()).error().code, "format-unknown");
  EXPECT_EQ(exports.progressJson("p"), R"({"busy":false,"done":0,"total":0,"bytes":0})");
  EXPECT_EQ(
      exports.write(model, "glb", "p", std::make_shared<std::atomic<bool>>(true)).error().code,
      "cancelled");
}

TEST(Zip, isReadByItsDirectory) {
  const std::string zip = zipped({{"a.txt", "hello"}, {"b/c.bin", std::string(3, '\0')}});
  // The end record names two entries; a stored file's checksum is the known one of "hello".
  const std::string end = zip.substr(zip.size() - 22);
  EXPECT_EQ(end.substr(0, 4), "PK\x05\x06");
  EXPECT_EQ(end[10], 2);
  EXPECT_NE(zip.find("\x86\xa6\x10\x36", 0, 4), std::string::npos);
  EXPECT_EQ(zip, zipped({{"a.txt", "hello"}, {"b/c.bin", std::string(3, '\0')}}));
}

}  // namespace
}  // namespace gable::studio
