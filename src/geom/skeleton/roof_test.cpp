// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/skeleton/roof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geom/region/corpus.h"
#include "geom/skeleton/roof_pieces.h"
#include "math/trig.h"

namespace gable {
namespace {

const Polygon kRectangle{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};
const Polygon kEll{{{0, 0}, {12, 0}, {12, 5}, {5, 5}, {5, 11}, {0, 11}}, {}};

RoofPitch angle(double degrees) { return {RoofPitch::By::Angle, degrees}; }
RoofPitch byHeight(double h) { return {RoofPitch::By::Height, h}; }

size_t count(const Roof& r, RoofRole role) {
  return static_cast<size_t>(std::count_if(r.faces.begin(), r.faces.end(),
                                           [&](const RoofFace& f) { return f.role == role; }));
}

size_t countEdges(const Roof& r, RoofEdgeRole role) {
  size_t n = 0;
  for (const RoofFace& f : r.faces) {
    for (const RoofLoop& l : f.loops) {
      n += static_cast<size_t>(std::count(l.edges.begin(), l.edges.end(), role));
    }
  }
  return n;
}

double top(const Roof& r) {
  double h = 0;
  for (const SkeletonVertex& v : r.vertices) h = std::max(h, v.height);
  return h;
}

Vec3 at(const Roof& r, uint32_t v) {
  return {r.vertices[v].xy.x, r.vertices[v].xy.y, r.vertices[v].height};
}

/// The greatest distance of a face's vertices from the plane of its outer loop.
double bend(const Roof& r) {
  double worst = 0;
  for (const RoofFace& f : r.faces) {
    const Vec3 n = skeleton::loopNormal(r.vertices, f.loops[0].vertices);
    for (const RoofLoop& l : f.loops) {
      for (const uint32_t v : l.vertices) {
        worst = std::max(worst, std::abs(dot(n, at(r, v) - at(r, f.loops[0].vertices[0]))));
      }
    }
  }
  return worst;
}

/// Six times the volume under all faces; the roof's own if they close.
double volume(const Roof& r) {
  double sum = 0;
  const Vec3 o = at(r, 0);
  for (const RoofFace& f : r.faces) {
    for (const RoofLoop& l : f.loops) {
      for (size_t i = 1; i + 1 < l.vertices.size(); ++i) {
        sum += dot(at(r, l.vertices[0]) - o,
                   cross(at(r, l.vertices[i]) - o, at(r, l.vertices[i + 1]) - o));
      }
    }
  }
  return sum / 6;
}

/// Edges that no other face runs the other way.
size_t openEdges(const Roof& r) {
  std::multiset<std::pair<uint32_t, uint32_t>> halves;
  for (const RoofFace& f : r.faces) {
    for (const RoofLoop& l : f.loops) {
      for (size_t i = 0; i < l.vertices.size(); ++i) {
        halves.insert({l.vertices[i], l.vertices[(i + 1) % l.vertices.size()]});
      }
    }
  }
  size_t open = 0;
  for (const auto& [a, b] : halves) open += halves.count({b, a}) == 0 ? 1 : 0;
  return open;
}

TEST(Roof, hipClosesOverARectangle) {
  const Roof r = hipRoof(kRectangle, angle(45));
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 4u);
  EXPECT_EQ(count(r, RoofRole::Bottom), 1u);
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_NEAR(top(r), 3, 1e-12);
  EXPECT_NEAR(volume(r), 4 * 9 + 2 * 6 * 6 * 3 / 6.0, 1e-9);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Eave), 4u);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Hip), 8u);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Ridge), 2u);
}

TEST(Roof, pitchByHeightSetsTheTop) {
  EXPECT_NEAR(top(hipRoof(kEll, byHeight(4))), 4, 1e-12);
  EXPECT_NEAR(top(gableRoof(kEll, byHeight(4))), 4, 1e-12);
  EXPECT_NEAR(top(shedRoof(kEll, byHeight(4))), 4, 1e-12);
  EXPECT_NEAR(top(pyramidRoof(kEll, byHeight(4))), 4, 1e-12);
}

