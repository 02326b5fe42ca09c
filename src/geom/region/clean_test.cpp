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

}  // namespace
}  // namespace gable
