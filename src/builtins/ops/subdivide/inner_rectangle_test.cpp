// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

Ran inner(const Shape& s, const char* alignment = "scope",
          std::vector<std::string> items = {"shape", "remainder"}) {
  FakeServices services;
  return Op("innerRectangle").args(word(alignment)).select(std::move(items)).on(s, services);
}

double areaOf(const std::vector<Shape>& shapes) {
  double sum = 0;
  for (const Shape& s : shapes) sum += meshInLocal(s).area();
  return sum;
}

TEST(InnerRectangle, findsTheLargestInAnL) {
  const Ran ran = inner(polygonShape({{{0, 0}, {10, 0}, {10, 4}, {3, 4}, {3, 9}, {0, 9}}}));
  ASSERT_TRUE(ran.status.ok());
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_EQ(ran.of(0)[0].geometry.kind, GeometryKind::QuadXz);
  EXPECT_NEAR(ran.of(0)[0].size.x, 10, 1e-4);
  EXPECT_NEAR(ran.of(0)[0].size.z, 4, 1e-4);
  EXPECT_NEAR(areaOf(ran.of(1)), 15, 1e-3);
}

TEST(InnerRectangle, aRectangleIsItsOwn) {
  const Ran ran = inner(quadShape(7, 3));
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_EQ(ran.of(0)[0].size, (Vec3{7, 0, 3}));
  EXPECT_EQ(ran.of(0)[0].geometry.kind, GeometryKind::QuadXz);
  EXPECT_TRUE(ran.of(1).empty());
}

TEST(InnerRectangle, keepsClearOfHoles) {
  const Ran ran =
      inner(polygonShape({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{1, 4}, {8, 4}, {8, 8}, {1, 8}}}),
            "scope", {"shape", "remainder ="});
  EXPECT_NEAR(areaOf(ran.of(0)), 36, 1e-3);
  EXPECT_EQ(ran.of(1).size(), 1u);
}

TEST(InnerRectangle, edgesGiveTheDirection) {
  const double a = 5;
  const Shape s = polygonShape({{{a, 0}, {2 * a, a}, {a, 2 * a}, {0, a}}});
  EXPECT_NEAR(areaOf(inner(s, "edge").of(0)), 2 * a * a, 1e-3);
  EXPECT_NEAR(areaOf(inner(s, "scope").of(0)), a * a, 1e-3);
  EXPECT_EQ(inner(s, "edge").of(0)[0].scope.x, s.scope.x);
}

TEST(InnerRectangle, wallsAreSeenAlongTheirNormal) {
  const Ran ran = inner(wallShape(4, 3));
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_EQ(ran.of(0)[0].geometry.kind, GeometryKind::QuadXy);
}

TEST(InnerRectangle, slopesAreSeenFromAbove) {
  MeshBuilder b;
  const uint32_t ring[] = {b.addPosition({0, 0, 4}), b.addPosition({4, 0, 4}),
                           b.addPosition({4, 1, 0}), b.addPosition({0, 1, 0})};
  b.addPolygon(ring);
  const Ran ran = inner(meshShape(b.take()));
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_NEAR(ran.of(0)[0].size.x, 4, 1e-4);
  EXPECT_NEAR(ran.of(0)[0].size.y, 1, 1e-4);
}

TEST(InnerRect, replacesTheFaceInPlace) {
  FakeServices services;
  const Ran ran =
      Op("innerRect")
          .on(polygonShape({{{0, 0}, {10, 0}, {10, 4}, {3, 4}, {3, 9}, {0, 9}}}), services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::QuadXz);
  EXPECT_NEAR(ran.shape.size.x, 10, 1e-4);
  EXPECT_STREQ(Op("innerRect").on(emptyShape({1, 1, 1}), services).status.code(), "no-geometry");
}

TEST(InnerRectangle, hostilePolygonsHaveOne) {
  const std::vector<TestPolygon> polygons = hostilePolygons(40, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z), area = areaOf({s});
    const Ran ran = inner(s);
    ASSERT_TRUE(ran.status.ok()) << p.number;
    for (const BlockChild& c : ran.children) EXPECT_TRUE(meshInLocal(c.shape).valid());
    EXPECT_LE(areaOf(ran.of(0)), area * (1 + 1e-6)) << p.number;
    EXPECT_NEAR(areaOf(ran.of(0)) + areaOf(ran.of(1)), area, 1e-3 * extent * extent) << p.number;
  }
}

}  // namespace
}  // namespace gable
