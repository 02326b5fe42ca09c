// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/work.h"
#include "io/exporters/surface.h"
#include "io/testing/scenes.h"

namespace gable {
namespace {

using testing::SceneBuilder;

// A prototype of `boxes` boxes.
uint32_t wall(SceneBuilder& b, int boxes) {
  for (int i = 0; i < boxes; ++i) b.leaf(kUnitBox, Frame::moved({i * 2.0, 0, 0}), {1, 1, 1});
  return b.prototype("Wall");
}

// Every leaf of the flattened scene is shown once, whatever the plan: counts leaves by following
// units and their children.
uint64_t shownLeaves(const ScenePlan& plan, uint32_t unit) {
  UnitContent content;
  plan.collect(unit, content);
  EXPECT_LE(static_cast<double>(content.leaves.size()), plan.contentSize(unit));
  uint64_t n = content.leaves.size();
  for (const PlannedChild& c : plan.units()[unit].children) n += shownLeaves(plan, c.unit);
  return n;
}

uint64_t shownNodes(const ScenePlan& plan, uint32_t unit) {
  uint64_t n = 1;
  for (const PlannedChild& c : plan.units()[unit].children) n += shownNodes(plan, c.unit);
  return n;
}

void expectWhole(const Scene& s) {
  const PlanOptions shared, bounded{true, 40}, tight{true, 1}, flat{false, 0}, cut{true, 40, 20};
  for (const PlanOptions& options : {shared, bounded, tight, flat, cut}) {
    const ScenePlan plan(s, options);
    uint64_t n = 0, nodes = 0;
    for (const PlannedRoot& r : plan.roots()) {
      n += shownLeaves(plan, r.unit);
      nodes += shownNodes(plan, r.unit);
    }
    EXPECT_EQ(n, count(s).leaves);
    if (options.mostNodes > 0) {
      EXPECT_LE(nodes, options.mostNodes);
    }
    EXPECT_TRUE(options.share || plan.units().size() == 1u);
  }
}

TEST(Plan, whatStandsOnceIsMerged) {
  SceneBuilder b;
  const uint32_t w = wall(b, 50);
  b.instance(w, Frame::moved({0, 5, 0}));
  b.root("house", b.prototype("House"), Frame{});
  const ScenePlan plan(b.scene, {});
  EXPECT_EQ(plan.units().size(), 1u);
  expectWhole(b.scene);
}

TEST(Plan, whatStandsOftenIsAUnitUnlessTiny) {
  SceneBuilder b;
  const uint32_t large = wall(b, 50), tiny = wall(b, 1);
  for (int i = 0; i < 20; ++i) {
    b.instance(large, Frame::moved({0, 5.0 * i, 0}));
    b.instance(tiny, Frame::moved({0, 5.0 * i, 9}));
  }
  b.root("house", b.prototype("House"), Frame{});
  const ScenePlan plan(b.scene, {});
  ASSERT_EQ(plan.units().size(), 2u);
  EXPECT_EQ(plan.units()[0].children.size(), 20u);
  expectWhole(b.scene);
}

// Two streets of kerbs, a kilometre apart, and houses that are more than a kerb; posts stand about.
TEST(Plan, smallRootsOfANameAreOneNodeWhereNodesAreShort) {
  SceneBuilder b;
  const uint32_t post = wall(b, 40);
  for (int i = 0; i < 60; ++i) {
    b.leaf(kUnitBox, Frame{}, {1.0 + i, 1, 1});
    b.instance(post, Frame::moved({0, 0, 2}));
    b.root("kerb", b.prototype("Kerb"), Frame::moved({i < 30 ? 10.0 : 1000.0, 0, 100}));
  }
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < 40; ++k) b.leaf(kUnitBox, Frame::moved({2.0 * k, 0, 5.0 * i}), {1, 1, 1});
    b.root("house", b.prototype("House"), Frame::moved({10, 0, 300}));
  }
  // A node for each root and each post.
  EXPECT_EQ(ScenePlan(b.scene, {true, 200}).roots().size(), 70u);
  // Kerbs become two nodes, houses stay, and so do the posts.
  const ScenePlan plan(b.scene, {true, 80});
  ASSERT_EQ(plan.roots().size(), 12u);
  uint64_t nodes = 0;
  for (const PlannedRoot& r : plan.roots()) nodes += shownNodes(plan, r.unit);
  EXPECT_EQ(nodes, 72u);
  EXPECT_EQ(plan.units()[plan.roots()[0].unit].children.size(), 30u);
  expectWhole(b.scene);
}

