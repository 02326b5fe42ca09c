// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/boolean.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

Ring square(double x, double y, double s) {
  return {{x, y}, {x + s, y}, {x + s, y + s}, {x, y + s}};
}

double boundaryLength(const Region& r) {
  double l = 0;
  for (const Ring& ring : ringsOf(r)) l += perimeter(ring);
  return l;
}

// A copy of the case, turned and shifted by a share of its size: the second operand.
Polygon partner(const Ring& ring, uint64_t seed) {
  const Box2 box = bounds(ring);
  const Vec2 c = box.center();
  const double angle = randomIn(hashCombine(seed, 1), 0, 360);
  const Vec2 x{cosDeg(angle), sinDeg(angle)};
  const Vec2 by{box.size().x * randomIn(hashCombine(seed, 2), -0.4, 0.4),
                box.size().y * randomIn(hashCombine(seed, 3), -0.4, 0.4)};
  Polygon p;
  for (const Vec2 v : ring)
    p.outer.push_back(c + by + x * (v - c).x + perpendicular(x) * (v - c).y);
  return p;
}

TEST(Boolean, knownSquares) {
  const Region a{{square(0, 0, 2), {}}}, b{{square(1, 1, 2), {}}};
  EXPECT_DOUBLE_EQ(area(unite(a, b)), 7);
  EXPECT_DOUBLE_EQ(area(intersect(a, b)), 1);
  EXPECT_DOUBLE_EQ(area(subtract(a, b)), 3);
  EXPECT_DOUBLE_EQ(area(combine(BooleanOp::SymmetricDifference, a, b)), 6);
  EXPECT_TRUE(intersect(a, {{square(5, 5, 1), {}}}).empty());
}

TEST(Boolean, holesAreNestedAndIslandsInHolesAreTheirOwnPolygons) {
  const Region a{{square(0, 0, 10), {}}};
  const Region ring = subtract(a, {{square(2, 2, 6), {}}});
  ASSERT_EQ(ring.size(), 1u);
  ASSERT_EQ(ring[0].holes.size(), 1u);
  const Region island = unite(ring, {{square(4, 4, 2), {}}});
  ASSERT_EQ(island.size(), 2u);
  EXPECT_EQ(island[0].holes.size() + island[1].holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area(island), 100 - 36 + 4);
}

TEST(Boolean, survivingPointsKeepTheirBitsAndRingsTheirStart) {
  const Region a{{{{0.1, 0.2}, {5.3, 0.7}, {5.1, 4.9}, {0.3, 4.7}}, {}}};
  const Region cut = subtract(a, {{square(4, 4, 2), {}}});
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].outer[0], (Vec2{0.1, 0.2}));
  EXPECT_EQ(cut[0].outer[1], (Vec2{5.3, 0.7}));
  EXPECT_EQ(cut[0].outer.size(), 6u);
}

TEST(Boolean, collinearVerticesStay) {
  Ring r = square(0, 0, 4);
  r.insert(r.begin() + 1, Vec2{1, 0});
  const Region cut = subtract({{r, {}}}, {{square(3, 3, 2), {}}});
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].outer.size(), 7u);
}

TEST(Boolean, repairsBowTiesByRule) {
  const Ring bow = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const Region r = repaired({bow}, FillRule::NonZero);
  EXPECT_TRUE(isValid(r));
  EXPECT_EQ(r.size(), 2u);
  EXPECT_DOUBLE_EQ(area(r), 2);
  EXPECT_DOUBLE_EQ(area(repaired({bow}, FillRule::Positive)), 1);
  const Ring outer = square(0, 0, 4), inner = square(1, 1, 1);
  EXPECT_DOUBLE_EQ(area(repaired({outer, inner}, FillRule::EvenOdd)), 15);
  EXPECT_DOUBLE_EQ(area(repaired({outer, inner}, FillRule::NonZero)), 16);
}

TEST(Boolean, notFiniteAndTinyInputsVanish) {
  const double nan = std::nan("");
  EXPECT_TRUE(repaired({{{0, 0}, {nan, 1}, {1, 1}}}, FillRule::NonZero).empty());
  EXPECT_TRUE(repaired({{{0, 0}, {1e-9, 0}, {0, 1e-9}}}, FillRule::NonZero).empty());
  EXPECT_TRUE(unite({}, {}).empty());
  EXPECT_TRUE(offset({{square(0, 0, 1), {}}}, -nan).empty());
}

TEST(Boolean, offsetsSquaresExactly) {
  const Region a{{square(0, 0, 4), {square(1, 1, 2)}}};
  EXPECT_DOUBLE_EQ(area(offset(a, -0.25)), 3.5 * 3.5 - 2.5 * 2.5);
  EXPECT_DOUBLE_EQ(area(offset(a, 0.5)), 25 - 1);
  EXPECT_TRUE(offset(a, -0.5).empty());
  EXPECT_DOUBLE_EQ(area(offset(a, 1)), 36);
  EXPECT_DOUBLE_EQ(area(thicken({{0, 0}, {4, 0}}, 0.5)), 4);
}

