// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "io/exporters/atlas_packing.h"
#include "io/image/image.h"
#include "io/testing/scenes.h"
#include "material/library.h"
#include "scene/flatten.h"

namespace gable {
namespace {

using testing::colored;
using testing::SceneBuilder;

// Four quarters of their own colours: red and green above, blue and white below.
std::string quarters(uint32_t side) {
  Image image{side, side, {}};
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const bool right = x >= side / 2, below = y >= side / 2;
      for (const bool on : {below == right, right, below}) image.rgba.push_back(on ? 255 : 0);
      image.rgba.push_back(255);
    }
  }
  return encodePng(image).value();
}

Result<std::string> read(const std::string& path) {
  if (path == "quarters.png") return quarters(32);
  return Error{"texture-not-found", "there is no picture '" + path + "'", ""};
}

Material pictured(const std::string& path) {
  Material m;
  m.name = path;
  m.map(TextureLayer::Color).path = path;
  return m;
}

// A square that shows its picture from `from` on, `repeats` times.
Mesh square(const Vec2& from, double repeats) {
  Mesh m = makeQuadMesh(1, 1, QuadPlane::Xy, true);
  for (Vec2& uv : m.uvs[0]) uv = from + uv * repeats;
  return m;
}

// What the atlas shows at a share of the way across and up a leaf's square.
std::array<int, 3> shownAt(const AtlasScene& a, size_t leaf, double across, double up) {
  const Leaf& l = a.scene.leaves[leaf];
  const Mesh& mesh = *a.scene.meshes[l.mesh];
  const Material& m = a.scene.materials[materialIndexOf(a.scene, l, 0)];
  const Image image = decodeImage(a.pictures.at(m.map(TextureLayer::Color).path)).value();
  Vec2 low = mesh.uvs[0][0], high = low;
  for (const Vec2& uv : mesh.uvs[0]) {
    low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
    high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
  }
  const double u = low.x + (high.x - low.x) * across, v = low.y + (high.y - low.y) * up;
  const uint8_t* const p = image.at(static_cast<uint32_t>(u * image.width),
                                    static_cast<uint32_t>((1 - v) * image.height));
  return {p[0], p[1], p[2]};
}

using Color = std::array<int, 3>;

class AtlasTest : public ::testing::Test {
 protected:
  void add(Mesh mesh, const Material& material) {
    b_.leaf(b_.mesh(std::move(mesh)), Frame{}, {1, 1, 1}, b_.material(material));
  }
  AtlasScene made(uint32_t side = 512) {
    b_.root("Lot", b_.prototype("Lot"), Frame{});
    return withAtlas(b_.scene, read, side);
  }
  SceneBuilder b_;
};

TEST_F(AtlasTest, coloursAndPicturesBecomeOneMaterial) {
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("red", {1, 0, 0})));
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("blue", {0, 0, 1})));
  add(square({0, 0}, 1), pictured("quarters.png"));
  // A whole number of repeats away, and tinted.
  Material tinted = pictured("quarters.png");
  tinted.color = {1, 0.5, 1};
  add(square({3, -2}, 1), tinted);
  const AtlasScene a = made();
  EXPECT_EQ(a.counts.merged, 4u);
  EXPECT_EQ(a.counts.into, 1u);
  std::set<uint32_t> materials;
  for (const Leaf& l : a.scene.leaves) materials.insert(materialIndexOf(a.scene, l, 0));
  EXPECT_EQ(materials.size(), 1u);
  EXPECT_EQ(shownAt(a, 0, 0.5, 0.5), (Color{255, 0, 0}));
  EXPECT_EQ(shownAt(a, 1, 0.5, 0.5), (Color{0, 0, 255}));
  EXPECT_EQ(shownAt(a, 2, 0.1, 0.9), (Color{255, 0, 0}));
  EXPECT_EQ(shownAt(a, 2, 0.9, 0.9), (Color{0, 255, 0}));
  EXPECT_EQ(shownAt(a, 2, 0.1, 0.1), (Color{0, 0, 255}));
  EXPECT_EQ(shownAt(a, 3, 0.9, 0.9), (Color{0, 128, 0}));
  EXPECT_FALSE(a.pictures.contains("atlas-metal-rough.png"));
}