// A group that has all roots is no model as a whole: its node is called as they are.
TEST(Plan, smallRootsOfOneNameKeepIt) {
  SceneBuilder b;
  const uint32_t post = wall(b, 40);
  for (int i = 0; i < 60; ++i) {
    b.leaf(kUnitBox, Frame{}, {1.0 + i, 1, 1});
    b.instance(post, Frame::moved({0, 0, 2}));
    b.root("kerb", b.prototype("Kerb"), Frame::moved({10, 0, 100}));
  }
  const ScenePlan plan(b.scene, {true, 80});
  ASSERT_EQ(plan.roots().size(), 1u);
  EXPECT_EQ(plan.roots()[0].root, 0u);
  expectWhole(b.scene);
  EXPECT_EQ(ScenePlan(b.scene, {true, 20}).roots()[0].root, PlannedRoot::kAll);
}

TEST(Plan, wideUnitsAreCutIntoCells) {
  SceneBuilder b;
  for (int i = 0; i < 4000; ++i) {
    b.leaf(kUnitBox, Frame::moved({i % 100 * 2.0 - 90, i % 7 * 1.0, i / 100 * 5.0}), {1, 1, 1});
  }
  b.leaf(kUnitBox, Frame{}, {300, 1, 1});
  const uint32_t field = b.prototype("Field");
  b.root("field", field, testing::turned(30, {1e4, 0, 0}));
  const ScenePlan plan(b.scene, {true, 0, 64});
  ASSERT_GT(plan.units().size(), 9u);
  EXPECT_EQ(shownLeaves(plan, 0), 4001u);
  for (uint32_t u = 0; u < plan.units().size(); ++u) {
    UnitContent content;
    plan.collect(u, content);
    EXPECT_EQ(plan.units()[u].children.empty(), u > 0);
    Box3 box;
    for (const PlannedLeaf& p : content.leaves) {
      const Leaf& leaf = b.scene.leaves[p.leaf];
      const Box3 unit = b.scene.meshes[leaf.mesh]->bounds();
      box.include(boundsAt(unit, content.placements[p.placement] * leaf.frame, leaf.scale));
    }
    const Vec3 size = box.size();
    if (u > 0) {
      EXPECT_LE(std::max({size.x, size.y, size.z}), 64);
    }
    if (u == 0) {
      EXPECT_EQ(size.x, 300);
    }
  }
  // Too few nodes, a unit that is shown twice, and what is narrow.
  EXPECT_EQ(ScenePlan(b.scene, {true, 3, 64}).units().size(), 1u);
  EXPECT_EQ(ScenePlan(b.scene, {true, 0, 1000}).units().size(), 1u);
  b.root("field", field, Frame{});
  EXPECT_EQ(ScenePlan(b.scene, {true, 0, 64}).units().size(), 1u);
}

TEST(Plan, equalRootsShareTheirUnitAndTakeInWhatIsBelow) {
  SceneBuilder b;
  const uint32_t w = wall(b, 5);
  for (int i = 0; i < 40; ++i) b.instance(w, Frame::moved({0, 5.0 * i, 0}));
  const uint32_t house = b.prototype("House");
  for (int i = 0; i < 100; ++i) b.root("house", house, Frame::moved({50.0 * i, 0, 0}));
  const ScenePlan plan(b.scene, {});
  ASSERT_EQ(plan.units().size(), 1u);
  EXPECT_TRUE(plan.units()[0].solid);
  expectWhole(b.scene);
}

