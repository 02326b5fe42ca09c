// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// A shape whose scope, pivot, object and world all differ.
struct Turned {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  Turned() {
    s.pivot = rotationXyz(0, 30, 0);
    s.pivot.origin = {1, 2, 3};
    s.scope = rotationXyz(10, 20, 30);
    s.scope.origin = {5, 6, 7};
    services.worldFrame = rotationXyz(0, 0, 90);
    services.worldFrame.origin = {100, 0, 0};
    services.initial.origin = rotationXyz(0, 90, 0);
    services.initial.origin.origin = {50, 5, 0};
  }
};

TEST(Transform, sizeKeepsPrimitivesAndTakesShares) {
  FakeServices services;
  const Ran ran = Op("s").args(relative(0.5), 7, relative(1)).on(boxShape({2, 3, 4}), services);
  EXPECT_EQ(ran.shape.size, (Vec3{1, 7, 4}));
  EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::Box);
}

TEST(Transform, sizeOfAFlatDimensionKeepsTheGeometryFlat) {
  FakeServices services;
  for (const Shape& flat : {quadShape(2, 3), polygonShape({{{0, 0}, {4, 0}, {0, 3}}})}) {
    const Ran ran = Op("s").args(relative(2), 5, relative(1)).on(flat, services);
    EXPECT_EQ(ran.shape.size.y, 5);
    const Box3 box = meshInScope(ran.shape)->bounds();
    EXPECT_EQ(box.size().y, 0);
    EXPECT_EQ(box.size().x, 2 * flat.size.x);
  }
}

TEST(Transform, negativeSizeMirrorsAndShowsTheInside) {
  FakeServices services;
  const Shape box = boxShape({2, 3, 4});
  const Shape s = Op("s").args(relative(-1), relative(1), relative(1)).on(box, services).shape;
  const Mesh mesh = meshInLocal(s);
  EXPECT_NEAR(enclosedVolume(mesh), -24, 1e-9);
  EXPECT_EQ(mesh.bounds().min, (Vec3{-2, 0, 0}));
  const Shape back = Op("s").args(relative(-1), relative(1), relative(1)).on(s, services).shape;
  EXPECT_NEAR(enclosedVolume(meshInLocal(back)), 24, 1e-9);
  const Shape twice = Op("s").args(relative(-1), relative(-1), relative(1)).on(box, services).shape;
  EXPECT_NEAR(enclosedVolume(meshInLocal(twice)), 24, 1e-9);
}

TEST(Transform, aSizeOfZeroForgetsNothing) {
  FakeServices services;
  const Shape box = meshShape(makeBoxMesh({2, 3, 4}, true));
  const Shape flat = Op("s").args(2, 0, 4).on(box, services).shape;
  EXPECT_EQ(meshInScope(flat)->bounds().size().y, 0);
  const Shape again = Op("s").args(2, 6, 4).on(flat, services).shape;
  EXPECT_NEAR(enclosedVolume(*meshInScope(again)), 48, 1e-9);
}

TEST(Transform, rIsTheSameAsRotateRelativeToThePivot) {
  Turned t;
  const Shape a = Op("r").args(10, -40, 25).on(t.s, t.services).shape;
  const Shape b =
      Op("rotate").args(word("rel"), word("pivot"), 10, -40, 25).on(t.s, t.services).shape;
  expectNear(a.scope.x, b.scope.x);
  expectNear(a.scope.y, b.scope.y);
  EXPECT_EQ(a.scope.origin, t.s.scope.origin);
}

TEST(Transform, rAroundTheCenterKeepsTheCenter) {
  Turned t;
  const Shape a = Op("r").args(word("scopeCenter"), 0, 45, 10).on(t.s, t.services).shape;
  expectNear(a.scope.point(a.size * 0.5), t.s.scope.point(t.s.size * 0.5));
  const Shape b = Op("r").args(word("scopeOrigin"), 0, 45, 10).on(t.s, t.services).shape;
  expectNear(b.scope.origin, t.s.scope.origin);
  expectNear(a.scope.x, b.scope.x);
}

TEST(Transform, rotateAbsoluteSetsTheOrientationThatConvertReads) {
  for (const char* system : {"pivot", "object", "world"}) {
    Turned t;
    const Shape a =
        Op("rotate").args(word("abs"), word(system), 20, 40, -30).on(t.s, t.services).shape;
    EXPECT_EQ(a.scope.origin, t.s.scope.origin);
    if (std::string(system) != "pivot") continue;
    EXPECT_NEAR(getAttribute("scope.rx", a, t.services).number, 20, 1e-9);
    EXPECT_NEAR(getAttribute("scope.ry", a, t.services).number, 40, 1e-9);
    EXPECT_NEAR(getAttribute("scope.rz", a, t.services).number, -30, 1e-9);
  }
}

