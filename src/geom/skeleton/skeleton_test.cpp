// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/skeleton/skeleton.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geom/region/corpus.h"
#include "geom/skeleton/skeleton_testing.h"
#include "math/trig.h"

namespace gable {
namespace {

using namespace skeleton_testing;

const Ring kRectangle{{0, 0}, {10, 0}, {10, 6}, {0, 6}};
const Ring kTee{{0, 0}, {12, 0}, {12, 7}, {8, 7}, {8, 12}, {4, 12}, {4, 7}, {0, 7}};

Ring regular(int n, double radius, Vec2 center = {}) {
  Ring r;
  for (int i = 0; i < n; ++i) {
    r.push_back(center + Vec2{cosDeg(360.0 * i / n), sinDeg(360.0 * i / n)} * radius);
  }
  return r;
}

Ring turned(const Ring& r, double degrees, Vec2 by = {}) {
  Ring out;
  for (const Vec2 p : r) {
    out.push_back(Vec2{p.x * cosDeg(degrees) - p.y * sinDeg(degrees),
                       p.x * sinDeg(degrees) + p.y * cosDeg(degrees)} +
                  by);
  }
  return out;
}

size_t innerVertices(const Skeleton& s) { return s.vertices.size() - s.inputCount; }

TEST(Skeleton, rectangleHasOneRidge) {
  const Polygon p{kRectangle, {}};
  const Skeleton s = buildSkeleton(p);
  ASSERT_EQ(broken(p, s), "");
  EXPECT_EQ(innerVertices(s), 2u);
  EXPECT_DOUBLE_EQ(s.maxHeight(), 3);
  EXPECT_EQ(s.faces[0].loop.size(), 4u);
  EXPECT_EQ(s.faces[1].loop.size(), 3u);
}

TEST(Skeleton, regularPolygonMeetsInOnePoint) {
  for (const int n : {3, 4, 5, 6, 7, 12, 64}) {
    const Polygon p{regular(n, 7, {458080, 5428000}), {}};
    const Skeleton s = buildSkeleton(p);
    ASSERT_EQ(broken(p, s), "") << n;
    EXPECT_EQ(innerVertices(s), 1u) << n;
    EXPECT_NEAR(s.maxHeight(), 7 * cosDeg(180.0 / n), 1e-6) << n;
  }
}

TEST(Skeleton, symmetricShapeGivesSymmetricFaces) {
  // A cross: its four arms are alike, and so are both sides of each.
  const Polygon p{{{1, -5},
                   {1, -1},
                   {5, -1},
                   {5, 1},
                   {1, 1},
                   {1, 5},
                   {-1, 5},
                   {-1, 1},
                   {-5, 1},
                   {-5, -1},
                   {-1, -1},
                   {-1, -5}},
                  {}};
  const Skeleton s = buildSkeleton(p);
  ASSERT_EQ(broken(p, s), "");
  EXPECT_EQ(innerVertices(s), 5u);
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(signedArea(planOf(s, s.faces[i].loop)),
                signedArea(planOf(s, s.faces[(i + 3) % 12].loop)), 1e-12);
  }
}

TEST(Skeleton, wingsInOneLinePartAtARightAngle) {
  for (const double degrees : {0.0, 90.0, 31.0, 17.3}) {
    const Polygon p{turned(kTee, degrees, {100, 200}), {}};
    const Skeleton s = buildSkeleton(p);
    ASSERT_EQ(broken(p, s), "") << degrees;
    EXPECT_EQ(openEdges(s), 0u) << degrees;
    EXPECT_NEAR(signedArea(planOf(s, s.faces[2].loop)), signedArea(planOf(s, s.faces[6].loop)),
                1e-6);
    // The hollow between the wing and the body ends in the wing's own ridge.
    EXPECT_EQ(s.faces[3].loop.size(), 4u) << degrees;
  }
}

TEST(Skeleton, collinearPointsSplitAFaceOnly) {
  const Polygon p{{{0, 0}, {3, 0}, {7, 0}, {10, 0}, {10, 6}, {5, 6}, {0, 6}}, {}};
  const Skeleton s = buildSkeleton(p);
  ASSERT_EQ(broken(p, s), "");
  EXPECT_EQ(openEdges(s), 0u);
  EXPECT_NEAR(signedArea(planOf(s, s.faces[1].loop)), 4 * 3, 1e-12);
  EXPECT_DOUBLE_EQ(s.maxHeight(), 3);
}

TEST(Skeleton, courtyardHasARidgeAllRound) {
  const Polygon p{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{{6, 6}, {6, 14}, {14, 14}, {14, 6}}}};
  const Skeleton s = buildSkeleton(p);
  ASSERT_EQ(broken(p, s), "");
  EXPECT_DOUBLE_EQ(s.maxHeight(), 3);
  EXPECT_EQ(openEdges(s), 0u);
}