TEST(Roof, overhangsBelowZeroCutTheSlopesOfAnyPolygon) {
  for (const double degrees : {30.0, 60.0}) {
    for (const Polygon& p : {kRectangle, kEll}) {
      const Roof whole = hipRoof(p, angle(degrees)), cut = hipRoof(p, angle(degrees), -1);
      ASSERT_TRUE(cut.status.ok());
      EXPECT_EQ(count(cut, RoofRole::Slope), count(whole, RoofRole::Slope));
      EXPECT_EQ(countEdges(cut, RoofEdgeRole::Ridge), countEdges(whole, RoofEdgeRole::Ridge));
      EXPECT_NEAR(top(cut), top(whole), 1e-12);
      EXPECT_LT(bend(cut), 1e-9);
      for (const RoofFace& f : cut.faces) {
        if (f.role != RoofRole::Slope) continue;
        double lowest = 1e9;
        for (const uint32_t v : f.loops[0].vertices) {
          lowest = std::min(lowest, cut.vertices[v].height);
        }
        EXPECT_NEAR(lowest, sinDeg(degrees), 1e-9);
      }
    }
  }
}

TEST(Roof, hipOverhangGoesDownTheSlope) {
  const Roof r = hipRoof(kRectangle, angle(45), std::sqrt(2.0));
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 4u);
  EXPECT_LT(bend(r), 1e-9);
  double lowest = 0;
  Box2 box;
  for (const RoofFace& f : r.faces) {
    if (f.role != RoofRole::Slope) continue;
    for (const uint32_t v : f.loops[0].vertices) {
      lowest = std::min(lowest, r.vertices[v].height);
      box.include(r.vertices[v].xy);
    }
    EXPECT_EQ(f.loops[0].edges[0], RoofEdgeRole::Eave);
  }
  EXPECT_NEAR(lowest, -1, 1e-12);
  EXPECT_NEAR(box.min.x, -1, 1e-12);
  EXPECT_NEAR(box.max.y, 7, 1e-12);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Hip), 8u);
}

TEST(Roof, valleyLiesInTheInnerCorner) {
  const Roof r = hipRoof(kEll, angle(30), 0.5);
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Valley), 2u);
  EXPECT_LT(bend(r), 1e-9);
}

TEST(Roof, overhangsThatMeetInACourtyardStop) {
  const Polygon p{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{{9, 9}, {9, 11}, {11, 11}, {11, 9}}}};
  const Roof r = hipRoof(p, angle(45), 3);
  ASSERT_TRUE(r.status.ok());
  EXPECT_LT(bend(r), 1e-9);
  for (const RoofFace& f : r.faces) {
    if (f.ring != 1) continue;
    for (const uint32_t v : f.loops[0].vertices) EXPECT_GE(r.vertices[v].height, -1 - 1e-9);
  }
}

TEST(Roof, anglePerEdgeIsMet) {
  const std::vector<std::vector<double>> angles{{30, 90, 60, 45}};
  const Roof r = hipRoof(kRectangle, angles, 0.2);
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 3u);
  EXPECT_EQ(count(r, RoofRole::SideOuter), 1u);
  EXPECT_LT(bend(r), 1e-9);
  const double expected[4] = {30, 0, 60, 45};
  for (const RoofFace& f : r.faces) {
    if (f.role != RoofRole::Slope) continue;
    const Vec3 n = skeleton::loopNormal(r.vertices, f.loops[0].vertices);
    EXPECT_NEAR(acosDeg(n.z), expected[f.edge], 1e-6);
  }
}

TEST(Roof, gableEndsStandUpright) {
  const Roof r = gableRoof(kRectangle, angle(45));
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 2u);
  EXPECT_EQ(count(r, RoofRole::SideOuter), 2u);
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_NEAR(volume(r), 10 * 6 * 3 / 2.0, 1e-9);
  for (const RoofFace& f : r.faces) {
    if (f.role != RoofRole::SideOuter) continue;
    EXPECT_TRUE(f.edge == 1 || f.edge == 3);
    EXPECT_NEAR(skeleton::loopNormal(r.vertices, f.loops[0].vertices).z, 0, 1e-12);
  }
}

TEST(Roof, gableOverhangsReachOutLevelAlongTheRidge) {
  const Roof r = gableRoof(kRectangle, angle(45), {std::sqrt(2.0), 0.5});
  ASSERT_TRUE(r.status.ok());
  EXPECT_LT(bend(r), 1e-9);
  Box3 box;
  for (const RoofFace& f : r.faces) {
    if (f.role != RoofRole::Slope) continue;
    EXPECT_EQ(f.loops[0].vertices.size(), 4u);
    for (const uint32_t v : f.loops[0].vertices) box.include(at(r, v));
  }
  EXPECT_NEAR(box.min.x, -0.5, 1e-9);
  EXPECT_NEAR(box.max.x, 10.5, 1e-9);
  EXPECT_NEAR(box.min.y, -1, 1e-9);
  EXPECT_NEAR(box.min.z, -1, 1e-9);
  EXPECT_NEAR(box.max.z, 3, 1e-9);
}

