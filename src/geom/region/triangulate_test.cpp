// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/work.h"
#include "geom/region/corpus.h"
#include "math/predicates.h"
#include "math/trig.h"

namespace gable {
namespace {

std::vector<Vec2> pointsOf(const Polygon& p) {
  std::vector<Vec2> points = p.outer;
  for (const Ring& h : p.holes) points.insert(points.end(), h.begin(), h.end());
  return points;
}

// Sum of the areas; -1 when a triangle is not counter-clockwise.
double triangleArea(const Polygon& p, const std::vector<Triangle>& triangles) {
  const std::vector<Vec2> points = pointsOf(p);
  double sum = 0;
  for (const Triangle& t : triangles) {
    if (orientation(points[t[0]], points[t[1]], points[t[2]]) <= 0) return -1;
    sum += cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
  }
  return sum;
}

void expectExact(const Polygon& p, const std::string& what, size_t touches = 0) {
  const std::vector<Triangle> t = triangulate(p);
  ASSERT_EQ(t.size(), pointsOf(p).size() - 2 + 2 * p.holes.size() - 2 * touches) << what;
  const double a = area(p);
  ASSERT_NEAR(triangleArea(p, t), a, 1e-9 * a) << what;
}

TEST(Triangulate, evenTrianglesMakeUpAnyPolygon) {
  const auto corpus = corpus::loadCorpus(4);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  for (size_t i = 0; i < corpus.size(); ++i) {
    Polygon p = corpus::withHoles(corpus[i].ring, i);
    orient(p);
    const std::vector<Triangle> even = triangulateEvenly(p);
    EXPECT_EQ(even.size(), triangulate(p).size()) << "case " << i;
    // Flips ask for an area that rounding can only just make out, so they may meet it inexactly.
    const std::vector<Vec2> points = pointsOf(p);
    double sum = 0;
    for (const Triangle& t : even) {
      const double a = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
      EXPECT_GE(a, -1e-9 * area(p));
      sum += a;
    }
    EXPECT_NEAR(sum, area(p), 1e-9 * area(p)) << "case " << i;
  }
}

TEST(Triangulate, evenBandsAreStripsFromOutlineToOutline) {
  Polygon band;
  for (int i = 0; i < 64; ++i) {
    const Vec2 at{cosDeg(360.0 * i / 64), sinDeg(360.0 * i / 64)};
    band.outer.push_back(at * 10);
  }
  band.holes.push_back({});
  for (int i = 63; i >= 0; --i) band.holes[0].push_back(band.outer[i] * 0.8);
  for (const Triangle& t : triangulateEvenly(band)) {
    const auto inner = std::count_if(t.begin(), t.end(), [](uint32_t v) { return v >= 64; });
    EXPECT_TRUE(inner == 1 || inner == 2);
  }
}

TEST(Triangulate, quadsSplitFromTheFirstVertex) {
  const Polygon p{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {}};
  EXPECT_EQ(triangulate(p), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, concaveQuadTakesTheOtherDiagonal) {
  expectExact({{{0, 0}, {4, 0}, {1, 1}, {0, 4}}, {}}, "dart");
  expectExact({{{0, 0}, {4, 0}, {4, 4}, {3, 1}}, {}}, "dart at the end");
}

TEST(Triangulate, directionOfRingsDoesNotMatter) {
  const Polygon p{{{0, 3}, {3, 3}, {3, 0}, {0, 0}}, {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}};
  const std::vector<Triangle> t = triangulate(p);
  EXPECT_EQ(t.size(), 8u);
  EXPECT_DOUBLE_EQ(triangleArea(p, t), 8);
}

TEST(Triangulate, collinearVerticesMakeNoFlatTriangles) {
  expectExact({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {1, 3}, {0, 3}}, {}}, "both sides");
  expectExact({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}, {0, 2}, {0, 1}}, {}}, "triangle");
}

TEST(Triangulate, holesTouchingInPoints) {
  const Ring outer = {{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}};
  expectExact({outer, {{{2, 0}, {1, 2}, {3, 2}}}}, "at the outer ring", 1);
  expectExact({outer, {{{4, 0}, {2, 1}, {3, 2}}}}, "in a corner", 1);
  expectExact({outer, {{{1, 1}, {1, 2}, {2, 2}}, {{2, 2}, {2, 3}, {3, 3}}}}, "at each other", 1);
  expectExact({outer, {{{1, 1}, {1, 2}, {2, 2}}, {{3, 1}, {2, 2}, {3, 3}}}}, "tip to tip", 1);
  const Ring five = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}};
  expectExact({five, {{{0, 2}, {1, 3}, {2, 2}}, {{3, 1}, {2, 2}, {3, 3}}}}, "a chain", 2);
  expectExact({five, {{{0, 2}, {1, 3}, {4, 4}, {1, 2}}}}, "across, in two parts", 2);
  expectExact({outer, {{{0, 0}, {1, 2}, {2, 1}}}}, "by its leftmost vertex", 1);
}

