// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Regions of thousands of vertices, on which booleans and offsets go box by box.
#include "geom/region/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "geom/region/along.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/moved_outline.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"

namespace gable {
namespace {

Ring roughStar(int n, double radius, uint64_t seed, Vec2 at = {}) {
  Ring r;
  for (int i = 0; i < n; ++i) {
    const double a = 360.0 * i / n;
    const double reach =
        radius * (0.7 + 0.3 * randomUnit(hashCombine(seed, static_cast<uint64_t>(i))));
    r.push_back({at.x + reach * cosDeg(a), at.y + reach * sinDeg(a)});
  }
  return r;
}

// Each edge in so many parts.
Ring divided(const Ring& r, int parts) {
  Ring out;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 d = r[(i + 1) % r.size()] - r[i];
    for (int k = 0; k < parts; ++k) out.push_back(r[i] + d * (1.0 * k / parts));
  }
  return out;
}

TEST(Tiles, waysOutsideOfABoxAreShortened) {
  const Box2 box{{0, 0}, {10, 10}};
  std::vector<Ring> rings{{{-5, 5}, {-7, -3}, {-9, 4}, {-5, -6}, {5, 5}},
                          {{20, 1}, {30, 2}, {25, 9}},
                          {{-90, -90}, {0, -80}, {90, -90}, {90, 90}, {-90, 90}}};
  shortenOutside(rings, box);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0], (Ring{{-5, 5}, {-5, -6}, {5, 5}}));
  // Around the box, as before.
  EXPECT_TRUE(contains(Polygon{rings[1], {}}, {5, 5}));
  EXPECT_LT(rings[1].size(), 5u);
}

TEST(Tiles, areasOfManyCornersAddUp) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const Region a{{roughStar(3000, 300, seed), {}}};
    const Region b{{roughStar(2000, 280, seed + 90, {40, -25}), {}}};
    const Region both = intersect(a, b), any = unite(a, b), rest = subtract(a, b);
    for (const Region* r : {&both, &any, &rest}) EXPECT_TRUE(isValid(*r));
    EXPECT_NEAR(area(any) + area(both), area(a) + area(b), 0.1);
    EXPECT_NEAR(area(rest) + area(both), area(a), 0.1);
    // All corners are the input's, or lie where two edges cross: borders of boxes leave none.
    std::vector<Segment> edges = edgesOf(a[0]);
    for (const Segment& s : edgesOf(b[0])) edges.push_back(s);
    for (const Ring& r : ringsOf(any)) {
      for (const Vec2 v : r) {
        const auto on = std::count_if(edges.begin(), edges.end(), [&](const Segment& s) {
          return distanceTo(s, v) < 4 * kRegionGrid;
        });
        EXPECT_GE(on, 2);
      }
    }
  }
}

TEST(Tiles, thousandsOfPartsThatMeetAtOnePlaceAreTakenAway) {
  // Wedges to a circle around the middle, each with its neighbours' sides.
  Region wedges;
  double taken = 0;
  for (int i = 0; i < 2500; ++i) {
    const double a = 360.0 * i / 2500, b = 360.0 * (i + 1) / 2500;
    if (i % 5 == 0) continue;
    const Vec2 u{cosDeg(a), sinDeg(a)}, v{cosDeg(b), sinDeg(b)};
    wedges.push_back({{u * 20, u * 250, v * 250, v * 20}, {}});
    taken += area(wedges.back());
  }
  const Region whole{{roughStar(60, 400, 5), {}}};
  const Region left = subtract(whole, wedges);
  EXPECT_TRUE(isValid(left));
  EXPECT_NEAR(area(left), area(whole) - taken, 0.5);
}

TEST(Tiles, manyCornersAreOffsetAsFewAre) {
  const Ring few = roughStar(24, 100, 3);
  const Region a{{few, {}}}, b{{divided(few, 100), {}}};
  for (const OffsetJoin join : {OffsetJoin::Miter, OffsetJoin::Round, OffsetJoin::Square}) {
    for (const double by : {-6.0, -0.5, 0.3, 4.0, 15.0}) {
      OffsetOptions options;
      options.join = join;
      options.miterLimit = 3;
      const Region one = offset(a, by, options), other = offset(b, by, options);
      ASSERT_EQ(one.size(), other.size()) << by;
      EXPECT_TRUE(isValid(other));
      EXPECT_NEAR(area(one), area(other), 0.003 * std::fabs(by) * 1000) << by;
    }
  }
}

TEST(Tiles, roughOutlinesKeepTheirDistance) {
  const Region a{{roughStar(3000, 300, 7), {}}};
  const std::vector<Segment> edges = edgesOf(a[0]);
  for (const double by : {-2.0, 2.0}) {
    const Region moved = offset(a, by);
    EXPECT_TRUE(isValid(moved));
    ASSERT_FALSE(moved.empty());
    for (const Ring& r : ringsOf(moved)) {
      for (size_t i = 0; i < r.size(); i += 7) {
        double least = 1e300;
        for (const Segment& s : edges) least = std::min(least, distanceTo(s, r[i]));
        EXPECT_GE(least, 2 - 1e-3);
      }
    }
  }
}

TEST(MovedOutline, goesBackOverCornersThatClose) {
  const Ring square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  EXPECT_NEAR(signedArea(movedOutline(square, 10, {})), 120 * 120, 1e-9);
  EXPECT_EQ(movedOutline(square, -10, {}).size(), 12u);
  OffsetOptions cut;
  cut.join = OffsetJoin::Square;
  // Cut at the distance itself.
  const double corner = 10 * (std::sqrt(2.0) - 1);
  EXPECT_NEAR(signedArea(movedOutline(square, 10, cut)),
              120 * 120 - 2 * (10 - corner) * (10 - corner), 1e-9);
}

TEST(InsetLines, foldsAreResolved) {
  const auto closed = [](Ring r) {
    Polyline line;
    line.points = std::move(r);
    line.closed = true;
    return line;
  };
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_EQ(insetLines(closed(square), 2)[0].points, movedLeft(closed(square), 2).points);
  EXPECT_TRUE(insetLines(closed(square), 6).empty());
  // The neck between two rooms is too narrow.
  const Ring rooms{{0, 0},   {10, 0},  {10, 4}, {12, 4}, {12, 0},  {22, 0},
                   {22, 10}, {12, 10}, {12, 6}, {10, 6}, {10, 10}, {0, 10}};
  EXPECT_EQ(insetLines(closed(rooms), 1.5).size(), 2u);
  // A hole turns right; what is around it lies to its left.
  Ring hole = square;
  std::reverse(hole.begin(), hole.end());
  const std::vector<Polyline> around = insetLines(closed(hole), 1);
  ASSERT_EQ(around.size(), 1u);
  EXPECT_NEAR(signedArea(around[0].points), -144, 1e-9);
}

}  // namespace
}  // namespace gable
