// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

Ran setback(const Shape& s, Arg distance, std::vector<std::string> items) {
  FakeServices services;
  return Op("setback").args(distance).select(std::move(items)).on(s, services);
}

double areaOf(const Shape& s) { return meshInLocal(s).area(); }

double areaOf(const Ran& ran, uint32_t slot) {
  double sum = 0;
  for (const Shape& s : ran.of(slot)) sum += areaOf(s);
  return sum;
}

TEST(Setback, oneEdgeGivesAStripAndARemainder) {
  const Ran ran = setback(quadShape(10, 6), 2, {"front", "remainder"});
  ASSERT_TRUE(ran.status.ok()) << ran.status.message();
  ASSERT_EQ(ran.of(0).size(), 1u);
  ASSERT_EQ(ran.of(1).size(), 1u);
  EXPECT_EQ(ran.of(0)[0].size, (Vec3{10, 0, 2}));
  EXPECT_EQ(ran.of(0)[0].scope.origin, (Vec3{0, 0, 4}));
  EXPECT_EQ(ran.of(0)[0].geometry.kind, GeometryKind::QuadXz);
  EXPECT_EQ(ran.of(1)[0].size, (Vec3{10, 0, 4}));
  EXPECT_EQ(ran.of(1)[0].geometry.kind, GeometryKind::QuadXz);
}

TEST(Setback, theRemainderDoesNotDependOnItsPlace) {
  const Ran first = setback(quadShape(10, 6), 2, {"remainder", "front"});
  EXPECT_NEAR(areaOf(first, 0), 40, 1e-9);
  EXPECT_NEAR(areaOf(first, 1), 20, 1e-9);
}

TEST(Setback, neighboursOfOneSelectorAreOnePolygon) {
  const Ran ran = setback(quadShape(10, 6), 1, {"front || left", "remainder"});
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_EQ(countsOf(ran.of(0)[0].geometry).edges, 6u);
  EXPECT_NEAR(areaOf(ran, 0), 15, 1e-9);
  // Of two selectors they meet on the line that halves the corner.
  const Ran two = setback(quadShape(10, 6), 1, {"front", "left", "remainder"});
  EXPECT_NEAR(areaOf(two, 0), 9.5, 1e-9);
  EXPECT_NEAR(areaOf(two, 1), 5.5, 1e-9);
  const Ran ring = setback(quadShape(10, 6), 1, {"all"});
  ASSERT_EQ(ring.of(0).size(), 1u);
  EXPECT_EQ(countsOf(ring.of(0)[0].geometry).holes, 1u);
}

TEST(Setback, edgesGetTagsOfTheirPart) {
  FakeServices services;
  const Ran ran =
      Op("setback").args(2).select({"front", "remainder"}).on(quadShape(10, 6), services);
  const auto tags = [&](const Shape& s, std::string_view tag) {
    const MeshRef m = meshInScope(s);
    return std::count_if(m->edgeTags.begin(), m->edgeTags.end(),
                         [&](uint32_t t) { return services.tags().has(t, tag); });
  };
  const Shape strip = ran.of(0)[0], rest = ran.of(1)[0];
  EXPECT_EQ(tags(strip, "setback.front"), 1);
  EXPECT_EQ(tags(strip, "setback.back"), 1);
  EXPECT_EQ(tags(strip, "setback.side"), 2);
  EXPECT_EQ(tags(rest, "setback.back"), 1);
  EXPECT_EQ(tags(rest, "setback.remainder"), 3);
}

TEST(Setback, distancesByEdgeAndMissingOnesAreNone) {
  // The ring of a rectangle: front, right, back, left.
  const Ran ran = setback(quadShape(10, 6), floats({1, 2}), {"all", "remainder"});
  EXPECT_NEAR(areaOf(ran, 1), 8 * 5, 1e-9);
  EXPECT_NEAR(areaOf(ran, 0), 60 - 40, 1e-9);
}

TEST(Setback, indicesWrapAround) {
  EXPECT_NEAR(areaOf(setback(quadShape(10, 6), 1, {"1"}), 0), 6, 1e-9);
  EXPECT_NEAR(areaOf(setback(quadShape(10, 6), 1, {"5"}), 0), 6, 1e-9);
  EXPECT_NEAR(areaOf(setback(quadShape(10, 6), 1, {"-4"}), 0), 10, 1e-9);
}

TEST(Setback, uvSelectorsLookAtTheTexture) {
  Mesh m = *meshInScope(quadShape(10, 6));
  // u runs north, v west.
  m.uvs[0] = {{0, 1}, {0, 0}, {1, 0}, {1, 1}};
  const Shape s = meshShape(m);
  EXPECT_NEAR(areaOf(setback(s, 1, {"uv.left"}), 0), 10, 1e-9);
  EXPECT_NEAR(areaOf(setback(s, 1, {"uv.bottom"}), 0), 6, 1e-9);
  EXPECT_NEAR(areaOf(setback(s, 1, {"uv.uMin"}), 0), 10, 1e-9);
  EXPECT_NEAR(areaOf(setback(s, 1, {"uv.vMax"}), 0), 6, 1e-9);
  EXPECT_NEAR(areaOf(setback(s, 1, {"uv.uMin || uv.uMax"}), 0), 20, 1e-9);
}

