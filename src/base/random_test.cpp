// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace gable {
namespace {

constexpr uint64_t kDraws = 100000;

// A change of one bit of the address changes each bit of the draw half of the time.
TEST(Random, neighbouringAddressesAreIndependent) {
  for (int flipped = 0; flipped < 64; flipped += 7) {
    uint64_t changed = 0;
    for (uint64_t a = 0; a < 2000; ++a) {
      const uint64_t other = a ^ (uint64_t{1} << flipped);
      changed += static_cast<uint64_t>(std::popcount(randomBits(a) ^ randomBits(other)));
    }
    EXPECT_NEAR(static_cast<double>(changed) / 2000, 32, 0.5) << flipped;
  }
}

TEST(Random, unitDrawsOfASequenceAreUniformAndDoNotFollowEachOther) {
  double sum = 0, squares = 0, products = 0;
  uint64_t tenths[10] = {};
  for (uint64_t a = 0; a < kDraws; ++a) {
    const double v = randomUnit(a);
    ASSERT_GE(v, 0);
    ASSERT_LT(v, 1);
    ++tenths[static_cast<size_t>(v * 10)];
    sum += v;
    squares += v * v;
    products += v * randomUnit(a + 1);
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 0.005);
  EXPECT_NEAR(products / kDraws, 0.25, 0.005);
  for (const uint64_t n : tenths) EXPECT_NEAR(static_cast<double>(n), kDraws / 10, 400);
}

TEST(Random, normalDrawsHaveMeanZeroAndVarianceOne) {
  double sum = 0, squares = 0;
  uint64_t beyondTwo = 0;
  for (uint64_t a = 0; a < kDraws; ++a) {
    const double v = randomNormal(a);
    sum += v;
    squares += v * v;
    beyondTwo += std::fabs(v) > 2 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.015);
  EXPECT_NEAR(squares / kDraws, 1, 0.02);
  EXPECT_NEAR(static_cast<double>(beyondTwo) / kDraws, 0.0455, 0.003);
}

}  // namespace
}  // namespace gable