TEST(Boolean, miterLimitCutsSharpCorners) {
  const Region spike{{{{0, 0}, {10, 0}, {0, 0.5}}, {}}};
  const Box2 sharp = bounds(offset(spike, 0.5, {OffsetJoin::Miter, 1000, 0.01})[0]);
  const Box2 blunt = bounds(offset(spike, 0.5, {OffsetJoin::Miter, 2, 0.01})[0]);
  EXPECT_GT(sharp.max.x, 25);
  EXPECT_LT(blunt.max.x, 11.1);
}

TEST(Boolean, corpusKeepsAreaIdentitiesAndValidity) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  size_t broken = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon pa = corpus::withHoles(cases[i].ring, i);
    const Region a{pa}, b{partner(cases[i].ring, i)};
    const Region both = intersect(a, b), any = unite(a, b), less = subtract(a, b);
    const Region either = combine(BooleanOp::SymmetricDifference, a, b);
    const double slack = 4 * kRegionGrid * (boundaryLength(a) + boundaryLength(b)) + 1e-9;
    ASSERT_NEAR(area(any), area(a) + area(b) - area(both), slack) << i;
    ASSERT_NEAR(area(less), area(a) - area(both), slack) << i;
    ASSERT_NEAR(area(either), area(any) - area(both), slack) << i;
    for (const Region* r : {&both, &any, &less, &either}) broken += isValid(*r) ? 0 : 1;
  }
  EXPECT_EQ(broken, 0u) << "of " << 4 * cases.size();
}

TEST(Boolean, corpusOffsetsAreValidAndNest) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  size_t broken = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Region a{corpus::withHoles(cases[i].ring, i)};
    const double d = std::sqrt(area(a)) * randomIn(hashCombine(i, 9), 0.005, 0.12);
    const Region in = offset(a, -d), out = offset(a, d);
    broken += (isValid(in) ? 0 : 1) + (isValid(out) ? 0 : 1);
    const double slack = 4 * kRegionGrid * (boundaryLength(a) + boundaryLength(out)) + 1e-9;
    ASSERT_LT(area(in), area(a)) << i;
    ASSERT_GT(area(out), area(a)) << i;
    ASSERT_NEAR(area(subtract(in, a)), 0, slack) << i;
    ASSERT_NEAR(area(subtract(a, out)), 0, slack) << i;
    // Every inset point keeps its distance from the boundary.
    for (const Ring& ring : ringsOf(in)) {
      for (const Vec2 p : ring) ASSERT_GT(corpus::clearance(a[0], p), d - 4 * kRegionGrid) << i;
    }
  }
  EXPECT_EQ(broken, 0u) << "of " << 2 * cases.size();
}

// Says stop after so many units.
class Allowance : public WorkMeter {
 public:
  explicit Allowance(uint64_t units) : left_(units) {}
  bool look(uint64_t units, uint64_t) override {
    if (units > left_) return false;
    left_ -= units;
    return true;
  }

 private:
  uint64_t left_;
};

Ring randomRing(uint64_t seed, uint64_t corners) {
  Ring r;
  for (uint64_t i = 0; i < corners; ++i) {
    r.push_back({randomIn(hashCombine(seed, 2 * i), 0, 100),
                 randomIn(hashCombine(seed, 2 * i + 1), 0, 100)});
  }
  return r;
}

// Under the address sanitizer: what a sweep had made when it was stopped is freed.
TEST(Boolean, mayBeStoppedAnywhere) {
  const Region a{{randomRing(1, 150), {}}}, b{{randomRing(2, 150), {}}};
  const Region whole = unite(a, b);
  size_t stopped = 0;
  for (uint64_t allowance = 0; allowance < 200; ++allowance) {
    Allowance meter(allowance * 4096);
    const WorkScope scope(meter);
    Region result;
    const Status status = guarded([&] {
      result = unite(a, b);
      result = offset(result, 0.5);
      return Status();
    });
    stopped += status.ok() ? 0 : 1;
  }
  EXPECT_GT(stopped, 20u);
  EXPECT_EQ(area(unite(a, b)), area(whole));
}

TEST(Boolean, whatReachesTooFarIsGivenUp) {
  const Region square{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}};
  for (const double distance : {1e16, 1e300, 1e308}) {
    const Status status = guarded([&] {
      const Region moved = offset(square, distance);
      return Status();
    });
    EXPECT_STREQ(status.code(), "beyond-range") << distance;
  }
  EXPECT_TRUE(offset(square, -1e308).empty());
  EXPECT_EQ(offset(square, 1e12).size(), 1u);
}

}  // namespace
}  // namespace gable
