// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "io/exporters/gltf_materials.h"
#include "io/exporters/quaternion.h"
#include "io/exporters/write_model.h"
#include "io/testing/glb_model.h"
#include "io/testing/scenes.h"
#include "material/library.h"
#include "material/linear_light.h"

namespace gable {
namespace {

using testing::areaOf;
using testing::GlbModel;
using testing::SceneBuilder;
using testing::street;

std::string written(const std::string& name) {
  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  return std::string(GABLE_WRITTEN_DIR) + "/" + name;
}

WriteReport writeTo(const Scene& s, const std::string& path, const WriteOptions& o = {}) {
  const Result<WriteReport> r = writeModel(s, path, o);
  EXPECT_TRUE(r.ok()) << r.error().message;
  return r.ok() ? r.value() : WriteReport{};
}

GlbModel roundTrip(const Scene& s, const std::string& name, const WriteOptions& o = {}) {
  const std::string path = written(name);
  const WriteReport report = writeTo(s, path, o);
  GlbModel model;
  model.read(path);
  EXPECT_EQ(report.bytes, model.bytes.size());
  EXPECT_EQ(report.triangles, model.triangles.size());
  return model;
}

void expectSame(const GlbModel& model, const Scene& s) {
  const Box3 bounds = count(s).bounds;
  EXPECT_NEAR(length(model.bounds.min - bounds.min), 0, 1e-4);
  EXPECT_NEAR(length(model.bounds.max - bounds.max), 0, 1e-4);
  EXPECT_NEAR(model.area, areaOf(s), 1e-5 * model.area);
  EXPECT_EQ(model.triangles.size(), count(s).triangles);
}

TEST(GltfWriter, sharedFlatAndInstancedFilesShowTheSameModel) {
  const Scene s = street(5);
  WriteOptions flat, instanced;
  flat.instancing = WriteOptions::Instancing::None;
  instanced.instancing = WriteOptions::Instancing::Gpu;
  const GlbModel a = roundTrip(s, "street.glb");
  const GlbModel b = roundTrip(s, "street-flat.glb", flat);
  const GlbModel c = roundTrip(s, "street-instanced.glb", instanced);
  for (const GlbModel* m : {&a, &b, &c}) expectSame(*m, s);
  EXPECT_LT(a.bytes.size() * 4, b.bytes.size());
  EXPECT_LT(c.nodes, a.nodes);
  EXPECT_EQ(b.meshes, 1u);
  EXPECT_EQ(b.nodes, 1u);
  // Windows, trees, and houses of three heights.
  EXPECT_EQ(a.meshes, 5u);
}

TEST(GltfWriter, nodesAreBoundedUnlessEachIsAskedFor) {
  SceneBuilder b;
  for (int i = 0; i < 9; ++i) b.leaf(kUnitBox, Frame::moved({0, 2.0 * i, 0}), {1, 1, 1});
  const uint32_t tower = b.prototype("Tower");
  for (int row = 0; row < 150; ++row) {
    for (int i = 0; i < 150; ++i) b.root("tower", tower, Frame::moved({3.0 * i, 0, 3.0 * row}));
  }
  WriteOptions each;
  each.instancing = WriteOptions::Instancing::Nodes;
  const GlbModel a = roundTrip(b.scene, "bounded.glb");
  const GlbModel all = roundTrip(b.scene, "unbounded.glb", each);
  expectSame(a, b.scene);
  expectSame(all, b.scene);
  EXPECT_EQ(a.nodes, 1u);
  EXPECT_EQ(all.nodes, 22'500u);
}

WriteOptions compact(WriteOptions::Instancing instancing = WriteOptions::Instancing::Auto) {
  WriteOptions o;
  o.vertices = WriteOptions::Vertices::Compact;
  o.instancing = instancing;
  return o;
}

// Primitives of one layout lie together, so files of other layouts have another order of them: by
// material they have the same.
void orderByMaterial(GlbModel& m) {
  std::stable_sort(m.triangles.begin(), m.triangles.end(),
                   [](const auto& a, const auto& b) { return a.material < b.material; });
}

// How far a corner lies from where it lies in the other file.
double farthestApart(GlbModel& a, GlbModel& b) {
  orderByMaterial(a);
  orderByMaterial(b);
  EXPECT_EQ(a.triangles.size(), b.triangles.size());
  double most = 0;
  for (size_t i = 0; i < std::min(a.triangles.size(), b.triangles.size()); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 d = a.triangles[i].p[k] - b.triangles[i].p[k];
      most = std::max({most, std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
      EXPECT_GT(dot(a.triangles[i].normal[k], b.triangles[i].normal[k]),
                0.9998 * length(b.triangles[i].normal[k]));
    }
  }
  return most;
}

TEST(GltfWriter, compactVerticesStayWithinHalfAMillimetre) {
  const Scene s = street(5);
  for (const auto way : {WriteOptions::Instancing::Auto, WriteOptions::Instancing::Gpu}) {
    WriteOptions wide;
    wide.instancing = way;
    GlbModel full = roundTrip(s, "street-wide.glb", wide);
    GlbModel m = roundTrip(s, "street-compact.glb", compact(way));
    EXPECT_LT(farthestApart(full, m), WriteOptions::kMostQuantized + 1e-5);
    EXPECT_EQ(m.json["extensionsRequired"].items().back().text(), "KHR_mesh_quantization");
  }
}

TEST(GltfWriter, compactMeshesBesideChildrenHaveANodeOfTheirOwn) {
  const auto wide = roundTrip(street(5), "street-wide.glb");
  const auto m = roundTrip(street(5), "street-compact.glb", compact());
  EXPECT_GT(m.nodes, wide.nodes);
  for (const JsonValue& n : m.json["nodes"].items()) {
    EXPECT_FALSE(n["mesh"].isNumber() && n["children"].size() > 0 && n["scale"].size() > 0);
  }
}

TEST(GltfWriter, compactPositionsOfWideMeshesStayFloats) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {90, 1, 1});
  b.leaf(kUnitBox, testing::turned(30, {500, 2, 0}), {1, 2, 3});
  b.root("wide", b.prototype("Wide"), Frame::moved({1e5, 0, -1e5}));
  for (int i = 0; i < 3; ++i) {
    b.leaf(kUnitBox, testing::turned(20.0 * i, {-30, 1, 0}), {-8, 2, 0.01});
    b.root("small", b.prototype("Small"), testing::turned(75, {0, 0, 20.0 * i}));
  }
  GlbModel wide = roundTrip(b.scene, "compact-wide-float.glb");
  GlbModel m = roundTrip(b.scene, "compact-wide.glb", compact());
  EXPECT_LT(farthestApart(wide, m), 0.01);
  std::set<int> components;
  for (const JsonValue& a : m.json["accessors"].items()) {
    if (a["min"].size() == 3) components.insert(static_cast<int>(a["componentType"].number(0)));
  }
  EXPECT_EQ(components, (std::set<int>{5123, 5126}));
}

TEST(GltfWriter, compactFilesKeepWithinTheBoundOnNodes) {
  SceneBuilder b;
  for (int i = 0; i < 3; ++i) b.leaf(kUnitBox, Frame::moved({0, 2.0 * i, 0}), {1, 1, 1});
  const uint32_t post = b.prototype("Post");
  for (int i = 0; i < 9000; ++i) {
    b.leaf(kUnitBox, Frame{}, {1, 1, 1 + 0.001 * i});
    b.instance(post, Frame::moved({0, 0, 3}));
    b.root("house", b.prototype("House"), Frame::moved({5.0 * i, 0, 0}));
  }
  const GlbModel m = roundTrip(b.scene, "compact-bounded.glb", compact());
  EXPECT_EQ(m.nodes, 18'000u);
}

TEST(GltfWriter, facesOfOnePlaneShareVertices) {
  SceneBuilder b;
  for (int i = 0; i < 4; ++i) {
    b.leaf(kUnitQuadXz, testing::turned(30, {}) * Frame::moved({i % 2 * 3.1, 7, i / 2 * 0.7}),
           {3.1, 1, 0.7});
  }
  // Round the edge to another plane they share none.
  b.leaf(kUnitQuadXy, testing::turned(30, {}) * Frame::moved({0, 7, 0}), {3.1, 2, 1});
  b.root("ground", b.prototype("Ground"), Frame::moved({1000, 0, 5}));
  WriteOptions o = compact();
  EXPECT_EQ(roundTrip(b.scene, "plane.glb").vertices, 9u + 4);
  EXPECT_EQ(roundTrip(b.scene, "plane-compact.glb", o).vertices, 9u + 4);
  o.vertices = WriteOptions::Vertices::Bare;
  EXPECT_EQ(roundTrip(b.scene, "plane-bare.glb", o).vertices, 9u + 2);
}

// Boxes of ten colours, so many of each.
GlbModel colouredBoxes(int each, const std::string& path) {
  SceneBuilder b;
  for (int color = 0; color < 10; ++color) {
    const uint32_t material =
        b.material(testing::colored(std::to_string(color), {0.1 * color, 1, 1}));
    for (int i = 0; i < each; ++i) {
      b.leaf(kUnitBox, Frame::moved({0.5 * i, 0, 2.0 * color}), {1, 1, 1}, material);
    }
  }
  b.root("boxes", b.prototype("Boxes"), Frame{});
  GlbModel m = roundTrip(b.scene, path, compact());
  expectSame(m, b.scene);
  return m;
}

TEST(GltfWriter, smallPrimitivesOfOneLayoutShareTheirVertices) {
  const GlbModel few = colouredBoxes(2, "boxes-few.glb"), many = colouredBoxes(100, "boxes.glb");
  // Positions, normals and the indices of ten.
  EXPECT_EQ(few.json["accessors"].size(), 12u);
  EXPECT_EQ(few.json["bufferViews"].size(), 2u);
  EXPECT_EQ(many.json["accessors"].size(), 30u);
  EXPECT_EQ(many.json["bufferViews"].size(), 20u);
}

TEST(GltfWriter, bareVerticesHaveNormalsWhereSurfacesAreSmooth) {
  const Scene s = street(5);
  WriteOptions o = compact(), floats;
  o.vertices = WriteOptions::Vertices::Bare;
  GlbModel m = roundTrip(s, "street-bare.glb", o);
  GlbModel full = roundTrip(s, "street-float.glb", floats);
  EXPECT_LT(m.bytes.size(), full.bytes.size());
  orderByMaterial(m);
  orderByMaterial(full);
  size_t smooth = 0, flat = 0;
  for (const JsonValue& mesh : m.json["meshes"].items()) {
    for (const JsonValue& p : mesh["primitives"].items()) {
      ++(p["attributes"]["NORMAL"].isNull() ? flat : smooth);
    }
  }
  EXPECT_EQ(smooth, 1u);
  EXPECT_GT(flat, 4u);
  double most = 0;
  ASSERT_EQ(m.triangles.size(), full.triangles.size());
  for (size_t i = 0; i < m.triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      most = std::max(most, length(m.triangles[i].p[k] - full.triangles[i].p[k]));
      EXPECT_GT(dot(m.triangles[i].normal[k], full.triangles[i].normal[k]), 0.99);
    }
  }
  EXPECT_LT(most, 2 * WriteOptions::kMostQuantized);
}

TEST(GltfWriter, bareBoxesHaveEightCorners) {
  SceneBuilder b;
  b.leaf(kUnitBox, testing::turned(30, {1, 2, 3}), {1, -2, 3});
  b.leaf(kUnitBoxUv, testing::turned(30, {5, 2, 3}), {1, 2, 3});
  b.root("boxes", b.prototype("P"), Frame{});
  WriteOptions o = compact();
  o.vertices = WriteOptions::Vertices::Bare;
  const GlbModel m = roundTrip(b.scene, "boxes-bare.glb", o);
  EXPECT_EQ(m.vertices, 16u);
  double volume = 0;
  for (const auto& t : m.triangles) volume += dot(t.p[0], cross(t.p[1], t.p[2])) / 6;
  EXPECT_NEAR(volume, 12, 0.05);
}

// A strip of squares, each with the picture `times` over, as one smooth surface or as many flat
// ones.
Mesh strip(int squares, double times, bool smooth) {
  MeshBuilder b;
  for (int i = 0; i < squares; ++i) {
    b.beginFace(0, 0, smooth);
    b.beginLoop();
    for (const Vec2 p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
      const uint32_t c = b.addCorner(b.addPosition({i + p.x, 0, -p.y}));
      b.setUv(c, 0, {(i + p.x) * times, p.y});
    }
  }
  return b.take();
}

Scene textured() {
  SceneBuilder b;
  Material m = testing::colored("paper", {1, 1, 1});
  m.map(TextureLayer::Color) = {"paper.png", 2.5, -0.75, 0.3, 0.1, 0};
  m.map(TextureLayer::Normal) = {"normal.png", 2.5, -0.75, 0.3, 0.1, 0};
  const uint32_t paper = b.material(m);
  m.shader = std::string(kLaidShader) + "paper";
  const uint32_t laid = b.material(m);
  m.shader.clear();
  m.map(TextureLayer::Color).rw = 30;
  const uint32_t turned = b.material(m);
  int z = 0;
  for (const uint32_t material : {paper, laid, turned}) {
    b.leaf(kUnitBoxUv, testing::turned(20, {-30, 1, 3.0 * ++z}), {1, 2, 1.5}, material);
    for (const Mesh& mesh : {strip(40, 0.1, false), strip(40, 0.5, true), strip(40, 9, true)}) {
      b.leaf(b.mesh(mesh), Frame::moved({0, 0, 3.0 * ++z}), {1, 1, 1}, material);
    }
  }
  b.root("strips", b.prototype("Strips"), Frame{});
  return b.scene;
}

TEST(GltfWriter, compactTextureCoordinatesStayWithinATexel) {
  const Scene s = textured();
  WriteOptions floats, narrow = compact();
  floats.readTexture = narrow.readTexture = [](const std::string&) -> Result<std::string> {
    return testing::picture(8, false);
  };
  const GlbModel full = roundTrip(s, "uv-float.glb", floats);
  const GlbModel m = roundTrip(s, "uv-compact.glb", narrow);
  ASSERT_EQ(m.triangles.size(), full.triangles.size());
  // Primitives are in another order.
  const auto ordered = [](const GlbModel& model) {
    std::map<std::array<int64_t, 3>, testing::WorldTriangle> out;
    for (const testing::WorldTriangle& t : model.triangles) {
      const Vec3 middle = (t.p[0] + t.p[1] + t.p[2]) * (100.0 / 3);
      out[{std::llround(middle.x), std::llround(middle.y), std::llround(middle.z)}] = t;
    }
    return out;
  };
  const auto a = ordered(full), b = ordered(m);
  ASSERT_EQ(a.size(), full.triangles.size());
  for (const auto& [place, t] : a) {
    ASSERT_TRUE(b.count(place));
    // By whole pictures, the same all over a triangle.
    const Vec2 shift = b.at(place).uv[0] - t.uv[0];
    for (size_t k = 0; k < 3; ++k) {
      const Vec2 apart = b.at(place).uv[k] - t.uv[k];
      EXPECT_NEAR(apart.x, std::round(shift.x), 1.0 / 500);
      EXPECT_NEAR(apart.y, std::round(shift.y), 1.0 / 500);
    }
  }
  std::multiset<int> forms;
  for (const JsonValue& accessor : m.json["accessors"].items()) {
    if (accessor["type"].text() == "VEC2")
      forms.insert(static_cast<int>(accessor["componentType"].number(0)));
  }
  // Floats where a surface repeats the picture 900 times, or turns it.
  EXPECT_EQ(forms.count(5123), 3u);
  EXPECT_EQ(forms.count(5126), 1u);
  EXPECT_EQ(m.json["extensionsRequired"].size(), 2u);
}

TEST(GltfWriter, compactVerticesHaveNoTangents) {
  const Scene s = textured();
  const auto attributes = [&](WriteOptions::Vertices vertices, const std::string& name) {
    WriteOptions o;
    o.vertices = vertices;
    o.readTexture = [](const std::string&) -> Result<std::string> {
      return testing::picture(8, false);
    };
    const GlbModel m = roundTrip(s, "tangents.glb", o);
    size_t count = 0;
    for (const JsonValue& p : m.json["meshes"].at(0)["primitives"].items()) {
      count += p["attributes"][name].isNumber() ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(attributes(WriteOptions::Vertices::Float, "TANGENT"), 0u);
  EXPECT_EQ(attributes(WriteOptions::Vertices::Compact, "TANGENT"), 0u);
  EXPECT_EQ(attributes(WriteOptions::Vertices::Bare, "TANGENT"), 0u);
  // What is smooth keeps its normals.
  EXPECT_GT(attributes(WriteOptions::Vertices::Bare, "NORMAL"), 1u);
  EXPECT_LT(attributes(WriteOptions::Vertices::Bare, "NORMAL"), 8u);
}

TEST(GltfWriter, largeFilesAreCompact) {
  const auto boxes = [](int count) {
    SceneBuilder b;
    for (int i = 0; i < count; ++i) b.leaf(kUnitBox, Frame::moved({2.0 * i, 0, 0}), {1, 1, 1});
    b.root("row", b.prototype("Row"), Frame{});
    return roundTrip(b.scene, "boxes.glb").json["extensionsRequired"].size();
  };
  // A box takes 24 vertices of 24 bytes and 12 triangles of 6.
  const auto most = static_cast<int>(WriteOptions::kMostFloat / (24 * 24 + 12 * 6));
  EXPECT_EQ(boxes(most), 0u);
  EXPECT_EQ(boxes(most + 1), 1u);
}

TEST(GltfWriter, nodesAreNamedAfterShapesAndRules) {
  const GlbModel m = roundTrip(street(2), "names.glb");
  const JsonValue& first = m.json["nodes"].at(0);
  EXPECT_EQ(first["name"].text(), "house 0");
  bool window = false, tree = false;
  for (const JsonValue& n : m.json["nodes"].items()) {
    window = window || n["name"].text() == "Window";
    tree = tree || (n["extras"]["rule"].text() == "Facade" && n["extras"]["line"].number(0) == 7);
  }
  EXPECT_TRUE(window);
  EXPECT_TRUE(tree);
}

TEST(GltfWriter, normalsLookOutOnEveryKindOfLeaf) {
  SceneBuilder b;
  int i = 0;
  for (const uint32_t mesh : {uint32_t{kUnitBox}, uint32_t{kUnitBoxUv}}) {
    for (const Vec3& scale : {Vec3{1, 2, 3}, Vec3{-1, 2, 3}, Vec3{-1, -2, 3}, Vec3{-1, -2, -3}}) {
      b.leaf(mesh, testing::turned(i % 2 ? 30 : 0, {20.0 * i, 0, 0}), scale);
      b.root("box", b.prototype("P"), Frame{});
      ++i;
    }
  }
  const GlbModel m = roundTrip(b.scene, "mirrored.glb");
  ASSERT_EQ(m.triangles.size(), 8u * 12);
  double volume = 0;
  for (const auto& t : m.triangles) {
    const Vec3 n = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
    EXPECT_GT(dot(normalized(n), t.normal[0]), 0.999);
    volume += dot(t.p[0], cross(t.p[1], t.p[2])) / 6;
  }
  EXPECT_NEAR(volume, 8 * 6, 1e-3);
}

TEST(GltfWriter, leavesWithoutAreaOrWithoutNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  b.leaf(kUnitBox, Frame{}, {1, 0, 1});
  b.leaf(kUnitBox, Frame{}, {0, 0, 1});
  b.leaf(kUnitBox, Frame::moved({1e7, 0, 0}), {1e-3, 1, 1});
  b.leaf(kUnitBox, Frame::moved({nan, 0, 0}), {1, 1, 1});
  b.leaf(kUnitBox, Frame::moved({1e300, 0, 0}), {1, 1, 1});
  b.leaf(kUnitQuadXz, Frame{}, {1, 1, 0});
  b.root("a", b.prototype("P"), Frame{});
  b.leaf(kUnitQuadXz, Frame{}, {1, 1, 0});
  b.root("nothing", b.prototype("P"), Frame{});
  const GlbModel m = roundTrip(b.scene, "degenerate.glb");
  // A cube, the two large sides of the flat box, the two sides of the thin one that have area.
  EXPECT_EQ(m.triangles.size(), 12u + 4 + 4);
  EXPECT_EQ(m.nodes, 1u);
}

TEST(GltfWriter, emptyScenesAreFiles) {
  GlbModel m;
  writeTo(Scene{}, written("empty.glb"));
  m.read(written("empty.glb"));
  EXPECT_EQ(m.nodes, 0u);
  SceneBuilder b;
  b.root("void", b.prototype("P"), Frame{});
  EXPECT_EQ(roundTrip(b.scene, "void.glb").nodes, 0u);
}

TEST(GltfWriter, longUnitsAreCutAndLargeMeshesKeptWhole) {
  SceneBuilder b;
  for (int i = 0; i < 6000; ++i) b.leaf(kUnitBox, Frame::moved({i * 2.0, 0, 0}), {1, 1, 1});
  b.root("row", b.prototype("Row"), Frame{});
  const uint32_t large = b.mesh(testing::ball(300, 300));
  b.leaf(large, Frame{}, {5, 5, 5});
  b.root("ball", b.prototype("Ball"), Frame::moved({0, 20, 0}));
  WriteOptions o;
  o.vertices = WriteOptions::Vertices::Float;
  const GlbModel m = roundTrip(b.scene, "large.glb", o);
  expectSame(m, b.scene);
  const JsonValue& row = m.json["meshes"].at(0)["primitives"];
  const JsonValue& ball = m.json["meshes"].at(1)["primitives"];
  EXPECT_EQ(row.size(), 3u);
  ASSERT_EQ(ball.size(), 1u);
  const auto indices = static_cast<size_t>(ball.at(0)["indices"].number(0));
  EXPECT_EQ(m.json["accessors"].at(indices)["componentType"].number(0), 5125);
}

TEST(GltfWriter, texturesAreEmbeddedTransformedAndCombined) {
  const std::string rgb = testing::picture(8, false), rgba = testing::picture(16, true, 2);
  WriteOptions o;
  o.readTexture = [&](const std::string& path) -> Result<std::string> {
    if (path == "none.png") return Error{"file-missing", "there is no such file", {}};
    if (path == "text.png") return std::string("this is no picture");
    return path == "alpha.png" ? rgba : rgb;
  };
  SceneBuilder b;
  Material m = testing::colored("bricks", {0.5, 0.5, 0.5});
  m.map(TextureLayer::Color) = {"a folder/bricks.png", 2, 3, 0.25, 0.5, 90};
  m.map(TextureLayer::Normal).path = "normal.png";
  m.map(TextureLayer::Roughness).path = "rough.png";
  m.map(TextureLayer::Metallic).path = "metal.png";
  m.map(TextureLayer::Opacity).path = "alpha.png";
  m.map(TextureLayer::Occlusion).path = "none.png";
  m.map(TextureLayer::Emissive).path = "text.png";
  m.map(TextureLayer::Dirt).path = "dirt.png";
  m.emissive = {0.5, 0, 0};
  m.doubleSided = true;
  Material cut = testing::colored("leaves", {1, 1, 1});
  cut.map(TextureLayer::Color).path = cut.map(TextureLayer::Opacity).path = "alpha.png";
  cut.opacityMode = OpacityMode::Mask;
  const uint32_t bricks = b.material(m), leaves = b.material(cut);
  b.leaf(kUnitBoxUv, Frame{}, {1, 2, 3}, bricks);
  b.leaf(kUnitBox, Frame::moved({5, 0, 0}), {1, 2, 3}, bricks);
  b.leaf(kUnitQuadXyUv, testing::turned(45, {9, 0, 0}), {-2, 2, 1}, leaves);
  b.leaf(b.mesh(testing::holedSquare()), Frame::moved({0, -1, 0}), {1, 1, 1}, bricks);
  b.root("r", b.prototype("P"), Frame{});

  const GlbModel model = roundTrip(b.scene, "textures.glb", o);
  expectSame(model, b.scene);
  const JsonValue& materials = model.json["materials"];
  ASSERT_EQ(materials.size(), 3u);
  const JsonValue& first = materials.at(0);
  EXPECT_EQ(first["alphaMode"].text(), "BLEND");
  EXPECT_TRUE(first["doubleSided"].boolean(false));
  EXPECT_TRUE(first["occlusionTexture"].isNull());
  EXPECT_TRUE(first["emissiveTexture"].isNull());
  EXPECT_FALSE(first["normalTexture"].isNull());
  EXPECT_FALSE(first["pbrMetallicRoughness"]["metallicRoughnessTexture"].isNull());
  const JsonValue& transform =
      first["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"];
  EXPECT_EQ(transform["scale"].at(1).number(0), 3);
  // The same material without uv has no textures.
  EXPECT_TRUE(materials.at(1)["pbrMetallicRoughness"]["baseColorTexture"].isNull());
  EXPECT_EQ(materials.at(2)["alphaMode"].text(), "MASK");
  EXPECT_EQ(model.json["images"].size(), 4u);

  const WriteReport report = writeTo(b.scene, written("textures.gltf"), o);
  EXPECT_EQ(report.files.size(), 6u);
  EXPECT_EQ(report.warnings.size(), 3u);
  for (const std::string& f : report.files) EXPECT_TRUE(fileExists(f));
}

// Faces of any size, of a box and of a smooth mesh, have coordinates in metres; each picture is in
// the file once.
TEST(GltfWriter, materialsOfTheLibraryLieInMetres) {
  const std::string rgb = testing::picture(8, false);
  WriteOptions o;
  std::map<std::string, int> asked;
  o.readTexture = [&](const std::string& path) -> Result<std::string> {
    ++asked[path];
    return rgb;
  };
  SceneBuilder b;
  const Vec3 tint{0.3, 0.2, 0.1};
  const uint32_t bricks = b.material(laidMaterial(*libraryMaterial("brick.flemish"), nullptr));
  const uint32_t tinted = b.material(laidMaterial(*libraryMaterial("brick.flemish"), &tint));
  const uint32_t glass = b.material(laidMaterial(*libraryMaterial("glass"), nullptr));
  b.leaf(kUnitBox, Frame{}, {6, 4, 2}, bricks);
  b.leaf(kUnitBoxUv, Frame::moved({9, 0, 0}), {-1, 2, 3}, tinted);
  b.leaf(kUnitQuadXz, Frame::moved({5, 0, 0}), {1, 0, 2}, glass);
  b.root("r", b.prototype("P"), Frame{});

  const GlbModel model = roundTrip(b.scene, "laid.glb", o);
  EXPECT_EQ(model.json["materials"].size(), 3u);
  EXPECT_EQ(model.json["images"].size(), 6u);
  for (const auto& [path, times] : asked) EXPECT_EQ(times, 1) << path;
  const JsonValue& color =
      model.json["materials"].at(0)["pbrMetallicRoughness"]["baseColorTexture"];
  EXPECT_NEAR(color["extensions"]["KHR_texture_transform"]["scale"].at(0).number(0), 1 / 1.35,
              1e-6);
  EXPECT_NEAR(model.json["materials"].at(2)["extensions"]["KHR_materials_ior"]["ior"].number(0),
              1.52, 1e-6);
  std::set<std::string> used;
  const JsonValue& extensions = model.json["extensionsUsed"];
  for (size_t i = 0; i < extensions.size(); ++i) used.insert(extensions.at(i).text());
  EXPECT_EQ(used, (std::set<std::string>{"KHR_materials_ior", "KHR_materials_transmission",
                                         "KHR_texture_transform"}));

  // In OBJ the coordinates are tiles: the front of the first box is 6 x 4 m.
  writeTo(b.scene, written("laid.obj"), o);
  Result<std::string> text = readFile(written("laid.obj"), 1 << 20);
  ASSERT_TRUE(text.ok());
  EXPECT_NE(text->find("vt 4.4444"), std::string::npos);
  EXPECT_NE(text->find(" 2.96296"), std::string::npos);
}

TEST(GltfWriter, textureTransformsShowTheSamePlace) {
  // u' = turned(scaled(u, v)) + shift, v upwards; glTF's formula with v downwards must agree.
  const double su = 2, sv = 3, tu = 0.25, tv = 0.5, rw = 30;
  SceneBuilder b;
  Material m = testing::colored("t", {1, 1, 1});
  m.map(TextureLayer::Color) = {"a.png", su, sv, tu, tv, rw};
  b.leaf(kUnitQuadXyUv, Frame{}, {1, 1, 1}, b.material(m));
  b.root("r", b.prototype("P"), Frame{});
  WriteOptions o;
  o.readTexture = [](const std::string&) -> Result<std::string> {
    return testing::picture(4, false);
  };
  const GlbModel model = roundTrip(b.scene, "transform.glb", o);
  const JsonValue& t = model.json["materials"].at(
      0)["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"];
  const double a = t["rotation"].number(0), c = std::cos(a), s = std::sin(a);
  const double gu = 0.3, gv = 1 - 0.8;
  const double u = c * t["scale"].at(0).number(0) * gu + s * t["scale"].at(1).number(0) * gv +
                   t["offset"].at(0).number(0);
  const double v = -s * t["scale"].at(0).number(0) * gu + c * t["scale"].at(1).number(0) * gv +
                   t["offset"].at(1).number(0);
  const double turn = rw * 3.14159265358979 / 180;
  const double wantU = std::cos(turn) * su * 0.3 - std::sin(turn) * sv * 0.8 + tu;
  const double wantV = std::sin(turn) * su * 0.3 + std::cos(turn) * sv * 0.8 + tv;
  EXPECT_NEAR(u, wantU, 1e-6);
  EXPECT_NEAR(1 - v, wantV, 1e-6);
}

TEST(GltfWriter, equalScenesGiveEqualBytes) {
  WriteOptions o;
  const std::string a = readFile(writeTo(street(3), written("equal-1.glb")).files[0]).value();
  const std::string b = readFile(writeTo(street(3), written("equal-2.glb")).files[0]).value();
  EXPECT_EQ(a, b);
}

TEST(GltfWriter, doublingScenesEndInAMessage) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  uint32_t p = b.prototype("P");
  for (int i = 0; i < 60; ++i) {
    b.instance(p, Frame{});
    b.instance(p, Frame::moved({1.0 + i, 0, 0}));
    p = b.prototype("P");
  }
  b.root("r", p, Frame{});
  for (const char* name : {"deep.glb", "deep.gltf", "deep.obj", "deep.ply", "deep.stl"}) {
    const auto r = writeModel(b.scene, written(name));
    ASSERT_FALSE(r.ok()) << name;
    EXPECT_EQ(r.error().code, "model-too-large");
    EXPECT_FALSE(fileExists(written(name)));
  }
}

TEST(GltfWriter, prototypesThatShowNothingCostNothing) {
  SceneBuilder b;
  uint32_t p = b.prototype("P");
  for (int i = 0; i < 60; ++i) {
    b.instance(p, Frame{});
    b.instance(p, Frame::moved({1.0 + i, 0, 0}));
    p = b.prototype("P");
  }
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  b.instance(p, Frame{});
  b.root("r", b.prototype("P"), Frame{});
  EXPECT_EQ(roundTrip(b.scene, "nothing.glb").triangles.size(), 12u);
}

TEST(GltfWriter, unknownFormatsAndFoldersAreTold) {
  EXPECT_EQ(writeModel(Scene{}, "a.fbx").error().code, "format-unknown");
  EXPECT_EQ(writeModel(Scene{}, "a").error().code, "format-unknown");
  for (const std::string& e : modelExtensions()) {
    EXPECT_EQ(writeModel(street(1), "/no/such/folder/a." + e).error().code, "file-unwritable") << e;
  }
}

TEST(GltfMaterials, coloursBecomeLinear) {
  EXPECT_EQ(linearOf(0), 0);
  EXPECT_EQ(linearOf(1), 1);
  EXPECT_NEAR(linearOf(0.5), 0.214041, 1e-6);
  EXPECT_EQ(linearOf(-1), 0);
  EXPECT_EQ(linearOf(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Quaternion, turnsAsTheFrameDoes) {
  for (int i = 0; i < 200; ++i) {
    const Frame f = rotationXyz(i * 17.0, i * 29.0, i * 41.0);
    const auto q = quaternionOf(f);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
    const Vec3 v{q[0], q[1], q[2]}, p{1, 2, 3};
    const Vec3 rotated = p + cross(v, cross(v, p) + p * q[3]) * 2;
    EXPECT_NEAR(length(rotated - f.direction(p)), 0, 1e-12);
  }
}

TEST(GltfWriter, eachShapeIsOneMeshThatEqualOnesShare) {
  const Scene s = street(5);
  WriteOptions shapes;
  shapes.instancing = WriteOptions::Instancing::Shapes;
  const GlbModel model = roundTrip(s, "street-shapes.glb", shapes);
  expectSame(model, s);
  EXPECT_EQ(model.nodes, s.roots.size());
  EXPECT_LT(model.meshes, model.nodes);
  // A grid of steps fits no wide mesh; it is whole all the same.
  shapes.vertices = WriteOptions::Vertices::Compact;
  EXPECT_EQ(roundTrip(s, "street-shapes-compact.glb", shapes).nodes, model.nodes);
}

TEST(GltfWriter, levelsOfDetailAreNodesOutsideTheScene) {
  SceneBuilder b;
  const uint32_t fine = b.mesh(makeBoxMesh({2, 2, 2}, false)),
                 coarse = b.mesh(makeBoxMesh({2, 2, 1.9}, false));
  b.leaf(fine, Frame{}, {1, 1, 1});
  const uint32_t house = b.prototype("House");
  b.leaf(coarse, Frame{}, {1, 1, 1});
  const uint32_t far = b.prototype("House_LOD1");
  b.leaf(b.mesh(Mesh{}), Frame{}, {1, 1, 1});
  const uint32_t nothing = b.prototype("Nothing");
  b.root("House", house, Frame::moved({5, 0, 0}));
  b.root("House_LOD1", far, Frame::moved({5, 0, 0}));
  b.root("House_LOD2", nothing, Frame::moved({5, 0, 0}));
  WriteOptions o;
  o.apart = true;
  o.levels = {{1, 2}, {}, {}};
  o.coverage = {0.5, 0.25, 0};
  const std::string path = written("levels.glb");
  writeTo(b.scene, path, o);
  GlbModel model;
  model.read(path);
  EXPECT_EQ(model.json["scenes"].at(0)["nodes"].size(), 1u);
  const JsonValue& node = model.json["nodes"].at(0);
  const JsonValue& ids = node["extensions"]["MSFT_lod"]["ids"];
  // The level that has nothing to show is none.
  ASSERT_EQ(ids.size(), 1u);
  EXPECT_EQ(model.json["nodes"].at(1)["name"].text(), "House_LOD1");
  EXPECT_EQ(ids.at(0).number(-1), 1);
  EXPECT_EQ(node["extras"]["MSFT_screencoverage"].size(), 2u);
  EXPECT_EQ(model.json["extensionsUsed"].at(0).text(), "MSFT_lod");
  EXPECT_EQ(model.triangles.size(), 12u);
}

TEST(GltfWriter, bakedCoordinatesLieAsReadersWouldPlaceThem) {
  SceneBuilder b;
  Material m;
  m.map(TextureLayer::Color) = {"wall.png", 2, 3, 0.25, 0.5, 90};
  b.leaf(kUnitQuadXyUv, Frame{}, {1, 1, 1}, b.material(m));
  b.root("a", b.prototype("a"), Frame{});
  WriteOptions o;
  o.bakedUv = true;
  o.readTexture = [](const std::string&) { return encodePng(Image{1, 1, {9, 9, 9, 255}}, 3); };
  const GlbModel model = roundTrip(b.scene, "baked.glb", o);
  EXPECT_FALSE(model.json["extensionsUsed"].isArray());
  EXPECT_EQ(model.bytes.find("KHR_texture_transform"), std::string::npos);
  const JsonValue& attributes = model.json["meshes"].at(0)["primitives"].at(0)["attributes"];
  const auto at = [&](const JsonValue& list, const JsonValue& number) -> const JsonValue& {
    return list.at(static_cast<size_t>(number.number(-1)));
  };
  // The numbers of vertex i, of an attribute.
  const auto values = [&](const char* name, size_t i, size_t count) {
    const JsonValue& a = at(model.json["accessors"], attributes[name]);
    const JsonValue& view = at(model.json["bufferViews"], a["bufferView"]);
    const double start = view["byteOffset"].number(0) + a["byteOffset"].number(0) +
                         static_cast<double>(i) * view["byteStride"].number(0);
    std::vector<float> out(count);
    std::memcpy(out.data(), model.buffer() + static_cast<size_t>(start), count * 4);
    return out;
  };
  for (size_t i = 0; i < 4; ++i) {
    const std::vector<float> p = values("POSITION", i, 3), uv = values("TEXCOORD_0", i, 2);
    // Turned by a quarter: what ran along u runs along v.
    EXPECT_NEAR(uv[0], 0.25 - 3.0 * p[1], 1e-6);
    EXPECT_NEAR(1 - uv[1], 0.5 + 2.0 * p[0], 1e-6);
  }
}

TEST(GltfWriter, texturesAreHalvedUntilTheyFit) {
  Image image;
  image.width = 40;
  image.height = 9;
  image.rgba.assign(size_t{40} * 9 * 4, 200);
  const std::string png = encodePng(image).value();
  SceneBuilder b;
  Material m;
  m.map(TextureLayer::Color).path = "wall.png";
  b.leaf(kUnitBoxUv, Frame{}, {1, 1, 1}, b.material(m));
  b.root("a", b.prototype("a"), Frame{});
  for (const uint32_t size : {0u, 40u, 39u, 10u, 1u}) {
    WriteOptions o;
    o.readTexture = [&](const std::string&) { return Result<std::string>(png); };
    o.textureSize = size;
    const GlbModel model = roundTrip(b.scene, "halved.glb", o);
    const JsonValue& view = model.json["bufferViews"].at(
        static_cast<size_t>(model.json["images"].at(0)["bufferView"].number(-1)));
    const std::string_view bytes(model.buffer() + static_cast<size_t>(view["byteOffset"].number(0)),
                                 static_cast<size_t>(view["byteLength"].number(0)));
    const ImageHeader h = readImageHeader(bytes).value();
    EXPECT_EQ(h.width, size == 0 || size == 40 ? 40u : size == 39 ? 20u : size);
    EXPECT_EQ(h.height, size == 0 || size == 40 ? 9u : size == 39 ? 5u : size == 10 ? 3u : 1u);
  }
}

}  // namespace
}  // namespace gable
