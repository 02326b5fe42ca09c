// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OBJ, PLY and STL: what is written shows the same model as the scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "base/files.h"
#include "io/exporters/write_model.h"
#include "io/importers/asset.h"
#include "io/testing/glb_model.h"
#include "io/testing/scenes.h"
#include "io/testing/text_model.h"

namespace gable {
namespace {

using testing::SceneBuilder;
using testing::Soup;

class TextWriters : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = ::testing::TempDir() + "gable-writers-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + "/";
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  WriteReport write(const Scene& s, const std::string& name, const WriteOptions& o = {}) {
    const Result<WriteReport> r = writeModel(s, folder_ + name, o);
    EXPECT_TRUE(r.ok()) << r.error().message;
    return r.ok() ? r.value() : WriteReport{};
  }
  std::string text(const std::string& name) { return readFile(folder_ + name).value(); }
  Asset readBack(const std::string& name) {
    AssetOptions o;
    o.path = folder_ + name;
    o.readFile = [](const std::string& path) { return readFile(path); };
    Result<Asset> r = readAsset(text(name), o);
    EXPECT_TRUE(r.ok()) << r.error().message;
    return r.ok() ? std::move(*r) : Asset{};
  }
  std::string folder_;
};

// Boxes of every kind whose volume is known, turned and mirrored.
Scene boxes(double* volume) {
  SceneBuilder b;
  *volume = 0;
  for (int i = 0; i < 16; ++i) {
    Vec3 scale{1.0 + i, 2, 0.5};
    if (i % 3 == 1) scale.x = -scale.x;
    if (i % 5 == 2) scale.y = -scale.y;
    b.leaf(i % 2 ? kUnitBoxUv : kUnitBox, testing::turned(i % 4 ? 0 : 25.0 * i, {20.0 * i, 1, 2}),
           scale);
    *volume += std::fabs(scale.x * scale.y * scale.z);
  }
  b.root("boxes", b.prototype("P"), testing::turned(10, {-5, 3, 2}));
  return b.scene;
}

double volumeOf(const Mesh& m) {
  double volume = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const MeshLoop& l = m.loopsOf(f)[0];
    for (uint32_t i = 1; i + 1 < l.cornerCount; ++i) {
      volume +=
          dot(m.at(l.firstCorner), cross(m.at(l.firstCorner + i), m.at(l.firstCorner + i + 1))) / 6;
    }
  }
  return volume;
}

TEST_F(TextWriters, objShowsTheSceneToAMicrometre) {
  const Scene s = testing::street(4);
  const WriteReport report = write(s, "street.obj");
  const Asset back = readBack("street.obj");
  ASSERT_TRUE(back.mesh);
  EXPECT_TRUE(back.warnings.empty());
  const SceneCounts counts = count(s);
  EXPECT_EQ(report.triangles, counts.triangles);
  EXPECT_NEAR(back.mesh->area(), testing::areaOf(s), 1e-4);
  EXPECT_NEAR(length(back.bounds.min - counts.bounds.min), 0, 1e-5);
  EXPECT_NEAR(length(back.bounds.max - counts.bounds.max), 0, 1e-5);
  // Polygons stay polygons, but the four yards with holes.
  EXPECT_EQ(back.mesh->faceCount(), counts.faces + 4 * 7);
  ASSERT_EQ(back.materials.size(), 2u);
  EXPECT_EQ(back.materials[0].name, "wall");
  EXPECT_EQ(back.materials[0].color, (Vec3{0.8, 0.7, 0.6}));
  EXPECT_EQ(back.materials[1].opacity, 0.5);
  EXPECT_NE(text("street.obj").find("\no house_0\ng Core\nusemtl wall\n"), std::string::npos);
}

// More leaves than a block has, in more blocks than are written at a time.
TEST_F(TextWriters, objIsTheSameForAnyNumberOfThreads) {
  const Scene s = testing::street(120);
  std::string first;
  for (const unsigned jobs : {1u, 2u, 5u}) {
    WriteOptions options;
    options.jobs = jobs;
    const WriteReport report = write(s, "long.obj", options);
    EXPECT_EQ(report.triangles, count(s).triangles) << jobs;
    if (first.empty()) first = text("long.obj");
    EXPECT_TRUE(text("long.obj") == first) << jobs;
  }
  const Asset back = readBack("long.obj");
  ASSERT_TRUE(back.mesh);
  EXPECT_TRUE(back.warnings.empty());
  EXPECT_NEAR(back.mesh->area() / testing::areaOf(s), 1, 1e-8);
}

