// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

Ran split(const Shape& s, const char* axis, std::vector<Piece> pieces, bool repeat = false) {
  FakeServices services;
  return Op("split").args(word(axis)).split(std::move(pieces), repeat).on(s, services);
}

TEST(Split, boxPartsAreBoxesWithoutAMesh) {
  const Ran ran = split(boxShape({10, 3, 4}), "x", {relative(.5), relative(.1), relative(.2)});
  ASSERT_TRUE(ran.status.ok());
  ASSERT_EQ(ran.children.size(), 3u);
  const double starts[] = {0, 5, 6}, sizes[] = {5, 1, 2};
  for (uint32_t i = 0; i < 3; ++i) {
    const Shape& s = ran.children[i].shape;
    EXPECT_EQ(ran.children[i].slot, i);
    EXPECT_EQ(s.geometry.kind, GeometryKind::Box);
    EXPECT_NEAR(s.scope.origin.x, starts[i], 1e-12);
    EXPECT_NEAR(s.size.x, sizes[i], 1e-12);
    EXPECT_EQ(s.size.y, 3);
    EXPECT_EQ(s.split.index, i);
    EXPECT_EQ(s.split.total, 3u);
  }
}

TEST(Split, followsTheAxesOfATurnedScope) {
  Shape s = wallShape(6, 3);
  s.scope = Frame::moved({1, 2, 3}) * rotationXyz(0, 90, 0);
  const Ran ran = split(s, "x", {2, floating(1)});
  ASSERT_EQ(ran.children.size(), 2u);
  EXPECT_NEAR(ran.children[1].shape.scope.origin.z, 1, 1e-12);
  EXPECT_EQ(ran.children[1].shape.geometry.kind, GeometryKind::QuadXy);
  EXPECT_NEAR(ran.children[1].shape.size.x, 4, 1e-12);
}

TEST(Split, keepsThePivotAndAddressesEachPart) {
  Shape s = boxShape({4, 4, 4});
  s.pivot = Frame::moved({7, 8, 9});
  const Ran ran = split(s, "y", {1}, true);
  ASSERT_EQ(ran.children.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(ran.children[i].shape.pivot, s.pivot);
    for (size_t j = 0; j < i; ++j) {
      EXPECT_NE(ran.children[i].shape.path, ran.children[j].shape.path);
    }
  }
}

TEST(Split, innerSidesOfABoxLoseTheirTags) {
  Shape s = boxShape({1, 2, 1});
  s.geometry.tags = {1, 2, 3, 4, 5, 6};
  const Ran ran = split(s, "y", {1, 1});
  ASSERT_EQ(ran.children.size(), 2u);
  EXPECT_EQ(ran.children[0].shape.geometry.tags, (std::array<uint32_t, 6>{1, 2, 3, 0, 5, 6}));
  EXPECT_EQ(ran.children[1].shape.geometry.tags, (std::array<uint32_t, 6>{1, 2, 0, 4, 5, 6}));
}

TEST(Split, mirroredScopesAreDividedFromTheirOrigin) {
  for (const bool asMesh : {false, true}) {
    Shape s = boxShape({10, 1, 1});
    if (asMesh) s.geometry.uv = true;
    s.size.x = -10;
    const Ran ran = split(s, "x", {3, floating(1)});
    ASSERT_EQ(ran.children.size(), 2u);
    EXPECT_NEAR(ran.children[0].shape.scope.origin.x, 0, 1e-12);
    EXPECT_NEAR(ran.children[0].shape.size.x, -3, 1e-12);
    EXPECT_NEAR(ran.children[1].shape.scope.origin.x, -3, 1e-12);
    EXPECT_NEAR(ran.children[1].shape.size.x, -7, 1e-12);
    EXPECT_NEAR(enclosedVolume(meshInLocal(ran.children[1].shape)), 7, 1e-9);
  }
}

TEST(Split, flatGeometryLiesInTheFirstPartOfADeepScope) {
  Shape s = wallShape(4, 3);
  s.size.z = 2;
  const Ran ran = split(s, "z", {1, 1});
  ASSERT_EQ(ran.children.size(), 1u);
  EXPECT_EQ(ran.children[0].slot, 0u);
  EXPECT_EQ(ran.children[0].shape.size, (Vec3{4, 3, 0}));
}

TEST(Split, scopesWithoutGeometryAreDividedToo) {
  const Ran ran = split(emptyShape({4, 2, 2}), "x", {1, floating(1)});
  ASSERT_EQ(ran.children.size(), 2u);
  EXPECT_EQ(ran.children[1].shape.size, (Vec3{3, 2, 2}));
}

TEST(Split, aScopeWithoutExtentIsAFailure) {
  for (const Shape& s : {wallShape(4, 3), emptyShape({4, 3, 0})}) {
    const Ran ran = split(s, "z", {1});
    EXPECT_STREQ(ran.status.code(), "split-flat");
    EXPECT_TRUE(ran.children.empty());
    EXPECT_EQ(ran.shape.size, s.size);
  }
}

