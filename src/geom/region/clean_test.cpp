// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/clean.h"

#include <gtest/gtest.h>

#include "geom/region/corpus.h"

namespace gable {
namespace {

const Ring kSquare = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST(Clean, dropsDuplicatesAndSpikes) {
  Ring r = {{0, 0}, {0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 1e-9}};
  dropDuplicates(r, 1e-6);
  EXPECT_EQ(r, kSquare);
  Ring flat = {{0, 0}, {4, 0}, {2, 0}};
  dropDuplicates(flat, 0);
  EXPECT_TRUE(flat.empty());
}

TEST(Clean, dropsCollinearVerticesAlsoAtTheSeam) {
  Ring r = {{2, 0}, {4, 0}, {4, 1}, {4, 4}, {0, 4}, {0, 0}};
  dropCollinear(r, 0);
  EXPECT_EQ(r.size(), 4u);
  EXPECT_DOUBLE_EQ(signedArea(r), 16);
}

TEST(Clean, aFineCurveKeepsItsShape) {
  Ring circle;
  for (int i = 0; i < 3600; ++i) circle.push_back({cosDeg(i * 0.1), sinDeg(i * 0.1)});
  Ring r = circle;
  dropCollinear(r, 1e-3);
  EXPECT_LT(r.size(), 200u);
  EXPECT_NEAR(signedArea(r), kPi, 0.005);
}

TEST(Clean, simpleMeansNoContact) {
  EXPECT_TRUE(isSimple(kSquare));
  EXPECT_FALSE(isSimple({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
  EXPECT_FALSE(isSimple({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));
  EXPECT_FALSE(isSimple({{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}}));
  EXPECT_FALSE(isSimple({{0, 0}, {1, 0}}));
}

TEST(Clean, validityKnowsOrientationNestingAndTouch) {
  const Ring hole = {{1, 1}, {1, 2}, {2, 2}, {2, 1}};
  EXPECT_TRUE(isValid(Polygon{kSquare, {hole}}));
  EXPECT_FALSE(isValid(Polygon{kSquare, {Ring(hole.rbegin(), hole.rend())}}));
  const Ring outside = {{5, 1}, {5, 2}, {6, 2}, {6, 1}};
  EXPECT_FALSE(isValid(Polygon{kSquare, {outside}}));
  const Ring touching = {{0, 2}, {1, 3}, {1, 1}};
  EXPECT_TRUE(isValid(Polygon{kSquare, {touching}}));
  const Ring alongTheEdge = {{0, 1}, {0, 2}, {1, 2}};
  EXPECT_FALSE(isValid(Polygon{kSquare, {alongTheEdge}}));
  EXPECT_FALSE(isValid(Polygon{kSquare, {hole, hole}}));
  const Ring inner = {{1.2, 1.2}, {1.2, 1.4}, {1.4, 1.4}};
  EXPECT_FALSE(isValid(Polygon{kSquare, {hole, inner}}));
  EXPECT_FALSE(isValid(Region{{kSquare, {}}, {{{1, 1}, {2, 1}, {2, 2}}, {}}}));
}

TEST(Clean, weldClosesNearTouches) {
  std::vector<Ring> rings = {kSquare, {{4 + 1e-7, 1}, {6, 1}, {6, 3}, {4 + 1e-7, 3}}};
  EXPECT_TRUE(weld(rings, 1e-6));
  // The square's right edge leads through both vertices of the second ring.
  EXPECT_EQ(rings[0].size(), 6u);
  EXPECT_FALSE(weld(rings, 1e-6));
}

TEST(Clean, repeatsAreTakenApart) {
  std::vector<Ring> rings = {{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 1}, {0, 1}}};
  splitAtRepeats(rings);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_TRUE(isSimple(rings[0]));
  EXPECT_TRUE(isSimple(rings[1]));
  EXPECT_DOUBLE_EQ(signedArea(rings[0]) + signedArea(rings[1]), 1.5);
}

TEST(Clean, tracesEdgesToTheirSources) {
  const Ring part = {{0, 0}, {2, 0}, {2, 4}, {0, 4}};
  const std::vector<uint32_t> from = traceEdges({part}, {kSquare}, 1e-6);
  EXPECT_EQ(from, (std::vector<uint32_t>{0, kNoEdge, 2, 3}));
  const Ring inset = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_EQ(traceEdges({inset}, {kSquare}, 1e-6, 1), (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST(Clean, corpusPolygonsAreValidAndStaySoWithHoles) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  for (size_t i = 0; i < cases.size(); ++i) {
    ASSERT_TRUE(isSimple(cases[i].ring)) << i;
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    ASSERT_TRUE(isValid(p)) << i;
    Region r{p};
    clean(r, 0);
    ASSERT_EQ(r.size(), 1u) << i;
    ASSERT_NEAR(area(r), area(p), 1e-12 * std::fabs(signedArea(p.outer))) << i;
  }
}

// What is clear stays valid when every point moves by less than half the distance.
TEST(NestClear, holdsWhenPointsMove) {
  const auto cases = corpus::loadCorpus(9);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t clear = 0, valid = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    std::vector<Ring> rings{p.outer};
    rings.insert(rings.end(), p.holes.begin(), p.holes.end());
    const double distance = 1e-4 * length(bounds(p).size());
    Region region;
    const bool said = nestClear(rings, distance, region);
    clear += said;
    valid += isValid(p);
    if (!said) continue;
    EXPECT_TRUE(isValid(region)) << i;
    for (uint64_t turn = 0; turn < 4; ++turn) {
      uint64_t k = 0;
      Region moved = region;
      const auto shake = [&](Ring& r) {
        for (Vec2& v : r) {
          const double a = 360 * randomUnit(hashCombine(hashCombine(i, turn), k++));
          v = v + Vec2{cosDeg(a), sinDeg(a)} * (0.499 * distance);
        }
      };
      for (Polygon& q : moved) {
        shake(q.outer);
        for (Ring& h : q.holes) shake(h);
      }
      EXPECT_TRUE(isValid(moved)) << i;
    }
  }
  EXPECT_GT(clear, valid / 2);
}

TEST(NestClear, seesWhatIsInDoubt) {
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  Region out;
  EXPECT_TRUE(nestClear({square}, 1, out));
  EXPECT_FALSE(nestClear({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}, 1, out));
  // A vertex near an edge, two near each other, a spike, rings near and in each other.
  EXPECT_FALSE(nestClear({{{0, 0}, {10, 0}, {10, 10}, {5, 0.5}, {0, 10}}}, 1, out));
  EXPECT_FALSE(nestClear({{{0, 0}, {10, 0}, {10.5, 0.5}, {10, 10}, {0, 10}}}, 1, out));
  EXPECT_FALSE(nestClear({{{0, 0}, {10, 0}, {20, 0.3}, {10, 0.6}, {10, 10}, {0, 10}}}, 1, out));
  EXPECT_FALSE(nestClear({square, {{10.5, 0}, {20, 0}, {20, 10}}}, 1, out));
  EXPECT_FALSE(nestClear({square, {{3, 3}, {6, 3}, {6, 6}}}, 1, out));
  EXPECT_FALSE(nestClear({square, {{3, 3}, {3, 3.5}, {6, 3}}}, 1, out));
  EXPECT_FALSE(nestClear({{{20, 0}, {20, 10}, {30, 0}}}, 1, out));
  EXPECT_TRUE(nestClear({square, {{3, 3}, {6, 6}, {6, 3}}}, 1, out));
  EXPECT_EQ(out.size(), 1u);
}

}  // namespace
}  // namespace gable
