// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "math/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace gable {
namespace {

TEST(Noise, staysInItsRangeAndUsesIt) {
  double low = 1, high = -1, sum = 0;
  const int n = 40000;
  for (int i = 0; i < n; ++i) {
    const Vec2 p{randomIn(2 * i, -500, 500), randomIn(2 * i + 1, -500, 500)};
    const double v = gradientNoise(p, 7);
    low = std::min(low, v);
    high = std::max(high, v);
    sum += v;
    EXPECT_LE(std::fabs(fractalNoise(p, 5, 7)), 1);
    EXPECT_LE(std::fabs(gradientNoise(Vec3{p.x, p.y, p.x * p.y}, 7)), 1);
    EXPECT_LE(std::fabs(fractalNoise(Vec3{p.x, p.y, p.x * p.y}, 5, 7)), 1);
  }
  EXPECT_LT(low, -0.8);
  EXPECT_GT(high, 0.8);
  EXPECT_NEAR(sum / n, 0, 0.01);
}

TEST(Noise, isSmooth) {
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p{randomIn(2 * i, -50, 50), randomIn(2 * i + 1, -50, 50)};
    EXPECT_LT(std::fabs(gradientNoise(p, 1) - gradientNoise(p + Vec2{1e-4, 0}, 1)), 1e-3);
  }
}

TEST(Noise, dependsOnItsAddressAlone) {
  EXPECT_EQ(gradientNoise(Vec2{0.3, 0.7}, 5), gradientNoise(Vec2{0.3, 0.7}, 5));
  EXPECT_NE(gradientNoise(Vec2{0.3, 0.7}, 5), gradientNoise(Vec2{0.3, 0.7}, 6));
  EXPECT_EQ(gradientNoise(Vec2{3, -2}, 5), 0);
}

TEST(Noise, answersForEveryPlace) {
  for (const double v : {1e12, HUGE_VAL, std::nan("")}) {
    EXPECT_EQ(gradientNoise(Vec2{v, 0.5}, 1), 0);
    EXPECT_EQ(gradientNoise(Vec3{0.5, v, 0}, 1), 0);
  }
}

}  // namespace
}  // namespace gable
