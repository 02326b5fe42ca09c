// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_part.h"

#include <gtest/gtest.h>

#include <set>

namespace gable {
namespace {

TilePart somePart() {
  TilePart part;
  part.root.emplace();
  part.root->uri = "tiles/0.glb";
  part.root->error = 1.5;
  part.root->box.include(Vec3{1, 2, 3});
  part.root->children.resize(2);
  part.root->children[1].uri = "tiles/01.glb";
  part.coarse.features.push_back({"id", "Lot", "name", "type", 3, "{}", 4, {5, 6}});
  part.coarse.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  part.coarse.triangles = {{0, 1, 2}};
  CoarsePart p;
  p.vertexCount = 3;
  p.triangleCount = 1;
  part.coarse.parts.push_back(p);
  part.files = {{"tiles/0.glb", 12, 34}};
  part.tiles = 3;
  part.warnings = {"a warning"};
  return part;
}

TEST(TilePart, comesBackAsItWas) {
  const std::string bytes = partBytes(somePart(), 7);
  const std::optional<TilePart> again = partOf(bytes, 7);
  ASSERT_TRUE(again);
  EXPECT_EQ(partBytes(*again, 7), bytes);
  EXPECT_EQ(again->root->children[1].uri, "tiles/01.glb");
  EXPECT_EQ(again->coarse.features[0].middle.y, 6);
}

TEST(TilePart, ofAnotherPlanIsNone) { EXPECT_FALSE(partOf(partBytes(somePart(), 7), 8)); }

TEST(TilePart, damagedOrCutOffIsNone) {
  const std::string bytes = partBytes(somePart(), 7);
  for (size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FALSE(partOf(bytes.substr(0, i), 7)) << i;
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    EXPECT_FALSE(partOf(damaged, 7)) << i;
  }
}

TEST(TilePart, numbersBeyondWhatIsThereAreRefused) {
  TilePart part = somePart();
  part.coarse.triangles[0][2] = 3;
  EXPECT_FALSE(partOf(partBytes(part, 7), 7));
  part = somePart();
  part.coarse.parts[0].firstVertex = 0xffffffff;
  EXPECT_FALSE(partOf(partBytes(part, 7), 7));
  part = somePart();
  part.coarse.parts[0].feature = 1;
  EXPECT_FALSE(partOf(partBytes(part, 7), 7));
}

TEST(TileDivision, everyShapeIsInOneUnitInTheOrderOfAWalk) {
  std::vector<Vec2> middles;
  for (int i = 0; i < 1000; ++i) middles.push_back({i % 37 * 10.0, i % 41 * 7.0});
  const TileDivision division = divided(middles, 50);
  std::set<uint32_t> seen;
  std::string last;
  for (const TileUnit& unit : division.units) {
    EXPECT_LE(unit.shapes.size(), 50u);
    EXPECT_LT(last, unit.name);
    last = unit.name;
    const TileSquare square = division.squareOf(unit.name);
    for (const uint32_t s : unit.shapes) {
      EXPECT_TRUE(seen.insert(s).second);
      Box2 box;
      box.include(middles[s]);
      EXPECT_TRUE(square.holds(box));
    }
  }
  EXPECT_EQ(seen.size(), middles.size());
  EXPECT_EQ(divided(middles, 0).units.size(), 1u);
  // Shapes in one place cannot be divided.
  EXPECT_EQ(divided(std::vector<Vec2>(100), 10).units.size(), 1u);
  EXPECT_TRUE(divided({}, 10).units.empty());
}

TEST(TileDivision, namesArePathsOfSmallFolders) {
  EXPECT_EQ(squarePath("0"), "0");
  EXPECT_EQ(squarePath("01230"), "01230");
  EXPECT_EQ(squarePath("012301"), "01230/1");
  EXPECT_EQ(squarePath("01230123012"), "01230/12301/2");
  for (const char* path : {"0", "01230", "01230/1", "01230/12301/2"}) {
    EXPECT_TRUE(isSquarePath(path)) << path;
  }
  for (const char* path : {"", "4", "0123/0", "01230/", "012301", "../0", "mine"}) {
    EXPECT_FALSE(isSquarePath(path)) << path;
  }
}

}  // namespace
}  // namespace gable
