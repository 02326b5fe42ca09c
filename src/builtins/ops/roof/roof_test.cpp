// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"
#include "math/trig.h"

namespace gable {
namespace {

size_t facesTagged(FakeServices& services, const Mesh& m, std::string_view tag) {
  size_t n = 0;
  for (const MeshFace& f : m.faces) n += services.tags().has(f.tags, tag);
  return n;
}

size_t edgesOf(FakeServices& services, const Shape& s, const char* kind) {
  return Op("comp").args(word("e")).select({kind}).on(s, services).children.size();
}

const std::vector<std::vector<Vec2>> kL = {{{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}}};

TEST(RoofHip, slopesRiseFromEveryEdge) {
  FakeServices services;
  const Ran ran = Op("roofHip").args(45).on(quadShape(8, 4), services);
  ASSERT_TRUE(ran.status.ok()) << ran.status.message();
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_TRUE(isClosed(m));
  EXPECT_EQ(m.faceCount(), 5u);
  EXPECT_EQ(facesTagged(services, m, "roof.top"), 4u);
  EXPECT_TRUE(services.tags().has(m.faces[0].tags, "roof.bottom"));
  EXPECT_NEAR(ran.shape.size.y, 2, 1e-9);
  EXPECT_NEAR(enclosedVolume(m), 8 * 4 * 2 / 2. - 2 * (4 * 2 * 2 / 6.), 1e-9);
  EXPECT_EQ(ran.shape.scope.y, (Vec3{0, 1, 0}));
  EXPECT_EQ(edgesOf(services, ran.shape, "eave"), 4u);
  EXPECT_EQ(edgesOf(services, ran.shape, "hip"), 4u);
  EXPECT_EQ(edgesOf(services, ran.shape, "ridge"), 1u);
  EXPECT_EQ(edgesOf(services, ran.shape, "valley"), 0u);
}

TEST(RoofHip, heightAndOverhangAreAsAsked) {
  FakeServices services;
  const Ran tall = Op("roofHip").args(word("byHeight"), 3).on(quadShape(8, 4), services);
  EXPECT_NEAR(tall.shape.size.y, 3, 1e-9);
  const Ran wide = Op("roofHip").args(45, std::sqrt(2)).on(quadShape(8, 4), services);
  // Measured down the slope: a metre out and a metre down.
  EXPECT_NEAR(wide.shape.size.x, 10, 1e-9);
  EXPECT_NEAR(wide.shape.size.z, 6, 1e-9);
  EXPECT_NEAR(wide.shape.size.y, 3, 1e-9);
}

TEST(RoofHip, concaveOutlinesHaveValleys) {
  FakeServices services;
  const Ran ran = Op("roofHip").args(30).on(polygonShape(kL), services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_TRUE(isClosed(meshInLocal(ran.shape)));
  EXPECT_EQ(edgesOf(services, ran.shape, "eave"), 6u);
  EXPECT_EQ(edgesOf(services, ran.shape, "valley"), 1u);
  EXPECT_EQ(edgesOf(services, ran.shape, "hip"), 5u);
}

TEST(RoofHip, wallsGetRoofsAlongTheirNormal) {
  FakeServices services;
  const Ran ran = Op("roofHip").args(45).on(wallShape(4, 4), services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_EQ(ran.shape.scope.y, (Vec3{0, 0, 1}));
  EXPECT_EQ(ran.shape.scope.x, (Vec3{1, 0, 0}));
  EXPECT_NEAR(ran.shape.size.y, 2, 1e-9);
}

TEST(RoofGable, endsAreUpright) {
  FakeServices services;
  const Ran ran = Op("roofGable").args(45).on(quadShape(8, 4), services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_TRUE(isClosed(m));
  EXPECT_EQ(facesTagged(services, m, "roof.top"), 2u);
  EXPECT_EQ(facesTagged(services, m, "roof.side"), 2u);
  EXPECT_EQ(facesTagged(services, m, "roof.bottom"), 1u);
  EXPECT_NEAR(enclosedVolume(m), 32, 1e-9);
  EXPECT_EQ(edgesOf(services, ran.shape, "ridge"), 1u);
  EXPECT_EQ(edgesOf(services, ran.shape, "eave"), 2u);
}

TEST(RoofGable, theIndexTurnsTheRidge) {
  FakeServices services;
  for (const double edge : {0., 1.}) {
    const Ran ran = Op("roofGable").args(45, 0, 0, false, edge).on(quadShape(8, 4), services);
    ASSERT_TRUE(ran.status.ok());
    EXPECT_NEAR(ran.shape.size.y, edge == 0 ? 2 : 4, 1e-9);
  }
  const Ran out = Op("roofGable").args(45, std::sqrt(2), 0.5).on(quadShape(8, 4), services);
  EXPECT_NEAR(out.shape.size.x, 9, 1e-9);
  EXPECT_NEAR(out.shape.size.z, 6, 1e-9);
}

TEST(RoofShed, oneSlopeRisesFromTheEdge) {
  FakeServices services;
  const Ran ran = Op("roofShed").args(45).on(quadShape(8, 4), services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_TRUE(isClosed(m));
  EXPECT_NEAR(enclosedVolume(m), 8 * 4 * 4 / 2., 1e-9);
  EXPECT_EQ(facesTagged(services, m, "roof.top"), 1u);
  EXPECT_EQ(facesTagged(services, m, "roof.side.outer"), 3u);
  EXPECT_EQ(edgesOf(services, ran.shape, "eave"), 2u);
  const Ran right = Op("roofShed").args(word("byHeight"), 3, 1).on(quadShape(8, 4), services);
  EXPECT_NEAR(enclosedVolume(meshInLocal(right.shape)), 8 * 4 * 3 / 2., 1e-9);
}

TEST(RoofPyramid, thePointIsOverTheMiddle) {
  FakeServices services;
  const Ran ran = Op("roofPyramid").args(word("byHeight"), 6).on(quadShape(4, 2), services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_NEAR(enclosedVolume(meshInLocal(ran.shape)), 16, 1e-9);
  EXPECT_EQ(facesTagged(services, meshInLocal(ran.shape), "roof.top"), 4u);
}

TEST(RoofRidge, oneRidgeAlongTheScope) {
  FakeServices services;
  const Ran ran = Op("roofRidge").args(word("byAngle"), 45).on(quadShape(8, 4), services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_TRUE(isClosed(m));
  EXPECT_NEAR(enclosedVolume(m), 32, 1e-9);
  EXPECT_EQ(facesTagged(services, m, "roof.top"), 2u);
  EXPECT_EQ(facesTagged(services, m, "roof.side.outer"), 2u);
  EXPECT_EQ(facesTagged(services, m, "roof.bottom"), 1u);
  // An L: the outline becomes part of both slopes, whatever it is.
  const Ran l = Op("roofRidge").args(word("byHeight"), 2).on(polygonShape(kL), services);
  ASSERT_TRUE(l.status.ok());
  EXPECT_NEAR(l.shape.size.y, 2, 1e-9);
  EXPECT_TRUE(isClosed(meshInLocal(l.shape)));
}

TEST(Roofs, tagsOfTheFaceAndItsEdgesGoOn) {
  FakeServices services;
  Mesh m = *meshInScope(quadShape(8, 4));
  m.faces[0].tags = services.tags().of("lot");
  m.edgeTags = {services.tags().of("street"), 0, 0, 0};
  Shape s = meshShape(m);
  const Ran ran = Op("roofHip").args(45).on(s, services);
  const Mesh roof = meshInLocal(ran.shape);
  EXPECT_TRUE(services.tags().has(roof.faces[0].tags, "lot"));
  EXPECT_EQ(facesTagged(services, roof, "street"), 1u);
}

TEST(Roofs, wrongNumbersLeaveTheShapeAsItWas) {
  FakeServices services;
  const Shape s = quadShape(8, 4);
  for (const char* name : {"roofHip", "roofGable", "roofShed", "roofPyramid", "roofRidge"}) {
    for (const double angle : {0., 90., -30., double(NAN)}) {
      const Ran ran = Op(name).args(angle).on(s, services);
      EXPECT_STREQ(ran.status.code(), "bad-argument") << name << " " << angle;
      EXPECT_EQ(ran.shape.geometry, s.geometry);
    }
    EXPECT_STREQ(Op(name).args(30).on(emptyShape({1, 1, 1}), services).status.code(),
                 "no-geometry");
  }
  EXPECT_STREQ(
      Op("roofRidge").args(word("byAngle"), 90).on(quadShape(8, 4), services).status.code(),
      "roof-pitch");
}

TEST(Roofs, hostilePolygonsGetClosedRoofs) {
  const std::vector<TestPolygon> polygons = hostilePolygons(8, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  size_t failed = 0;
  for (const TestPolygon& p : polygons) {
    FakeServices services;
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z), area = meshInLocal(s).area();
    for (const char* name : {"roofHip", "roofShed", "roofRidge"}) {
      const Ran ran = Op(name).args(45).on(s, services);
      failed += !ran.status.ok();
      if (!ran.status.ok()) continue;
      const Mesh m = *meshInScope(ran.shape);
      ASSERT_TRUE(m.valid()) << name << p.number;
      EXPECT_GT(enclosedVolume(m), 0) << name << p.number;
      double up = 0;
      for (size_t f = 0; f < m.faceCount(); ++f) up += m.areaNormal(f).y / 2 * (m.normal(f).y > 0);
      for (size_t f = 0; f < m.faceCount(); ++f) {
        for (size_t l = 1; l < m.loopsOf(f).size() && m.normal(f).y > 0; ++l) {
          Mesh hole;
          hole.positions = m.positions;
          hole.corners = m.corners;
          hole.loops = {m.loopsOf(f)[l]};
          hole.faces.push_back({0, 1});
          up += hole.areaNormal(0).y / 2;
        }
      }
      EXPECT_NEAR(up, area, 1e-6 * extent * extent) << name << p.number;
    }
  }
  EXPECT_EQ(failed, 0u);
}

}  // namespace
}  // namespace gable