TEST(Roof, squareHasTheRidgeAlongItsFirstEdge) {
  const Polygon square{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {}};
  const Roof r = gableRoof(square, angle(30));
  for (const RoofFace& f : r.faces) {
    if (f.role == RoofRole::Slope) {
      EXPECT_EQ(f.edge % 2, 0u);
    }
  }
}

TEST(Roof, ridgeEdgeTurnsTheGable) {
  GableOptions options;
  options.ridgeEdge = 5;
  const Roof r = gableRoof(kRectangle, angle(45), options);
  ASSERT_TRUE(r.status.ok());
  EXPECT_NEAR(top(r), 5, 1e-9);
  EXPECT_EQ(count(r, RoofRole::Slope), 2u);
  EXPECT_EQ(openEdges(r), 0u);
}

TEST(Roof, evenLevelsTheRidge) {
  const Polygon trapezoid{{{0, 0}, {12, 1}, {12, 5}, {0, 8}}, {}};
  for (const bool gable : {false, true}) {
    GableOptions options{0.5, 0.5, true};
    const Roof r =
        gable ? gableRoof(trapezoid, angle(30), options) : hipRoof(trapezoid, angle(30), 0.5, true);
    ASSERT_TRUE(r.status.ok());
    EXPECT_GT(countEdges(r, RoofEdgeRole::Ridge), 0u);
    for (const RoofFace& f : r.faces) {
      const RoofLoop& l = f.loops[0];
      for (size_t i = 0; i < l.edges.size(); ++i) {
        if (l.edges[i] != RoofEdgeRole::Ridge) continue;
        EXPECT_NEAR(at(r, l.vertices[i]).z, at(r, l.vertices[(i + 1) % l.vertices.size()]).z,
                    1e-12);
      }
    }
  }
}

TEST(Roof, shedRisesFromItsEdge) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {{{4, 2}, {4, 4}, {6, 4}, {6, 2}}}};
  const Roof r = shedRoof(p, angle(45), -4);
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 1u);
  EXPECT_EQ(count(r, RoofRole::SideOuter), 3u);
  EXPECT_EQ(count(r, RoofRole::SideInner), 4u);
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_LT(bend(r), 1e-9);
  EXPECT_NEAR(volume(r), 60 * 3 - 4 * 3, 1e-9);
  EXPECT_EQ(r.faces[0].loops[0].edges[0], RoofEdgeRole::Eave);
}

TEST(Roof, pyramidMeetsOverTheMeanOfTheVertices) {
  const Roof r = pyramidRoof(kRectangle, angle(45));
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 4u);
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_NEAR(top(r), 3, 1e-12);
  EXPECT_NEAR(volume(r), 60, 1e-9);
}

TEST(Roof, ridgeRunsAlongItsDirection) {
  const Roof r = ridgeRoof(kRectangle, angle(45), {-2, 0});
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(count(r, RoofRole::Slope), 2u);
  EXPECT_EQ(count(r, RoofRole::SideOuter), 2u);
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_NEAR(top(r), 3, 1e-12);
  EXPECT_NEAR(volume(r), 90, 1e-9);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Ridge), 2u);
  EXPECT_EQ(countEdges(r, RoofEdgeRole::Eave), 2u);
}

TEST(Roof, ridgeCutsConcaveShapesAndHoles) {
  const Polygon comb{{{0, 0},
                      {14, 0},
                      {14, 10},
                      {11, 10},
                      {11, 3},
                      {8, 3},
                      {8, 10},
                      {6, 10},
                      {6, 5},
                      {4, 5},
                      {4, 10},
                      {0, 10}},
                     {{{1, 4}, {1, 6}, {2, 6}, {2, 4}}}};
  const Roof r = ridgeRoof(comb, angle(45), {1, 0});
  ASSERT_TRUE(r.status.ok());
  EXPECT_EQ(openEdges(r), 0u);
  EXPECT_LT(bend(r), 1e-9);
  // The lower part is one, three teeth reach over the ridge, and the hole lies across it.
  EXPECT_EQ(count(r, RoofRole::Slope), 4u);
  EXPECT_EQ(count(r, RoofRole::SideInner), 4u);
}

