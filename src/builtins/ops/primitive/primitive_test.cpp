// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"
#include "math/trig.h"

namespace gable {
namespace {

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// The geometry fills the scope exactly.
void expectFills(const Shape& s) {
  const MeshRef m = meshInScope(s);
  EXPECT_TRUE(m->valid());
  const Box3 box = m->bounds();
  expectNear(box.min, {}, 1e-9);
  expectNear(box.max, s.size, 1e-9);
}

TEST(PrimitiveCube, fillsTheScopeWithoutMakingAMesh) {
  FakeServices services;
  const Ran ran = Op("primitiveCube").on(emptyShape({2, 3, 4}), services);
  EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::Box);
  EXPECT_TRUE(ran.shape.geometry.uv);
  expectFills(ran.shape);
}

TEST(PrimitiveCube, fillsZeroSizes) {
  FakeServices services;
  const auto sized = [&](const Vec3& size) {
    return Op("primitiveCube").on(emptyShape(size), services).shape.size;
  };
  EXPECT_EQ(sized({0, 0, 0}), (Vec3{1, 1, 1}));
  EXPECT_EQ(sized({0, 5, 0}), (Vec3{5, 5, 5}));
  EXPECT_EQ(sized({2, 0, 4}), (Vec3{2, 3, 4}));
}

TEST(PrimitiveCube, withSizesStandsInTheMiddleOfTheGround) {
  FakeServices services;
  const Shape s = Op("primitiveCube").args(1, 5, 2).on(emptyShape({10, 8, 20}), services).shape;
  EXPECT_EQ(s.scope.origin, (Vec3{4.5, 0, 9}));
  EXPECT_EQ(s.size, (Vec3{1, 5, 2}));
  const Shape down =
      Op("primitiveCube").args(1, -5, -2).on(emptyShape({10, 8, 20}), services).shape;
  EXPECT_EQ(down.scope.origin, (Vec3{4.5, -5, 9}));
  EXPECT_EQ(down.size, (Vec3{1, 5, 2}));
}

TEST(PrimitiveCube, inAMirroredScopeShowsItsInside) {
  FakeServices services;
  const Shape s = Op("primitiveCube").on(emptyShape({-2, 3, 4}), services).shape;
  const Mesh m = meshInLocal(s);
  EXPECT_NEAR(enclosedVolume(m), -24, 1e-9);
  EXPECT_EQ(m.bounds().min.x, -2);
}

TEST(PrimitiveQuad, liesInThePlaneOfTheTwoSizes) {
  FakeServices services;
  const Shape ground = Op("primitiveQuad").on(emptyShape({2, 0, 4}), services).shape;
  EXPECT_EQ(ground.geometry.kind, GeometryKind::QuadXz);
  const Shape wall = Op("primitiveQuad").on(emptyShape({2, 3, 0}), services).shape;
  EXPECT_EQ(wall.geometry.kind, GeometryKind::QuadXy);
  const Shape side = Op("primitiveQuad").on(emptyShape({0, 3, 4}), services).shape;
  expectFills(side);
  const Mesh m = *meshInScope(side);
  expectNear(m.normal(0), {1, 0, 0});
  EXPECT_NEAR(m.area(), 12, 1e-9);
  // The picture stands upright: v grows with y.
  for (uint32_t c = 0; c < 4; ++c) EXPECT_NEAR(m.uvs[0][c].y, m.at(c).y / 3, 1e-9);
}

TEST(PrimitiveQuad, withSizesIsCentred) {
  FakeServices services;
  const Shape s = Op("primitiveQuad").args(2, 4).on(emptyShape({10, 5, 10}), services).shape;
  EXPECT_EQ(s.scope.origin, (Vec3{4, 0, 3}));
  EXPECT_EQ(s.size, (Vec3{2, 0, 4}));
  const Shape side = Op("primitiveQuad").args(2, 4).on(emptyShape({0, 10, 10}), services).shape;
  EXPECT_EQ(side.size, (Vec3{0, 2, 4}));
  EXPECT_EQ(side.scope.origin, (Vec3{0, 4, 3}));
}

TEST(PrimitiveDisk, isARegularPolygon) {
  FakeServices services;
  const Shape s = Op("primitiveDisk").args(8, 10).on(emptyShape({0, 0, 0}), services).shape;
  EXPECT_NEAR(meshInScope(s)->area(), 8 * 0.5 * 100 * sinDeg(45), 1e-9);
  expectFills(s);
  for (const Vec3& size : {Vec3{2, 0, 3}, Vec3{2, 3, 0}, Vec3{0, 2, 3}}) {
    const Shape flat = Op("primitiveDisk").args(5).on(emptyShape(size), services).shape;
    EXPECT_EQ(flat.size, size);
    expectFills(flat);
  }
}

TEST(PrimitiveSolids, areClosedAndLookOutward) {
  FakeServices services;
  for (const char* name : {"primitiveSphere", "primitiveCylinder", "primitiveCone"}) {
    const Shape s = Op(name).on(emptyShape({2, 3, 4}), services).shape;
    expectFills(s);
    EXPECT_EQ(countsOf(s.geometry).vertices + countsOf(s.geometry).faces,
              countsOf(s.geometry).edges + 2);
    const double volume = enclosedVolume(*meshInScope(s));
    EXPECT_GT(volume, 6);
    EXPECT_LT(volume, 24);
    // Normals agree with the faces.
    const Mesh m = *meshInScope(s);
    for (size_t f = 0; f < m.faceCount(); ++f) {
      for (uint32_t i = 0; i < m.loopsOf(f)[0].cornerCount; ++i) {
        EXPECT_GT(dot(m.normals[m.loopsOf(f)[0].firstCorner + i], m.normal(f)), 0.5);
      }
    }
  }
}

TEST(PrimitiveSolids, haveTheSizesAskedFor) {
  FakeServices services;
  const Shape cylinder =
      Op("primitiveCylinder").args(8, 10, 15).on(emptyShape({4, 4, 4}), services).shape;
  EXPECT_NEAR(enclosedVolume(*meshInScope(cylinder)), 8 * 0.5 * 100 * sinDeg(45) * 15, 1e-6);
  expectNear(cylinder.scope.origin, {-8, 0, -8});
  const Shape cone = Op("primitiveCone").args(8, 10, -15).on(emptyShape({4, 4, 4}), services).shape;
  EXPECT_NEAR(enclosedVolume(*meshInScope(cone)), 8 * 0.5 * 100 * sinDeg(45) * 5, 1e-6);
  EXPECT_EQ(cone.scope.origin.y, -15);
  const Shape sphere =
      Op("primitiveSphere").args(8, 4, 10).on(emptyShape({4, 4, 4}), services).shape;
  EXPECT_EQ(countsOf(sphere.geometry).faces, 32u);
  expectNear(sphere.size, {20, 20, 20});
  EXPECT_EQ(sphere.scope.origin.y, 0);
}

TEST(PrimitiveSolids, impossibleCountsAreReported) {
  FakeServices services;
  const Shape s = boxShape({1, 1, 1});
  for (const Ran& ran : {Op("primitiveDisk").args(2).on(s, services),
                         Op("primitiveSphere").args(3, 1).on(s, services),
                         Op("primitiveSphere").args(4000, 4000).on(s, services),
                         Op("primitiveCone").args(1e300).on(s, services),
                         Op("primitiveCylinder").args(std::nan("")).on(s, services)}) {
    EXPECT_STREQ(ran.status.code(), "bad-argument");
    EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::Box);
  }
}

}  // namespace
}  // namespace gable
