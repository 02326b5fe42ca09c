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

constexpr Signature kNothing[] = {{}};

Status runs(Status (*apply)(OpCall&), uint32_t effects) {
  const OpSpec spec{"moves", "test", "", kNothing, apply, BlockKind::None, effects};
  FakeServices services;
  Shape shape = boxShape({1, 1, 1});
  const CallPlace place{shape.scope, shape.size, "rules/test.cga"};
  OpCall call(spec, shape, {}, services, place);
  return call.run();
}

}  // namespace

TEST(Audit, whatIsDeclaredMayBeLookedAt) {
  EXPECT_TRUE(runs(movesByPivot, kReadsPivot).ok());
  EXPECT_TRUE(runs(movesByWorld, kReadsWorld).ok());
  EXPECT_TRUE(runs(movesByChance, kRandom).ok());
  EXPECT_TRUE(runs(turnsBySplitIndex, kReadsSplit).ok());
}

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
  EXPECT_DEATH(runs(movesByWorld, kReadsPivot), "kReadsWorld");
  EXPECT_DEATH(runs(movesByChance, kReadsWorld), "kRandom");
  EXPECT_DEATH(runs(turnsBySplitIndex, kRandom), "depends on a field");
}
#endif

}  // namespace gable
