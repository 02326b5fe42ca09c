// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/usage.h"

#include <gtest/gtest.h>

#include "runtime/derive.h"

namespace gable {
namespace {

class UsageTest : public testing::Test {
 protected:
  Limits limits_;
  std::atomic<bool> cancel_{false};
};

TEST_F(UsageTest, countsOfAllWorkersTogether) {
  limits_.shapes = 10;
  Usage usage(limits_, &cancel_);
  EXPECT_FALSE(usage.spend({.shapes = 6}));
  EXPECT_FALSE(usage.spend({.shapes = 4}));
  const auto excess = usage.spend({.shapes = 1});
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "too-many-shapes");
  EXPECT_TRUE(usage.exhausted());
  EXPECT_TRUE(usage.exhaustedByCount());
}

TEST_F(UsageTest, eachCountHasItsLimit) {
  limits_.shapes = limits_.steps = limits_.vertices = 10;
  const auto codeOf = [&](const Usage::Use& use) {
    const auto excess = Usage(limits_, &cancel_).spend(use);
    return excess ? std::string(excess->code) : std::string();
  };
  EXPECT_EQ(codeOf({10, 10, 10, 10}), "");
  EXPECT_EQ(codeOf({.shapes = 11}), "too-many-shapes");
  EXPECT_EQ(codeOf({.steps = 11}), "too-many-steps");
  EXPECT_EQ(codeOf({.vertices = 11}), "too-many-vertices");
  EXPECT_EQ(codeOf({.turns = 11}), "too-many-turns");
}

TEST_F(UsageTest, startsAgain) {
  limits_.steps = 10;
  Usage usage(limits_, &cancel_);
  EXPECT_TRUE(usage.spend({.steps = 11}));
  usage.startAgain();
  EXPECT_FALSE(usage.exhausted() || usage.exhaustedByCount());
  EXPECT_FALSE(usage.spend({.steps = 9}));
}

TEST_F(UsageTest, timeIsNoCount) {
  limits_.seconds = 1e-9;
  Usage usage(limits_, &cancel_);
  const auto excess = usage.spend({});
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "out-of-time");
  EXPECT_TRUE(usage.exhausted());
  EXPECT_FALSE(usage.exhaustedByCount());
}

TEST_F(UsageTest, memoryIsAskedForApart) {
  limits_.bytes = 1;
  Usage usage(limits_, &cancel_);
  EXPECT_FALSE(usage.spend({}));
  const std::vector<char> much(64 << 20, 'x');
  const auto excess = usage.lookAtMemory();
  ASSERT_TRUE(excess) << much[1];
  EXPECT_STREQ(excess->code, "out-of-memory");
}

TEST_F(UsageTest, fullTablesEndAllButAreNoCount) {
  Usage usage(limits_, &cancel_);
  EXPECT_STREQ(usage.tablesAreFull().code, "too-many-values");
  EXPECT_TRUE(usage.exhausted());
  EXPECT_FALSE(usage.exhaustedByCount());
}

TEST_F(UsageTest, isCancelledFromOutside) {
  Usage usage(limits_, &cancel_);
  EXPECT_FALSE(usage.cancelled());
  cancel_ = true;
  EXPECT_TRUE(usage.cancelled());
  EXPECT_FALSE(Usage(limits_, nullptr).cancelled());
}

}  // namespace
}  // namespace gable
