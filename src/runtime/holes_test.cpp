// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/holes.h"

#include <gtest/gtest.h>

#include "runtime/recall.h"

namespace gable {
namespace {

Output::Mark atLeaf(uint32_t leaf) { return {leaf, 0, 0}; }

TEST(Holes, OfOneActivationTheLastPortionComesLast) {
  Holes holes;
  holes.leave(1, 10);
  holes.leave(1, 11);
  EXPECT_TRUE(holes.isPendingAt(1));
  holes.place(1, atLeaf(4), 2);
  EXPECT_FALSE(holes.anyPending());
  const std::vector<OutputHole> placed = holes.take();
  ASSERT_EQ(placed.size(), 2u);
  // The second half went first, so what was handed over later lies before it.
  EXPECT_EQ(placed[0].unit, 11u);
  EXPECT_EQ(placed[1].unit, 10u);
  EXPECT_EQ(placed[1].at.leaves, 4u);
  EXPECT_EQ(placed[1].messages, 2u);
}

TEST(Holes, AreFilledFromTheInsideOut) {
  Holes holes;
  holes.leave(0, 10);
  holes.leave(2, 11);
  EXPECT_FALSE(holes.isPendingAt(0));
  holes.place(0, atLeaf(1), 0);
  EXPECT_EQ(holes.placed(), 0u);
  holes.place(2, atLeaf(3), 0);
  EXPECT_TRUE(holes.isPendingAt(0));
  holes.place(0, atLeaf(9), 0);
  const std::vector<OutputHole> placed = holes.take();
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].unit, 11u);
  EXPECT_EQ(placed[0].at.leaves, 3u);
  EXPECT_EQ(placed[1].unit, 10u);
  EXPECT_EQ(placed[1].at.leaves, 9u);
}

TEST(Holes, AUnitIsDividedFromTheFirstPortionOn) {
  Holes holes;
  EXPECT_FALSE(holes.any());
  holes.leave(0, 10);
  EXPECT_TRUE(holes.any());
  holes.place(0, atLeaf(1), 0);
  EXPECT_TRUE(holes.any());
  EXPECT_FALSE(holes.anyPending());
  holes.take();
  EXPECT_FALSE(holes.any());
}

TEST(Holes, WhatIsTakenOverDividesNoUnit) {
  Holes holes;
  const RecallPart part;
  holes.fill(part, atLeaf(2), 1);
  EXPECT_FALSE(holes.any());
  EXPECT_EQ(holes.placed(), 1u);
  EXPECT_EQ(holes.portions(), 0u);
  holes.leave(0, 10);
  holes.place(0, atLeaf(3), 1);
  EXPECT_EQ(holes.portions(), 1u);
  const std::vector<OutputHole> placed = holes.take();
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].taken, &part);
  EXPECT_EQ(placed[0].at.leaves, 2u);
  EXPECT_EQ(placed[1].taken, nullptr);
}

TEST(Holes, AUnitThatALimitEndsLeavesNone) {
  Holes holes;
  holes.leave(3, 10);
  holes.begin();
  EXPECT_FALSE(holes.any());
  EXPECT_FALSE(holes.isPendingAt(3));
}

}  // namespace
}  // namespace gable
