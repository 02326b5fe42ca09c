// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/in_place.h"

#include <gtest/gtest.h>

#include <set>

namespace gable {
namespace {

class InPlaceTest : public testing::Test {
 protected:
  InPlaceTest() {
    a.rule = 3;
    a.parameters = 5;
    a.shape.path = 77;
    a.shape.size = {1, 2, 3};
    readsPrevious.needsPrevious = true;
    inPlace.begin(0);
  }

  Activation a;
  LocalValues locals;
  InPlace inPlace{locals};
  RuleCode plain, readsPrevious;
  Instruction code[2];
};

TEST_F(InPlaceTest, ARuleGivesTheActivationBack) {
  inPlace.beginRule(a, plain, 8, 1, {&code[1], 20});
  EXPECT_EQ(a.rule, 8u);
  EXPECT_EQ(a.parameters, 20u);
  EXPECT_NE(a.shape.path, 77u);
  EXPECT_EQ(inPlace.innermost(), InPlace::Kind::Rule);
  a.shape.size = {9, 9, 9};
  const InPlace::Return back = inPlace.endRule(a);
  EXPECT_EQ(back.pc, &code[1]);
  EXPECT_EQ(back.stackBase, 20u);
  EXPECT_EQ(a.rule, 3u);
  EXPECT_EQ(a.parameters, 5u);
  EXPECT_EQ(a.shape.path, 77u);
  // The shape itself stays as the rule has made it.
  EXPECT_EQ(a.shape.size, (Vec3{9, 9, 9}));
  EXPECT_EQ(inPlace.size(), 0u);
}

TEST_F(InPlaceTest, CallsOfARuleHaveAddressesOfTheirOwn) {
  inPlace.beginRule(a, plain, 8, 1, {});
  const uint64_t one = a.shape.path;
  inPlace.endRule(a);
  inPlace.beginRule(a, plain, 8, 2, {});
  EXPECT_NE(a.shape.path, one);
}

TEST_F(InPlaceTest, TheScopeBelowIsThatAtTheCall) {
  a.previous.size = {4, 4, 4};
  inPlace.beginRule(a, readsPrevious, 8, 1, {});
  EXPECT_EQ(a.previous.size, (Vec3{1, 2, 3}));
  a.shape.size = {6, 6, 6};
  inPlace.beginRule(a, readsPrevious, 9, 2, {});
  EXPECT_EQ(a.previous.size, (Vec3{6, 6, 6}));
  inPlace.endRule(a);
  EXPECT_EQ(a.previous.size, (Vec3{1, 2, 3}));
  inPlace.endRule(a);
  EXPECT_EQ(a.previous.size, (Vec3{4, 4, 4}));
}

TEST_F(InPlaceTest, AnEarlyEndWithinARuleLeavesTheScopeBelow) {
  a.previous.size = {4, 4, 4};
  inPlace.beginRule(a, readsPrevious, 8, 1, {});
  const uint32_t base = inPlace.size();
  Activation child = a;
  inPlace.beginRule(child, readsPrevious, 9, 2, {});
  // The child ends within its rule.
  inPlace.cut(base);
  inPlace.endRule(a);
  EXPECT_EQ(a.previous.size, (Vec3{4, 4, 4}));
  EXPECT_EQ(inPlace.size(), 0u);
}

TEST_F(InPlaceTest, RulesAreCountedThroughOtherFrames) {
  inPlace.begin(2);
  EXPECT_EQ(inPlace.rules(), 2u);
  inPlace.beginRule(a, plain, 8, 1, {});
  inPlace.beginLoop(a.shape, 4, 1);
  inPlace.beginRule(a, plain, 8, 1, {});
  EXPECT_EQ(inPlace.rules(), 4u);
  EXPECT_EQ(inPlace.rulesIn(2), 3u);
  EXPECT_EQ(inPlace.rulesIn(0), 2u);
}

TEST_F(InPlaceTest, ALoopNumbersItsTurns) {
  a.shape.split = {6, 7};
  inPlace.beginLoop(a.shape, 3, 1);
  std::set<uint64_t> paths{77};
  for (uint32_t turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(inPlace.turn(), turn);
    EXPECT_EQ(a.shape.split.index, turn);
    EXPECT_EQ(a.shape.split.total, 3u);
    EXPECT_TRUE(paths.insert(a.shape.path).second) << "turn " << turn << " has the address of one";
    EXPECT_EQ(inPlace.nextTurn(a.shape), turn < 2);
  }
  EXPECT_EQ(inPlace.size(), 0u);
  EXPECT_EQ(a.shape.split.index, 6u);
  EXPECT_EQ(a.shape.split.total, 7u);
  EXPECT_EQ(a.shape.path, 77u);
}

TEST_F(InPlaceTest, LocalValuesEndWithTheirBlock) {
  a.shape.locals = locals.bind(0, 1, Value::of(10.0));
  inPlace.beginLocals(a.shape);
  a.shape.locals = locals.bind(a.shape.locals, 1, Value::of(20.0));
  EXPECT_EQ(locals.find(a.shape.locals, 1)->number, 20);
  inPlace.endLocals(a.shape);
  EXPECT_EQ(locals.find(a.shape.locals, 1)->number, 10);
  EXPECT_EQ(locals.size(), 1u);
}

}  // namespace
}  // namespace gable
