// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "scene/sound.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "base/allowance.h"
#include "scene/flatten.h"

namespace gable {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A house of two boxes that stands three times, once in a yard.
Scene houses() {
  Scene s;
  s.names = {"leaf"};
  s.materials = {Material{}};
  s.materialLists = {{0}};
  s.leaves.resize(3);
  s.instances = {{Frame::moved({1, 0, 0}), 0, 0}, {Frame::moved({2, 0, 0}), 0, 1}};
  s.prototypes = {{0, 0, 2, 0, 0, 2}, {0, 2, 1, 0, 2, 5}};
  s.roots = {{0, {Frame::moved({9, 0, 0}), 0, 0}}, {0, {Frame{}, 1, 0}}};
  return s;
}

// By leaf in path order: where it stands, or nothing where it shows nothing.
std::vector<double> places(const Scene& s) {
  std::vector<double> out;
  forEachLeaf(s, [&](const Leaf& l, const Frame& world) {
    out.push_back(s.meshes[l.mesh]->empty() ? -1 : world.origin.x);
  });
  return out;
}

TEST(Sound, aSoundSceneIsNotCopied) {
  const SoundScene sound = soundOf(houses());
  EXPECT_FALSE(sound.scene.has_value());
  EXPECT_EQ(sound.leavesLeftOut, 0u);
}

TEST(Sound, aBrokenLeafKeepsItsPlaceWithoutGeometry) {
  const std::pair<Vec3, Vec3> broken[] = {{{kNan, 0, 0}, {1, 1, 1}},
                                          {{0, -kInfinite, 0}, {1, 1, 1}},
                                          {{0, 0, 0}, {1, kNan, 1}},
                                          {{0, 0, 0}, {1, 1, 1e200}},
                                          {{0, 2e30, 0}, {1, 1, 1}}};
  for (const auto& [origin, scale] : broken) {
    Scene s = houses();
    s.leaves[1].frame = Frame::moved(origin);
    s.leaves[1].scale = scale;
    const SoundScene sound = soundOf(s);
    ASSERT_TRUE(sound.scene.has_value());
    EXPECT_EQ(sound.leavesLeftOut, 3u);
    EXPECT_EQ(sound.firstLeft, 1u);
    EXPECT_EQ(places(*sound.scene), (std::vector<double>{9, -1, 1, -1, 0, 2, -1}));
    EXPECT_FALSE(soundOf(*sound.scene).scene.has_value());
  }
}

TEST(Sound, framesThatAreNotRigidAreBroken) {
  Scene s = houses();
  s.leaves[2].frame.x = {kNan, 0, 0};
  s.leaves[2].frame.turned = true;
  EXPECT_EQ(soundOf(s).leavesLeftOut, 1u);
  s.leaves[2].frame = Frame::of({}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(soundOf(s).leavesLeftOut, 1u);
  s.leaves[2].frame = rotationXyz(10, 20, 30);
  EXPECT_EQ(soundOf(s).leavesLeftOut, 0u);
}

// The content keeps its number of leaves, so that the numbers behind it stay the same.
TEST(Sound, aBrokenInstanceShowsAnEmptyTwin) {
  Scene s = houses();
  s.instances[0].frame.origin.z = kNan;
  SoundScene sound = soundOf(s);
  ASSERT_TRUE(sound.scene.has_value());
  EXPECT_EQ(sound.leavesLeftOut, 2u);
  EXPECT_EQ(places(*sound.scene), (std::vector<double>{9, 9, -1, -1, 0, 2, 2}));
  EXPECT_FALSE(soundOf(*sound.scene).scene.has_value());
  s.roots[1].instance.frame.origin.z = 1e40;
  sound = soundOf(s);
  EXPECT_EQ(sound.leavesLeftOut, 5u);
  EXPECT_EQ(places(*sound.scene), (std::vector<double>{9, 9, -1, -1, -1, -1, -1}));
  EXPECT_FALSE(soundOf(*sound.scene).scene.has_value());
}

TEST(Sound, numbersOfMeshesAndMaterialsAreReplaced) {
  Scene s = houses();
  Mesh m = makeBoxMesh({1, 1, 1}, true);
  m.normals.assign(m.corners.size(), Vec3{0, 1, 0});
  m.normals[0] = {};
  m.normals[1] = {kNan, 0, 0};
  m.normals[2] = {1e200, 0, 0};
  m.uvs[0][3] = {kInfinite, 1};
  s.meshes.push_back(makeRef<Mesh>(m));
  s.leaves[0].mesh = kFirstMesh;
  s.materials[0].roughness = kNan;
  s.materials[0].maps[0].su = -1e99;
  const SoundScene sound = soundOf(s);
  ASSERT_TRUE(sound.scene.has_value());
  EXPECT_EQ(sound.leavesLeftOut, 0u);
  EXPECT_EQ(sound.valuesReplaced, 5u);
  const Mesh& mended = *sound.scene->meshes[kFirstMesh];
  EXPECT_EQ(mended.normals[1], Vec3{});
  EXPECT_EQ(mended.normals[2], Vec3{});
  EXPECT_EQ(mended.normals[3], (Vec3{0, 1, 0}));
  EXPECT_EQ(mended.uvs[0][3], Vec2{});
  EXPECT_EQ(sound.scene->materials[0].roughness, 1);
  EXPECT_EQ(sound.scene->materials[0].maps[0].su, 1);
  EXPECT_FALSE(soundOf(*sound.scene).scene.has_value());
}

TEST(Sound, aMeshThatIsNotFiniteLeavesItsLeavesOut) {
  Scene s = houses();
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  m.positions[3].y = kNan;
  s.meshes.push_back(makeRef<Mesh>(m));
  s.leaves[2].mesh = kFirstMesh;
  EXPECT_EQ(soundOf(s).leavesLeftOut, 1u);
}

// Leaves that show nothing are equal wherever a derivation found them.
TEST(Sound, theContentIsTheSameSharedAndFlat) {
  Scene shared = houses();
  shared.instances[0].frame.origin.z = kNan;
  Scene flat = houses();
  flat.instances.clear();
  flat.leaves.clear();
  const auto add = [&](double x, double z) {
    Leaf l;
    l.frame = Frame::moved({x, 0, z});
    flat.leaves.push_back(l);
  };
  for (const double x : {9.0, 9.0}) add(x, 0);
  for (int i = 0; i < 2; ++i) add(1, kNan);
  for (const double x : {0.0, 2.0, 2.0}) add(x, 0);
  flat.prototypes = {{0, 0, 2, 0, 0, 2}, {0, 2, 5, 0, 0, 5}};
  flat.roots = {{0, {Frame{}, 0, 0}}, {0, {Frame{}, 1, 0}}};
  const SoundScene a = soundOf(shared), b = soundOf(flat);
  EXPECT_EQ(a.leavesLeftOut, b.leavesLeftOut);
  EXPECT_EQ(places(*a.scene), places(*b.scene));
  EXPECT_EQ(contentHash(*a.scene), contentHash(*b.scene));
}

TEST(Sound, hearsTheWishToStop) {
  Scene s = houses();
  s.leaves.resize(s.leaves.size() + (size_t{1} << 16), s.leaves[0]);
  const std::atomic<bool> cancel{true};
  Allowance allowance({{}, {}, &cancel});
  const WorkScope scope(allowance);
  const Status status = guarded([&] {
    soundOf(s, 2);
    return Status();
  });
  EXPECT_FALSE(status.ok());
  EXPECT_TRUE(allowance.reached());
}

}  // namespace
}  // namespace gable
