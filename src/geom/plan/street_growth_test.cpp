// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/street_growth.h"

#include <gtest/gtest.h>

#include "geom/region/hull.h"

namespace gable {
namespace {

Region lShape() { return {{{{0, 0}, {900, 0}, {900, 300}, {400, 300}, {400, 700}, {0, 700}}, {}}}; }

void expectInside(const std::vector<Street>& streets, const Region& area, double beyond) {
  for (const Street& s : streets) {
    EXPECT_GE(s.line.size(), 2u);
    for (const Vec2 p : s.line) {
      EXPECT_TRUE(contains(area[0], p) || distanceToBoundary(area[0], p) < beyond);
    }
  }
}

DirectionField mixedField() {
  DirectionField field;
  field.addGrid({0, 0}, 10, 0);
  field.addRadial({250, 250}, 200);
  field.setNoise(15, 150, 3);
  return field;
}

TEST(GridStreets, runStraightThroughTheArea) {
  GridStreets o;
  o.spacing = 100;
  o.crossSpacing = 150;
  const auto streets = gridStreets(lShape(), o);
  expectInside(streets, lShape(), 1e-6);
  EXPECT_EQ(streets.size(), 8u + 7u);
  o.angle = 33;
  o.irregularity = 0.3;
  expectInside(gridStreets(lShape(), o), lShape(), 1e-6);
}

TEST(RadialStreets, areRingsAndSpokes) {
  RadialStreets o;
  o.center = {200, 200};
  o.irregularity = 0.2;
  const auto streets = radialStreets(lShape(), o);
  expectInside(streets, lShape(), 1e-6);
  EXPECT_GT(streets.size(), 20u);
}

TEST(FieldStreets, stayInTheAreaAndApart) {
  const auto streets = fieldStreets(lShape(), mixedField(), {});
  expectInside(streets, lShape(), 16);
  EXPECT_GT(streets.size(), 12u);
  const StreetPlan plan = planStreets(buildStreetGraph(streets), lShape());
  EXPECT_GT(plan.blocks.size(), 25u);
  double blocks = area(plan.blocks);
  EXPECT_GT(blocks, 0.6 * area(lShape()));
  // Blocks have the size that the spacing asks for, mostly.
  size_t good = 0;
  for (const Polygon& b : plan.blocks) good += area(b) > 1000 && area(b) < 20000;
  EXPECT_GT(good, plan.blocks.size() * 8 / 10);
}

TEST(FieldStreets, areEqualForEqualInputAndChangeWithTheAddress) {
  FieldStreets o;
  const auto a = fieldStreets(lShape(), mixedField(), o),
             b = fieldStreets(lShape(), mixedField(), o);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].line, b[i].line);
  o.address = 9;
  const auto c = fieldStreets(lShape(), mixedField(), o);
  EXPECT_TRUE(a.size() != c.size() || !(a[0].line == c[0].line));
}

TEST(Growth, ofNothingIsNothing) {
  EXPECT_TRUE(gridStreets({}, {}).empty());
  EXPECT_TRUE(radialStreets({}, {}).empty());
  EXPECT_TRUE(fieldStreets({}, mixedField(), {}).empty());
  EXPECT_TRUE(fieldStreets(lShape(), DirectionField(), {}).empty());
}

TEST(DirectionField, followsItsSources) {
  DirectionField field;
  field.addRadial({0, 0}, 0);
  const Vec2 d = field.direction({10, 0});
  EXPECT_NEAR(std::fabs(d.y), 1, 1e-9);
  EXPECT_EQ(field.direction({0, 0}), Vec2{});
  DirectionField grid;
  grid.addGrid({}, 30, 0);
  EXPECT_NEAR(std::fabs(dot(grid.direction({5, 7}), {cos(0.5235987755982988), 0.5})), 1, 1e-9);
}

}  // namespace
}  // namespace gable