TEST_F(AtlasTest, whatRepeatsTwiceStandsTwiceAndMoreStays) {
  add(square({0, 0}, 2), pictured("quarters.png"));
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("red", {1, 0, 0})));
  Material often = pictured("quarters.png");
  often.name = "often";
  add(square({0, 0}, 5), often);
  const AtlasScene a = made();
  EXPECT_EQ(a.counts.merged, 2u);
  EXPECT_EQ(a.counts.repeating, 1u);
  for (const double half : {0.0, 0.5}) {
    EXPECT_EQ(shownAt(a, 0, 0.05 + half, 0.45), (Color{255, 0, 0}));
    EXPECT_EQ(shownAt(a, 0, 0.05 + half, 0.55), (Color{0, 0, 255}));
    EXPECT_EQ(shownAt(a, 0, 0.45 + half, 0.95), (Color{0, 255, 0}));
  }
  EXPECT_EQ(a.scene.materials[materialIndexOf(a.scene, a.scene.leaves[2], 0)].name, "often");
  EXPECT_EQ(a.scene.leaves[2].mesh, b_.scene.leaves[2].mesh);
}

TEST_F(AtlasTest, otherKindsOfMaterialsStayApart) {
  for (int i = 0; i < 4; ++i) {
    Material m = colored("m" + std::to_string(i), {0.2 * i, 0, 0});
    if (i == 1) m.opacity = 0.5;
    if (i == 2) m.doubleSided = false;
    if (i == 3) m.roughness = 0.25;
    b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(m));
  }
  Material lamp = colored("lamp", {1, 1, 1});
  lamp.emissive = {1, 1, 0.5};
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(lamp));
  add(square({0, 0}, 1), laidMaterial(*libraryMaterial("brick.flemish"), nullptr));
  add(square({0, 0}, 1), pictured("missing.png"));
  const AtlasScene a = made();
  EXPECT_EQ(a.counts.merged, 4u);
  // Opaque, clear, and single sided.
  EXPECT_EQ(a.counts.into, 3u);
  EXPECT_EQ(a.counts.special, 1u);
  EXPECT_EQ(a.counts.repeating, 1u);
  EXPECT_EQ(a.counts.large, 1u);
  const Image rough = decodeImage(a.pictures.at("atlas-metal-rough.png")).value();
  std::set<int> found;
  for (size_t i = 0; i < rough.rgba.size(); i += 4) found.insert(rough.rgba[i + 1]);
  EXPECT_TRUE(found.contains(64));
}

TEST_F(AtlasTest, aFullAtlasLeavesTheRest) {
  for (int i = 0; i < 30; ++i) {
    b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("m", {i / 30.0, 0.5, 1})));
  }
  const AtlasScene a = made(64);
  EXPECT_EQ(a.counts.merged, 4u);
  EXPECT_EQ(a.counts.large, 26u);
}

TEST_F(AtlasTest, oneMaterialNeedsNoAtlas) {
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("red", {1, 0, 0})));
  const AtlasScene a = made();
  EXPECT_TRUE(a.pictures.empty());
  EXPECT_EQ(a.counts.into, 0u);
  EXPECT_EQ(contentHash(a.scene), contentHash(b_.scene));
}

TEST_F(AtlasTest, theSameSceneIsWrittenWithAndWithoutIt) {
  add(square({0, 0}, 1), pictured("quarters.png"));
  b_.leaf(kUnitBox, Frame{}, {1, 1, 1}, b_.material(colored("red", {1, 0, 0})));
  AtlasScene a = made();
  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  for (const char* ending : {"glb", "obj"}) {
    WriteOptions options;
    options.readTexture = [&](const std::string& path) -> Result<std::string> {
      return a.pictures.at(path);
    };
    const std::string path = std::string(GABLE_WRITTEN_DIR) + "/atlas." + ending;
    Result<WriteReport> report = writeModel(a.scene, path, options);
    ASSERT_TRUE(report.ok());
    EXPECT_TRUE(report->warnings.empty());
    EXPECT_EQ(report->triangles, count(b_.scene).triangles);
  }
}

TEST(AtlasPacking, rectanglesFitAndDoNotOverlap) {
  std::vector<PackedSize> sizes;
  for (uint32_t i = 0; i < 60; ++i) sizes.push_back({10 + 7 * i % 50, 8 + 13 * i % 40});
  const Packing sheet = pack(sizes, 1024);
  std::vector<bool> taken(size_t{sheet.width} * sheet.height);
  for (size_t i = 0; i < sizes.size(); ++i) {
    ASSERT_TRUE(sheet.places[i]);
    for (uint32_t y = 0; y < sizes[i].height; ++y) {
      for (uint32_t x = 0; x < sizes[i].width; ++x) {
        const size_t at = size_t{sheet.places[i]->y + y} * sheet.width + sheet.places[i]->x + x;
        ASSERT_FALSE(taken[at]);
        taken[at] = true;
      }
    }
  }
  EXPECT_LE(sheet.width * sheet.height, 512u * 512u);
}

}  // namespace
}  // namespace gable
