// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/light_parts.h"

#include <gtest/gtest.h>

#include "runtime/usage.h"

namespace gable {
namespace {

// A box is divided along x into parts: those of slot 0 become leaves, those of slot 1 go, and those
// of slot 2 have code that is done the long way.
class LightPartsTest : public testing::Test {
 protected:
  LightPartsTest() {
    program.pool = std::make_shared<ValuePool>();
    program.constants.push_back(Value::string(program.pool->intern("Glass")));
    program.rules.resize(1);
    const auto at = [&](Code code) {
      Instruction i{};
      i.code = code;
      program.code.push_back(i);
    };
    for (const Code code : {Code::Leaf, Code::Drop, Code::PushShape}) {
      at(code);
      at(Code::End);
    }
    program.blocks.resize(1);
    program.blocks[0].kind = BlockKind::Split;
    program.blocks[0].slots = {0, 2, 4};
    shape.geometry.kind = GeometryKind::Box;
    shape.size = {10, 4, 2};
    shape.scope = Frame::moved({1, 0, 0});
    shape.attributes = 6;
    plan.axis = Axis::X;
  }
  size_t make(const std::vector<SplitPiece>& pieces, bool flat = true) {
    const SplitCache splits(program);
    LightParts parts({program, limits, splits, flat}, output, tally);
    return parts.make({shape, plan, world, 0, 0, 1, &childCount}, pieces);
  }
  static SplitPiece piece(double start, double size, uint32_t slot) {
    SplitPiece p{};
    p.start = start;
    p.size = size;
    p.slot = slot;
    return p;
  }

  Program program;
  Limits limits;
  Usage usage{limits, nullptr};
  Tally tally{usage};
  Output output;
  Shape shape;
  PartPlan plan;
  Frame world = Frame::moved({100, 0, 0});
  uint32_t childCount = 0;
};

TEST_F(LightPartsTest, BecomeLeavesWhereTheyLie) {
  EXPECT_EQ(make({piece(0, 3, 0), piece(3, 7, 0)}), 2u);
  ASSERT_EQ(output.openLeaves.size(), 2u);
  const Leaf& second = output.openLeaves[1];
  EXPECT_EQ(second.frame.origin, (Vec3{104, 0, 0}));
  EXPECT_EQ(second.scale, (Vec3{7, 4, 2}));
  EXPECT_EQ(second.mesh, kUnitBox);
  EXPECT_EQ(program.pool->text(second.name), "Glass");
  EXPECT_EQ(second.attributes, 6u);
  EXPECT_EQ(tally.made(), 2u);
  EXPECT_EQ(childCount, 2u);
}

TEST_F(LightPartsTest, LieInTheLocalFrameOfAPrototype) {
  EXPECT_EQ(make({piece(3, 7, 0)}, false), 1u);
  EXPECT_EQ(output.openLeaves[0].frame.origin, (Vec3{4, 0, 0}));
}

TEST_F(LightPartsTest, ThatGoAreCounted) {
  EXPECT_EQ(make({piece(0, 3, 1), piece(3, 7, 0)}), 2u);
  EXPECT_EQ(output.openLeaves.size(), 1u);
  EXPECT_EQ(tally.made(), 2u);
}

TEST_F(LightPartsTest, EndBeforeOneThatIsNotLight) {
  EXPECT_EQ(make({piece(0, 3, 0), piece(3, 1, 2), piece(4, 6, 0)}), 1u);
  EXPECT_EQ(output.openLeaves.size(), 1u);
  EXPECT_EQ(make({piece(3, 1, 2)}), 0u);
}

TEST_F(LightPartsTest, AreNoneOfAShapeThatIsNoPlainBox) {
  shape.size.x = -1;
  EXPECT_EQ(make({piece(0, 3, 0)}), 0u);
  shape.size.x = 10;
  shape.geometry.kind = GeometryKind::None;
  EXPECT_EQ(make({piece(0, 3, 0)}), 0u);
}

TEST_F(LightPartsTest, BeyondTheLimitOnDepthLeaveNothing) {
  limits.depth = 0;
  EXPECT_EQ(make({piece(0, 3, 0)}), 0u);
  EXPECT_TRUE(output.openLeaves.empty());
  EXPECT_EQ(tally.made(), 0u);
  EXPECT_EQ(childCount, 0u);
}

TEST_F(LightPartsTest, StopWhenALookAtTheLimitsIsDue) {
  const std::vector<SplitPiece> pieces(5000, piece(0, 1, 0));
  const size_t made = make(pieces);
  EXPECT_GE(made, Tally::kStepsBetweenLooks);
  EXPECT_LT(made, pieces.size());
  EXPECT_TRUE(tally.isLookDue());
  EXPECT_FALSE(tally.look(0));
  EXPECT_GT(make(pieces), 0u);
}

}  // namespace
}  // namespace gable
