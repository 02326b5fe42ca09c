// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

Ran extrude(const Shape& s, double distance) {
  FakeServices services;
  return Op("extrude").args(distance).on(s, services);
}

std::string tagOf(FakeServices& services, uint32_t set) {
  const auto& names = services.tags().names(set);
  return names.empty() ? std::string() : std::string(services.pool().text(names[0]));
}

TEST(Extrude, aRectangleBecomesABox) {
  const Ran lot = extrude(quadShape(4, 5), 10);
  ASSERT_TRUE(lot.status.ok());
  EXPECT_EQ(lot.shape.geometry.kind, GeometryKind::Box);
  EXPECT_EQ(lot.shape.size, (Vec3{4, 10, 5}));
  EXPECT_EQ(lot.shape.scope.origin, Vec3{});

  const Ran wall = extrude(wallShape(4, 3), 0.5);
  EXPECT_EQ(wall.shape.geometry.kind, GeometryKind::Box);
  EXPECT_EQ(wall.shape.scope.y, (Vec3{0, 0, 1}));
  EXPECT_EQ(wall.shape.scope.x, (Vec3{1, 0, 0}));
  EXPECT_EQ(wall.shape.size, (Vec3{4, 0.5, 3}));
  const Box3 box = meshInLocal(wall.shape).bounds();
  EXPECT_EQ(box.min, Vec3{});
  EXPECT_EQ(box.max, (Vec3{4, 3, 0.5}));
}

// The fast path and the general one must not differ in anything a rule can see.
TEST(Extrude, boxesAgreeWithTheGeneralWay) {
  for (const bool lying : {true, false}) {
    FakeServices services;
    Shape s = lying ? quadShape(4, 5) : wallShape(4, 5);
    const Ran fast = Op("extrude").args(2).on(s, services);
    Mesh m = *meshInScope(s);
    m.normals.assign(4, m.normal(0));
    s.geometry = {GeometryKind::Mesh, false, s.size, makeRef<Mesh>(m)};
    const Ran slow = Op("extrude").args(2).on(s, services);
    EXPECT_EQ(fast.shape.geometry, slow.shape.geometry);
    EXPECT_EQ(fast.shape.scope, slow.shape.scope);
    EXPECT_EQ(fast.shape.size, slow.shape.size);
    EXPECT_EQ(meshInScope(fast.shape)->contentHash(), meshInScope(slow.shape)->contentHash());
  }
}

TEST(Extrude, facesCarryTheirPart) {
  FakeServices services;
  const Shape ring = polygonShape({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {6, 3}, {6, 6}}});
  const Ran ran = Op("extrude").args(10).on(ring, services);
  const MeshRef m = meshInScope(ran.shape);
  ASSERT_EQ(m->faceCount(), 9u);
  EXPECT_EQ(m->positions.size(), 14u);
  std::map<std::string, int> tags;
  for (const MeshFace& f : m->faces) ++tags[tagOf(services, f.tags)];
  EXPECT_EQ(tags["extrude.bottom"], 1);
  EXPECT_EQ(tags["extrude.side.outer"], 4);
  EXPECT_EQ(tags["extrude.side.inner"], 3);
  EXPECT_EQ(tags["extrude.top"], 1);
  EXPECT_EQ(tagOf(services, m->faces[0].tags), "extrude.bottom");
  EXPECT_EQ(tagOf(services, m->faces[8].tags), "extrude.top");
}

TEST(Extrude, ownTagsAreReplacedAndOthersKept) {
  FakeServices services;
  Shape s = quadShape(2, 2);
  s.geometry.tags[kSideTop] = services.tags().intern(
      {services.pool().intern("extrude.top"), services.pool().intern("roof.top")});
  const Ran ran = Op("extrude").args(1).on(s, services);
  const uint32_t top = ran.shape.geometry.tags[kSideTop];
  EXPECT_TRUE(services.tags().has(top, "extrude.top"));
  EXPECT_TRUE(services.tags().has(top, "roof.top"));
  const uint32_t bottom = ran.shape.geometry.tags[kSideBottom];
  EXPECT_FALSE(services.tags().has(bottom, "extrude.top"));
  EXPECT_TRUE(services.tags().has(bottom, "roof.top"));
}

TEST(Extrude, downwardScopesHangFromTheFace) {
  for (const Shape& s : {quadShape(4, 5), polygonShape({{{0, 0}, {5, 0}, {2, 4}}})}) {
    const Ran ran = extrude(s, -3);
    ASSERT_TRUE(ran.status.ok());
    EXPECT_EQ(ran.shape.size.y, -3);
    EXPECT_EQ(ran.shape.scope.origin.y, 0);
    const Mesh m = meshInLocal(ran.shape);
    EXPECT_NEAR(m.bounds().min.y, -3, 1e-12);
    EXPECT_NEAR(m.bounds().max.y, 0, 1e-12);
    EXPECT_NEAR(enclosedVolume(m), 3 * meshInLocal(s).area(), 1e-9);
  }
}