TEST(Transform, rotateInTheWorldTurnsAboutTheWorldsAxes) {
  Turned t;
  const Shape a = Op("rotate").args(word("rel"), word("world"), 0, 90, 0).on(t.s, t.services).shape;
  // Local up of the world is the local frame's x axis turned back by 90 degrees: (0, 1, 0) world is
  // (1, 0, 0) local.
  const Frame inWorld = t.services.worldFrame * a.scope, before = t.services.worldFrame * t.s.scope;
  const Frame expected = rotationXyz(0, 90, 0) * before;
  expectNear(inWorld.x, expected.x);
  expectNear(inWorld.z, expected.z);
}

TEST(Transform, translateMovesInEachSystem) {
  Turned t;
  const Vec3 v{1, 2, 3};
  const auto moved = [&](const char* mode, const char* system) {
    return Op("translate").args(word(mode), word(system), 1, 2, 3).on(t.s, t.services).shape.scope;
  };
  expectNear(moved("rel", "scope").origin, t.s.scope.point(v));
  expectNear(moved("rel", "pivot").origin, t.s.scope.origin + t.s.pivot.direction(v));
  expectNear(moved("abs", "pivot").origin, t.s.pivot.point(v));
  expectNear(t.services.worldFrame.point(moved("abs", "world").origin), v);
  const Vec3 before = t.services.worldFrame.point(t.s.scope.origin);
  expectNear(t.services.worldFrame.point(moved("rel", "world").origin), before + v);
  expectNear(t.services.worldFrame.point(moved("abs", "object").origin),
             t.services.initial.origin.point(v));
}

TEST(Transform, unknownSystemsAreReported) {
  Turned t;
  const Ran ran = Op("translate").args(word("rel"), word("moon"), 1, 2, 3).on(t.s, t.services);
  EXPECT_STREQ(ran.status.code(), "wrong-argument");
  EXPECT_EQ(ran.shape.scope.origin, t.s.scope.origin);
}

TEST(Transform, centerMovesOnlyAlongTheNamedAxes) {
  FakeServices services;
  Shape s = boxShape({1, 1, 1});
  s.scope.origin = {9, 9, 9};
  Frame around = rotationXyz(0, 90, 0);
  around.origin = {10, 0, 0};
  const Shape a = Op("center").args(word("xyz")).previous(around, {4, 6, 8}).on(s, services).shape;
  expectNear(a.scope.point(a.size * 0.5), around.point({2, 3, 4}));
  const Shape b = Op("center").args(word("y")).previous(around, {4, 6, 8}).on(s, services).shape;
  expectNear(b.scope.origin, {9, 2.5, 9});
}

TEST(Transform, scopeAttributesAreRelativeToThePivot) {
  Turned t;
  ASSERT_TRUE(setAttribute("scope.tx", 4, t.s, t.services).ok());
  EXPECT_NEAR(getAttribute("scope.tx", t.s, t.services).number, 4, 1e-9);
  ASSERT_TRUE(setAttribute("scope.ry", 77, t.s, t.services).ok());
  EXPECT_NEAR(getAttribute("scope.ry", t.s, t.services).number, 77, 1e-9);
  EXPECT_NEAR(getAttribute("scope.tx", t.s, t.services).number, 4, 1e-9);
}

TEST(Transform, settingThePivotCarriesTheScopeAlong) {
  Turned t;
  const double tx = getAttribute("scope.tx", t.s, t.services).number;
  const double ry = getAttribute("scope.ry", t.s, t.services).number;
  const Vec3 before = t.s.scope.origin;
  for (const char* name : {"pivot.px", "pivot.oz"}) {
    ASSERT_TRUE(setAttribute(name, 12, t.s, t.services).ok());
    EXPECT_NEAR(getAttribute(name, t.s, t.services).number, 12, 1e-9);
  }
  EXPECT_NEAR(getAttribute("scope.tx", t.s, t.services).number, tx, 1e-9);
  EXPECT_NEAR(getAttribute("scope.ry", t.s, t.services).number, ry, 1e-9);
  EXPECT_GT(length(before - t.s.scope.origin), 1);
}

TEST(Transform, elevationIsTheHeightInTheWorld) {
  Turned t;
  EXPECT_NEAR(getAttribute("scope.elevation", t.s, t.services).number, t.s.scope.origin.x, 1e-9);
}

}  // namespace
}  // namespace gable
