// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "scene/dump.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

Scene oneLeaf(const Frame& root, const Leaf& leaf) {
  Scene scene;
  scene.names = {"Lot", "Wall"};
  scene.materials = {Material{}};
  scene.materialLists = {{0}};
  scene.leaves = {leaf};
  Prototype prototype;
  prototype.leafCount = 1;
  scene.prototypes = {prototype};
  scene.roots = {{0, {root, 0, 0}}};
  return scene;
}

TEST(Dump, writesAFaceInTheWorld) {
  Leaf leaf;
  leaf.mesh = kUnitQuadXy;
  leaf.scale = {4, 3, 1};
  leaf.name = 1;
  EXPECT_EQ(dumpText(oneLeaf(Frame::moved({1, 2, -0.00001}), leaf)),
            "Wall at 1 2 0 size 4 3 0\n"
            "  1 2 0  5 2 0  5 5 0  1 5 0\n");
}

TEST(Dump, tellsTurnsAndColours) {
  Leaf leaf;
  leaf.mesh = kUnitQuadXy;
  leaf.name = 1;
  Scene scene = oneLeaf(rotationXyz(0, 90, 0), leaf);
  scene.materials[0].color = {1, 0, 0};
  EXPECT_EQ(dumpText(scene),
            "Wall at 0 0 0 turn 0 90 0 size 1 1 0 color #ff0000\n"
            "  0 0 0  0 0 -1  0 1 -1  0 1 0\n");
}

TEST(Dump, roundsNumbers) {
  EXPECT_EQ(roundedText(1.00004), "1");
  EXPECT_EQ(roundedText(-0.00004), "0");
  EXPECT_EQ(roundedText(-12.34567), "-12.3457");
  EXPECT_EQ(roundedText(100), "100");
}

}  // namespace
}  // namespace gable
