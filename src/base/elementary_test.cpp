// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "base/hash.h"
#include "base/random.h"

namespace gable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool neighbours(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::nextafter(a, b) == b;
}

// 2 to a power drawn from a range: arguments of all sizes.
double sized(uint64_t address, double from, double to) {
  const double power = from + (to - from) * randomUnit(address);
  return std::ldexp(1 + randomUnit(address + 1), static_cast<int>(std::floor(power)));
}

TEST(Elementary, areWithinOneUnitOfTheLibraryOfThisMachine) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const double quarter = randomUnit(3 * i) * 0.785, share = 2 * randomUnit(3 * i + 1) - 1;
    const double any = sized(3 * i, -1000, 1000), middle = sized(3 * i, -40, 40);
    EXPECT_TRUE(neighbours(sinSmall(quarter), std::sin(quarter))) << quarter;
    EXPECT_TRUE(neighbours(cosSmall(quarter), std::cos(quarter))) << quarter;
    EXPECT_TRUE(neighbours(asinOf(share), std::asin(share))) << share;
    EXPECT_TRUE(neighbours(acosOf(share), std::acos(share))) << share;
    EXPECT_TRUE(neighbours(atan2Of(share, middle), std::atan2(share, middle))) << middle;
    EXPECT_TRUE(neighbours(atan2Of(share, -middle), std::atan2(share, -middle))) << middle;
    EXPECT_TRUE(neighbours(expOf(700 * share), std::exp(700 * share))) << share;
    EXPECT_TRUE(neighbours(logOf(any), std::log(any))) << any;
    EXPECT_TRUE(neighbours(logOf(1 + share / 8), std::log(1 + share / 8))) << share;
    EXPECT_TRUE(neighbours(log10Of(any), std::log10(any))) << any;
    EXPECT_TRUE(neighbours(powOf(middle, 9 * share), std::pow(middle, 9 * share))) << middle;
  }
}

TEST(Elementary, takeSpecialArgumentsAsCDoes) {
  const double special[] = {
      0.0,   -0.0,   1,      -1,      kInfinity, -kInfinity,        kNan, 2, -2, 3, -3, 0.5, -0.5,
      1e300, -1e300, 1e-320, -1e-320, 4e18,      9007199254740993.0};
  const auto same = [](double a, double b) {
    return neighbours(a, b) && (std::isnan(a) || std::signbit(a) == std::signbit(b));
  };
  for (const double a : special) {
    EXPECT_TRUE(same(expOf(a), std::exp(a))) << a;
    EXPECT_TRUE(same(logOf(a), std::log(a))) << a;
    EXPECT_TRUE(same(log10Of(a), std::log10(a))) << a;
    EXPECT_TRUE(same(asinOf(a), std::asin(a))) << a;
    EXPECT_TRUE(same(acosOf(a), std::acos(a))) << a;
    for (const double b : special) {
      EXPECT_TRUE(same(powOf(a, b), std::pow(a, b))) << a << " " << b;
      EXPECT_TRUE(same(atan2Of(a, b), std::atan2(a, b))) << a << " " << b;
    }
  }
}

TEST(Elementary, areExactWhereTheResultIs) {
  for (int i = -300; i < 300; ++i) {
    EXPECT_EQ(log10Of(std::strtod(("1e" + std::to_string(i)).c_str(), nullptr)), i);
    EXPECT_EQ(powOf(2, i), std::ldexp(1.0, i));
  }
  EXPECT_EQ(powOf(3, 4), 81);
  EXPECT_EQ(powOf(10, 22), 1e22);
  EXPECT_EQ(expOf(0), 1);
  EXPECT_EQ(logOf(1), 0);
}

// The bits themselves, so that every compiler, optimisation and machine is held to them.
TEST(Elementary, giveTheSameBitsEverywhere) {
  uint64_t hash = 0;
  const auto add = [&](double v) { hash = hashCombine(hash, std::bit_cast<uint64_t>(v)); };
  for (uint64_t i = 0; i < 5000; ++i) {
    const double unit = randomUnit(i), any = sized(i, -60, 60);
    add(sinSmall(unit * 0.785));
    add(cosSmall(unit * 0.785));
    add(asinOf(unit));
    add(acosOf(-unit));
    add(atan2Of(unit, any));
    add(expOf(unit * 100 - 50));
    add(logOf(any));
    add(log10Of(any));
    add(powOf(any, unit * 5));
  }
  EXPECT_EQ(hash, 18020065379531604647u);
}

}  // namespace
}  // namespace gable