TEST(Extrude, worldUpIgnoresTheSlopeAndFlatTopLevelsIt) {
  FakeServices services;
  // A square that rises by 1 over 2 metres.
  MeshBuilder b;
  const uint32_t ring[] = {b.addPosition({0, 0, 2}), b.addPosition({2, 0, 2}),
                           b.addPosition({2, 1, 0}), b.addPosition({0, 1, 0})};
  b.addPolygon(ring);
  const Shape s = meshShape(b.take());
  const Ran up = Op("extrude").args(word("world.up"), 3).on(s, services);
  EXPECT_NEAR(enclosedVolume(meshInLocal(up.shape)), 12, 1e-9);
  EXPECT_NEAR(up.shape.size.y, 4, 1e-12);
  const Ran level = Op("extrude").args(word("world.up.flatTop"), 3).on(s, services);
  EXPECT_NEAR(level.shape.size.y, 3, 1e-12);
  EXPECT_NEAR(enclosedVolume(meshInLocal(level.shape)), 10, 1e-9);
  const Ran least = Op("extrude").args(word("world.up.flatTop"), 0).on(s, services);
  EXPECT_NEAR(enclosedVolume(meshInLocal(least.shape)), 2, 1e-9);
  const Ran along = Op("extrude").args(word("face.normal"), 3).on(s, services);
  EXPECT_NEAR(enclosedVolume(meshInLocal(along.shape)), 3 * std::sqrt(20), 1e-9);
}

TEST(Extrude, worldUpFollowsTheWorldNotTheScope) {
  FakeServices services;
  services.worldFrame = rotationXyz(90, 0, 0);
  const Ran ran = Op("extrude").args(word("world.up"), 3).on(wallShape(2, 2), services);
  ASSERT_TRUE(ran.status.ok());
  const Vec3 y = services.worldFrame.direction(ran.shape.scope.y);
  EXPECT_NEAR(y.y, 1, 1e-12);
}

TEST(Extrude, edgesBecomeFaces) {
  FakeServices services;
  const Ran edges = Op("comp").args(word("fe")).select({"all ="}).on(quadShape(4, 2), services);
  ASSERT_EQ(edges.children.size(), 1u);
  const Ran ran = Op("extrude").args(1).on(edges.children[0].shape, services);
  ASSERT_TRUE(ran.status.ok());
  // Each edge of the rectangle looks outward.
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_EQ(m.faceCount(), 4u);
  EXPECT_NEAR(m.area(), 12, 1e-9);
  EXPECT_NEAR(m.bounds().min.x, -1, 1e-9);
  EXPECT_NEAR(m.bounds().max.x, 5, 1e-9);
}

TEST(Extrude, sidesOfAnyPolygonAreRectangles) {
  FakeServices services;
  const Shape s = polygonShape({{{0.1, 0.2}, {7.3, 1.1}, {9.7, 6.13}, {4.44, 8.9}, {-1.2, 5.5}}});
  const Ran ran = Op("extrude").args(3.1).on(s, services);
  const Ran faces = Op("comp").args(word("f")).select({"side"}).on(ran.shape, services);
  ASSERT_EQ(faces.children.size(), 5u);
  for (const BlockChild& c : faces.children) {
    EXPECT_EQ(c.shape.geometry.kind, GeometryKind::QuadXy);
    EXPECT_NEAR(c.shape.size.y, 3.1, 1e-9);
    EXPECT_NEAR(c.shape.scope.y.y, 1, 1e-12);
  }
}

TEST(Extrude, mistakesLeaveTheShapeAsItWas) {
  FakeServices services;
  const Shape s = quadShape(2, 3);
  for (const Ran& ran : {Op("extrude").args(NAN).on(s, services),
                         Op("extrude").args(word("sideways"), 3).on(s, services)}) {
    EXPECT_FALSE(ran.status.ok());
    EXPECT_EQ(ran.shape.geometry, s.geometry);
    EXPECT_EQ(ran.shape.size, s.size);
  }
  EXPECT_STREQ(extrude(emptyShape({1, 1, 1}), 2).status.code(), "no-geometry");
}

TEST(Extrude, hostilePolygonsBecomeClosedSolidsOfTheRightVolume) {
  const std::vector<TestPolygon> polygons = hostilePolygons(1, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const Ran ran = extrude(s, 7);
    ASSERT_TRUE(ran.status.ok()) << p.number;
    const Mesh m = *meshInScope(ran.shape);
    ASSERT_TRUE(m.valid()) << p.number;
    EXPECT_TRUE(isClosed(m)) << p.number;
    const double area = meshInLocal(s).area(), extent = std::max(s.size.x, s.size.z);
    EXPECT_NEAR(enclosedVolume(m), 7 * area, 1e-6 * extent * extent) << p.number;
    EXPECT_EQ(ran.shape.size.y, 7);
  }
}

TEST(Taper, joinsTheFaceToAPointAboveItsCentre) {
  FakeServices services;
  const Ran ran = Op("taper").args(6).on(quadShape(4, 2), services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_EQ(m.faceCount(), 5u);
  EXPECT_TRUE(isClosed(m));
  EXPECT_NEAR(enclosedVolume(m), 16, 1e-9);
  EXPECT_EQ(tagOf(services, m.faces[0].tags), "taper.bottom");
  EXPECT_EQ(tagOf(services, m.faces[1].tags), "taper.side");
  const Ran down = Op("taper").args(-6).on(quadShape(4, 2), services);
  EXPECT_EQ(down.shape.size.y, -6);
  EXPECT_NEAR(enclosedVolume(meshInLocal(down.shape)), 16, 1e-9);
}

}  // namespace
}  // namespace gable
