// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "scene/scene.h"

namespace gable {
namespace {

/// A street of three houses, each a box with a square on top.
Scene street() {
  Scene scene;
  scene.names = {"Street", "House"};
  scene.materials = {Material{}};
  scene.materialLists = {{0}};
  Leaf box;
  box.scale = {2, 3, 2};
  Leaf square;
  square.mesh = kUnitQuadXz;
  scene.leaves = {box, square};
  Prototype house;
  house.leafCount = 2;
  house.shapes = 3;
  Prototype whole;
  whole.firstLeaf = 2;
  whole.instanceCount = 3;
  whole.shapes = 10;
  scene.prototypes = {house, whole};
  for (double x : {0.0, 10.0, 20.0}) scene.instances.push_back({Frame::moved({x, 0, 0}), 0, 0});
  scene.roots = {{0, {Frame::moved({0, 1, 0}), 1, 0}}};
  return scene;
}

TEST(Statistics, expandsInstances) {
  const SceneCounts counts = count(street());
  EXPECT_EQ(counts.shapes, 10u);
  EXPECT_EQ(counts.leaves, 6u);
  EXPECT_EQ(counts.faces, 21u);
  EXPECT_EQ(counts.vertices, 36u);
  EXPECT_EQ(counts.triangles, 3u * (12 + 2));
  EXPECT_EQ(counts.instances, 3u);
  EXPECT_EQ(counts.prototypes, 2u);
  EXPECT_EQ(counts.bounds.min, (Vec3{0, 1, 0}));
  EXPECT_EQ(counts.bounds.max, (Vec3{22, 4, 2}));
}

TEST(Statistics, countsTrianglesAroundHoles) {
  Scene scene = street();
  MeshBuilder builder;
  const auto ring = [&](double from, double to) {
    builder.beginLoop();
    for (Vec2 p : {Vec2{from, from}, Vec2{to, from}, Vec2{to, to}, Vec2{from, to}}) {
      builder.addCorner(builder.addPosition({p.x, p.y, 0}));
    }
  };
  builder.beginFace();
  ring(0, 9);
  ring(6, 3);
  scene.meshes.push_back(MeshRef(new Mesh(builder.take())));
  scene.leaves[1].mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
  EXPECT_EQ(count(scene).triangles, 3u * (12 + 8));
  EXPECT_EQ(count(scene).faces, 3u * (6 + 1));
  EXPECT_EQ(count(scene).encoderFaces, 3u * (6 + 8));
}

}  // namespace
}  // namespace gable