TEST(Split, meshPartsAreFittedOrFillTheScope) {
  // An L: the upper half is only 2 wide.
  const Shape s = polygonShape({{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}});
  FakeServices services;
  const Ran fitted = Op("split").args(word("z")).split({3, floating(1)}).on(s, services);
  const Ran filling =
      Op("split").args(word("z"), word("noAdjust")).split({3, floating(1)}).on(s, services);
  ASSERT_EQ(fitted.children.size(), 2u);
  ASSERT_EQ(filling.children.size(), 2u);
  // Scope z runs from north to south: the first part is the upright of the L.
  EXPECT_NEAR(fitted.children[0].shape.size.x, 2, 1e-12);
  EXPECT_NEAR(fitted.children[0].shape.size.z, 3, 1e-12);
  EXPECT_NEAR(filling.children[0].shape.size.x, 6, 1e-12);
  EXPECT_NEAR(filling.children[0].shape.size.z, 3, 1e-12);
  EXPECT_EQ(filling.children[0].shape.scope.origin, s.scope.origin);
  for (const Ran* ran : {&fitted, &filling}) {
    EXPECT_NEAR(meshInLocal(ran->children[0].shape).area(), 6, 1e-9);
    EXPECT_NEAR(meshInLocal(ran->children[1].shape).area(), 14, 1e-9);
  }
}

TEST(Split, solidsAreClosedAfterTheCut) {
  Shape s = boxShape({4, 4, 4});
  s.geometry.uv = true;  // As a mesh.
  const Ran ran = split(s, "x", {1, 2, 1});
  ASSERT_EQ(ran.children.size(), 3u);
  double volume = 0;
  for (const BlockChild& c : ran.children) {
    const Mesh m = meshInLocal(c.shape);
    EXPECT_EQ(m.faceCount(), 6u);
    EXPECT_TRUE(isClosed(m));
    volume += enclosedVolume(m);
  }
  EXPECT_NEAR(volume, 64, 1e-9);
}

TEST(Split, interpolatesUvAlongCuts) {
  Shape s = wallShape(4, 2);
  s.geometry.uv = true;
  const Ran ran = split(s, "x", {1, floating(1)});
  ASSERT_EQ(ran.children.size(), 2u);
  const MeshRef m = ran.children[0].shape.geometry.mesh;
  ASSERT_TRUE(m && m->hasUv(0));
  double most = 0;
  for (const Vec2 uv : m->uvs[0]) most = std::max(most, uv.x);
  EXPECT_NEAR(most, 0.25, 1e-12);
}

TEST(Split, uvSpaceCountsInCoordinatesAndUnitSpaceInMetres) {
  Shape s = wallShape(8, 3);
  s.geometry.uv = true;
  FakeServices services;
  const Ran uv =
      Op("split").args(word("u"), word("uvSpace"), 0).split({0.25, floating(1)}).on(s, services);
  const Ran unit =
      Op("split").args(word("u"), word("unitSpace"), 0).split({3, floating(1)}).on(s, services);
  ASSERT_EQ(uv.children.size(), 2u);
  ASSERT_EQ(unit.children.size(), 2u);
  EXPECT_NEAR(uv.children[0].shape.size.x, 2, 1e-9);
  EXPECT_NEAR(unit.children[0].shape.size.x, 3, 1e-9);
  EXPECT_NEAR(unit.children[1].shape.size.x, 5, 1e-9);
  const Ran v =
      Op("split").args(word("v"), word("unitSpace"), 0).split({floating(1)}, true).on(s, services);
  EXPECT_EQ(v.children.size(), 3u);
}

TEST(Split, uvWithoutCoordinatesIsAFailure) {
  FakeServices services;
  const Ran ran =
      Op("split").args(word("u"), word("uvSpace"), 0).split({1}).on(wallShape(1, 1), services);
  EXPECT_STREQ(ran.status.code(), "split-no-uv");
  const Ran set =
      Op("split").args(word("u"), word("uvSpace"), 12).split({1}).on(wallShape(1, 1), services);
  EXPECT_STREQ(set.status.code(), "bad-argument");
}

TEST(Split, farTrimPlanesAreForgottenSoThatPartsAreEqual) {
  Shape s = wallShape(100, 3);
  ShapeExtra extra;
  extra.trim.push_back({{-1, 0, 0}, 0, false});
  s.extra = makeRef<ShapeExtra>(extra);
  const Ran ran = split(s, "x", {floating(4)}, true);
  ASSERT_EQ(ran.children.size(), 25u);
  EXPECT_TRUE(ran.children[0].shape.extra);
  EXPECT_FALSE(ran.children[1].shape.extra);
  EXPECT_FALSE(ran.children[24].shape.extra);
}

// The parts of any polygon lie in order, within the parent, and make up its area.
TEST(Split, partsOfHostilePolygonsMakeUpTheWhole) {
  const std::vector<TestPolygon> polygons = hostilePolygons(1, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  size_t parts = 0;
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const double area = meshInLocal(s).area();
    const double extent = std::max(s.size.x, s.size.z);
    for (const char* axis : {"x", "z"}) {
      const Ran ran = split(s, axis, {floating(1), relative(0.13), floating(2)}, false);
      ASSERT_TRUE(ran.status.ok()) << p.number;
      double sum = 0;
      for (const BlockChild& c : ran.children) {
        const Mesh m = meshInLocal(c.shape);
        ASSERT_TRUE(m.valid()) << p.number;
        sum += m.area();
        const Vec3 lo = s.scope.toLocal(c.shape.scope.origin);
        EXPECT_GE(std::min(lo.x, lo.z), -1e-6 * extent) << p.number;
        EXPECT_LE(lo.x + c.shape.size.x, s.size.x + 1e-6 * extent) << p.number;
        EXPECT_LE(lo.z + c.shape.size.z, s.size.z + 1e-6 * extent) << p.number;
        ++parts;
      }
      ASSERT_NEAR(sum, area, 1e-7 * extent * extent) << p.number << " " << axis;
    }
  }
  EXPECT_GT(parts, polygons.size() * 5);
}

}  // namespace
}  // namespace gable
