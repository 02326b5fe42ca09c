// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/region.h"

#include <gtest/gtest.h>

#include "geom/region/corpus.h"
#include "geom/region/locator.h"

namespace gable {
namespace {

Ring square(double x, double y, double s) {
  return {{x, y}, {x + s, y}, {x + s, y + s}, {x, y + s}};
}

TEST(Region, areaKeepsItsDigitsAtMapCoordinates) {
  EXPECT_DOUBLE_EQ(signedArea(square(458000.25, 5428000.5, 0.5)), 0.25);
  Ring cw = square(0, 0, 2);
  std::reverse(cw.begin(), cw.end());
  EXPECT_DOUBLE_EQ(signedArea(cw), -4);
}

TEST(Region, areaSubtractsHoles) {
  Polygon p{square(0, 0, 4), {square(1, 1, 1)}};
  EXPECT_DOUBLE_EQ(area(p), 15);
  orient(p);
  EXPECT_GT(signedArea(p.outer), 0);
  EXPECT_LT(signedArea(p.holes[0]), 0);
  EXPECT_DOUBLE_EQ(area(Region{p, {square(10, 0, 1), {}}}), 16);
  EXPECT_DOUBLE_EQ(perimeter(p.outer), 16);
  EXPECT_EQ(bounds(p).max, (Vec2{4, 4}));
}

TEST(Region, containsCountsTheBoundaryIn) {
  Polygon p{square(0, 0, 4), {square(1, 1, 1)}};
  orient(p);
  EXPECT_TRUE(contains(p, {0.5, 0.5}));
  EXPECT_FALSE(contains(p, {1.5, 1.5}));
  EXPECT_FALSE(contains(p, {5, 1}));
  EXPECT_FALSE(contains(p, {-1, 4}));
  for (const Vec2 b :
       {Vec2{0, 0}, Vec2{4, 2}, Vec2{2, 4}, Vec2{1, 1}, Vec2{1.5, 2}, Vec2{2, 1.5}}) {
    EXPECT_TRUE(contains(p, b)) << b.x << " " << b.y;
  }
}

TEST(Region, rayThroughVerticesCountsOnce) {
  const Polygon p{{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 3}, {0, 4}}, {}};
  EXPECT_TRUE(contains(p, {1, 2}));
  EXPECT_FALSE(contains(p, {-1, 2}));
  EXPECT_FALSE(contains(p, {-1, 0}));
  EXPECT_FALSE(contains(p, {2, 0}));
}

TEST(Locator, saysWhatLocateSays) {
  const auto cases = corpus::loadCorpus(29);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const Locator locator(p);
    const Box2 box = bounds(p);
    const double slack = 1e-3 * length(box.size());
    std::vector<Vec2> points = p.outer;
    for (uint64_t k = 0; k < 100; ++k) {
      const uint64_t at = hashCombine(i, k);
      points.push_back({randomIn(hashCombine(at, 0), box.min.x - slack, box.max.x + slack),
                        randomIn(hashCombine(at, 1), box.min.y - slack, box.max.y + slack)});
      // At the height of a vertex.
      points.push_back({points.back().x, p.outer[k % p.outer.size()].y});
    }
    for (size_t k = 0; k < p.outer.size(); ++k) {
      points.push_back((p.outer[k] + p.outer[(k + 1) % p.outer.size()]) * 0.5);
    }
    size_t sure = 0;
    for (const Vec2 v : points) {
      EXPECT_EQ(locator.at(v), locate(p, v)) << i;
      if (!locator.surelyOutside(v, slack)) continue;
      ++sure;
      for (const Vec2 d : {Vec2{slack, 0}, Vec2{0, slack}, Vec2{-slack, 0}, Vec2{0, -slack}}) {
        EXPECT_EQ(locate(p, v + d * 0.99), Where::Outside) << i;
      }
    }
    EXPECT_GT(sure, 0u) << i;
  }
}

}  // namespace
}  // namespace gable
