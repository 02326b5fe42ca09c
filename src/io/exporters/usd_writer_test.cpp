// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "base/files.h"
#include "base/work.h"
#include "io/exporters/usd_text.h"
#include "io/exporters/write_model.h"
#include "io/image/png.h"
#include "io/testing/scenes.h"
#include "material/library.h"

namespace gable {
namespace {

using testing::SceneBuilder;

// Three places of one prototype, which is not so small that it is merged into each of them; and a
// name that is no identifier.
Scene threePlaces() {
  SceneBuilder b;
  Material red;
  red.color = {1, 0, 0};
  const uint32_t reds = b.material(red);
  for (int i = 0; i < 39; ++i) b.leaf(kUnitBox, Frame::moved({0, i * 1.0, 0}), {1, 0.5, 1}, reds);
  b.leaf(kUnitBoxUv, Frame::moved({0, 2, 0}), {-1, 0.5, 1});
  const uint32_t post = b.prototype("Post");
  for (const double x : {0.0, 5.0, 10.0}) b.instance(post, Frame::moved({x, 0, 0}));
  b.root("lot \"1\"/a", b.prototype("Lot"), Frame::moved({100, 0, 0}));
  return b.scene;
}

std::string inWritten(const std::string& name) {
  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  return std::string(GABLE_WRITTEN_DIR) + "/" + name;
}

std::string written(const Scene& scene, const std::string& name, WriteReport* report = nullptr) {
  const std::string path = inWritten(name);
  auto r = writeModel(scene, path, {});
  EXPECT_TRUE(r.ok()) << r.error().message;
  if (report) *report = *r;
  return readFile(path).value();
}

size_t countOf(const std::string& text, const std::string& word) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(UsdWriter, whatStandsSeveralTimesIsOnePrototype) {
  WriteOptions nodes;
  nodes.instancing = WriteOptions::Instancing::Nodes;
  const std::string path = inWritten("nodes.usda");
  auto r = writeModel(threePlaces(), path, nodes);
  ASSERT_TRUE(r.ok());
  const std::string text = readFile(path).value();
  EXPECT_EQ(countOf(text, "instanceable = true"), 3u);
  EXPECT_EQ(countOf(text, "references = </Prototypes/Post>"), 3u);
  EXPECT_EQ(countOf(text, "def Mesh "), 2u);
  EXPECT_EQ(r->triangles, 3u * 40 * 12);
  EXPECT_EQ(countOf(text, "{"), countOf(text, "}"));
}

TEST(UsdWriter, namesAreIdentifiersAndTheirTextIsKept) {
  const std::string text = written(threePlaces(), "names.usda");
  EXPECT_NE(text.find("def Xform \"lot__1__a\""), std::string::npos);
  EXPECT_NE(text.find("string name = \"lot \\\"1\\\"/a\""), std::string::npos);
  UsdNames names;
  EXPECT_EQ(names.unique("a"), "a");
  EXPECT_EQ(names.unique("a_1"), "a_1");
  EXPECT_EQ(names.unique("a"), "a_2");
  EXPECT_EQ(names.unique("7 b"), "_7_b");
  EXPECT_EQ(names.unique(""), "part");
  EXPECT_EQ(usdText("a\n\\\x01"), "\"a\\x0a\\\\\\x01\"");
  EXPECT_EQ(usdAsset("x@y.png"), "@x_y.png@");
}

// A wall of 4 x 2 m without coordinates of its own: metres, and the tile in UsdTransform2d.
TEST(UsdWriter, laidMaterialsCountInMetres) {
  SceneBuilder b;
  const LibraryMaterial& brick = *libraryMaterial("brick.flemish");
  const uint32_t bricks = b.material(laidMaterial(brick, nullptr));
  b.leaf(kUnitBox, Frame::moved({0, 1, 0}), {4, 2, 0.5}, bricks);
  b.leaf(kUnitBoxUv, Frame::moved({8, 1, 0}), {4, 2, 0.5}, bricks);
  b.root("lot", b.prototype("Wall"), Frame{});
  WriteOptions o;
  o.readTexture = [](const std::string&) -> Result<std::string> {
    return testing::picture(2, false);
  };
  const std::string path = inWritten("laid@2.usda");
  auto r = writeModel(b.scene, path, o);
  ASSERT_TRUE(r.ok()) << r.error().message;
  const std::string text = readFile(path).value();
  // What a path between at signs cannot hold is not in the names of files.
  EXPECT_NE(text.find("= @./laid_2-brick"), std::string::npos);
  for (size_t i = 1; i < r->files.size(); ++i) {
    EXPECT_NE(text.find("@./" + fileNameOf(r->files[i]) + "@"), std::string::npos) << r->files[i];
    EXPECT_TRUE(readFile(r->files[i]).ok());
  }
  EXPECT_EQ(countOf(text, "def Material "), 1u);
  EXPECT_NE(text.find("Texture_color.outputs:rgb"), std::string::npos);
  EXPECT_NE(text.find("float2 inputs:scale = (0.74"), std::string::npos);
  const size_t at = text.find("primvars:st = [");
  ASSERT_NE(at, std::string::npos);
  const std::string uvs = text.substr(at, text.find(']', at) - at);
  // Courses are level: v is the height in the model, on both boxes.
  EXPECT_NE(uvs.find(", 1)"), std::string::npos);
  EXPECT_NE(uvs.find(", 3)"), std::string::npos);
  EXPECT_EQ(countOf(uvs, "("), 48u);
}

class Counter final : public WorkMeter {
 public:
  bool look(uint64_t count, uint64_t) override {
    units += count;
    return true;
  }
  uint64_t units = 0;
};

// A mesh of many slots is prepared once, and its parts come out each in its own material.
TEST(UsdWriter, slotsOfOneMeshAreAsManyMeshes) {
  constexpr uint32_t kSlots = 2000;
  SceneBuilder b;
  MeshBuilder mesh;
  std::vector<uint32_t> list;
  for (uint32_t i = 0; i < kSlots; ++i) {
    const double x = i;
    std::vector<uint32_t> triangle;
    for (const Vec3& p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x, 1, 0}}) {
      triangle.push_back(mesh.addPosition(p));
    }
    mesh.addPolygon(triangle, static_cast<uint16_t>(i));
    Material own;
    own.color = {i / 2000.0, 0, 0};
    b.scene.materials.push_back(own);
    list.push_back(static_cast<uint32_t>(b.scene.materials.size() - 1));
  }
  b.scene.materialLists.push_back(list);
  b.leaf(b.mesh(mesh.take()), Frame{}, {1, 1, 1},
         static_cast<uint32_t>(b.scene.materialLists.size() - 1));
  b.root("lot", b.prototype("Parts"), Frame{});
  Counter meter;
  WriteReport report;
  std::string text;
  {
    const WorkScope scope(meter);
    text = written(b.scene, "slots.usda", &report);
  }
  EXPECT_EQ(report.triangles, kSlots);
  EXPECT_EQ(countOf(text, "def Mesh "), kSlots);
  EXPECT_LT(meter.units, 100u * kSlots);
}