TEST(Skeleton, weightsSetTheSlopes) {
  const Polygon p{kRectangle, {}};
  const std::vector<std::vector<double>> w{{1, 1, 2, 1}};
  const Skeleton s = buildSkeleton(p, w);
  ASSERT_EQ(broken(p, s, w), "");
  EXPECT_NEAR(s.maxHeight(), 2, 1e-12);
}

TEST(Skeleton, edgeOfWeightNothingStandsUpright) {
  const Polygon p{kRectangle, {}};
  const std::vector<std::vector<double>> w{{1, 0, 1, 0}};
  const Skeleton s = buildSkeleton(p, w);
  ASSERT_TRUE(s.status.ok());
  EXPECT_NEAR(signedArea(planOf(s, s.faces[0].loop)), 30, 1e-9);
  ASSERT_EQ(s.faces[1].loop.size(), 3u);
  EXPECT_NEAR(s.vertices[s.faces[1].loop[2]].xy.x, 10, 1e-12);
  EXPECT_NEAR(s.vertices[s.faces[1].loop[2]].height, 3, 1e-12);
}

TEST(Skeleton, stepStandsBetweenCollinearEdgesOfTwoWeights) {
  const Polygon p{{{0, 0}, {5, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};
  const std::vector<std::vector<double>> w{{1, 2, 1, 1, 1}};
  const Skeleton s = buildSkeleton(p, w);
  ASSERT_EQ(broken(p, s, w), "");
  ASSERT_EQ(s.faces.size(), 6u);
  EXPECT_TRUE(s.faces[5].step);
  for (const uint32_t v : s.faces[5].loop) EXPECT_NEAR(s.vertices[v].xy.x, 5, 1e-9);
}

TEST(Skeleton, maxHeightCutsTheRoofOff) {
  const Polygon p{kTee, {}};
  const Skeleton s = buildSkeleton(p, {}, 1);
  ASSERT_EQ(broken(p, s, {}, 1), "");
  EXPECT_DOUBLE_EQ(s.maxHeight(), 1);
  double sum = 0;
  for (const SkeletonFace& f : s.faces) sum += signedArea(planOf(s, f.loop));
  // What is left is the tee set back by one: 10 x 5 and 2 x 5.
  EXPECT_NEAR(sum, area(p) - 60, 1e-9);
}

TEST(Skeleton, millimetresInKilometresSurvive) {
  const Polygon p{{{0, 0},
                   {10000, 0},
                   {10000, 8000},
                   {5000.001, 8000},
                   {5000.001, 7999.999},
                   {5000, 7999.999},
                   {5000, 8000},
                   {0, 8000}},
                  {}};
  const Skeleton s = buildSkeleton(p);
  EXPECT_EQ(broken(p, s), "");
}

TEST(Skeleton, refusesWhatIsNoPolygon) {
  EXPECT_STREQ(buildSkeleton({}).status.code(), "skeleton-input");
  EXPECT_STREQ(buildSkeleton({{{0, 0}, {1, 0}, {2, 0}}, {}}).status.code(), "skeleton-input");
  EXPECT_STREQ(buildSkeleton({{{0, 0}, {0, 1}, {1, 0}}, {}}).status.code(), "skeleton-input");
  EXPECT_STREQ(buildSkeleton({{{0, 0}, {1, 0}, {1, NAN}}, {}}).status.code(), "skeleton-input");
  const std::vector<std::vector<double>> still{{0, 0, 0, 0}}, bad{{1, -1, 1, 1}}, few{{1, 1}};
  EXPECT_STREQ(buildSkeleton({kRectangle, {}}, still).status.code(), "skeleton-unbounded");
  EXPECT_STREQ(buildSkeleton({kRectangle, {}}, bad).status.code(), "skeleton-input");
  EXPECT_STREQ(buildSkeleton({kRectangle, {}}, few).status.code(), "skeleton-input");
}

TEST(Skeleton, ringsMayTouch) {
  const Ring square{{0, 0}, {20, 0}, {20, 20}, {0, 20}};
  const Polygon cases[] = {
      {square, {{{10, 0}, {5, 5}, {15, 5}}}},
      {square, {{{0, 0}, {3, 8}, {8, 3}}}},
      {square, {{{10, 10}, {5, 12}, {12, 16}}, {{10, 10}, {12, 5}, {5, 5}}}},
      {square, {{{5, 0}, {5, 5}, {10, 5}, {10, 0}}}},
      {square, {{{5, 5}, {5, 10}, {10, 10}, {10, 5}}, {{10, 6}, {10, 12}, {15, 12}, {15, 6}}}},
      {{{0, 0}, {10, 0}, {10, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 10}, {0, 10}}, {}},
      {{{0, 0}, {20, 0}, {20, 20}, {12, 20}, {10, 0}, {8, 20}, {0, 20}}, {}},
  };
  for (const Polygon& p : cases) {
    const Skeleton s = buildSkeleton(p);
    EXPECT_EQ(broken(p, s), "") << &p - cases;
    EXPECT_EQ(openEdges(s), 0u) << &p - cases;
  }
}

// A hole begins at a corner of the outline, so that the polygon is one strip wound to a loop. It
// was swept as if the two did not meet: a hole within the outline's set-back part.
TEST(Skeleton, aHoleAtACornerPartsWhatIsLeft) {
  const Vec2 corner{18.553168047, -45.373396884};
  const Polygon p{{{25, -4}, corner, {27, -100}}, {{corner, {25, -32}, {19, -45}}}};
  const std::vector<std::vector<double>> weights{{1.6, 1.6, 1.6}, {1.6, 1.6, 1.6}};
  const Skeleton s = buildSkeleton(p, weights, 1);
  ASSERT_EQ(broken(p, s, weights, 1), "");
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (const SkeletonFace& f : s.faces) {
    for (size_t i = 0; i < f.loop.size(); ++i) {
      edges.emplace_back(s.vertices[f.loop[i]].xy, s.vertices[f.loop[(i + 1) % f.loop.size()]].xy);
    }
  }
  for (size_t i = 0; i < edges.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(
          crossClearly(edges[i].first, edges[i].second, edges[j].first, edges[j].second, 1e-6))
          << i << ' ' << j;
    }
  }
}

TEST(Skeleton, nearlyParallelWallsCollapseTogether) {
  // A comb, turned so that its teeth are parallel but for rounding.
  Ring comb;
  for (int i = 0; i < 150; ++i) {
    const double x = 2.0 * i;
    for (const Vec2 v : {Vec2{x, 0}, {x + 1, 0}, {x + 1, 20}, {x + 2, 20}}) comb.push_back(v);
  }
  comb.push_back({300, 30});
  comb.push_back({0, 30});
  const Polygon p{turned(comb, 17.2), {}};
  const Skeleton s = buildSkeleton(p);
  EXPECT_EQ(broken(p, s), "");
  EXPECT_EQ(openEdges(s), 0u);
}

TEST(Skeleton, crossingPolygonsEndWithoutACrash) {
  // Random rings cross themselves; any status will do as long as there is an end.
  size_t refused = 0;
  for (uint64_t k = 0; k < 300; ++k) {
    Polygon p;
    for (uint64_t i = 0; i < 4 + k % 24; ++i) {
      const uint64_t at = hashCombine(k, i);
      // Few distinct values make for touching, repeated and collinear points.
      p.outer.push_back({std::floor(randomIn(hashCombine(at, 0), 0, 6)),
                         std::floor(randomIn(hashCombine(at, 1), 0, 6))});
    }
    const Skeleton s = buildSkeleton(p);
    refused += s.status.ok() ? 0 : 1;
    for (const SkeletonFace& f : s.faces) {
      for (const uint32_t v : f.loop) ASSERT_LT(v, s.vertices.size());
    }
  }
  EXPECT_GT(refused, 0u);
}

TEST(Skeleton, repeatedPointsAndSpikesAreTakenOut) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 0}, {10, 6}, {5, 6}, {5, 9}, {5, 6}, {0, 6}}, {}};
  const Skeleton s = buildSkeleton(p);
  ASSERT_TRUE(s.status.ok());
  EXPECT_DOUBLE_EQ(s.maxHeight(), 3);
}

