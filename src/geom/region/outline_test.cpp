// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/hull.h"

namespace gable {
namespace {

TEST(Outline, aRingAroundASquareHasItsArea) {
  const Region square = {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
  const Region ring = bandAround(square, 1, 3, OffsetJoin::Miter);
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_EQ(ring[0].holes.size(), 1u);
  EXPECT_NEAR(area(ring), 16 * 16 - 12 * 12, 1e-3);
  EXPECT_NEAR(area(bandAround(square, 3, 1, OffsetJoin::Miter)), area(ring), 1e-9);
  EXPECT_NEAR(area(bandAround(square, -2, 0, OffsetJoin::Miter)), 100 - 36, 1e-3);
  EXPECT_LT(area(bandAround(square, 1, 3, OffsetJoin::Round)), area(ring));
  EXPECT_TRUE(bandAround(square, -7, -6, OffsetJoin::Miter).empty());
}

TEST(Outline, ringsAroundAnythingAreValidAndAdjoin) {
  const auto corpus = corpus::loadCorpus(16);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  for (size_t i = 0; i < corpus.size(); ++i) {
    Polygon p = corpus::withHoles(corpus[i].ring, i);
    orient(p);
    if (!isValid(p)) continue;
    const double d = std::sqrt(area(p)) / 15;
    const Region near = bandAround({p}, 0, d, OffsetJoin::Round);
    const Region far = bandAround({p}, d, 2 * d, OffsetJoin::Round);
    const Region both = bandAround({p}, 0, 2 * d, OffsetJoin::Round);
    EXPECT_TRUE(isValid(near)) << "case " << i;
    EXPECT_NEAR(area(near) + area(far), area(both), 1e-3 * area(both)) << "case " << i;
    EXPECT_NEAR(area(intersect(near, {p})), 0, 1e-3 * area(p)) << "case " << i;
  }
}

TEST(Outline, roughenedOutlinesStayNearAndAreValid) {
  const auto corpus = corpus::loadCorpus(16);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t changed = 0;
  for (size_t i = 0; i < corpus.size(); ++i) {
    Polygon p = corpus::withHoles(corpus[i].ring, i);
    orient(p);
    if (!isValid(p)) continue;
    const double size = std::sqrt(area(p)), amount = size / 40;
    const Region r = roughened(p, amount, size / 6, i);
    EXPECT_TRUE(isValid(r)) << "case " << i;
    EXPECT_EQ(area(r), area(roughened(p, amount, size / 6, i)));
    for (const Polygon& q : r) {
      for (const Vec2 at : q.outer) EXPECT_LT(distanceToBoundary(p, at), amount * 1.01 + 1e-3);
    }
    if (std::fabs(area(r) - area(p)) > 1e-4 * area(p)) ++changed;
  }
  EXPECT_GT(changed, corpus.size() / 2);
}

TEST(Outline, hullsWithoutShortEdgesHoldTheHull) {
  const auto corpus = corpus::loadCorpus(4);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t fewer = 0;
  for (size_t i = 0; i < corpus.size(); ++i) {
    const Ring hull = convexHull(corpus[i].ring);
    const double shortest = std::sqrt(std::fabs(signedArea(hull))) / 4;
    const Ring wide = withoutShortEdges(hull, shortest);
    ASSERT_GE(wide.size(), 3u);
    EXPECT_TRUE(isSimple(wide)) << "case " << i;
    Polygon grown{wide, {}};
    for (const Polygon& q : offset({grown}, 1e-3 * shortest)) grown = q;
    for (const Vec2 p : hull) EXPECT_TRUE(contains(grown, p)) << "case " << i;
    EXPECT_LE(wide.size(), hull.size());
    EXPECT_LT(signedArea(wide), 3 * std::fabs(signedArea(hull)));
    if (wide.size() < hull.size()) ++fewer;
  }
  EXPECT_GT(fewer, corpus.size() / 2);
  EXPECT_EQ(withoutShortEdges({{0, 0}, {10, 0}, {10, 9}, {9, 10}, {0, 10}}, 3).size(), 4u);
}

TEST(Outline, anotherAddressGivesAnotherOutline) {
  const Polygon square{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {}};
  EXPECT_NE(area(roughened(square, 3, 20, 1)), area(roughened(square, 3, 20, 2)));
  EXPECT_LE(roughened(square, 3, 20, 1)[0].outer.size(), roughenedSize(square, 20));
}

}  // namespace
}  // namespace gable
