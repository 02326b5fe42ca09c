// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/uv.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(Uv, projectsAlongAxes) {
  Mesh m = makeQuadMesh(4, 2, QuadPlane::Xy, false);
  projectUv(m, 3, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0});
  EXPECT_TRUE(m.valid());
  EXPECT_EQ(uvBounds(m, 3).min, (Vec2{-0.5, 0}));
  EXPECT_EQ(uvBounds(m, 3).max, (Vec2{1.5, 2}));
  EXPECT_TRUE(uvBounds(m, 0).empty());
}

TEST(Uv, scalesMovesTurns) {
  Mesh m = makeQuadMesh(1, 1, QuadPlane::Xy, true);
  scaleUv(m, 0, {2, 3});
  translateUv(m, 0, {1, 0});
  rotateUv(m, 0, 90);
  EXPECT_EQ(m.uvs[0][2], (Vec2{-3, 3}));
}

TEST(Uv, normalizesAllOrEachFace) {
  Mesh m = makeQuadMesh(1, 1, QuadPlane::Xy, true);
  scaleUv(m, 0, {4, 2});
  append(m, makeQuadMesh(1, 1, QuadPlane::Xy, true));
  Mesh each = m, uniform = m, onlyU = m;
  normalizeUv(each, 0, UvNormalize::Both, true);
  EXPECT_EQ(each.uvs[0][2], (Vec2{1, 1}));
  EXPECT_EQ(each.uvs[0][6], (Vec2{1, 1}));
  normalizeUv(uniform, 0, UvNormalize::Uniform, false);
  EXPECT_EQ(uniform.uvs[0][2], (Vec2{1, 0.5}));
  EXPECT_EQ(uniform.uvs[0][6], (Vec2{0.25, 0.25}));
  normalizeUv(onlyU, 0, UvNormalize::U, false);
  EXPECT_EQ(onlyU.uvs[0][2], (Vec2{1, 2}));
}

TEST(Uv, unitLengthIsTheStretchOfTheSurface) {
  const Mesh m = makeQuadMesh(6, 3, QuadPlane::Xz, true);
  EXPECT_NEAR(uvUnitLength(m, 0).x, 6, 1e-12);
  EXPECT_NEAR(uvUnitLength(m, 0).y, 3, 1e-12);
  EXPECT_EQ(uvUnitLength(m, 1), (Vec2{0, 0}));
}

TEST(Uv, tilesExactlyOrInWholeTiles) {
  Mesh m = makeQuadMesh(10, 3, QuadPlane::Xy, true);
  Mesh whole = m;
  tileUv(m, 0, {4, false}, {0, false});
  EXPECT_NEAR(uvBounds(m, 0).max.x, 2.5, 1e-12);
  EXPECT_NEAR(uvBounds(m, 0).max.y, 1, 1e-12);
  tileUv(whole, 0, {4, true}, {10, true});
  EXPECT_NEAR(uvBounds(whole, 0).max.x, 3, 1e-12);
  EXPECT_NEAR(uvBounds(whole, 0).max.y, 1, 1e-12);
}

TEST(Uv, copiesAndDeletes) {
  Mesh m = makeQuadMesh(1, 1, QuadPlane::Xy, true);
  copyUv(m, 0, 4);
  deleteUv(m, 0);
  EXPECT_FALSE(m.hasUv(0));
  EXPECT_TRUE(m.hasUv(4));
}

}  // namespace
}  // namespace gable
