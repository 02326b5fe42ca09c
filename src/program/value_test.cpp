// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gable {
namespace {

TEST(NumberText, showsUpToSixteenDigits) {
  EXPECT_EQ(numberText(14), "14");
  EXPECT_EQ(numberText(-0.0), "0");
  EXPECT_EQ(numberText(1.69), "1.69");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.3");
  EXPECT_EQ(numberText(3 * 0.15), "0.45");
  EXPECT_EQ(numberText(static_cast<double>(0.1f)), "0.1000000014901161");
  EXPECT_EQ(numberText(9.3), "9.3");
  EXPECT_EQ(numberText(-8.7), "-8.7");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.3");
  EXPECT_EQ(numberText(100000), "100000");
  EXPECT_EQ(numberText(1e15), "1000000000000000");
  EXPECT_EQ(numberText(1e20), "1e+20");
  EXPECT_EQ(numberText(2.5e-7), "2.5e-07");
  EXPECT_EQ(numberText(0.0003), "0.0003");
  EXPECT_EQ(numberText(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(numberText(1234567.25), "1234567.25");
  EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(numberText(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(numberText(std::nan("")), "nan");
}

TEST(ValuePool, showsArrays) {
  ValuePool pool;
  Array a;
  a.rows = 2;
  a.columns = 2;
  a.numbers = {1, 0.5, 2, 1e20};
  EXPECT_EQ(pool.str(pool.intern(a)), "(2x2)\n   1     0.5\n   2   1e+20");
  a.rows = 1;
  a.columns = 4;
  EXPECT_EQ(pool.str(pool.intern(a)), "(4)[1,0.5,2,1e+20]");
  EXPECT_EQ(pool.str(pool.intern(Array{})), "(0)[]");
}

// Else each would take a place of its own, and what depends on it could not be shared; and of 0 and
// -0 all would get the sign of which came first.
TEST(ValuePool, numbersOfArraysAreTheSameToTheBit) {
  ValuePool pool;
  Array a;
  a.rows = a.columns = 1;
  a.numbers = {std::nan("")};
  const Value none = pool.intern(a);
  EXPECT_EQ(pool.intern(a), none);
  a.numbers = {0.0};
  const Value zero = pool.intern(a);
  a.numbers = {-0.0};
  EXPECT_TRUE(std::signbit(pool.array(pool.intern(a)).numbers[0]));
  EXPECT_FALSE(std::signbit(pool.array(zero).numbers[0]));
}

}  // namespace
}  // namespace gable
