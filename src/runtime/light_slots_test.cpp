// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/light_slots.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

bool applyNothing(LightPart&, const void*) { return true; }
void constructNothing(void*) {}
Status applyLong(OpCall&) { return {}; }

constexpr Signature kNoArguments[] = {{}};
constexpr OpSpec kLight =
    withLight({"light", "", "", kNoArguments, applyLong}, {constructNothing, applyNothing});
constexpr OpSpec kLong{"long", "", "", {}, applyLong};

// A program of one block with one slot, whose code each test writes.
class LightSlotsTest : public testing::Test {
 protected:
  LightSlotsTest() {
    program.pool = std::make_shared<ValuePool>();
    program.constants.push_back(Value::string(program.pool->intern("Glass")));
    program.operations.resize(2);
    program.operations[0].spec = &kLight;
    program.operations[1].spec = &kLong;
    program.rules.resize(2);
    program.rules[0].name = program.pool->intern("Bay");
    program.rules[1].name = program.pool->intern("Frame");
    program.blocks.resize(1);
    program.blocks[0].kind = BlockKind::Split;
    program.blocks[0].slots = {0};
  }
  static Instruction at(Code code, uint32_t a = 0, uint8_t x = 0) {
    Instruction i{};
    i.code = code;
    i.a = a;
    i.x = x;
    return i;
  }
  LightSlot slot(bool flat = true) { return LightSlots(program, flat).of(0, 0)[0]; }

  Program program;
};

TEST_F(LightSlotsTest, StepsAndANameMakeALeaf) {
  program.code = {at(Code::Operation, 0), at(Code::Operation, 0), at(Code::Leaf, 0), at(Code::End)};
  const LightSlot made = slot();
  EXPECT_TRUE(made.light);
  EXPECT_TRUE(made.named);
  EXPECT_EQ(made.steps.size(), 2u);
  EXPECT_EQ(program.pool->text(made.name), "Glass");
  EXPECT_EQ(made.source, 2u);
  EXPECT_EQ(made.shapes, 1u);
  EXPECT_EQ(made.work, 3u);
}

TEST_F(LightSlotsTest, PartsForASharedRuleAreAlikeUnlessItTellsThemApart) {
  program.code = {at(Code::CallRule, 1), at(Code::End), at(Code::Operation, 0), at(Code::End)};
  program.rules[1].entry = 2;
  EXPECT_FALSE(slot(false).taker);
  program.rules[1].shared = true;
  EXPECT_EQ(slot(false).taker, &program.rules[1]);
  for (const uint32_t effect : {kReadsSplit, kReadsPivot}) {
    program.rules[1].reads.effects = effect;
    EXPECT_FALSE(slot(false).taker);
  }
  program.rules[1].reads.effects = kUsesTrim;
  EXPECT_EQ(slot(false).taker, &program.rules[1]);
  program.code[0].x = 1;
  EXPECT_FALSE(slot(false).taker);
}

TEST_F(LightSlotsTest, CallsAreFollowed) {
  program.code = {at(Code::CallRule, 1), at(Code::End), at(Code::Operation, 0), at(Code::End)};
  program.rules[1].entry = 2;
  const LightSlot made = slot();
  EXPECT_TRUE(made.light);
  EXPECT_EQ(made.calls, 1u);
  EXPECT_EQ(made.rule, 1u);
  EXPECT_EQ(program.pool->text(made.name), "Frame");
  EXPECT_EQ(made.steps.size(), 1u);
}

TEST_F(LightSlotsTest, SharedRulesBecomePrototypesWhereLeavesAreNotPlacedAtOnce) {
  program.code = {at(Code::CallRule, 1), at(Code::End), at(Code::End)};
  program.rules[1].entry = 2;
  program.rules[1].shared = true;
  EXPECT_FALSE(slot(false).light);
  const LightSlot made = slot(true);
  EXPECT_TRUE(made.light);
  EXPECT_TRUE(made.boundary);
  // Steps before it would work in another frame.
  program.code = {at(Code::Operation, 0), at(Code::CallRule, 1), at(Code::End), at(Code::End)};
  program.rules[1].entry = 3;
  EXPECT_FALSE(slot(true).light);
}

TEST_F(LightSlotsTest, EndlessCallsAreNotFollowedForEver) {
  program.code = {at(Code::End), at(Code::CallRule, 1), at(Code::End)};
  program.blocks[0].slots = {1};
  program.rules[1].entry = 1;
  EXPECT_FALSE(slot().light);
}

TEST_F(LightSlotsTest, NilDropsTheParts) {
  program.code = {at(Code::Drop), at(Code::End)};
  EXPECT_TRUE(slot().light);
  EXPECT_TRUE(slot().drop);
}

TEST_F(LightSlotsTest, OtherCodeIsNotLight) {
  program.code = {at(Code::Operation, 1), at(Code::End)};
  EXPECT_FALSE(slot().light);
  // An argument that is computed.
  program.code = {at(Code::Operation, 0, 1), at(Code::End)};
  EXPECT_FALSE(slot().light);
  program.code = {at(Code::Leaf, 0), at(Code::Operation, 0), at(Code::End)};
  EXPECT_FALSE(slot().light);
  program.code = {at(Code::PushShape), at(Code::End)};
  EXPECT_FALSE(slot().light);
}

}  // namespace
}  // namespace gable
