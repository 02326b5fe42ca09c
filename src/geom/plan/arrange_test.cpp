// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/arrange.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/hull.h"
#include "geom/region/places.h"

namespace gable {
namespace {

constexpr double kRounding = 2e-4;

Polygon square(double side) { return {{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}; }

double distanceBetween(const Ring& a, const Ring& b) {
  double least = HUGE_VAL;
  for (const Vec2 p : a) least = std::min(least, distanceToBoundary({b, {}}, p));
  for (const Vec2 p : b) least = std::min(least, distanceToBoundary({a, {}}, p));
  return least;
}

// Contract 1, and that rectangles do not lie in each other.
void expectSound(const Polygon& area, const std::vector<Footprint>& footprints,
                 const std::vector<ArrangedPlace>& places, double gap, double edge) {
  ASSERT_EQ(places.size(), footprints.size());
  std::vector<Ring> rings;
  for (size_t i = 0; i < places.size(); ++i) {
    if (!places[i].placed) continue;
    const Ring ring = footprints[i].at(places[i].middle);
    for (const Vec2 p : ring) EXPECT_GE(signedDistance(area, p), edge - kRounding);
    // Nothing of the border within it.
    EXPECT_LT(gable::area(subtract({{ring, {}}}, {area})), 1e-3);
    for (const Ring& other : rings) {
      EXPECT_GE(distanceBetween(ring, other), gap - kRounding);
      EXPECT_LT(gable::area(intersect({{ring, {}}}, {{other, {}}})), 1e-3);
    }
    rings.push_back(ring);
  }
}

TEST(Arrange, aWishThatIsFreeIsMet) {
  const std::vector<Footprint> f = {{4, 6, {20, 30}, 30}, {4, 6, {70, 70}, 0}};
  const auto places = arrange(square(100), f, 1, 1);
  EXPECT_EQ(places[0].middle, (Vec2{20, 30}));
  EXPECT_EQ(places[1].middle, (Vec2{70, 70}));
}

TEST(Arrange, theNearestFreePlaceIsTaken) {
  // Both want the middle; the larger gets it, the other lies beside its shorter way out.
  const std::vector<Footprint> f = {{2, 2, {50, 51}, 0}, {10, 10, {50, 50}, 0}};
  const auto places = arrange(square(100), f, 1, 0);
  ASSERT_TRUE(places[0].placed && places[1].placed);
  EXPECT_EQ(places[1].middle, (Vec2{50, 50}));
  EXPECT_NEAR(places[0].middle.x, 50, 1e-3);
  EXPECT_NEAR(places[0].middle.y, 57, 1e-3);
}

TEST(Arrange, aWishOutsideComesIn) {
  const auto places = arrange(square(100), {{10, 20, {-500, 40}, 0}}, 1, 2);
  ASSERT_TRUE(places[0].placed);
  EXPECT_NEAR(places[0].middle.x, 7, 1e-3);
  EXPECT_NEAR(places[0].middle.y, 40, 1e-3);
}

TEST(Arrange, whatIsTakenStaysFree) {
  const Region taken{{{{40, 0}, {60, 0}, {60, 100}, {40, 100}}, {}}};
  const auto places = arrange(square(100), {{10, 10, {48, 50}, 0}}, 0, 1, taken);
  ASSERT_TRUE(places[0].placed);
  EXPECT_NEAR(places[0].middle.x, 34, 1e-3);
}

TEST(Arrange, whatFitsNowhereIsLeftOut) {
  const auto places =
      arrange(square(10), {{11, 2, {5, 5}, 0}, {0, 2, {5, 5}, 0}, {2, HUGE_VAL, {5, 5}, 0}}, 0, 0);
  for (const ArrangedPlace& p : places) EXPECT_FALSE(p.placed);
}

// A full area: no larger one can be put in afterwards, so none was left out that would have fitted.
TEST(Arrange, fillsTheAreaBeforeItGivesUp) {
  const std::vector<Footprint> f(40, Footprint{20, 20, {50, 50}, 0});
  const auto places = arrange(square(100.01), f, 0, 0);
  size_t placed = 0;
  Region rings;
  for (size_t i = 0; i < f.size(); ++i) {
    if (!places[i].placed) continue;
    ++placed;
    rings.push_back({f[i].at(places[i].middle), {}});
  }
  EXPECT_GE(placed, 9u);
  EXPECT_FALSE(arrange(square(100.01), {{20, 20, {50, 50}, 0}}, 0, 0, rings)[0].placed);
}

TEST(Arrange, keepsItsPromisesOnHostileAreas) {
  const auto cases = corpus::loadCorpus(20);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there";
  size_t placed = 0;
  for (size_t c = 0; c < cases.size(); ++c) {
    Polygon area{cases[c].ring, {}};
    orient(area);
    if (!isValid(area)) continue;
    const Box2 box = bounds(area);
    const double unit = std::sqrt(gable::area(area)) / 10;
    std::vector<Footprint> f;
    for (uint64_t i = 0; i < 6; ++i) {
      const auto draw = [&](uint64_t k, double low, double high) {
        return randomIn(hashCombine(hashCombine(c, i), k), low, high);
      };
      f.push_back({unit * draw(0, 0.3, 1.5),
                   unit * draw(1, 0.3, 1.5),
                   {draw(2, box.min.x, box.max.x), draw(3, box.min.y, box.max.y)},
                   draw(4, 0, 360)});
    }
    const auto places = arrange(area, f, unit / 10, unit / 20);
    for (const ArrangedPlace& p : places) placed += p.placed ? 1 : 0;
    expectSound(area, f, places, unit / 10, unit / 20);
  }
  EXPECT_GT(placed, cases.size());
}

TEST(Jittered, aPointInEachCell) {
  const auto points = scatterJittered(square(100), 10, 1, 0, 1000, 3);
  EXPECT_EQ(points.size(), 100u);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(std::fabs(points[i].x - 5 - 10 * static_cast<double>(i % 10)), 5);
    EXPECT_LE(std::fabs(points[i].y - 5 - 10 * static_cast<double>(i / 10)), 5);
  }
  EXPECT_NE(points, scatterJittered(square(100), 10, 1, 0, 1000, 4));
  EXPECT_EQ(scatterJittered(square(100), 10, 1, 0, 7, 3).size(), 7u);
}

TEST(Jittered, keepsOffTheBorder) {
  const auto cases = corpus::loadCorpus(40);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there";
  size_t found = 0;
  for (const auto& c : cases) {
    Polygon area{c.ring, {}};
    orient(area);
    if (!isValid(area)) continue;
    const double unit = std::sqrt(gable::area(area)) / 20;
    for (const Vec2 p : scatterJittered(area, unit, 0.7, unit / 2, 100000, 1)) {
      EXPECT_GE(signedDistance(area, p), unit / 2 * (1 - 1e-9));
      ++found;
    }
    // Poisson's points keep off each other too.
    const auto apart = scatterPoisson(area, unit, unit / 2, 400, 1);
    for (size_t i = 0; i < apart.size(); ++i) {
      EXPECT_GE(signedDistance(area, apart[i]), unit / 2 * (1 - 1e-9));
      for (size_t k = 0; k < i; ++k) EXPECT_GE(length(apart[i] - apart[k]), unit * (1 - 1e-9));
    }
  }
  EXPECT_GT(found, 100u);
}

}  // namespace
}  // namespace gable
