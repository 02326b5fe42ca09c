// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What an operation looks at and does not declare stops builds with checks.

#include <gtest/gtest.h>

#include "builtins/catalogue.h"
#include "builtins/testing/op_fixture.h"

namespace gable {

namespace {

Status movesByPivot(OpCall& call) {
  call.shape().scope.origin += call.shape().pivot.origin;
  return {};
}
Status movesByWorld(OpCall& call) {
  call.shape().scope.origin += call.world().origin;
  return {};
}
Status movesByChance(OpCall& call) {
  call.shape().scope.origin.x += randomIn(call.randomAddress(0), 0, 1);
  return {};
}
Status turnsBySplitIndex(OpCall& call) {
  if (call.shape().split.index == 0) call.shape().size.x = 2;
  return {};
}

// The code of an argument, which gives another number each time it is asked.
struct CodeServices : FakeServices {
  Value evaluateAtWork(uint32_t, uint64_t, const Shape*) override { return Value::of(++count); }
  double count = 0;
};
Status growsByCode(OpCall& call) {
  for (uint64_t k = 0; k < 3; ++k) {
    call.shape().size.x += call.services().evaluate(1, k, nullptr).number;
  }
  return {};
}
Status growsByCodeAtPivot(OpCall& call) {
  call.shape().size.x =
      call.services().evaluate(1, hashDouble(call.shape().pivot.origin.x), nullptr).number;
  return {};
}
Value pivotX(FunctionCall& call) { return Value::of(call.shape().pivot.origin.x); }
Value splitCode(FunctionCall& call) {
  return call.services().evaluate(call.shape().split.index, 0, nullptr);
}
Value nextOfCode(FunctionCall& call) { return call.services().evaluate(1, 0, nullptr); }

constexpr Signature kNothing[] = {{}};

Status runs(Status (*apply)(OpCall&), uint32_t effects) {
  const OpSpec spec{"moves", "test", "", kNothing, apply, BlockKind::None, effects};
  CodeServices services;
  Shape shape = boxShape({1, 1, 1});
  const CallPlace place{shape.scope, shape.size, "rules/test.cga"};
  OpCall call(spec, shape, {}, services, place);
  return call.run();
}

double valueOf(Value (*function)(FunctionCall&), uint32_t effects) {
  CodeServices services;
  const Shape shape = boxShape({1, 1, 1});
  FunctionCall call({}, shape, services);
  return call.run(function, effects).number;
}

}  // namespace

TEST(Audit, whatIsDeclaredMayBeLookedAt) {
  EXPECT_TRUE(runs(movesByPivot, kReadsPivot).ok());
  EXPECT_TRUE(runs(movesByWorld, kReadsWorld).ok());
  EXPECT_TRUE(runs(movesByChance, kRandom).ok());
  EXPECT_TRUE(runs(turnsBySplitIndex, kReadsSplit).ok());
  EXPECT_TRUE(runs(growsByCode, kPure).ok());
  EXPECT_TRUE(runs(growsByCodeAtPivot, kReadsPivot).ok());
  EXPECT_EQ(valueOf(pivotX, kReadsPivot), 0);
  EXPECT_EQ(valueOf(splitCode, kReadsSplit), 1);
}

TEST(Audit, theSecondRunGetsWhatCodeGaveTheFirst) { EXPECT_EQ(valueOf(nextOfCode, kPure), 1); }

// A getter that looks at more than it declares would end the program.
TEST(Audit, everyAttributeOfShapesDeclaresWhatItReads) {
  FakeServices services;
  for (const Shape& shape :
       {boxShape({1, 2, 3}), quadShape(4, 5), polygonShape({{{0, 0}, {3, 0}, {0, 4}}})}) {
    for (const AttributeSpec* attribute : builtinCatalogue().attributes) {
      if (!attribute->get) continue;
      FunctionCall call({}, shape, services);
      EXPECT_EQ(call.run(attribute->get, attribute->effects).type, attribute->type)
          << attribute->name;
    }
  }
}

#if GABLE_DCHECKS && GTEST_HAS_DEATH_TEST
TEST(AuditDeathTest, whatIsNotDeclaredStops) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(runs(movesByPivot, kPure), "depends on a field");
  EXPECT_DEATH(runs(movesByWorld, kReadsPivot), "kReadsWorld.* in 'moves'");
  EXPECT_DEATH(runs(movesByChance, kReadsWorld), "kRandom");
  EXPECT_DEATH(runs(turnsBySplitIndex, kRandom), "depends on a field");
  EXPECT_DEATH(runs(growsByCodeAtPivot, kPure), "depends on a field");
  EXPECT_DEATH(valueOf(pivotX, kReadsSplit), "depends on a field");
  EXPECT_DEATH(valueOf(splitCode, kReadsPivot), "depends on a field");
}
#endif

}  // namespace gable
