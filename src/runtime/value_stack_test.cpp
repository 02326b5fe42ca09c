// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/value_stack.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(ValueStack, WhatIsTakenStaysReadable) {
  ValueStack stack;
  for (int k = 0; k < 5; ++k) stack.push(Value::of(double(k)));
  const Value* const taken = stack.take(3);
  EXPECT_EQ(stack.size(), 2u);
  EXPECT_EQ(stack.top().number, 1);
  EXPECT_EQ(taken[0].number, 2);
  EXPECT_EQ(taken[2].number, 4);
}

TEST(ValueStack, WhatIsHeldIsNotWrittenOver) {
  ValueStack stack;
  for (int k = 0; k < 4; ++k) stack.push(Value::of(double(k)));
  const Value* const arguments = stack.take(2);
  stack.hold(2);
  const uint32_t outer = stack.cover();
  stack.push(Value::of(70.0));
  const Value* const inner = stack.take(1);
  stack.hold(1);
  const uint32_t nested = stack.cover();
  stack.push(Value::of(80.0));
  EXPECT_EQ(inner[0].number, 70);
  EXPECT_EQ(stack.pop().number, 80);
  stack.uncover(nested);
  stack.hold(0);
  stack.uncover(outer);
  EXPECT_EQ(arguments[0].number, 2);
  EXPECT_EQ(arguments[1].number, 3);
  EXPECT_EQ(stack.size(), 2u);
}

TEST(ValueStack, IsNearlyFullWhileARuleStillFits) {
  ValueStack stack;
  stack.cut(ValueStack::kSize - kMostOnStack);
  EXPECT_FALSE(stack.isNearlyFull());
  stack.push(Value::of(1.0));
  EXPECT_TRUE(stack.isNearlyFull());
}

TEST(ValueStack, GivesTheArgumentsOfACall) {
  ValueStack stack;
  for (int k = 0; k < 5; ++k) stack.push(Value::of(double(k)));
  ASSERT_EQ(stack.from(3).size(), 2u);
  EXPECT_EQ(stack.from(3)[0].number, 3);
  EXPECT_EQ(stack.range(1, 3).back().number, 2);
}

}  // namespace
}  // namespace gable
