// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/leaf_shape.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

Shape shapeWith(GeometryKind kind, bool uv) {
  Shape s;
  s.scope = Frame::moved({1, 2, 3});
  s.size = {4, 5, 6};
  s.geometry.kind = kind;
  s.geometry.uv = uv;
  return s;
}

TEST(LeafShape, PrimitivesComeBackAsTheyWere) {
  Output output;
  for (const auto kind : {GeometryKind::Box, GeometryKind::QuadXy, GeometryKind::QuadXz}) {
    for (const bool uv : {false, true}) {
      Leaf leaf;
      setShape(leaf, shapeWith(kind, uv), output);
      const Shape s = shapeOf(leaf, output);
      EXPECT_EQ(s.geometry.kind, kind);
      EXPECT_EQ(s.geometry.uv, uv);
      EXPECT_EQ(s.size, (Vec3{4, 5, 6}));
      EXPECT_EQ(s.scope.origin, (Vec3{1, 2, 3}));
      EXPECT_FALSE(meshOf(leaf, output));
    }
  }
  EXPECT_TRUE(output.meshes.empty());
}

TEST(LeafShape, AMeshIsScaledFromTheSizeItWasMadeIn) {
  Output output;
  Shape s = shapeWith(GeometryKind::Mesh, false);
  s.geometry.mesh = makeRef<Mesh>();
  s.geometry.refSize = {2, 5, 0};
  Leaf leaf;
  setShape(leaf, s, output);
  // A flat mesh has no size to scale by.
  EXPECT_EQ(leaf.scale, (Vec3{2, 1, 1}));
  EXPECT_TRUE(meshOf(leaf, output) == s.geometry.mesh);
  EXPECT_EQ(shapeOf(leaf, output).size, leaf.scale);
  EXPECT_EQ(shapeOf(leaf, output).geometry.refSize, (Vec3{1, 1, 1}));
}

}  // namespace
}  // namespace gable
