// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <algorithm>

#include "builtins/testing/op_fixture.h"
#include "math/trig.h"

namespace gable {
namespace {

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// Geometry as a set of points in the local frame, whatever the scope.
void expectSamePlace(const Shape& a, const Shape& b) {
  const auto sorted = [](const Shape& s) {
    std::vector<Vec3> p = meshInLocal(s).positions;
    std::sort(p.begin(), p.end(), [](const Vec3& u, const Vec3& v) {
      const auto key = [](const Vec3& w) { return std::round(w.x * 1e6); };
      if (key(u) != key(v)) return key(u) < key(v);
      if (std::fabs(u.y - v.y) > 1e-6) return u.y < v.y;
      return u.z < v.z;
    });
    return p;
  };
  const auto pa = sorted(a), pb = sorted(b);
  ASSERT_EQ(pa.size(), pb.size());
  for (size_t i = 0; i < pa.size(); ++i) expectNear(pa[i], pb[i], 1e-6);
}

// The scope is right-handed, holds the geometry exactly, and the pivot is at its origin.
void expectFitted(const Shape& s) {
  expectNear(cross(s.scope.x, s.scope.y), s.scope.z);
  const Box3 box = meshInScope(s)->bounds();
  expectNear(box.min, {}, 1e-6);
  expectNear(box.max, s.size, 1e-6);
  EXPECT_EQ(s.pivot, s.scope);
}

TEST(SetPivot, allCornersLookInward) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.scope = rotationXyz(10, 20, 30);
  s.scope.origin = {5, 6, 7};
  const Vec3 corners[] = {{0, 0, 0}, {2, 0, 0}, {2, 0, 4}, {0, 0, 4},
                          {0, 3, 0}, {2, 3, 0}, {2, 3, 4}, {0, 3, 4}};
  for (const char* map : {"xyz", "yzx", "zxy"}) {
    for (int corner = 0; corner < 8; ++corner) {
      const Shape a = Op("setPivot").args(word(map), corner).on(s, services).shape;
      expectFitted(a);
      expectSamePlace(a, s);
      expectNear(a.pivot.origin, s.scope.point(corners[corner]));
      const Vec3& along = *map == 'x' ? a.scope.y : *map == 'y' ? a.scope.z : a.scope.x;
      expectNear(along, corner < 4 ? s.scope.y : -s.scope.y);
    }
  }
}

TEST(SetPivot, firstCornerTurnsTheAxesAsNamed) {
  FakeServices services;
  const Shape s = boxShape({2, 3, 4});
  EXPECT_EQ(Op("setPivot").args(word("xyz"), 0).on(s, services).shape.size, (Vec3{2, 3, 4}));
  EXPECT_EQ(Op("setPivot").args(word("yzx"), 0).on(s, services).shape.size, (Vec3{4, 2, 3}));
  EXPECT_EQ(Op("setPivot").args(word("zxy"), 0).on(s, services).shape.size, (Vec3{3, 4, 2}));
}

TEST(SetPivot, aCornerThatIsNoneIsReported) {
  FakeServices services;
  const Ran ran = Op("setPivot").args(word("xyz"), 8).on(boxShape({1, 1, 1}), services);
  EXPECT_STREQ(ran.status.code(), "bad-argument");
}

TEST(MirrorScope, leavesTheGeometryAndTurnsTheBox) {
  FakeServices services;
  const Shape s = boxShape({2, 3, 4});
  const Shape a = Op("mirrorScope").args(true, false, true).on(s, services).shape;
  expectSamePlace(a, s);
  EXPECT_EQ(a.size, (Vec3{-2, 3, -4}));
  EXPECT_EQ(a.scope.origin, (Vec3{2, 0, 4}));
  EXPECT_NEAR(enclosedVolume(meshInLocal(a)), 24, 1e-9);
  const Shape one = Op("mirrorScope").args(true, false, false).on(s, services).shape;
  EXPECT_NEAR(enclosedVolume(meshInLocal(one)), 24, 1e-9);
  const Shape back = Op("mirrorScope").args(true, false, false).on(one, services).shape;
  EXPECT_EQ(back.size, s.size);
  expectSamePlace(back, s);
}

TEST(Mirror, turnsTheGeometryRoundWithinTheScope) {
  FakeServices services;
  const Shape s = polygonShape({{{0, 0}, {6, 0}, {3, 3}, {0, 3}}});
  const Shape a = Op("mirror").args(true, false, false).on(s, services).shape;
  EXPECT_EQ(a.scope, s.scope);
  EXPECT_EQ(a.size, s.size);
  EXPECT_NEAR(meshInScope(a)->area(), meshInScope(s)->area(), 1e-9);
  EXPECT_GT(meshInScope(a)->normal(0).y, 0.9);
  const Shape b = Op("mirror").args(true, false, false).on(a, services).shape;
  expectSamePlace(b, s);
  Shape up = boxShape({1, 2, 3});
  up.scope = rotationXyz(10, 20, 30);
  const Shape c = Op("mirror").args(true, true, true).on(up, services).shape;
  expectSamePlace(c, up);
  EXPECT_NEAR(enclosedVolume(meshInLocal(c)), 6, 1e-9);
}

TEST(RotateScope, fitsTheBoxAgain) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.pivot = rotationXyz(0, 0, 40);
  Shape a = Op("rotateScope").args(0, 0, 90).on(s, services).shape;
  expectNear(a.size, {3, 2, 4});
  expectSamePlace(a, s);
  EXPECT_EQ(a.pivot, s.pivot);
  a.pivot = a.scope;
  expectFitted(a);
  const Shape flat = Op("rotateScope").args(90, 0, 0).on(quadShape(5, 6), services).shape;
  EXPECT_EQ(flat.size.z, 0);
  expectSamePlace(flat, quadShape(5, 6));
}

