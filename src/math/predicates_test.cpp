// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "math/predicates.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace gable {
namespace {

TEST(Predicates, orientationIsAntisymmetricNearCollinear) {
  // Points within a few ulps of a diagonal, where rounded determinants contradict each other.
  const double ulp = 0x1.0p-53;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p{0.5 + i * ulp, 0.5 + j * ulp};
      const Vec2 q{12, 12}, r{24, 24};
      const int expected = i == j ? 0 : (i > j ? -1 : 1);
      ASSERT_EQ(orientation(q, r, p), expected) << i << " " << j;
      ASSERT_EQ(orientation(r, p, q), expected);
      ASSERT_EQ(orientation(r, q, p), -expected);
    }
  }
}

TEST(Predicates, orientationAgreesWithIntegersAtMapCoordinates) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const auto coordinate = [&](uint64_t k) {
      return static_cast<int64_t>(randomIn(hashCombine(i, k), 0, 64)) + 5428000;
    };
    const int64_t ax = coordinate(0), ay = coordinate(1), bx = coordinate(2), by = coordinate(3),
                  cx = coordinate(4), cy = coordinate(5);
    const int64_t det = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    const auto p = [](int64_t x, int64_t y) {
      return Vec2{static_cast<double>(x) / 1024, static_cast<double>(y) / 1024};
    };
    ASSERT_EQ(orientation(p(ax, ay), p(bx, by), p(cx, cy)), (det > 0) - (det < 0));
  }
}

TEST(Predicates, onSegmentIncludesEndsOnly) {
  EXPECT_TRUE(onSegment({0, 0}, {4, 2}, {2, 1}));
  EXPECT_TRUE(onSegment({0, 0}, {4, 2}, {4, 2}));
  EXPECT_FALSE(onSegment({0, 0}, {4, 2}, {6, 3}));
  EXPECT_FALSE(onSegment({0, 0}, {4, 2}, {2, 1 + 0x1.0p-50}));
}

}  // namespace
}  // namespace gable
