// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

Ran offset(const Shape& s, double distance, const char* keep = "all") {
  FakeServices services;
  return Op("offset").args(distance, word(keep)).on(s, services);
}

size_t count(const Shape& s, const char* selector) {
  FakeServices services;
  return Op("comp").args(word("f")).select({selector}).on(s, services).children.size();
}

TEST(Offset, inwardLeavesTheInsideAndAFaceForEachEdge) {
  const Ran ran = offset(quadShape(10, 6), -1);
  ASSERT_TRUE(ran.status.ok()) << ran.status.message();
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_EQ(m.faceCount(), 5u);
  EXPECT_NEAR(m.area(), 60, 1e-9);
  EXPECT_EQ(count(ran.shape, "inside"), 1u);
  EXPECT_EQ(count(ran.shape, "border"), 4u);
  EXPECT_EQ(ran.shape.size, (Vec3{10, 0, 6}));
}

TEST(Offset, theInsideOfARectangleIsARectangle) {
  const Ran ran = offset(quadShape(10, 6), -1, "inside");
  EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::QuadXz);
  EXPECT_EQ(ran.shape.size, (Vec3{8, 0, 4}));
  EXPECT_EQ(ran.shape.scope.origin, (Vec3{1, 0, 1}));
}

TEST(Offset, outwardBordersLookDown) {
  const Ran ran = offset(quadShape(10, 6), 1);
  const Mesh m = meshInLocal(ran.shape);
  ASSERT_EQ(m.faceCount(), 5u);
  EXPECT_EQ(count(ran.shape, "inside"), 1u);
  EXPECT_EQ(count(ran.shape, "border"), 4u);
  EXPECT_NEAR(m.area(0), 96, 1e-9);
  // Inside and border faces together are the face that was.
  double signedSum = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) signedSum += m.areaNormal(f).y / 2;
  EXPECT_NEAR(signedSum, 60, 1e-9);
  EXPECT_EQ(offset(quadShape(10, 6), 1, "inside").shape.geometry.kind, GeometryKind::QuadXz);
}

TEST(Offset, holesGrowInwardAndShrinkOutward) {
  const Shape s =
      polygonShape({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{8, 8}, {12, 8}, {12, 12}, {8, 12}}});
  EXPECT_NEAR(meshInLocal(offset(s, -1, "inside").shape).area(), 18 * 18 - 6 * 6, 1e-9);
  EXPECT_NEAR(meshInLocal(offset(s, 1, "inside").shape).area(), 22 * 22 - 2 * 2, 1e-9);
  EXPECT_NEAR(meshInLocal(offset(s, 3, "inside").shape).area(), 26 * 26, 1e-9);
}

TEST(Offset, whatHasNoRoomInsideStays) {
  const Ran ran = offset(quadShape(10, 6), -4, "inside");
  ASSERT_TRUE(ran.status.ok());
  EXPECT_FALSE(ran.dropped);
  EXPECT_NEAR(meshInLocal(ran.shape).area(), 60, 1e-9);
  EXPECT_NEAR(meshInLocal(offset(quadShape(10, 6), -4, "border").shape).area(), 60, 1e-9);
}

TEST(Offset, keepsUvAndTags) {
  FakeServices services;
  Mesh m = *meshInScope(quadShape(10, 10));
  m.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.faces[0].tags = services.tags().of("lot");
  m.edgeTags = {services.tags().of("street"), 0, 0, 0};
  const Ran ran = Op("offset").args(-1).on(meshShape(m), services);
  const Mesh out = meshInLocal(ran.shape);
  EXPECT_TRUE(services.tags().has(out.faces[0].tags, "lot"));
  EXPECT_FALSE(services.tags().has(out.faces[0].tags, "street"));
  EXPECT_TRUE(services.tags().has(out.faces[1].tags, "street"));
  for (uint32_t c = 0; c < out.corners.size(); ++c) {
    EXPECT_NEAR(out.uvs[0][c].x, out.at(c).x / 10, 1e-12);
    EXPECT_NEAR(out.uvs[0][c].y, 1 - out.at(c).z / 10, 1e-12);
  }
}

TEST(Offset, mistakesLeaveTheShapeAsItWas) {
  EXPECT_STREQ(offset(quadShape(1, 1), NAN).status.code(), "offset-distance");
  EXPECT_STREQ(offset(emptyShape({1, 1, 1}), 1).status.code(), "no-geometry");
}

TEST(Offset, hostilePolygonsAddUp) {
  const std::vector<TestPolygon> polygons = hostilePolygons(4, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  size_t failed = 0;
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z), area = meshInLocal(s).area();
    for (const double share : {-0.02, -0.2, 0.03}) {
      const Ran ran = offset(s, share * extent);
      failed += !ran.status.ok();
      if (!ran.status.ok()) {
        ADD_FAILURE() << p.number << " " << ran.status.code();
        continue;
      }
      const Mesh m = meshInLocal(ran.shape);
      ASSERT_TRUE(m.valid()) << p.number;
      double sum = 0;
      for (size_t f = 0; f < m.faceCount(); ++f) sum += m.area(f) * (m.normal(f).y > 0 ? 1 : -1);
      EXPECT_NEAR(sum, area, 1e-6 * extent * extent) << p.number << " " << share;
      if (share < 0) {
        EXPECT_LE(ran.shape.size.x, s.size.x * (1 + 1e-9));
        EXPECT_LE(ran.shape.size.z, s.size.z * (1 + 1e-9));
      }
    }
  }
  EXPECT_EQ(failed, 0u);
}

}  // namespace
}  // namespace gable