// MTL has no turn of a texture: the coordinates are turned, and other materials keep theirs.
TEST_F(TextWriters, objTurnsTextureCoordinates) {
  testing::SceneBuilder b;
  Material turned = testing::colored("turned", {1, 1, 1});
  turned.map(TextureLayer::Color) = {"a.png", 2, 3, 0.5, 0.25, 90};
  Material plain = testing::colored("plain", {1, 1, 1});
  plain.map(TextureLayer::Color) = {"a.png", 2, 3, 0.5, 0.25, 0};
  b.leaf(kUnitQuadXyUv, Frame{}, {1, 1, 1}, b.material(turned));
  b.leaf(kUnitBoxUv, Frame::moved({5, 0, 0}), {1, 1, 1}, b.material(turned));
  b.leaf(kUnitBoxUv, Frame::moved({9, 0, 0}), {1, 1, 1}, b.material(plain));
  b.root("r", b.prototype("p"), Frame{});
  WriteOptions options;
  options.readTexture = [](const std::string&) -> Result<std::string> {
    return testing::picture(4, false);
  };
  ASSERT_TRUE(writeModel(b.scene, folder_ + "t.obj", options).ok());
  const std::string obj = text("t.obj"), mtl = text("t.mtl");
  // (u, v) becomes (0.5 - 3 v, 0.25 + 2 u): six faces of the box and the quad.
  size_t count = 0;
  for (size_t at = 0; (at = obj.find("vt -2.5 2.25\n", at)) != std::string::npos; ++at) ++count;
  EXPECT_EQ(count, 7u);
  const size_t first = mtl.find("newmtl turned"), last = mtl.find("newmtl plain");
  ASSERT_LT(first, last);
  EXPECT_EQ(mtl.substr(first, last - first).find("-s 2"), std::string::npos);
  EXPECT_NE(mtl.find("map_Kd -s 2 3 1 -o 0.5 0.25 0 ", last), std::string::npos);
}

TEST_F(TextWriters, closedModelsKeepTheirVolume) {
  double volume = 0;
  const Scene s = boxes(&volume);
  write(s, "b.obj");
  write(s, "b.ply");
  write(s, "b.stl");
  EXPECT_NEAR(volumeOf(*readBack("b.obj").mesh), volume, 1e-3);
  EXPECT_NEAR(testing::readPly(text("b.ply")).volume, volume, 1e-2);
  EXPECT_NEAR(testing::readStl(text("b.stl")).volume, volume, 1e-2);
}

TEST_F(TextWriters, plyAndStlShowTheScene) {
  const Scene s = testing::street(4);
  const SceneCounts counts = count(s);
  const double area = testing::areaOf(s);
  for (const char* name : {"street.ply", "street.stl"}) {
    const WriteReport report = write(s, name);
    const Soup soup = std::string(name) == "street.ply" ? testing::readPly(text(name))
                                                        : testing::readStl(text(name));
    EXPECT_EQ(soup.triangles, counts.triangles) << name;
    EXPECT_EQ(report.triangles, counts.triangles) << name;
    EXPECT_EQ(report.bytes, text(name).size());
    EXPECT_NEAR(soup.area, area, 1e-4 * area) << name;
    EXPECT_NEAR(length(soup.bounds.max - counts.bounds.max), 0, 1e-3) << name;
    EXPECT_GT(soup.smallest, 0);
  }
}

// Which holds only where numbers are really rounded to single precision on their way.
TEST_F(TextWriters, stlNormalsAreThoseOfTheVerticesAsWritten) {
  write(testing::street(3), "n.stl");
  const Soup soup = testing::readStl(text("n.stl"));
  for (size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<Vec3>& p = soup.polygons[i];
    const Vec3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
    ASSERT_NEAR(length(n - soup.normals[i]), 0, 1.1e-7) << i;
  }
}

TEST_F(TextWriters, facesWithoutAreaOrWithoutNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  b.leaf(kUnitBox, Frame{}, {1, 0, 1});
  b.leaf(kUnitBox, Frame{}, {1e-9, 1, 1e-9});
  b.leaf(kUnitBox, Frame::moved({nan, 0, 0}), {1, 1, 1});
  b.leaf(kUnitBox, Frame::moved({1e300, 0, 0}), {1, 1, 1});
  b.leaf(kUnitQuadXz, Frame{}, {0, 1, 1});
  b.root("a", b.prototype("P"), Frame{});
  write(b.scene, "d.obj");
  write(b.scene, "d.stl");
  write(b.scene, "d.ply");
  EXPECT_EQ(text("d.obj").find("nan"), std::string::npos);
  EXPECT_EQ(readBack("d.obj").mesh->faceCount(), 8u);
  for (const Soup& s : {testing::readStl(text("d.stl")), testing::readPly(text("d.ply"))}) {
    EXPECT_GT(s.smallest, 0);
    EXPECT_TRUE(isFinite(s.bounds.min) && isFinite(s.bounds.max));
  }
}