TEST(AlignScopeToAxes, takesTheWorldsAxesAndAllWords) {
  for (const char* name : {"world.xyz", "x", "y", "z", "world.x", "object.y", "object.xyz"}) {
    FakeServices services;
    services.worldFrame = rotationXyz(0, 33, 0);
    services.initial.origin = rotationXyz(12, 0, 5);
    Shape s = boxShape({2, 3, 4});
    s.scope = rotationXyz(10, 20, 30);
    s.scope.origin = {5, 6, 7};
    const Shape a = Op("alignScopeToAxes").args(word(name)).on(s, services).shape;
    expectFitted(a);
    expectSamePlace(a, s);
    const Frame scope = services.worldFrame * a.scope;
    const Frame& o = services.initial.origin;
    const std::string n = name;
    if (n == "world.xyz") expectNear(scope.x, {1, 0, 0});
    if (n == "x" || n == "world.x") expectNear(scope.x, {1, 0, 0});
    if (n == "world.x") {
      EXPECT_NEAR(scope.z.x, 0, 1e-9);
    }
    if (n == "y") expectNear(scope.y, {0, 1, 0});
    if (n == "y") {
      EXPECT_NEAR(scope.x.y, 0, 1e-9);
    }
    if (n == "z") expectNear(scope.z, {0, 0, 1});
    if (n == "object.y") expectNear(scope.y, o.y);
    if (n == "object.xyz") expectNear(scope.z, o.z);
  }
}

TEST(AlignScopeToAxes, leavesAnAlignedBoxAPrimitive) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.scope.origin = {1, 1, 1};
  const Shape a = Op("alignScopeToAxes").args(word("y")).on(s, services).shape;
  EXPECT_EQ(a.geometry.kind, GeometryKind::Box);
  EXPECT_EQ(a.pivot, a.scope);
  EXPECT_EQ(a.scope.origin, s.scope.origin);
}

TEST(AlignScopeToAxes, worksWithoutGeometry) {
  FakeServices services;
  Shape s = emptyShape({1, 2, 3});
  s.scope = rotationXyz(90, 0, 0);
  const Shape a = Op("alignScopeToAxes").on(s, services).shape;
  expectNear(a.size, {1, 3, 2});
}

// A wall that leans, its scope upside down.
Shape leaning() {
  Shape s = wallShape(4, 3);
  s.scope = rotationXyz(150, 0, 0);
  s.scope.origin = {0, 5, 0};
  return s;
}

TEST(AlignScopeToGeometry, lowestEdgeTurnsTheWallUpright) {
  FakeServices services;
  for (const char* face : {"any", "world.lowest", "largest"}) {
    const Shape a = Op("alignScopeToGeometry")
                        .args(word("zUp"), word(face), word("world.lowest"))
                        .on(leaning(), services)
                        .shape;
    expectFitted(a);
    expectSamePlace(a, leaning());
    EXPECT_GT(a.scope.y.y, 0.1);
    expectNear(a.size, {4, 3, 0});
    expectNear(a.scope.z, leaning().scope.z);
  }
}

