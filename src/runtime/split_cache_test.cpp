// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/split_cache.h"

#include <gtest/gtest.h>

#include <limits>

namespace gable {
namespace {

class SplitCacheTest : public testing::Test {
 protected:
  SplitCacheTest() {
    BlockCode& block = program.blocks.emplace_back();
    block.kind = BlockKind::Split;
    block.repeat = true;
    block.items.resize(3);
    // A group of the two that follow.
    block.items[0].group = true;
    block.items[0].length = 2;
    block.items[1].slot = 4;
    block.items[2].slot = 5;
  }

  Program program;
};

TEST_F(SplitCacheTest, TakesTheSizesOfItemsAndNotOfGroups) {
  SplitCache cache(program);
  const Value sizes[] = {Value::of(2.0), Value::of(3.0)};
  const SplitBlock block = cache.at(0, sizes);
  ASSERT_EQ(block.items.size(), 3u);
  EXPECT_TRUE(block.repeat);
  EXPECT_TRUE(block.items[0].group);
  EXPECT_EQ(block.items[1].size, 2);
  EXPECT_EQ(block.items[2].size, 3);
  EXPECT_EQ(block.items[2].slot, 5u);
}

TEST_F(SplitCacheTest, ADivisionIsKnownWhileTheSizesAreTheSame) {
  SplitCache cache(program);
  Value sizes[] = {Value::of(2.0), Value::of(3.0)};
  cache.at(0, sizes).memo->known = true;
  cache.at(0, sizes);
  EXPECT_TRUE(cache.memo(0).known);
  sizes[1].unit = Unit::Relative;
  cache.at(0, sizes);
  EXPECT_FALSE(cache.memo(0).known);
}

TEST_F(SplitCacheTest, WhatIsNoNumberIsNeverTheSame) {
  SplitCache cache(program);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Value sizes[] = {Value::of(nan), Value::of(3.0)};
  cache.at(0, sizes).memo->known = true;
  cache.at(0, sizes);
  EXPECT_FALSE(cache.memo(0).known);
}

TEST_F(SplitCacheTest, ConstantSizesComeFromTheProgram) {
  program.blocks[0].constantSizes = {Value::of(7.0), Value::of(8.0)};
  SplitCache cache(program);
  const SplitBlock block = cache.at(0, nullptr);
  EXPECT_EQ(block.items[1].size, 7);
  block.memo->known = true;
  cache.at(0, nullptr);
  EXPECT_TRUE(cache.memo(0).known);
}

}  // namespace
}  // namespace gable
