// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.h"
#include "base/hash.h"
#include "base/random.h"
#include "io/exporters/write_model.h"
#include "io/importers/base64.h"
#include "io/importers/gltf_file.h"
#include "io/importers/shape_input.h"
#include "io/testing/glb_model.h"
#include "io/testing/scenes.h"
#include "material/linear_light.h"

namespace gable {
namespace {

using testing::SceneBuilder;

std::string writtenBytes(const Scene& s, const std::string& name, const WriteOptions& o = {}) {
  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  const std::string path = std::string(GABLE_WRITTEN_DIR) + "/" + name;
  EXPECT_TRUE(writeModel(s, path, o).ok());
  return readFile(path).value();
}

AssetOptions optionsFor(const std::string& path) {
  AssetOptions o;
  o.path = path;
  o.readFile = [](const std::string& p) { return readFile(p); };
  return o;
}

TEST(GltfAsset, whatIsWrittenReadsBack) {
  const Scene s = testing::street(3);
  for (const char* name : {"read.glb", "read.gltf"}) {
    const std::string bytes = writtenBytes(s, name);
    auto r = readAsset(bytes, optionsFor(std::string(GABLE_WRITTEN_DIR) + "/" + name));
    ASSERT_TRUE(r.ok()) << r.error().message;
    const SceneCounts counts = count(s);
    EXPECT_EQ(r->mesh->faceCount(), counts.triangles);
    EXPECT_NEAR(r->mesh->area(), testing::areaOf(s), 1e-5 * r->mesh->area());
    EXPECT_NEAR(length(r->bounds.min - counts.bounds.min), 0, 1e-4);
    EXPECT_NEAR(length(r->bounds.max - counts.bounds.max), 0, 1e-4);
    EXPECT_TRUE(r->mesh->valid());
    EXPECT_TRUE(r->warnings.empty());
    ASSERT_EQ(r->materials.size(), 2u);
    EXPECT_EQ(r->materials[0].name, "wall");
    EXPECT_NEAR(r->materials[0].color.x, 0.8, 1e-6);
    EXPECT_EQ(r->materials[1].opacity, 0.5);
    EXPECT_EQ(r->materials[1].opacityMode, OpacityMode::Blend);
    // The balls are smooth, so that normals were kept.
    EXPECT_FALSE(r->mesh->normals.empty());
    EXPECT_EQ(r->groups[0], "house 0");
  }
}

TEST(GltfAsset, flatNormalsAreNotKeptAndPositionsAreShared) {
  SceneBuilder b;
  b.leaf(kUnitBoxUv, testing::turned(30, {5, 0, 0}), {2, 3, 4});
  b.root("box", b.prototype("P"), Frame{});
  auto r = readAsset(writtenBytes(b.scene, "box.glb"), optionsFor("box.glb"));
  ASSERT_TRUE(r.ok());
  EXPECT_TRUE(r->mesh->normals.empty());
  EXPECT_EQ(r->mesh->positions.size(), 8u);
  ASSERT_TRUE(r->mesh->hasUv(0));
  // v points up again: every side has its uv corners.
  double sum = 0;
  for (const Vec2 uv : r->mesh->uvs[0]) sum += uv.x + uv.y;
  EXPECT_NEAR(sum, 6 * 6, 1e-6);
}

TEST(GltfAsset, texturesInsideTheFileGetNames) {
  const std::string picture = testing::picture(8, true);
  WriteOptions w;
  w.readTexture = [&](const std::string&) -> Result<std::string> { return picture; };
  SceneBuilder b;
  Material m = testing::colored("cut", {1, 1, 1});
  m.map(TextureLayer::Color) = {"a.png", 2, 3, 0.25, 0.5, 30};
  m.map(TextureLayer::Opacity) = m.map(TextureLayer::Color);
  m.map(TextureLayer::Roughness).path = m.map(TextureLayer::Metallic).path = "mr.png";
  m.opacityMode = OpacityMode::Mask;
  m.opacityCutoff = 0.25;
  m.metallic = 0.75;
  b.leaf(kUnitQuadXyUv, Frame{}, {1, 1, 1}, b.material(m));
  b.root("r", b.prototype("P"), Frame{});
  auto r = readAsset(writtenBytes(b.scene, "named.glb", w), optionsFor("models/named.glb"));
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->materials.size(), 1u);
  const Material& back = r->materials[0];
  const TextureMap& map = back.map(TextureLayer::Color);
  EXPECT_EQ(map.path, "models/named.glb#0.png");
  EXPECT_EQ(r->textures.at(map.path), picture);
  EXPECT_NEAR(map.su, 2, 1e-6);
  EXPECT_NEAR(map.sv, 3, 1e-6);
  EXPECT_NEAR(map.tu, 0.25, 1e-6);
  EXPECT_NEAR(map.tv, 0.5, 1e-6);
  EXPECT_NEAR(map.rw, 30, 1e-4);
  EXPECT_EQ(back.map(TextureLayer::Opacity).path, map.path);
  EXPECT_EQ(back.map(TextureLayer::Roughness).path, back.map(TextureLayer::Metallic).path);
  EXPECT_EQ(back.opacityMode, OpacityMode::Mask);
  EXPECT_EQ(back.opacityCutoff, 0.25);
  EXPECT_EQ(back.metallic, 0.75);
}

// A triangle with everything that our writer does not make.
std::string handMade(const std::string& extra = {}, const std::string& node = R"("mesh":0)") {
  // Positions as shorts: (0,0,0) (1,0,0) (0,1,0), padded to 8 bytes; indices as bytes 0 1 2 0.
  return R"({"asset":{"version":"2.0"},"nodes":[{)" + node +
         R"(}],"meshes":[{"name":"M","primitives":[
    {"attributes":{"POSITION":0},"indices":1,"mode":4}]}],
    "accessors":[{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3"},
                 {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":3}],
    "buffers":[{"byteLength":28,"uri":"data:application/octet-stream;base64,AAAAAAAAAAABAAAAAAAAAAAAAQAAAAAAAAECAA=="}])" +
         extra + "}";
}

TEST(GltfAsset, integersStridesAndDataUris) {
  auto r = readGltfAsset(handMade(), optionsFor("a.gltf"));
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_EQ(r->mesh->faceCount(), 1u);
  EXPECT_EQ(r->mesh->area(), 0.5);
  EXPECT_EQ(r->groups, std::vector<std::string>{"M"});
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) {
      three = three * 256 + (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    }
    for (int k = 3; k >= 0; --k) out.push_back(kDigits[three >> (6 * k) & 63]);
  }
  const size_t missing = (3 - bytes.size() % 3) % 3;
  return out.replace(out.size() - missing, missing, missing, '=');
}

