// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"
#include "geom/mesh/topology.h"

namespace gable {
namespace {

const std::vector<std::vector<Vec2>> kL = {{{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}}};

Mesh grid(int n) {
  MeshBuilder b;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) b.addPosition({double(x), 0, double(-y)});
  }
  const auto at = [&](int x, int y) { return static_cast<uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const uint32_t ring[] = {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
      b.addPolygon(ring);
    }
  }
  return b.take();
}

TEST(CleanupGeometry, unitesCoplanarFacesAndKeepsTheScope) {
  FakeServices services;
  const Shape s = meshShape(grid(4));
  const Ran ran = Op("cleanupGeometry").args(word("all"), 0).on(s, services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_EQ(countsOf(ran.shape.geometry).faces, 1u);
  EXPECT_EQ(countsOf(ran.shape.geometry).vertices, 4u);
  EXPECT_EQ(ran.shape.size, s.size);
  EXPECT_STREQ(Op("cleanupGeometry").args(word("all"), 2).on(s, services).status.code(),
               "bad-argument");
}

TEST(Trim, cutsWhatThePlanesThatAreOnSay) {
  FakeServices services;
  Shape s = boxShape({4, 4, 4});
  ShapeExtra extra;
  extra.trim.push_back({{1, 0, 0}, 3, false});
  extra.trim.push_back({{0, 1, 0}, 2, true});
  s.extra = makeRef<ShapeExtra>(extra);
  EXPECT_NEAR(enclosedVolume(meshInLocal(Op("trim").on(s, services).shape)), 48, 1e-9);
  s.trimHorizontal = true;
  EXPECT_NEAR(enclosedVolume(meshInLocal(Op("trim").on(s, services).shape)), 24, 1e-9);
}

TEST(Convexify, partsAreConvexAndMakeUpTheFace) {
  FakeServices services;
  const Ran ran = Op("convexify").on(polygonShape(kL), services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_EQ(m.faceCount(), 2u);
  EXPECT_FALSE(isConcave(m));
  EXPECT_NEAR(m.area(), 48, 1e-9);
  // The only cut is longer than allowed.
  EXPECT_EQ(countsOf(Op("convexify").args(1).on(polygonShape(kL), services).shape.geometry).faces,
            1u);
  EXPECT_EQ(Op("convexify").on(quadShape(2, 2), services).shape.geometry.kind,
            GeometryKind::QuadXz);
}

TEST(Convexify, hostilePolygonsFallIntoConvexParts) {
  const std::vector<TestPolygon> polygons = hostilePolygons(16, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    FakeServices services;
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z);
    const Mesh m = meshInLocal(Op("convexify").on(s, services).shape);
    EXPECT_FALSE(isConcave(m)) << p.number;
    EXPECT_NEAR(m.area(), meshInLocal(s).area(), 1e-7 * extent * extent) << p.number;
  }
}

TEST(Footprint, isTheGroundThatTheShapeCovers) {
  FakeServices services;
  const Ran box = Op("footprint").on(boxShape({4, 9, 3}), services);
  EXPECT_EQ(box.shape.geometry.kind, GeometryKind::QuadXz);
  EXPECT_EQ(box.shape.size, (Vec3{4, 0, 3}));
  const Ran roof = Op("roofHip").args(45, 1).on(polygonShape(kL), services);
  const Ran ground = Op("footprint").on(roof.shape, services);
  ASSERT_TRUE(ground.status.ok());
  const Mesh m = meshInLocal(ground.shape);
  EXPECT_EQ(m.faceCount(), 1u);
  EXPECT_NEAR(m.area(), 48 + 32 * std::sqrt(0.5) + 2, 1e-3);
  EXPECT_NEAR(m.normal(0).y, 1, 1e-12);
  EXPECT_EQ(ground.shape.size.y, 0);
  EXPECT_STREQ(Op("footprint").on(emptyShape({1, 1, 1}), services).status.code(), "no-geometry");
}

TEST(Rectify, nearlyRightAnglesBecomeRight) {
  FakeServices services;
  const Shape s = polygonShape({{{0, 0}, {10, 0.3}, {9.8, 6}, {0.1, 6.2}}});
  const Ran ran = Op("rectify").args(5).on(s, services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_TRUE(isRectangular(meshInLocal(ran.shape), 0.01));
  const Ran little = Op("rectify").args(0.5).on(s, services);
  EXPECT_FALSE(isRectangular(meshInLocal(little.shape), 0.01));
  EXPECT_STREQ(Op("rectify").args(50).on(s, services).status.code(), "bad-argument");
}

TEST(Scatter, pointsLieInTheirDomain) {
  FakeServices services;
  const Shape l = polygonShape(kL);
  const Ran surface =
      Op("scatter").slots(1).args(word("surface"), 300, word("uniform")).on(l, services);
  ASSERT_EQ(surface.children.size(), 300u);
  size_t lower = 0;
  for (const BlockChild& c : surface.children) {
    const Vec3 p = c.shape.scope.origin;
    EXPECT_EQ(c.shape.size, Vec3{});
    EXPECT_TRUE(p.x <= 4.0001 || -p.z <= 4.0001);
    EXPECT_EQ(c.shape.scope.y, (Vec3{0, 1, 0}));
    EXPECT_EQ(countsOf(c.shape.geometry).vertices, 1u);
    lower += -p.z <= 4;
  }
  EXPECT_NEAR(static_cast<double>(lower) / 300, 2. / 3, 0.1);
  Shape roof = Op("roofHip").args(45).on(l, services).shape;
  const Ran volume =
      Op("scatter").slots(1).args(word("volume"), 100, word("uniform")).on(roof, services);
  for (const BlockChild& c : volume.children) {
    const Vec3 p = c.shape.scope.origin;
    EXPECT_TRUE(p.y >= 0 && p.y <= std::min({p.x, -p.z, 8 - p.x, 8 + p.z}) + 1e-9);
  }
}

TEST(Scatter, gaussianClustersAboutItsMean) {
  FakeServices services;
  const Ran ran = Op("scatter")
                      .slots(1)
                      .args(word("scope"), 400, word("gaussian"), word("left"), relative(0.1))
                      .on(boxShape({10, 10, 10}), services);
  ASSERT_EQ(ran.children.size(), 400u);
  double x = 0, z = 0;
  for (const BlockChild& c : ran.children) {
    x += c.shape.scope.origin.x / 400;
    z += c.shape.scope.origin.z / 400;
    EXPECT_GE(c.shape.scope.origin.x, 0);
  }
  EXPECT_NEAR(x, 0.8, 0.15);
  EXPECT_NEAR(z, 5, 0.3);
}

TEST(Scatter, drawsDependOnTheAddressAlone) {
  FakeServices services;
  Shape s = boxShape({1, 1, 1});
  const auto first = [&] {
    return Op("scatter").slots(1).args(word("scope"), 3, word("uniform")).on(s, services).children;
  };
  const auto a = first(), b = first();
  EXPECT_EQ(a[2].shape.scope.origin, b[2].shape.scope.origin);
  s.path = 77;
  EXPECT_NE(a[2].shape.scope.origin, first()[2].shape.scope.origin);
  EXPECT_STREQ(Op("scatter")
                   .slots(1)
                   .args(word("scope"), 1e9, word("uniform"))
                   .on(s, services)
                   .status.code(),
               "bad-argument");
}

TEST(SplitArea, partsHaveTheirAreas) {
  FakeServices services;
  const Shape l = polygonShape(kL);
  const Ran ran =
      Op("splitArea").args(word("x")).split({relative(0.5), 6, floating(1)}).on(l, services);
  ASSERT_TRUE(ran.status.ok());
  ASSERT_EQ(ran.children.size(), 3u);
  EXPECT_NEAR(meshInLocal(ran.children[0].shape).area(), 24, 1e-6);
  EXPECT_NEAR(meshInLocal(ran.children[1].shape).area(), 6, 1e-6);
  EXPECT_NEAR(meshInLocal(ran.children[2].shape).area(), 18, 1e-6);
  EXPECT_EQ(ran.children[2].shape.split.index, 2u);
  EXPECT_EQ(ran.children[2].shape.split.total, 3u);
  const Ran fifths = Op("splitArea").args(word("z")).split({relative(0.2)}, true).on(l, services);
  ASSERT_EQ(fifths.children.size(), 5u);
  for (const BlockChild& c : fifths.children) {
    EXPECT_NEAR(meshInLocal(c.shape).area(), 48 / 5., 1e-6);
  }
  EXPECT_STREQ(Op("splitArea").args(word("y")).split({1}).on(l, services).status.code(),
               "split-flat");
}

TEST(SplitArea, hostilePolygonsAreHalved) {
  const std::vector<TestPolygon> polygons = hostilePolygons(16, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    FakeServices services;
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z);
    const Ran ran =
        Op("splitArea").args(word("x")).split({floating(1), floating(1)}).on(s, services);
    ASSERT_EQ(ran.children.size(), 2u) << p.number;
    EXPECT_NEAR(meshInLocal(ran.children[0].shape).area(),
                meshInLocal(ran.children[1].shape).area(), 1e-6 * extent * extent)
        << p.number;
  }
}

}  // namespace
}  // namespace gable