TEST(AlignScopeToGeometry, indicesCountFromTheEndWhenNegative) {
  FakeServices services;
  const Shape s = boxShape({2, 3, 4});
  const Shape a = Op("alignScopeToGeometry").args(word("yUp"), -1, 0).on(s, services).shape;
  // The last face of a box is the left one.
  expectNear(a.scope.y, {-1, 0, 0});
  const Shape b = Op("alignScopeToGeometry").args(word("zUp"), 1, -1).on(s, services).shape;
  expectNear(b.scope.z, {0, 1, 0});
  expectFitted(a);
  expectFitted(b);
}

TEST(AlignScopeToGeometry, longestEdgeGivesTheXAxis) {
  FakeServices services;
  const Shape s = polygonShape({{{0, 0}, {3, 4}, {0, 1}}});
  const Shape a = Op("alignScopeToGeometry")
                      .args(word("yUp"), word("any"), word("longest"))
                      .on(s, services)
                      .shape;
  EXPECT_NEAR(a.size.x, 5, 1e-9);
  expectNear(a.scope.x, {0.6, 0, -0.8});
  expectFitted(a);
}

TEST(AlignScopeToGeometry, legacyFormsWork) {
  FakeServices services;
  const Shape a =
      Op("alignScopeToGeometry").args(word("zUp"), word("auto")).on(leaning(), services).shape;
  EXPECT_GT(a.scope.y.y, 0.1);
  const Shape b =
      Op("alignScopeToGeometry").args(word("yUp"), 0).on(quadShape(2, 3), services).shape;
  EXPECT_EQ(b.geometry.kind, GeometryKind::QuadXz);
  const Shape c = Op("alignScopeToGeometry")
                      .args(word("yUp"), word("top"))
                      .on(boxShape({1, 2, 3}), services)
                      .shape;
  expectNear(c.scope.y, {0, 1, 0});
}

TEST(AlignScopeToGeometry, takesPointsAndEdges) {
  FakeServices services;
  MeshBuilder b;
  const uint32_t ends[] = {b.addPosition({0, 0, 0}), b.addPosition({0, 2, 0})};
  b.addPolygon(ends);
  const Shape edge = meshShape(b.take());
  const Shape a = Op("alignScopeToGeometry").args(word("zUp"), 0, 0).on(edge, services).shape;
  expectNear(a.scope.x, {0, 1, 0});
  expectNear(a.size, {2, 0, 0});
  const uint32_t one[] = {b.addPosition({1, 1, 1})};
  b.addPolygon(one);
  const Ran ran =
      Op("alignScopeToGeometry").args(word("yUp"), 0, 0).on(meshShape(b.take()), services);
  EXPECT_TRUE(ran.status.ok());
  expectNear(ran.shape.size, {0, 0, 0});
}

TEST(AlignScopeToGeometryBBox, findsTheSmallestRectangle) {
  FakeServices services;
  // A rectangle of 8 x 2 turned by 30 degrees in the plan.
  std::vector<Vec2> ring;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{8, 0}, Vec2{8, 2}, Vec2{0, 2}}) {
    ring.push_back({p.x * cosDeg(30) - p.y * sinDeg(30), p.x * sinDeg(30) + p.y * cosDeg(30)});
  }
  const Shape s = polygonShape({ring});
  for (const char* axes : {"xz", "zx"}) {
    const Shape a = Op("alignScopeToGeometryBBox").args(word(axes)).on(s, services).shape;
    expectFitted(a);
    expectSamePlace(a, s);
    expectNear(a.scope.y, {0, 1, 0});
    expectNear(a.size, *axes == 'x' ? Vec3{8, 0, 2} : Vec3{2, 0, 8}, 1e-9);
  }
}

TEST(AlignScopeToGeometryBBox, allPairsKeepTheThirdAxis) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.scope = rotationXyz(10, 20, 30);
  const Mesh turned =
      transformed(makeBoxMesh({2, 3, 4}, false), {1, 1, 1}, rotationXyz(25, 50, 75));
  for (const char* axes : {"xy", "yx", "xz", "zx", "yz", "zy"}) {
    const Shape b = meshShape(turned);
    const Shape a = Op("alignScopeToGeometryBBox").args(word(axes)).on(b, services).shape;
    expectFitted(a);
    expectSamePlace(a, b);
    EXPECT_GE(a.size[static_cast<size_t>(axes[0] - 'x')] + 1e-9,
              a.size[static_cast<size_t>(axes[1] - 'x')]);
    const size_t fixed =
        3 - static_cast<size_t>(axes[0] - 'x') - static_cast<size_t>(axes[1] - 'x');
    Vec3 axis;
    axis[fixed] = 1;
    expectNear(a.scope.direction(axis), axis);
  }
}

}  // namespace
}  // namespace gable