// A triangle with colours of its vertices: the accessor, and 48 bytes for it to read.
Result<Asset> colored(const std::string& accessor, const std::string& bytes) {
  std::string text = handMade();
  const auto put = [&](const std::string& before, const std::string& what) {
    text.insert(text.find(before), what);
  };
  put("},\"indices\":1", ",\"COLOR_0\":2");
  put("],\n    \"bufferViews\"", ",{\"bufferView\":2," + accessor + "}");
  put("],\n    \"buffers\"", ",{\"buffer\":1,\"byteLength\":48}");
  text.insert(text.rfind("]"),
              ",{\"byteLength\":48,\"uri\":\"data:application/octet-stream;base64," +
                  base64(bytes) + "\"}");
  return readGltfAsset(text, optionsFor("a.gltf"));
}

TEST(GltfAsset, coloursOfVerticesAreColoursOfFaces) {
  const std::string bytes4 = "\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":";
  // A third of full light, and two thirds of alpha.
  std::string bytes(48, '\0');
  for (size_t v = 0; v < 3; ++v) bytes[4 * v] = 85;
  bytes[3] = bytes[7] = '\xff';
  auto r = colored(bytes4 + "\"VEC4\"", bytes);
  ASSERT_TRUE(r.ok()) << r.error().message;
  ASSERT_EQ(r->materials.size(), 1u);
  EXPECT_NEAR(r->materials[0].color.x, srgbOf(1.0 / 3), 0.002);
  EXPECT_EQ(r->materials[0].color.y, 0);
  EXPECT_NEAR(r->materials[0].opacity, 2.0 / 3, 0.002);

  // Of three components, and of the wrong number of vertices.
  r = colored("\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"", std::string(48, '\0'));
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->materials[0].color, Vec3{});
  r = colored("\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"", std::string(48, '\0'));
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->materials[0].color, (Vec3{1, 1, 1}));
}

