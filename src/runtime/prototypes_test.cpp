// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/prototypes.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

constexpr ShareKey kWindow{1, 2}, kFacade{3, 4};

class PrototypesTest : public testing::Test {
 protected:
  void makeLeaves(int count) {
    for (int i = 0; i < count; ++i) output.openLeaves.emplace_back();
  }

  Output output;
  Prototypes prototypes{output};
};

TEST_F(PrototypesTest, AreFoundByTheirKeys) {
  prototypes.beginUnit();
  EXPECT_FALSE(prototypes.find(kWindow));
  prototypes.begin(kWindow, 7, Frame::moved({1, 0, 0}), 10);
  EXPECT_TRUE(prototypes.anyOpen());
  makeLeaves(3);
  prototypes.end(14, true);
  EXPECT_FALSE(prototypes.anyOpen());
  ASSERT_TRUE(prototypes.find(kWindow));
  const OutputPrototype& made = prototypes.finished(*prototypes.find(kWindow));
  EXPECT_EQ(made.range.leafCount, 3u);
  EXPECT_EQ(made.range.shapes, 4u);
  EXPECT_EQ(made.range.name, 7u);
  // Its leaves are its own, and it stands where it was called.
  EXPECT_TRUE(output.openLeaves.empty());
  ASSERT_EQ(output.openInstances.size(), 1u);
  EXPECT_EQ(output.openInstances[0].frame.origin.x, 1);
}

TEST_F(PrototypesTest, ArePlacedAgainWithTheSameAxes) {
  prototypes.beginUnit();
  const Frame turned = Frame::of({1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  prototypes.begin(kWindow, 7, turned, 10);
  prototypes.end(14, true);
  EXPECT_EQ(prototypes.placeAgain({2, 3, 4}), *prototypes.find(kWindow));
  ASSERT_EQ(output.openInstances.size(), 2u);
  EXPECT_EQ(output.openInstances[1].frame, Frame::of({2, 3, 4}, turned.x, turned.y, turned.z));
}

TEST_F(PrototypesTest, LieInThoseAround) {
  prototypes.beginUnit();
  makeLeaves(1);
  prototypes.begin(kFacade, 1, Frame{}, 0);
  makeLeaves(2);
  prototypes.begin(kWindow, 2, Frame{}, 1);
  makeLeaves(4);
  prototypes.end(5, true);
  EXPECT_EQ(prototypes.instancesAround(), 1u);
  prototypes.place(*prototypes.find(kWindow), Frame::moved({0, 0, 3}));
  EXPECT_EQ(prototypes.instancesAround(), 2u);
  prototypes.end(6, true);
  const Prototype& facade = prototypes.finished(*prototypes.find(kFacade)).range;
  EXPECT_EQ(facade.leafCount, 2u);
  EXPECT_EQ(facade.instanceCount, 2u);
  const Instance& first = output.instances[facade.firstInstance];
  EXPECT_EQ(first.prototype, *prototypes.find(kWindow));
  // Places among leaves count from the prototype around.
  EXPECT_EQ(first.leavesBefore, 2u);
  EXPECT_EQ(output.openInstances[0].leavesBefore, 1u);
}

TEST_F(PrototypesTest, CutShortAreKeptAndNeverGivenAgain) {
  prototypes.beginUnit();
  prototypes.begin(kWindow, 2, Frame{}, 0);
  makeLeaves(4);
  prototypes.end(4, false);
  EXPECT_FALSE(prototypes.find(kWindow));
  ASSERT_EQ(output.openInstances.size(), 1u);
  EXPECT_EQ(prototypes.finished(output.openInstances[0].prototype).range.leafCount, 4u);
}

TEST_F(PrototypesTest, OfOneUnitServeTheNext) {
  prototypes.beginUnit();
  prototypes.begin(kWindow, 2, Frame{}, 0);
  makeLeaves(1);
  prototypes.end(1, true);
  makeLeaves(2);
  const uint32_t first = prototypes.endUnit(9, 5);
  EXPECT_EQ(prototypes.finished(first).range.leafCount, 2u);
  EXPECT_EQ(prototypes.finished(first).range.shapes, 5u);
  prototypes.beginUnit();
  EXPECT_EQ(prototypes.instancesAround(), 0u);
  ASSERT_TRUE(prototypes.find(kWindow));
  makeLeaves(3);
  prototypes.place(*prototypes.find(kWindow), Frame{});
  EXPECT_EQ(prototypes.placeInUnit().leaves, 3u);
  EXPECT_EQ(prototypes.placeInUnit().instances, 1u);
  EXPECT_EQ(prototypes.finished(prototypes.endUnit(9, 4)).range.instanceCount, 1u);
}

TEST_F(PrototypesTest, AreForgottenWithTheOutput) {
  prototypes.beginUnit();
  prototypes.begin(kWindow, 2, Frame{}, 0);
  makeLeaves(1);
  prototypes.end(1, true);
  prototypes.forget();
  EXPECT_FALSE(prototypes.find(kWindow));
  EXPECT_TRUE(output.prototypes.empty());
  EXPECT_TRUE(output.openInstances.empty());
}

TEST_F(PrototypesTest, AUnitBeginsBehindWhatLiesOpen) {
  makeLeaves(5);
  prototypes.beginUnit();
  makeLeaves(2);
  EXPECT_EQ(prototypes.placeInUnit().leaves, 2u);
  EXPECT_EQ(prototypes.finished(prototypes.endUnit(0, 2)).range.leafCount, 2u);
  EXPECT_EQ(output.openLeaves.size(), 5u);
}

}  // namespace
}  // namespace gable