TEST(Plan, largeMeshesStandAloneWhenTheyOccurTwice) {
  SceneBuilder b;
  const uint32_t tree = b.mesh(testing::ball(20, 30)), statue = b.mesh(testing::ball(20, 31));
  b.leaf(tree, Frame{}, {1, 2, 1});
  b.leaf(tree, Frame::moved({5, 0, 0}), {1, 3, -1});
  b.leaf(tree, Frame::moved({9, 0, 0}), {1, 0, 1});
  b.leaf(statue, Frame{}, {1, 1, 1});
  b.root("garden", b.prototype("Garden"), Frame{});
  const ScenePlan plan(b.scene, {});
  ASSERT_EQ(plan.units().size(), 2u);
  // A node must not flatten its mesh, so that the third tree is merged.
  EXPECT_EQ(plan.units()[0].children.size(), 2u);
  EXPECT_EQ(plan.units()[0].children[1].scale, (Vec3{1, 3, -1}));
  expectWhole(b.scene);
}

// Three kinds of walls, of 20, 40 and 80 boxes, each 30 times, and a statue.
SceneBuilder quarter() {
  SceneBuilder b;
  const uint32_t walls[] = {wall(b, 20), wall(b, 40), wall(b, 80)};
  const uint32_t statue = b.mesh(testing::ball(20, 30));
  for (int i = 0; i < 30; ++i) {
    for (const uint32_t w : walls) b.instance(w, Frame::moved({9.0 * i, 0, 3.0 * w}));
    b.leaf(statue, Frame::moved({9.0 * i, 0, 30}), {1, 1, 1});
  }
  b.root("quarter", b.prototype("Quarter"), Frame{});
  return b;
}

TEST(Plan, aBoundOnNodesMergesFirstWhatSavesLeast) {
  const SceneBuilder b = quarter();
  EXPECT_EQ(shownNodes(ScenePlan(b.scene, {}), 0), 121u);
  const auto children = [&](uint64_t most) {
    const ScenePlan plan(b.scene, {true, most});
    EXPECT_FALSE(plan.grouped());
    return plan.units()[0].children.size();
  };
  EXPECT_EQ(children(121), 120u);
  EXPECT_EQ(children(120), 90u);
  EXPECT_EQ(children(91), 90u);
  EXPECT_EQ(children(31), 30u);
  EXPECT_EQ(children(30), 0u);
  expectWhole(b.scene);
}

TEST(Plan, nodesThatAreLeftOverShowWhatSavesMost) {
  SceneBuilder b;
  const uint32_t few = wall(b, 50), many = wall(b, 60), large = wall(b, 200);
  const auto row = [&](uint32_t prototype, int count, double z) {
    for (int i = 0; i < count; ++i) b.instance(prototype, Frame::moved({0, 5.0 * i, z}));
  };
  row(few, 10, 0);
  row(many, 100, 9);
  row(large, 12, 18);
  b.root("quarter", b.prototype("Quarter"), Frame{});
  // The hundred have to be merged; the ten before them need not be.
  const ScenePlan plan(b.scene, {true, 100});
  EXPECT_EQ(plan.units()[0].children.size(), 22u);
  expectWhole(b.scene);
}

TEST(Plan, prototypesOfEqualContentAreOne) {
  SceneBuilder b;
  uint32_t towers[3];
  for (const int boxes : {30, 30, 31}) {
    const uint32_t w = wall(b, boxes);
    for (int i = 0; i < 9; ++i) b.instance(w, Frame::moved({0, 5.0 * i, 0}));
    towers[w / 2] = b.prototype("Tower");
  }
  for (int i = 0; i < 3; ++i) b.root("tower", towers[i], Frame::moved({90.0 * i, 0, 0}));
  const ScenePlan plan(b.scene, {});
  ASSERT_EQ(plan.roots().size(), 3u);
  EXPECT_EQ(plan.roots()[0].unit, plan.roots()[1].unit);
  EXPECT_NE(plan.roots()[0].unit, plan.roots()[2].unit);
  expectWhole(b.scene);
}