TEST(Setback, nothingSelectedLeavesAllAsRemainder) {
  const Ran ran = setback(quadShape(10, 6), 1, {"top", "remainder"});
  EXPECT_TRUE(ran.of(0).empty());
  EXPECT_NEAR(areaOf(ran, 1), 60, 1e-9);
}

TEST(Setback, deeperThanTheFaceLeavesNoRemainder) {
  const Ran ran = setback(quadShape(10, 6), 50, {"front", "remainder"});
  EXPECT_NEAR(areaOf(ran, 0), 60, 1e-9);
  EXPECT_TRUE(ran.of(1).empty());
}

TEST(Setback, combinesThePolygonsOfASelector) {
  const Ran each = setback(quadShape(10, 6), 1, {"front || back"});
  EXPECT_EQ(each.of(0).size(), 2u);
  const Ran all = setback(quadShape(10, 6), 1, {"front || back ="});
  ASSERT_EQ(all.of(0).size(), 1u);
  EXPECT_EQ(countsOf(all.of(0)[0].geometry).faces, 2u);
}

TEST(SetbackToArea, findsTheDistance) {
  FakeServices services;
  const Ran ran =
      Op("setbackToArea").args(100).select({"all", "remainder"}).on(quadShape(20, 20), services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_NEAR(areaOf(ran, 1), 100, 1e-5);
  EXPECT_NEAR(ran.of(1)[0].size.x, 10, 1e-6);
  const Ran front =
      Op("setbackToArea").args(300).select({"front", "remainder"}).on(quadShape(20, 20), services);
  EXPECT_NEAR(areaOf(front, 0), 100, 1e-5);
  const Ran bounded = Op("setbackToArea")
                          .args(100, floats({6, 0, 0, 0}), floats({7, 1, 1, 1}))
                          .select({"all", "remainder"})
                          .on(quadShape(20, 20), services);
  EXPECT_NEAR(areaOf(bounded, 1), 18 * 12, 1e-5);
  const Ran whole =
      Op("setbackToArea").args(1000).select({"all", "remainder"}).on(quadShape(20, 20), services);
  EXPECT_NEAR(areaOf(whole, 1), 400, 1e-9);
}

TEST(ShapeLUO, wingsLieAtTheirSides) {
  FakeServices services;
  const Ran l =
      Op("shapeL").args(2, 3).select({"shape", "remainder"}).on(quadShape(10, 8), services);
  ASSERT_TRUE(l.status.ok());
  ASSERT_EQ(l.of(0).size(), 1u);
  EXPECT_NEAR(areaOf(l, 0), 80 - 7 * 6, 1e-9);
  EXPECT_NEAR(areaOf(l, 1), 42, 1e-9);
  EXPECT_EQ(l.of(1)[0].scope.origin, (Vec3{3, 0, 0}));
  const Ran u =
      Op("shapeU").args(2, 1, 3).select({"shape", "remainder"}).on(quadShape(10, 8), services);
  EXPECT_NEAR(areaOf(u, 1), 6 * 6, 1e-9);
  const Ran o =
      Op("shapeO").args(2, 1, 1, 3).select({"shape", "remainder"}).on(quadShape(10, 8), services);
  EXPECT_NEAR(areaOf(o, 1), 6 * 5, 1e-9);
  EXPECT_EQ(countsOf(o.of(0)[0].geometry).holes, 1u);
}

TEST(Setback, mistakesEmitNothing) {
  const Ran ran = setback(quadShape(1, 1), NAN, {"all", "remainder"});
  EXPECT_STREQ(ran.status.code(), "setback-distance");
  EXPECT_TRUE(ran.children.empty());
  EXPECT_STREQ(setback(emptyShape({1, 1, 1}), 1, {"all"}).status.code(), "no-geometry");
}

TEST(Setback, hostilePolygonsAreTiled) {
  const std::vector<TestPolygon> polygons = hostilePolygons(4, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z), area = areaOf(s);
    for (const double share : {0.01, 0.1}) {
      const Ran ran = setback(s, share * extent, {"front", "2", "left || back", "remainder"});
      if (!ran.status.ok()) {
        ADD_FAILURE() << p.number << " " << ran.status.code();
        continue;
      }
      double sum = 0;
      for (const BlockChild& c : ran.children) {
        const Mesh m = meshInLocal(c.shape);
        ASSERT_TRUE(m.valid()) << p.number;
        EXPECT_GT(m.areaNormal(0).y, 0) << p.number;
        sum += m.area();
      }
      EXPECT_NEAR(sum, area, 1e-6 * extent * extent) << p.number << " " << share;
    }
  }
}

}  // namespace
}  // namespace gable
