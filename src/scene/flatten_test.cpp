// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "scene/flatten.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace gable {
namespace {

Vec3 randomVec(uint64_t address, double lo, double hi) {
  return {randomIn(hashCombine(address, 0), lo, hi), randomIn(hashCombine(address, 1), lo, hi),
          randomIn(hashCombine(address, 2), lo, hi)};
}

Frame randomFrame(uint64_t address) {
  const Vec3 a = randomVec(hashCombine(address, 9), -180, 180);
  Frame f = address % 3 ? rotationXyz(a.x, a.y, a.z) : Frame{};
  f.origin = randomVec(address, -50, 50);
  return f;
}

// Four levels, each prototype with two leaves and three instances of the level below.
Scene nested(uint64_t seed) {
  Scene s;
  s.names = {"a", "b"};
  s.materials = {Material{}};
  s.materialLists = {{0}};
  s.sources = {{"f.cga", 3, 1, "A"}};
  for (uint32_t level = 0; level < 4; ++level) {
    Prototype p;
    p.firstLeaf = static_cast<uint32_t>(s.leaves.size());
    p.firstInstance = static_cast<uint32_t>(s.instances.size());
    for (uint32_t i = 0; i < 2; ++i) {
      Leaf l;
      l.frame = randomFrame(hashCombine(seed, level * 10 + i));
      l.scale = randomVec(hashCombine(seed, level * 10 + i + 500), -3, 3);
      l.mesh = i;
      s.leaves.push_back(l);
    }
    for (uint32_t i = 0; level > 0 && i < 3; ++i) {
      s.instances.push_back({randomFrame(hashCombine(seed, level * 10 + i + 100)), level - 1, i});
    }
    p.leafCount = 2;
    p.instanceCount = static_cast<uint32_t>(s.instances.size()) - p.firstInstance;
    p.shapes = 1;
    s.prototypes.push_back(p);
  }
  s.roots = {{0, {randomFrame(seed), 3, 0}}, {1, {randomFrame(seed + 1), 3, 0}}};
  return s;
}

// The same flattened model with one prototype for all.
Scene unshared(const Scene& s) {
  Scene out = s;
  out.prototypes.clear();
  out.instances.clear();
  out.leaves.clear();
  out.roots.clear();
  for (const Root& root : s.roots) {
    Prototype p;
    p.firstLeaf = static_cast<uint32_t>(out.leaves.size());
    forEachLeaf(s, s.prototypes[root.instance.prototype], root.instance.frame,
                [&](Leaf leaf, const Frame& world) {
                  leaf.frame = world;
                  out.leaves.push_back(leaf);
                });
    p.leafCount = static_cast<uint32_t>(out.leaves.size()) - p.firstLeaf;
    out.roots.push_back({root.name, {Frame{}, static_cast<uint32_t>(out.prototypes.size()), 0}});
    out.prototypes.push_back(p);
  }
  return out;
}

TEST(Flatten, boundsAreThoseOfEveryPoint) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Scene s = nested(seed);
    Box3 all;
    for (const PlacedLeaf& leaf : flatLeaves(s)) all.include(worldMesh(s, leaf).bounds());
    const Box3 found = count(s).bounds;
    EXPECT_EQ(found.min, all.min);
    EXPECT_EQ(found.max, all.max);
  }
}

TEST(Flatten, theHashSeesTheFlattenedModelOnly) {
  const Scene s = nested(1);
  const Scene flat = unshared(s);
  EXPECT_EQ(contentHash(s), contentHash(flat));
  EXPECT_EQ(count(s).leaves, count(flat).leaves);
  EXPECT_EQ(count(s).leaves, 2u * (2 + 3 * (2 + 3 * (2 + 3 * 2))));

  Scene moved = s;
  moved.leaves[0].frame.origin.x += 1e-9;
  EXPECT_NE(contentHash(moved), contentHash(s));
  Scene painted = s;
  painted.materials[0].roughness = 0.5;
  EXPECT_NE(contentHash(painted), contentHash(s));
  Scene reported = s;
  reported.reports.push_back({"area", {PlainValue::Kind::Number, 3, ""}});
  EXPECT_NE(contentHash(reported), contentHash(s));
}

TEST(Flatten, countsOfDoublingScenesStopAtTheLargestNumber) {
  Scene s = nested(2);
  // Each prototype holds the one below twice.
  for (uint32_t i = 0; i < 70; ++i) {
    Prototype p;
    p.firstInstance = static_cast<uint32_t>(s.instances.size());
    p.instanceCount = 2;
    const auto below = static_cast<uint32_t>(s.prototypes.size() - 1);
    s.instances.push_back({Frame{}, below, 0});
    s.instances.push_back({Frame{}, below, 0});
    s.prototypes.push_back(p);
  }
  s.roots[0].instance.prototype = static_cast<uint32_t>(s.prototypes.size() - 1);
  const SceneCounts c = count(s);
  EXPECT_EQ(c.leaves, ~uint64_t{0});
  EXPECT_FALSE(c.bounds.empty());
}

TEST(Flatten, slotsWithoutAMaterialUseTheFirst) {
  Scene s;
  s.materials.resize(3);
  s.materials[1].color = {1, 0, 0};
  s.materialLists = {{1, 2}, {}, {7}};
  Leaf l;
  EXPECT_EQ(materialIndexOf(s, l, 1), 2u);
  EXPECT_EQ(materialIndexOf(s, l, 5), 1u);
  l.materials = 1;
  EXPECT_EQ(materialIndexOf(s, l, 0), kNoMaterial);
  EXPECT_EQ(materialOf(s, l, 0).color, (Vec3{1, 1, 1}));
  l.materials = 2;
  EXPECT_EQ(materialIndexOf(s, l, 0), kNoMaterial);
  l.materials = 99;
  EXPECT_EQ(materialIndexOf(s, l, 0), kNoMaterial);
}

}  // namespace
}  // namespace gable
