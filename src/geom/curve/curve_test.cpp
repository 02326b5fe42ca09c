// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/curve/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace gable {
namespace {

double distanceTo(const Line& line, Vec2 p) {
  const Path path(line);
  return length(path.at(path.nearest(p)).point - p);
}

bool has(const Line& line, Vec2 p) { return std::find(line.begin(), line.end(), p) != line.end(); }

Line walk(uint64_t seed, size_t n) {
  Line out;
  Vec2 at;
  for (size_t i = 0; i < n; ++i) {
    at = at + Vec2{randomIn(seed + 2 * i, 1e-3, 30), randomIn(seed + 2 * i + 1, -20, 20)};
    out.push_back(at);
  }
  return out;
}

TEST(CatmullRom, goesThroughItsPointsInOrder) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Line points = walk(seed * 1000, 3 + seed % 8);
    for (const bool closed : {false, true}) {
      const Line line = catmullRom(points, closed, 0.01);
      auto from = line.begin();
      for (const Vec2 p : points) {
        from = std::find(from, line.end(), p);
        ASSERT_NE(from, line.end()) << seed;
      }
    }
  }
}

// The finer line of the same curve lies within the tolerance of the coarser one.
TEST(CatmullRom, keepsItsTolerance) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Line points = walk(seed * 1000 + 7, 6);
    const Line coarse = catmullRom(points, false, 0.1);
    for (const Vec2 p : catmullRom(points, false, 0.001)) {
      EXPECT_LT(distanceTo(coarse, p), 0.1 + 0.001);
    }
  }
}

TEST(CatmullRom, ofTwoPointsIsALineAndOfOneAPoint) {
  EXPECT_EQ(catmullRom(Line{{0, 0}, {3, 4}}, false, 0.1).size(), 2u);
  EXPECT_EQ(catmullRom(Line{{0, 0}, {0, 0}}, true, 0.1).size(), 1u);
  EXPECT_TRUE(catmullRom(Line{}, true, 0.1).empty());
  EXPECT_EQ(catmullRom(Line{{0, 0}, {NAN, 1}, {1, 0}}, false, 0.1).size(), 2u);
}

TEST(Simplified, keepsItsToleranceAndItsEnds) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Line fine = catmullRom(walk(seed * 31, 6), false, 0.01);
    const Line coarse = simplified(fine, 0.5);
    EXPECT_LT(coarse.size(), fine.size());
    EXPECT_EQ(coarse.front(), fine.front());
    EXPECT_EQ(coarse.back(), fine.back());
    for (const Vec2 p : fine) EXPECT_LE(distanceTo(coarse, p), 0.5 + 1e-9);
  }
}

TEST(Bezier, meetsTheEndsOfItsPieces) {
  const Line controls{{0, 0}, {0, 10}, {10, 10}, {10, 0}, {10, -10}, {20, -10}, {20, 0}};
  const Line line = bezier(controls, 0.01);
  EXPECT_TRUE(has(line, {0, 0}) && has(line, {10, 0}) && has(line, {20, 0}));
  // The middle of a cubic is known.
  EXPECT_LT(distanceTo(line, {5, 7.5}), 0.01);
}

TEST(Arc, staysOnItsCircle) {
  for (const double radius : {0.1, 5.0, 300.0}) {
    const Line line = arc({2, 3}, radius, 30, 30 - 360, 0.01);
    for (const Vec2 p : line) EXPECT_NEAR(length(p - Vec2{2, 3}), radius, radius * 1e-12);
    const Path path(line);
    EXPECT_NEAR(path.length(), 2 * 3.14159265358979 * radius, radius * 0.1 + 0.02);
    for (double s = 0; s < path.length(); s += path.length() / 97) {
      EXPECT_GT(length(path.at(s).point - Vec2{2, 3}), radius - 0.0101);
    }
  }
}

TEST(Path, measuresAndFindsPlaces) {
  const Path path(Line{{0, 0}, {10, 0}, {10, 0}, {10, 5}});
  EXPECT_EQ(path.length(), 15);
  EXPECT_EQ(path.at(4).point, (Vec2{4, 0}));
  EXPECT_EQ(path.at(12).point, (Vec2{10, 2}));
  EXPECT_NEAR(path.at(10).tangent.x, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(path.at(-3).point, (Vec2{0, 0}));
  EXPECT_EQ(path.at(99).point, (Vec2{10, 5}));
  EXPECT_EQ(path.nearest({12, 3}), 13);
}

TEST(Path, wrapsWhenItIsClosed) {
  const Path path(Line{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, true);
  EXPECT_EQ(path.length(), 16);
  EXPECT_EQ(path.at(17).point, (Vec2{1, 0}));
  EXPECT_EQ(path.at(-1).point, (Vec2{0, 1}));
}

TEST(Path, findsAgainWhatItGave) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const Path path(catmullRom(walk(seed * 77, 5), false, 0.01));
    for (int i = 0; i <= 20; ++i) {
      const Vec2 p = path.at(path.length() * i / 20).point;
      EXPECT_LT(length(path.at(path.nearest(p)).point - p), 1e-9);
    }
  }
}

TEST(Stations, fillTheRoom) {
  EXPECT_EQ(stations(10, {2.5, 0, 0, false, false}), (std::vector<double>{0, 2.5, 5, 7.5, 10}));
  EXPECT_EQ(stations(11, {2.5, 0, 0, false, true}), (std::vector<double>{0.5, 3, 5.5, 8, 10.5}));
  const auto stretched = stations(10, {3, 1, 1, true, false});
  ASSERT_EQ(stretched.size(), 4u);
  EXPECT_EQ(stretched.front(), 1);
  EXPECT_NEAR(stretched.back(), 9, 1e-12);
  EXPECT_TRUE(stations(3, {1, 2, 2}).empty());
  EXPECT_TRUE(stations(3, {0, 0, 0}).empty());
  EXPECT_LE(stations(1e9, {1e-3}).size(), 100000u);
}

}  // namespace
}  // namespace gable