TEST(GltfAsset, coloursWithoutEndAreBounded) {
  // A strip of 200,000 vertices, each of another colour.
  const size_t count = 200000;
  std::string bytes;
  const auto put = [&](float v) { bytes.append(reinterpret_cast<const char*>(&v), 4); };
  for (size_t i = 0; i < count; ++i) {
    put(static_cast<float>(i / 2));
    put(static_cast<float>(i % 2));
    put(0);
  }
  for (size_t i = 0; i < count * 4; ++i) bytes.push_back(static_cast<char>(hashCombine(7, i)));
  const std::string size = std::to_string(bytes.size()), at = std::to_string(count * 12);
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[
      {"attributes":{"POSITION":0,"COLOR_0":1},"mode":5}]}],"accessors":[
      {"bufferView":0,"componentType":5126,"count":200000,"type":"VEC3"},
      {"bufferView":1,"componentType":5121,"normalized":true,"count":200000,"type":"VEC4"}],
      "bufferViews":[{"buffer":0,"byteLength":)" +
      at + R"(},{"buffer":0,"byteOffset":)" + at +
      R"(,"byteLength":800000}],"buffers":[{"byteLength":)" + size +
      R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"}]}";
  auto r = readGltfAsset(text, optionsFor("a.gltf"));
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_EQ(r->mesh->faceCount(), count - 2);
  EXPECT_GT(r->materials.size(), 4096u);
  EXPECT_LE(r->materials.size(), 4096u + 6 * 6 * 6 * 6);
}

TEST(GltfAsset, nodesPlaceAndMirror) {
  auto r = readGltfAsset(
      handMade(
          {},
          R"("mesh":0,"translation":[1,2,3],"scale":[-2,1,1],"rotation":[0,0,0.7071067811865476,0.7071067811865476])"),
      optionsFor("a.gltf"));
  ASSERT_TRUE(r.ok());
  EXPECT_NEAR(r->mesh->area(), 1, 1e-9);
  EXPECT_NEAR(length(r->bounds.min - Vec3{0, 0, 3}), 0, 1e-9);
  // The mirrored triangle still shows its front to +z.
  EXPECT_GT(r->mesh->normal(0).z, 0.99);
  auto matrix =
      readGltfAsset(handMade({}, R"("mesh":0,"matrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 5,6,7,1])"),
                    optionsFor("a.gltf"));
  ASSERT_TRUE(matrix.ok());
  EXPECT_EQ(matrix->bounds.min, (Vec3{5, 6, 7}));
  EXPECT_EQ(matrix->mesh->area(), 2);
}

TEST(GltfAsset, loopsOfNodesEnd) {
  auto r = readGltfAsset(handMade({}, R"("mesh":0,"children":[0,0,7])"), optionsFor("a.gltf"));
  EXPECT_FALSE(r.ok());
  r = readGltfAsset(
      handMade(R"(,"scene":0,"scenes":[{"nodes":[0,0,5]}])", R"("mesh":0,"children":[0])"),
      optionsFor("a.gltf"));
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->mesh->faceCount(), 1u);
}

// The groups of what is read of some nodes, each with a mesh if it has no children.
std::vector<std::string> groupsOf(const std::string& nodes, const std::string& extra = {}) {
  auto r = readGltfAsset(handMade(extra, nodes), optionsFor("a.gltf"));
  return r.ok() ? r->groups : std::vector<std::string>{r.error().message};
}

TEST(GltfAsset, coarserLevelsAreLeftOutWithAllBelowThem) {
  using Names = std::vector<std::string>;
  const std::string levels =
      R"("name":"H_LOD0","children":[2]},{"name":"H_LOD1","children":[3]},
         {"name":"fine","mesh":0},{"name":"coarse","mesh":0)";
  EXPECT_EQ(groupsOf(levels), Names{"fine"});
  // A scene with the coarse level alone shows it.
  EXPECT_EQ(groupsOf(levels, R"(,"scene":0,"scenes":[{"nodes":[1]}])"), Names{"coarse"});
  // Below a collision shape is something else.
  EXPECT_EQ(groupsOf(R"("name":"UCX_H","mesh":0,"children":[1]},{"name":"sign","mesh":0)"),
            Names{"sign"});
  const std::string extension =
      R"("name":"fine","mesh":0,"extensions":{"MSFT_lod":{"ids":[1,0,9]}}},
         {"name":"coarse","children":[2]},{"name":"below","mesh":0)";
  EXPECT_EQ(groupsOf(extension), Names{"fine"});
  EXPECT_EQ(groupsOf(extension, R"(,"scene":0,"scenes":[{"nodes":[0,1]}])"), Names{"fine"});
}