TEST(Plan, tooManyRootsAreOneUnitAndStillShare) {
  SceneBuilder b;
  const uint32_t large = wall(b, 500);
  for (int i = 0; i < 50; ++i) {
    b.leaf(kUnitBox, Frame{}, {1, 1, 1});
    if (i % 10 == 0) b.instance(large, Frame::moved({0, 9, 0}));
    b.root("house", b.prototype("House"), Frame::moved({9000.25 + i, 0, 1}));
  }
  const ScenePlan plan(b.scene, {true, 49});
  ASSERT_EQ(plan.roots().size(), 1u);
  EXPECT_EQ(plan.roots()[0].root, PlannedRoot::kAll);
  EXPECT_EQ(plan.roots()[0].frame.origin, (Vec3{9024, 0, 1}));
  EXPECT_EQ(plan.units()[0].children.size(), 5u);
  expectWhole(b.scene);
}

TEST(Plan, whereMergingWouldCostTooMuchEqualChildrenAreOneNode) {
  SceneBuilder b;
  const uint32_t tree = b.mesh(testing::ball(200, 200));
  for (int i = 0; i < 300; ++i) b.leaf(tree, Frame::moved({9.0 * i, 0, 0}), {1, 1, 1});
  const uint32_t row = b.prototype("Row");
  for (int i = 0; i < 10; ++i) b.instance(row, Frame::moved({0, 0, 9.0 * i}));
  const uint32_t grove = b.prototype("Grove");
  for (int i = 0; i < 5; ++i) b.root("grove", grove, Frame::moved({999.0 * i, 0, 0}));
  const ScenePlan plan(b.scene, {true, 90});
  EXPECT_TRUE(plan.grouped());
  ASSERT_EQ(plan.roots().size(), 1u);
  EXPECT_LE(plan.units().size(), 3u);
  for (const PlannedChild& c : plan.units()[0].children) {
    EXPECT_TRUE(plan.units()[c.unit].children.empty());
  }
  EXPECT_EQ(shownLeaves(plan, 0), 15000u);
}

TEST(Plan, nestedScenesAreShownWhole) {
  SceneBuilder b;
  uint32_t p = wall(b, 7);
  const uint32_t tree = b.mesh(testing::ball(20, 30));
  for (int level = 0; level < 5; ++level) {
    b.leaf(tree, Frame::moved({1, 1.0 * level, 0}), {1, 1, 1});
    b.instance(p, Frame{});
    b.leaf(kUnitBox, Frame{}, {1, 1, 1});
    b.instance(p, testing::turned(30, {3, 0, 0}));
    if (level % 2) b.instance(p, Frame::moved({0, 0, 9}));
    p = b.prototype("Level");
    b.root("r", p, Frame::moved({100.0 * level, 0, 0}));
  }
  expectWhole(b.scene);
  expectWhole(testing::street(6));
  expectWhole(Scene{});
}

TEST(DrawSurface, verticesOfSmoothMeshesAreShared) {
  FaceTriangulator t;
  DrawSurface s;
  const Mesh ball = testing::ball(10, 12);
  s.build(ball, t);
  ASSERT_EQ(s.parts.size(), 1u);
  EXPECT_EQ(s.parts[0].faceCount, 1u);
  EXPECT_EQ(s.corners.size(), ball.positions.size());
  EXPECT_EQ(s.triangles.size(), 12u * 2 * 9);
  for (size_t v = 0; v < s.corners.size(); ++v) {
    EXPECT_GT(dot(s.normals[v], normalized(ball.at(s.corners[v]))), 0.95);
  }
}