TEST(Skeleton, fiveThousandCornersAreNoTrouble) {
  Polygon p;
  for (uint64_t i = 0; i < 5000; ++i) {
    const double angle = 360.0 * static_cast<double>(i) / 5000;
    p.outer.push_back(Vec2{cosDeg(angle), sinDeg(angle)} * randomIn(mix64(i + 1), 70, 100));
  }
  const Skeleton s = buildSkeleton(p);
  EXPECT_EQ(broken(p, s), "");
  EXPECT_EQ(openEdges(s), 0u);
}

TEST(Skeleton, outOfTheWayNumbersAreNoTrouble) {
  for (const double scale : {1e-100, 1e-9, 1.0, 1e9, 1e140}) {
    Polygon p{kTee, {}};
    for (Vec2& v : p.outer) v = v * scale;
    EXPECT_EQ(broken(p, buildSkeleton(p)), "") << scale;
    for (const double w : {1e-300, 1e-6, 1e6, 1e300}) {
      for (const double h : {1e-300, 1e-12, 1e300}) {
        const std::vector<std::vector<double>> weights{{w, 1, 1, 1, 1, 1, 1, w}};
        const Skeleton s = buildSkeleton(p, weights, h);
        for (const SkeletonVertex& v : s.vertices) EXPECT_TRUE(std::isfinite(v.height));
      }
    }
  }
}