TEST(GltfAsset, wrongReferencesAreErrorsOrLeftOut) {
  const std::string good = handMade();
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string t = good;
    const size_t at = t.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return t.replace(at, from.size(), to);
  };
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\"count\":3", "\"count\":4"},
           {"\"count\":3", "\"count\":4294967295"},
           {"\"count\":3", "\"count\":1e300"},
           {"\"count\":3", "\"count\":-1"},
           {"\"bufferView\":0", "\"bufferView\":9"},
           {"\"componentType\":5122", "\"componentType\":5126"},
           {"\"byteLength\":24", "\"byteLength\":9999999999"},
           {"\"byteStride\":8", "\"byteStride\":0"},
           {"\"POSITION\":0", "\"POSITION\":1"},
           {"\"POSITION\":0", "\"NORMAL\":0"},
           {"AAAAAAAAAAAB", "AAAA*AAAAAAB"},
           {"\"mode\":4", "\"mode\":1"},
           {"\"mode\":4", "\"mode\":1e300"},
           {"\"indices\":1", "\"indices\":0"},
           {"\"mesh\":0", "\"mesh\":1"},
           {"2.0", "1.0"}}) {
    EXPECT_FALSE(readGltfAsset(replaced(from, to), optionsFor("a.gltf")).ok()) << from << " " << to;
  }
  EXPECT_FALSE(readGltfAsset(replaced("\"nodes\"",
                                      "\"extensionsRequired\":[\"KHR_no_such_thing\"],\"nodes\""),
                             optionsFor("a.gltf"))
                   .ok());
  for (const char* text : {"", "{}", "glTF", "[1]", "{\"asset\":{\"version\":\"2.0\"}}"}) {
    EXPECT_FALSE(readGltfAsset(text, optionsFor("a.gltf")).ok()) << text;
  }
}

TEST(GltfAsset, everyCutOffAndChangedFileEnds) {
  SceneBuilder b;
  Material m = testing::colored("t", {1, 1, 1});
  m.map(TextureLayer::Color).path = "a.png";
  b.leaf(kUnitBoxUv, Frame{}, {2, 3, 4}, b.material(m));
  b.leaf(b.mesh(testing::ball(4, 5)), Frame{}, {1, 1, 1});
  b.root("box", b.prototype("P"), testing::turned(20, {1, 2, 3}));
  WriteOptions w;
  w.readTexture = [](const std::string&) -> Result<std::string> {
    return testing::picture(4, true);
  };
  const std::string good = writtenBytes(b.scene, "changed.glb", w);
  for (size_t n = 0; n < good.size(); n += 1 + n / 50) {
    readGltfAsset(good.substr(0, n), optionsFor("a.glb"));
  }
  size_t read = 0;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    std::string bytes = good;
    for (uint64_t k = 0; k < 3; ++k) {
      const uint64_t bits = randomBits(hashCombine(seed, k));
      const size_t at = bits % (bits >> 63 ? bytes.size() : 2200);
      bytes[at] = bits >> 62 & 1 ? static_cast<char>('0' + (bits >> 32) % 10)
                                 : static_cast<char>(bits >> 32);
    }
    const auto r = readGltfAsset(bytes, optionsFor("a.glb"));
    if (!r.ok()) continue;
    ++read;
    EXPECT_TRUE(r.value().mesh->valid());
    EXPECT_EQ(r.value().faceGroups.size(), r.value().mesh->faceCount());
    for (const MeshFace& f : r.value().mesh->faces)
      ASSERT_LT(f.materialSlot, r.value().materials.size());
  }
  EXPECT_GT(read, 300u);
}