TEST_F(TextWriters, farModelsKeepTheirDigits) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  b.root("far", b.prototype("P"), Frame::moved({500000.25, 0, -4800000.5}));
  write(b.scene, "far.obj");
  write(b.scene, "far.ply");
  EXPECT_EQ(readBack("far.obj").bounds.min.z, -4800000.5);
  EXPECT_EQ(testing::readPly(text("far.ply")).bounds.max.x, 500001.25);
}

TEST_F(TextWriters, objCarriesUvNormalsAndTextures) {
  const std::string picture = testing::picture(4, false);
  WriteOptions o;
  o.readTexture = [&](const std::string&) -> Result<std::string> { return picture; };
  SceneBuilder b;
  Material m = testing::colored("brick wall #1", {1, 1, 1});
  m.map(TextureLayer::Color) = {"dir/brick.png", 2, 3, 0, 0.5, 0};
  m.roughness = 0.25;
  const uint32_t bricks = b.material(m);
  Mesh smooth = testing::ball(4, 6);
  smooth.normals.resize(smooth.corners.size());
  for (size_t c = 0; c < smooth.corners.size(); ++c)
    smooth.normals[c] = smooth.positions[smooth.corners[c]];
  b.leaf(kUnitBoxUv, Frame{}, {1, 1, 1}, bricks);
  b.leaf(b.mesh(std::move(smooth)), testing::turned(90, {5, 0, 0}), {-1, 2, 1}, bricks);
  b.leaf(b.mesh(testing::holedSquare()), Frame{}, {1, 1, 1}, bricks);
  b.root("r", b.prototype("P"), Frame{});
  const WriteReport report = write(b.scene, "uv.obj", o);
  EXPECT_EQ(report.files.size(), 3u);
  const Asset back = readBack("uv.obj");
  ASSERT_TRUE(back.mesh);
  EXPECT_TRUE(back.warnings.empty());
  ASSERT_EQ(back.materials.size(), 1u);
  EXPECT_EQ(back.materials[0].name, "brick_wall__1");
  EXPECT_EQ(back.materials[0].map(TextureLayer::Color).path, folder_ + "uv-brick.png");
  EXPECT_EQ(back.materials[0].map(TextureLayer::Color).sv, 3);
  EXPECT_EQ(back.materials[0].roughness, 0.25);
  EXPECT_EQ(text("uv-brick.png"), picture);
  // The ball's normals look out.
  size_t checked = 0;
  for (size_t f = 0; f < back.mesh->faceCount(); ++f) {
    for (const uint32_t c : {back.mesh->loopsOf(f)[0].firstCorner}) {
      if (back.mesh->normals[c] == Vec3{}) continue;
      EXPECT_GT(dot(back.mesh->normals[c], back.mesh->normal(f)), 0.2);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 24u);
  // The square's uv runs from corner to corner.
  Box2 uv;
  for (const Vec2 t : back.mesh->uvs[0]) uv.include(t);
  EXPECT_EQ(uv.max, (Vec2{1, 1}));
}

TEST_F(TextWriters, materialNamesStayApart) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1}, b.material(testing::colored("a", {1, 0, 0})));
  b.leaf(kUnitBox, Frame{}, {1, 1, 1}, b.material(testing::colored("a", {0, 1, 0})));
  b.leaf(kUnitBox, Frame{}, {1, 1, 1}, b.material(testing::colored("a-2", {0, 0, 1})));
  b.leaf(kUnitBox, Frame{}, {1, 1, 1}, 0xffff);
  b.root("r", b.prototype("P"), Frame{});
  write(b.scene, "names.obj");
  const Asset back = readBack("names.obj");
  ASSERT_EQ(back.materials.size(), 4u);
  EXPECT_EQ(back.materials[1].color, (Vec3{0, 1, 0}));
  EXPECT_EQ(back.materials[2].color, (Vec3{0, 0, 1}));
}

TEST_F(TextWriters, emptyScenesAreFiles) {
  for (const char* name : {"e.obj", "e.ply", "e.stl"}) {
    EXPECT_EQ(write(Scene{}, name).triangles, 0u);
    EXPECT_TRUE(fileExists(folder_ + name));
  }
}

}  // namespace
}  // namespace gable
