// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/tally.h"

#include <gtest/gtest.h>

#include "gable/limits.h"

namespace gable {
namespace {

Limits smallLimits() {
  Limits limits;
  limits.shapes = 10;
  limits.steps = 5000;
  limits.vertices = 100;
  limits.seconds.reset();
  limits.bytes.reset();
  return limits;
}

TEST(Tally, TellsEachThingOnce) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally tally(usage);
  tally.countShapes(6);
  EXPECT_FALSE(tally.tell());
  // Would be twelve if the first six were told again.
  EXPECT_FALSE(tally.tell());
  tally.countShapes(4);
  EXPECT_FALSE(tally.tell());
  tally.countShape();
  const auto excess = tally.tell();
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "too-many-shapes");
}

TEST(Tally, SumsWithOthers) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally one(usage), other(usage);
  one.countVertices(60);
  other.countVertices(60);
  EXPECT_FALSE(one.tell());
  const auto excess = other.tell();
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "too-many-vertices");
}

TEST(Tally, CountsTurnsOnTheirOwn) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally tally(usage);
  for (int turn = 0; turn < 11; ++turn) tally.countTurn();
  const auto excess = tally.tell();
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "too-many-turns");
  EXPECT_EQ(tally.made(), 0u);
}

TEST(Tally, IsDueAfterSoManyStepsAndKeepsTheirSum) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally tally(usage);
  tally.countSteps(Tally::kStepsBetweenLooks - 1);
  EXPECT_FALSE(tally.isLookDue());
  tally.countWork(Tally::kUnitsPerStep);
  EXPECT_TRUE(tally.isLookDue());
  EXPECT_FALSE(tally.look(0));
  EXPECT_FALSE(tally.isLookDue());
  tally.countSteps(5);
  EXPECT_EQ(tally.steps(), Tally::kStepsBetweenLooks + 5);
}

TEST(Tally, InstancesAreNotMadeAgain) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally tally(usage);
  tally.countShape();
  tally.countExpanded(1000);
  EXPECT_EQ(tally.made(), 1u);
  EXPECT_EQ(tally.expanded(), 1001u);
  EXPECT_FALSE(tally.tell());
}

TEST(Tally, GoesBackToAMark) {
  const Limits limits = smallLimits();
  Usage usage(limits, nullptr);
  Tally tally(usage);
  tally.countShapes(3);
  const Tally::Mark mark = tally.mark();
  tally.countShapes(20);
  tally.countExpanded(5);
  tally.countSteps(9);
  tally.goBack(mark);
  EXPECT_EQ(tally.made(), 3u);
  EXPECT_EQ(tally.expanded(), 3u);
  EXPECT_EQ(tally.steps(), 0u);
  EXPECT_FALSE(tally.tell());
}

// A look that only happens where something is read for the first time.
TEST(Tally, LooksAsideWithoutTelling) {
  Limits limits = smallLimits();
  limits.bytes = uint64_t{64} << 20;
  Usage usage(limits, nullptr);
  Tally tally(usage);
  tally.countShapes(11);
  tally.countSteps(Tally::kStepsBetweenLooks - 1);
  EXPECT_FALSE(tally.lookAside(0));
  EXPECT_FALSE(tally.isLookDue());
  tally.countSteps(1);
  EXPECT_TRUE(tally.isLookDue());
  const auto excess = tally.lookAside(uint64_t{1} << 40);
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "out-of-memory");
  EXPECT_STREQ(tally.tell()->code, "too-many-shapes");
}

TEST(Tally, AsksBeforeMuchMemoryIsTaken) {
  Limits limits = smallLimits();
  limits.bytes = uint64_t{64} << 20;
  Usage usage(limits, nullptr);
  Tally tally(usage);
  EXPECT_FALSE(tally.look(uint64_t{1} << 20));
  const auto excess = tally.look(uint64_t{1} << 40);
  ASSERT_TRUE(excess);
  EXPECT_STREQ(excess->code, "out-of-memory");
}

}  // namespace
}  // namespace gable
