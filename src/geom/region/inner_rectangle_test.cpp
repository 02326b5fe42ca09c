// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/inner_rectangle.h"

#include <gtest/gtest.h>

#include "geom/region/corpus.h"

namespace gable {
namespace {

TEST(InnerRectangle, ofARectangleIsExactlyItself) {
  const OrientedRect r = largestInnerRect({{{0.1, 0.2}, {7.3, 0.2}, {7.3, 4.9}, {0.1, 4.9}}, {}});
  EXPECT_EQ(r.origin, (Vec2{0.1, 0.2}));
  EXPECT_DOUBLE_EQ(r.width, 7.2);
  EXPECT_DOUBLE_EQ(r.height, 4.7);
}

TEST(InnerRectangle, ofATriangleIsHalfOfIt) {
  const OrientedRect r = largestInnerRect({{{0, 0}, {10, 0}, {0, 6}}, {}});
  EXPECT_NEAR(r.area(), 15, 1e-6);
  const OrientedRect iso = largestInnerRect({{{0, 0}, {10, 0}, {5, 8}}, {}});
  EXPECT_NEAR(iso.area(), 20, 1e-6);
  EXPECT_NEAR(iso.width, 5, 1e-3);
}

TEST(InnerRectangle, goesRoundHolesAndThroughGates) {
  const Ring outer = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const OrientedRect beside = largestInnerRect({outer, {{{4, 4}, {4, 5}, {5, 5}, {5, 4}}}});
  EXPECT_NEAR(beside.area(), 50, 1e-9);
  const Polygon cross{{{4, 0},
                       {6, 0},
                       {6, 4},
                       {10, 4},
                       {10, 6},
                       {6, 6},
                       {6, 10},
                       {4, 10},
                       {4, 6},
                       {0, 6},
                       {0, 4},
                       {4, 4}},
                      {}};
  EXPECT_NEAR(largestInnerRect(cross).area(), 20, 1e-9);
}

TEST(InnerRectangle, byEdgeFindsTheTurnedOne) {
  const OrientedRect turned{{3, 4}, {0.8, 0.6}, 5, 2};
  const Polygon p{turned.ring(), {}};
  EXPECT_NEAR(largestInnerRectByEdge(p).area(), 10, 1e-9);
  EXPECT_LT(largestInnerRect(p).area(), 9);
  EXPECT_NEAR(largestInnerRect(p, {-0.6, 0.8}).area(), 10, 1e-9);
}

TEST(InnerRectangle, nothingInsideNothing) {
  EXPECT_DOUBLE_EQ(largestInnerRect({}).area(), 0);
  EXPECT_DOUBLE_EQ(largestInnerRect({{{0, 0}, {1, 0}, {2, 0}}, {}}).area(), 0);
  EXPECT_DOUBLE_EQ(largestInnerRectByEdge({{{1, 1}, {1, 1}, {1, 1}}, {}}).area(), 0);
}

// Whether a rectangle, a little smaller, keeps inside.
bool inside(const Polygon& p, const OrientedRect& r) {
  const double shrink = 1e-7 * (r.width + r.height);
  const OrientedRect s{r.at(shrink, shrink), r.x, r.width - 2 * shrink, r.height - 2 * shrink};
  if (s.width <= 0 || s.height <= 0) return true;
  for (const Vec2 c : s.ring()) {
    if (locate(p, c) == Where::Outside) return false;
  }
  // No vertex of the polygon in it and no edge through it.
  for (const Segment& e : edgesOf(p)) {
    const auto local = [&](Vec2 v) {
      return Vec2{dot(v - s.origin, s.x), dot(v - s.origin, s.y())};
    };
    const Vec2 a = local(e.a), d = local(e.b) - a;
    double t0 = 0, t1 = 1;
    const auto clip = [&](double from, double by, double low, double high) {
      if (by == 0) {
        if (from <= low || from >= high) t1 = -1;
        return;
      }
      const double u = (low - from) / by, v = (high - from) / by;
      t0 = std::max(t0, std::min(u, v));
      t1 = std::min(t1, std::max(u, v));
    };
    clip(a.x, d.x, 0, s.width);
    clip(a.y, d.y, 0, s.height);
    if (t0 < t1) return false;
  }
  return true;
}

// The largest of many rectangles that are grown in a raster: a lower bound for the largest of all.
double rasterBest(const Polygon& p, int n) {
  const Box2 box = bounds(p);
  const Vec2 cell{box.size().x / n, box.size().y / n};
  std::vector<std::vector<bool>> free(static_cast<size_t>(n),
                                      std::vector<bool>(static_cast<size_t>(n)));
  const std::vector<Segment> edges = edgesOf(p);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const OrientedRect r{
          {box.min.x + x * cell.x, box.min.y + y * cell.y}, {1, 0}, cell.x, cell.y};
      free[static_cast<size_t>(y)][static_cast<size_t>(x)] = inside(p, r);
    }
  }
  double best = 0;
  std::vector<int> run(static_cast<size_t>(n));
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      int& r = run[static_cast<size_t>(x)];
      r = free[static_cast<size_t>(y)][static_cast<size_t>(x)] ? r + 1 : 0;
    }
    for (int x = 0; x < n; ++x) {
      int least = n;
      for (int w = x; w < n && run[static_cast<size_t>(w)] > 0; ++w) {
        least = std::min(least, run[static_cast<size_t>(w)]);
        best = std::max(best, (w - x + 1) * least * cell.x * cell.y);
      }
    }
  }
  return best;
}

TEST(InnerRectangle, corpusRectanglesLieInsideAndBeatARaster) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const OrientedRect r = largestInnerRect(p);
    ASSERT_GT(r.area(), 0) << i;
    ASSERT_TRUE(inside(p, r)) << i;
    if (i % 20 == 0) {
      ASSERT_GE(r.area(), rasterBest(p, 40) * (1 - 1e-6)) << i;
    }
    if (i % 10 == 0) {
      const OrientedRect e = largestInnerRectByEdge(p);
      ASSERT_TRUE(inside(p, e)) << i;
      ASSERT_GT(e.area(), 0) << i;
    }
  }
}

}  // namespace
}  // namespace gable