TEST(Roof, clockwiseRingsKeepTheirEdgeNumbers) {
  Polygon p = kRectangle;
  std::reverse(p.outer.begin(), p.outer.end());
  const Roof r = gableRoof(p, angle(45));
  ASSERT_TRUE(r.status.ok());
  for (const RoofFace& f : r.faces) {
    if (f.role == RoofRole::Bottom) continue;
    const Vec2 a = p.outer[f.edge], b = p.outer[(f.edge + 1) % 4];
    const bool isShort = length(b - a) < 8;
    EXPECT_EQ(f.role == RoofRole::SideOuter, isShort);
  }
}

TEST(Roof, refusesPitchesThatAreNone) {
  for (const double a : {0.0, -10.0, 90.0, 200.0}) {
    EXPECT_STREQ(hipRoof(kRectangle, angle(a)).status.code(), "roof-pitch");
    EXPECT_STREQ(gableRoof(kRectangle, angle(a)).status.code(), "roof-pitch");
    EXPECT_STREQ(shedRoof(kRectangle, angle(a)).status.code(), "roof-pitch");
    EXPECT_STREQ(pyramidRoof(kRectangle, angle(a)).status.code(), "roof-pitch");
  }
}

double planArea(const Roof& r) {
  double sum = 0;
  for (const RoofFace& f : r.faces) {
    if (f.role != RoofRole::Slope) continue;
    for (const RoofLoop& l : f.loops) {
      Ring plan;
      for (const uint32_t v : l.vertices) plan.push_back(r.vertices[v].xy);
      sum += signedArea(plan);
    }
  }
  return sum;
}

/// Empty where a roof without overhangs is closed and flat-faced and covers the polygon.
std::string broken(const Polygon& p, const Roof& r) {
  if (!r.status.ok()) return std::string("status ") + r.status.code();
  const double extent = length(bounds(p).size());
  for (const SkeletonVertex& v : r.vertices) {
    if (!isFinite({v.xy.x, v.xy.y, v.height})) return "coordinate not finite";
    if (v.height < 0) return "below the bottom";
  }
  if (const size_t open = openEdges(r)) return std::to_string(open) + " open edges";
  if (std::abs(planArea(r) - area(p)) > 1e-6 * area(p)) return "does not cover the polygon";
  if (bend(r) > 1e-6 * extent) return "bent by " + std::to_string(bend(r) / extent);
  if (!(volume(r) > 0)) return "no volume";
  return {};
}

class RoofCorpus : public testing::TestWithParam<bool> {};

TEST_P(RoofCorpus, everyRoofClosesOverThePolygon) {
  const auto cases = corpus::loadCorpus(8);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there (GABLE_SHARED)";
  const char* const kinds[] = {"hip", "gable", "shed", "ridge"};
  size_t good[4] = {};
  std::string first[4];
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = GetParam() ? corpus::withHoles(cases[i].ring, i) : Polygon{cases[i].ring, {}};
    const Roof roofs[] = {hipRoof(p, angle(30)), gableRoof(p, angle(40)),
                          shedRoof(p, angle(20), static_cast<int64_t>(i)),
                          ridgeRoof(p, angle(30), {cosDeg(i % 8 * 45.0), sinDeg(i % 8 * 45.0)})};
    for (size_t k = 0; k < 4; ++k) {
      const std::string wrong = broken(p, roofs[k]);
      if (wrong.empty())
        ++good[k];
      else if (first[k].empty())
        first[k] = std::to_string(i) + ": " + wrong;
    }
  }
  for (size_t k = 0; k < 4; ++k) EXPECT_EQ(good[k], cases.size()) << kinds[k] << " " << first[k];
}

TEST_P(RoofCorpus, overhangsStayFlat) {
  const auto cases = corpus::loadCorpus(11);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not there (GABLE_SHARED)";
  size_t good = 0;
  std::string first;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = GetParam() ? corpus::withHoles(cases[i].ring, i) : Polygon{cases[i].ring, {}};
    const double extent = length(bounds(p).size()), reach = 0.02 * extent;
    const Roof hip = hipRoof(p, angle(30), reach);
    const Roof gable = gableRoof(p, angle(40), {reach, reach / 2});
    const bool fine = hip.status.ok() && gable.status.ok() && bend(hip) < 1e-6 * extent &&
                      bend(gable) < 1e-6 * extent && planArea(hip) > area(p) &&
                      planArea(gable) > area(p);
    if (fine)
      ++good;
    else if (first.empty())
      first = std::to_string(i);
  }
  EXPECT_EQ(good, cases.size()) << first;
}

INSTANTIATE_TEST_SUITE_P(All, RoofCorpus, testing::Values(false, true), [](const auto& param) {
  return std::string(param.param ? "holes" : "plain");
});

}  // namespace
}  // namespace gable