TEST(UsdWriter, brokenNumbersAreLeftOut) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1e300, 1, 1});
  b.leaf(kUnitBox, Frame{}, {1, 0, 1});
  b.root("lot", b.prototype("P"), Frame{});
  WriteReport report;
  const std::string text = written(b.scene, "broken.usda", &report);
  EXPECT_EQ(text.find("(inf"), std::string::npos);
  EXPECT_EQ(text.find("nan,"), std::string::npos);
  EXPECT_EQ(report.warnings.size(), 1u);
  // One side of the first, and both sides of the second.
  EXPECT_EQ(report.triangles, 6u);
}

// Contract of the format: nothing is compressed, and each file begins at a multiple of 64.
TEST(UsdWriter, archivesAreStoredAndAligned) {
  const std::string zip = written(threePlaces(), "posts.usdz");
  const std::string layer = written(threePlaces(), "posts.usda");
  ASSERT_EQ(zip.substr(0, 4), "PK\x03\x04");
  const auto number = [&](size_t at, size_t bytes) {
    uint32_t v = 0;
    std::memcpy(&v, zip.data() + at, bytes);
    return v;
  };
  EXPECT_EQ(number(8, 2), 0u);
  const size_t start = 30 + number(26, 2) + number(28, 2);
  EXPECT_EQ(start % 64, 0u);
  EXPECT_EQ(number(22, 4), layer.size());
  EXPECT_EQ(zip.substr(start, layer.size()), layer);
  EXPECT_EQ(zip, written(threePlaces(), "again.usdz"));
}

}  // namespace
}  // namespace gable
