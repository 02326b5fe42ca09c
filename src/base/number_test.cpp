// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

#include "base/random.h"

namespace gable {
namespace {

std::string fixed(double v, int decimals) {
  char text[kNumberRoom];
  return {text, writeFixed(text, v, decimals)};
}

TEST(Number, shortestTextReadsBackEqual) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const double v = std::bit_cast<double>(randomBits(i));
    if (!std::isfinite(v)) continue;
    double back = 0;
    ASSERT_TRUE(parseNumber(shortestText(v), back)) << shortestText(v);
    ASSERT_EQ(back, v);
  }
  EXPECT_EQ(shortestText(-0.0), "0");
  EXPECT_EQ(shortestText(100), "100");
  EXPECT_EQ(shortestText(0.1), "0.1");
}

TEST(Number, readsAsTheLibraryDoes) {
  for (const char* text : {"0",
                           "1",
                           "-1",
                           "+1",
                           "1.",
                           ".5",
                           "1.5e3",
                           "1E-3",
                           "123456789012345678901234567890",
                           "0.1",
                           "0.30000000000000004",
                           "9007199254740993",
                           "4.9e-324",
                           "1.7976931348623157e308",
                           "0.000000000000000000000000000001",
                           "00012.50",
                           "1e22",
                           "1e23",
                           "123456.789e-12",
                           "9223372036854775807.5"}) {
    double v = 0;
    ASSERT_TRUE(parseNumber(text, v)) << text;
    EXPECT_EQ(v, std::strtod(text, nullptr)) << text;
  }
  for (uint64_t i = 0; i < 20000; ++i) {
    const std::string text = fixed(randomIn(i, -1e6, 1e6), static_cast<int>(i % 10));
    double v = 0;
    ASSERT_TRUE(parseNumber(text, v)) << text;
    ASSERT_EQ(v, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Number, refusesWhatIsNoNumber) {
  double v = 7;
  for (const char* text : {"", "-", "+", ".", "e5", "1x", " 1", "1 ", "nan", "inf", "-infinity",
                           "1e999", "0x10", "--1", "1e", "1e+"}) {
    EXPECT_FALSE(parseNumber(text, v)) << text;
  }
  EXPECT_EQ(v, 7);
}

TEST(Number, numbersTooSmallForADoubleAreZero) {
  double v = 7;
  EXPECT_TRUE(parseNumber("1e-400", v));
  EXPECT_EQ(v, 0);
  v = 7;
  EXPECT_TRUE(parseNumber("0." + std::string(400, '0') + "1", v));
  EXPECT_EQ(v, 0);
  EXPECT_TRUE(parseNumber("1" + std::string(400, '0') + "e-400", v));
  EXPECT_EQ(v, 1);
  EXPECT_FALSE(parseNumber("1" + std::string(800, '0') + "e-400", v));
}

TEST(Number, fixedPointRoundsHalfAwayAndDropsZeros) {
  EXPECT_EQ(fixed(1.5, 6), "1.5");
  EXPECT_EQ(fixed(-3, 6), "-3");
  EXPECT_EQ(fixed(0.125, 2), "0.13");
  EXPECT_EQ(fixed(-0.125, 2), "-0.13");
  EXPECT_EQ(fixed(-1e-9, 6), "0");
  EXPECT_EQ(fixed(0.000001, 6), "0.000001");
  EXPECT_EQ(fixed(1234567.000001, 6), "1234567.000001");
  EXPECT_EQ(fixed(99.9999999, 6), "100");
  EXPECT_EQ(fixed(10, 0), "10");
  EXPECT_EQ(fixed(1e20, 6), "1e+20");
  for (uint64_t i = 0; i < 20000; ++i) {
    const double v = randomIn(i, -1e5, 1e5);
    double back = 0;
    ASSERT_TRUE(parseNumber(fixed(v, 6), back));
    ASSERT_NEAR(back, v, 0.5000001e-6);
  }
}

TEST(Number, integersHaveAllTheirDigits) {
  char text[kNumberRoom];
  for (uint64_t v : {uint64_t{0}, uint64_t{9}, uint64_t{10}, uint64_t{99}, uint64_t{12345},
                     uint64_t{1} << 40, ~uint64_t{0}}) {
    EXPECT_EQ(std::string(text, writeInteger(text, v)), std::to_string(v));
  }
}

}  // namespace
}  // namespace gable