TEST(DrawSurface, partsFollowTheSlots) {
  MeshBuilder b;
  std::vector<uint32_t> ids;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) {
    ids.push_back(b.addPosition(p));
  }
  for (const uint16_t slot : {uint16_t{5}, uint16_t{1}, uint16_t{5}, uint16_t{65535}}) {
    b.addPolygon(ids, slot);
  }
  const Mesh m = b.take();
  const std::vector<SlotTally> tallies = slotTallies(m);
  ASSERT_EQ(tallies.size(), 3u);
  EXPECT_EQ(tallies[1].slot, 5);
  EXPECT_EQ(tallies[1].corners, 8u);
  EXPECT_EQ(tallies[1].triangles, 4u);
  FaceTriangulator t;
  DrawSurface s;
  s.build(m, t);
  ASSERT_EQ(s.parts.size(), 3u);
  EXPECT_EQ(s.part(5)->faceCount, 2u);
  EXPECT_EQ(s.part(65535)->faceCount, 1u);
  EXPECT_EQ(s.part(2), nullptr);
}

TEST(DrawSurface, tangentsRunAlongTheTexture) {
  MeshBuilder b;
  std::vector<uint32_t> ids;
  b.beginFace();
  b.beginLoop();
  // u runs to the left and v up: a mirrored texture.
  for (const Vec2 p : {Vec2{0, 0}, Vec2{2, 0}, Vec2{2, 1}, Vec2{0, 1}}) {
    b.setUv(b.addCorner(b.addPosition({p.x, p.y, 0})), 0, {-p.x, p.y});
  }
  const Mesh m = b.take();
  FaceTriangulator t;
  DrawSurface s;
  s.build(m, t);
  const Tangents tangents = tangentsOf(m, s, 0);
  for (size_t v = 0; v < 4; ++v) {
    EXPECT_EQ(normalized(tangents.u[v]), (Vec3{-1, 0, 0}));
    EXPECT_EQ(normalized(tangents.v[v]), (Vec3{0, 1, 0}));
  }
}

TEST(DrawSurface, scaledNormalsStayOutside) {
  const Vec3 n = normalized({1, 1, 0});
  EXPECT_NEAR(length(scaledNormal(n, {2, 1, 1}) - normalized({1, 2, 0})), 0, 1e-12);
  EXPECT_EQ(scaledNormal({0, 1, 0}, {3, 0, 2}), (Vec3{0, 1, 0}));
  EXPECT_EQ(scaledNormal({0, 1, 0}, {1, -2, 1}), (Vec3{0, -1, 0}));
  EXPECT_EQ(scaledNormal({1, 0, 0}, {3, 0, 2}), (Vec3{1, 0, 0}));
}

// A large scene is gone through again and again until its nodes are few enough: who wishes to stop
// does not wait for all of that.
TEST(ScenePlan, looksAtLimitsOnEachPass) {
  class Looks final : public WorkMeter {
   public:
    bool look(uint64_t, uint64_t) override { return ++count < most; }
    int count = 0, most = 1000;
  };
  SceneBuilder b;
  std::vector<uint32_t> walls;
  for (int i = 0; i < 400; ++i) walls.push_back(wall(b, 20 + i % 20));
  for (int i = 0; i < 800; ++i) {
    b.instance(walls[static_cast<size_t>(i % 400)], Frame::moved({0, 5.0 * i, 0}));
  }
  b.root("house", b.prototype("House"), Frame{});
  Looks looks;
  const WorkScope scope(looks);
  const ScenePlan plan(b.scene, {true, 40});
  EXPECT_GT(looks.count, 50);
  looks = {};
  looks.most = 30;
  EXPECT_THROW(ScenePlan(b.scene, {true, 40}), Unwinding);
}

TEST(ScenePlan, wholeRootsAreOneUnitEach) {
  const Scene s = testing::street(5);
  PlanOptions options;
  options.whole = true;
  const ScenePlan plan(s, options);
  EXPECT_EQ(plan.roots().size(), s.roots.size());
  EXPECT_LT(plan.units().size(), s.roots.size());
  for (const ScenePlan::Unit& u : plan.units()) EXPECT_TRUE(u.children.empty());
}

}  // namespace
}  // namespace gable