TEST(GltfAsset, smallFilesThatShowMuchEnd) {
  // One mesh of many zeros, shown by many nodes.
  std::string nodes = R"("mesh":0})";
  for (int i = 0; i < 3000; ++i) nodes += R"(,{"mesh":0})";
  nodes += R"(,{"mesh":0)";
  std::string text = handMade({}, nodes);
  const std::string from = R"({"bufferView":0,"componentType":5122,"count":3,"type":"VEC3"})";
  text.replace(text.find(from), from.size(),
               R"({"componentType":5126,"count":1000000,"type":"VEC3"})");
  auto r = readGltfAsset(text, optionsFor("a.gltf"));
  EXPECT_FALSE(r.ok());
}

TEST(GltfShapes, nodesAreShapes) {
  SceneBuilder b;
  b.leaf(kUnitQuadXz, Frame{}, {10, 1, 20});
  b.root("lot a", b.prototype("P"), Frame::moved({5, 0, 0}));
  b.leaf(kUnitQuadXz, Frame{}, {3, 1, 3});
  b.root("lot b", b.prototype("P"), Frame{});
  auto r = readShapes(writtenBytes(b.scene, "lots.glb"), optionsFor("lots.glb"));
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 2u);
  EXPECT_EQ(r->shapes[0].name, "lot a");
  EXPECT_EQ(r->shapes[0].mesh.area(), 200);
  EXPECT_EQ(r->shapes[0].mesh.bounds().min.x, 5);
  EXPECT_GT(r->shapes[0].mesh.normal(0).y, 0.99);
  // The two triangles are one rectangle again.
  ASSERT_EQ(r->shapes[0].mesh.faceCount(), 1u);
  EXPECT_EQ(r->shapes[0].mesh.corners.size(), 4u);
}

TEST(GltfShapes, extrasOfNodesAreAttributes) {
  std::string text = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"extras":{"roof:shape":"hip","floors":3,"old":true,"odd":{"a":1},"mix":[1,"a"]}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,
    "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIC/"}]})";
  auto r = readShapes(text, optionsFor("lots.gltf"));
  ASSERT_TRUE(r.ok());
  const std::vector<AttributeValue>& a = r->shapes[0].attributes;
  ASSERT_EQ(a.size(), 3u);
  EXPECT_EQ(a[0].name, "roof_shape");
  EXPECT_EQ(a[0].values[0].text, "hip");
  EXPECT_EQ(a[1].values[0].number, 3);
  EXPECT_EQ(a[2].values[0].kind, PlainValue::Kind::Bool);
  for (const char* broken : {"[]", "null", "\"x\"", "{\"\":[]}"}) {
    std::string other = text;
    const size_t at = other.find("{\"roof"), end = other.find("}}]") + 1;
    other.replace(at, end - at, broken);
    r = readShapes(other, optionsFor("lots.gltf"));
    ASSERT_TRUE(r.ok()) << broken;
    EXPECT_TRUE(r->shapes[0].attributes.empty()) << broken;
  }
}

TEST(GltfShapes, holesComeBack) {
  SceneBuilder b;
  b.leaf(b.mesh(testing::holedSquare()), testing::turned(33, {100, 0, 50}), {1, 1, 1});
  b.root("yard", b.prototype("P"), Frame{});
  auto r = readShapes(writtenBytes(b.scene, "yard.glb"), optionsFor("yard.glb"));
  ASSERT_TRUE(r.ok());
  const Mesh& m = r->shapes[0].mesh;
  ASSERT_EQ(m.faceCount(), 1u);
  EXPECT_EQ(m.loopsOf(0).size(), 2u);
  EXPECT_NEAR(m.area(), 91, 1e-3);
}

TEST(DataUri, readsBase64) {
  std::string mime, bytes;
  EXPECT_TRUE(readDataUri("data:image/png;base64,TWFu", mime, bytes));
  EXPECT_EQ(bytes, "Man");
  EXPECT_EQ(mime, "image/png");
  EXPECT_TRUE(readDataUri("data:;base64,TWE=", mime, bytes));
  EXPECT_EQ(bytes, "Ma");
  EXPECT_TRUE(readDataUri("data:;base64,", mime, bytes));
  EXPECT_TRUE(bytes.empty());
  for (const char* uri : {"", "data:", "data:,x", "data:;base64,T*", "file.bin"}) {
    EXPECT_FALSE(readDataUri(uri, mime, bytes)) << uri;
  }
}

}  // namespace
}  // namespace gable