TEST(Triangulate, aHoleThatTouchesTheInsideOfAnEdge) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{0, 2}, {1, 3}, {2, 2}}}};
  EXPECT_NEAR(triangleArea(p, triangulate(p)), area(p), 1e-12);
}

TEST(Triangulate, holesInARowShareTheirHeight) {
  Polygon p{{{0, 0}, {40, 0}, {40, 4}, {0, 4}}, {}};
  for (int i = 0; i < 12; ++i) {
    const double x = 1 + 3 * i;
    p.holes.push_back({{x, 1}, {x, 2}, {x + 1, 2}, {x + 1, 1}});
    p.holes.push_back({{x, 2.5}, {x, 3}, {x + 1, 3}, {x + 1, 2.5}});
  }
  expectExact(p, "a facade");
}

// The work of joining holes in a grid.
uint64_t workForHoles(int side) {
  class Count final : public WorkMeter {
   public:
    bool look(uint64_t units, uint64_t) override {
      done += units;
      return true;
    }
    uint64_t done = 0;
  };
  const double size = side * 10;
  Polygon p{{{0, 0}, {size, 0}, {size, size}, {0, size}}, {}};
  for (int i = 0; i < side * side; ++i) {
    const double x = 10.0 * (i % side) + 2 + 0.001 * (i / side), y = 10.0 * (i / side) + 3;
    p.holes.push_back({{x, y}, {x, y + 4}, {x + 4, y + 4}, {x + 4, y}});
  }
  Count meter;
  const WorkScope scope(meter);
  EXPECT_NEAR(triangleArea(p, triangulate(p)), area(p), 1e-6 * area(p));
  return meter.done;
}

TEST(Triangulate, joiningHolesTakesLittleMoreThanTheirNumber) {
  EXPECT_LT(workForHoles(48), 8 * workForHoles(24));
}

TEST(Triangulate, hopelessInputEnds) {
  EXPECT_TRUE(triangulate(Polygon{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {}}).empty());
  EXPECT_TRUE(triangulate(Polygon{{{1, 1}, {1, 1}, {1, 1}}, {}}).empty());
  EXPECT_TRUE(triangulate(Polygon{}).empty());
  const Polygon bow{{{0, 0}, {4, 4}, {4, 0}, {0, 4}, {2, 7}}, {}};
  EXPECT_LE(triangulate(bow).size(), 3u);
  const Polygon outside{{{0, 0}, {1, 0}, {1, 1}}, {{{5, 5}, {6, 6}, {6, 5}}}};
  EXPECT_LE(triangulate(outside).size(), 6u);
}

TEST(Triangulate, corpusWithAndWithoutHoles) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  for (size_t i = 0; i < cases.size(); ++i) {
    ASSERT_NO_FATAL_FAILURE(expectExact({cases[i].ring, {}}, std::to_string(i)));
    ASSERT_NO_FATAL_FAILURE(
        expectExact(corpus::withHoles(cases[i].ring, i), std::to_string(i) + " with holes"));
  }
}

TEST(Triangulate, fiveThousandVerticesInLittleTime) {
  Polygon comb;
  for (int i = 0; i < 1250; ++i) {
    for (const Vec2 p : {Vec2{0.0, 0}, Vec2{0.25, 9}, Vec2{0.5, 9}, Vec2{0.75, 0}}) {
      comb.outer.push_back({i + p.x, p.y + 0.001 * (i % 7)});
    }
  }
  comb.outer.push_back({1250, -1});
  comb.outer.push_back({0, -1});
  expectExact(comb, "comb");
  Polygon disc;
  for (int i = 0; i < 5000; ++i) {
    const double r = 10 + randomUnit(static_cast<uint64_t>(i));
    disc.outer.push_back(Vec2{cosDeg(i * 0.072), sinDeg(i * 0.072)} * r);
  }
  expectExact(disc, "rough disc");
}

}  // namespace
}  // namespace gable
