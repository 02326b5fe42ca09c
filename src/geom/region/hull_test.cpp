// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/hull.h"

#include <gtest/gtest.h>

#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "math/predicates.h"

namespace gable {
namespace {

TEST(Hull, knownPoints) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}, {0, 0}};
  EXPECT_EQ(convexHull(points), (Ring{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(convexHull(std::vector<Vec2>{{1, 1}, {0, 0}, {2, 2}}).size(), 2u);
  EXPECT_TRUE(convexHull(std::vector<Vec2>{}).empty());
}

TEST(Hull, smallestRectOfATurnedRectangleIsItself) {
  const OrientedRect r{{3, 4}, {0.8, 0.6}, 5, 2};
  const OrientedRect found = smallestRect(r.ring());
  EXPECT_NEAR(found.area(), 10, 1e-12);
  EXPECT_NEAR(std::fabs(dot(found.x, r.x)) + std::fabs(dot(found.x, r.y())), 1, 1e-12);
  EXPECT_DOUBLE_EQ(smallestRect(std::vector<Vec2>{{0, 0}, {3, 4}}).width, 5);
  EXPECT_DOUBLE_EQ(smallestRect(std::vector<Vec2>{{2, 2}}).area(), 0);
}

TEST(Hull, distances) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}};
  EXPECT_DOUBLE_EQ(signedDistance(p, {0.5, 2}), 0.5);
  EXPECT_DOUBLE_EQ(signedDistance(p, {2, 2}), -1);
  EXPECT_DOUBLE_EQ(signedDistance(p, {7, 8}), -5);
}

TEST(Hull, corpusHullsContainAllAndRectsTouchTheLeast) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  for (size_t i = 0; i < cases.size(); ++i) {
    const Ring hull = convexHull(cases[i].ring);
    for (size_t k = 0; k < hull.size(); ++k) {
      const Vec2 a = hull[k], b = hull[(k + 1) % hull.size()];
      for (const Vec2 p : cases[i].ring) ASSERT_GE(orientation(a, b, p), 0) << i;
    }
    const OrientedRect best = smallestRect(cases[i].ring);
    const double slack = 1e-9 * (best.width + best.height);
    for (const Vec2 p : cases[i].ring) {
      const Vec2 d = p - best.origin;
      ASSERT_GE(dot(d, best.x), -slack) << i;
      ASSERT_LE(dot(d, best.x), best.width + slack) << i;
      ASSERT_GE(dot(d, best.y()), -slack) << i;
      ASSERT_LE(dot(d, best.y()), best.height + slack) << i;
    }
    // No side of the hull does better.
    for (size_t k = 0; k < hull.size(); ++k) {
      const Vec2 x = normalized(hull[(k + 1) % hull.size()] - hull[k]);
      Box2 box;
      for (const Vec2 p : hull) box.include({dot(p - hull[0], x), cross(x, p - hull[0])});
      ASSERT_GE(box.size().x * box.size().y, best.area() * (1 - 1e-9)) << i;
    }
  }
}

}  // namespace
}  // namespace gable