TEST(Skeleton, uprightNeighboursInOneLineShareTheirTop) {
  const Polygon p{{{0, 0}, {4, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};
  const std::vector<std::vector<double>> w{{0, 0, 1, 1, 1}};
  const Skeleton s = buildSkeleton(p, w, 2);
  ASSERT_EQ(broken(p, s, w, 2), "");
  EXPECT_EQ(s.faces[0].loop.size(), 4u);
  EXPECT_EQ(s.faces[1].loop.size(), 4u);
}

TEST(Skeleton, groundThatNothingSweepsIsUnbounded) {
  // The one moving edge starts in a funnel and is gone where its neighbours meet.
  const Polygon p{{{0, 0}, {10, 0}, {10, 10}, {6, 4}, {4, 4}, {0, 10}}, {}};
  const std::vector<std::vector<double>> w{{0, 0, 0, 1, 0, 0}};
  const Skeleton s = buildSkeleton(p, w);
  EXPECT_TRUE(s.status.ok() || std::string(s.status.code()) == "skeleton-unbounded");
  EXPECT_TRUE(buildSkeleton(p, w, 1).status.ok());
}

/// Vertices at the top where the faces' upper borders do not go on, and borders below the top.
size_t brokenTops(const Skeleton& s, double top) {
  std::set<std::pair<uint32_t, uint32_t>> halves;
  for (const SkeletonFace& f : s.faces) {
    const auto add = [&](const std::vector<uint32_t>& l) {
      for (size_t i = 0; i < l.size(); ++i) halves.insert({l[i], l[(i + 1) % l.size()]});
    };
    add(f.loop);
    for (const auto& h : f.holes) add(h);
  }
  size_t wrong = 0;
  std::map<uint32_t, int> balance;
  for (const auto& [a, b] : halves) {
    if ((a < s.inputCount && b < s.inputCount) || halves.count({b, a}) != 0) continue;
    if (std::abs(s.vertices[a].height - top) + std::abs(s.vertices[b].height - top) > 1e-9) ++wrong;
    ++balance[a];
    --balance[b];
  }
  for (const auto& [v, b] : balance) wrong += b != 0 ? 1 : 0;
  return wrong;
}

TEST(SkeletonSetback, everyPolygonIsLeftWithClosedRings) {
  const auto cases = corpus::loadCorpus(2);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there (GABLE_SHARED)";
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = i % 2 ? corpus::withHoles(cases[i].ring, i) : Polygon{cases[i].ring, {}};
    // Two edges of five move, by three hundredths of the extent.
    auto w = randomWeights(p, i);
    const double reach = 0.03 * length(bounds(p).size());
    for (auto& ring : w) {
      for (double& v : ring) v = v < 1.1 ? reach : 0;
    }
    w[0][0] = reach;
    const Skeleton s = buildSkeleton(p, w, 1);
    ASSERT_EQ(broken(p, s, w, 1), "") << i;
    ASSERT_EQ(brokenTops(s, 1), 0u) << i;
  }
}

class SkeletonCorpus : public testing::TestWithParam<std::pair<bool, bool>> {};

TEST_P(SkeletonCorpus, everyPolygonIsTiledByItsFaces) {
  const auto [holes, weighted] = GetParam();
  const auto cases = corpus::loadCorpus(weighted ? 2 : 1);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there (GABLE_SHARED)";
  size_t good = 0;
  std::string first;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = holes ? corpus::withHoles(cases[i].ring, i) : Polygon{cases[i].ring, {}};
    const auto weights = weighted ? randomWeights(p, i) : std::vector<std::vector<double>>{};
    const Skeleton s = buildSkeleton(p, weights);
    std::string wrong = broken(p, s, weights);
    if (wrong.empty() && openEdges(s) > 0) wrong = "open edges";
    if (wrong.empty())
      ++good;
    else if (first.empty())
      first = std::to_string(i) + ": " + wrong;
  }
  EXPECT_EQ(good, cases.size()) << first;
}

INSTANTIATE_TEST_SUITE_P(All, SkeletonCorpus,
                         testing::Values(std::pair{false, false}, std::pair{false, true},
                                         std::pair{true, false}, std::pair{true, true}),
                         [](const auto& param) {
                           return std::string(param.param.first ? "holes" : "plain") +
                                  (param.param.second ? "Weighted" : "");
                         });

}  // namespace
}  // namespace gable
