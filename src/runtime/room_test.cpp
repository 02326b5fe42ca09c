// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/room.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

constexpr StringId kHouse = 5, kTree = 6;

Shape boxAt(double x) {
  Shape s;
  s.scope = Frame::moved({x, 0, 0});
  s.size = {2, 2, 2};
  s.geometry.kind = GeometryKind::Box;
  return s;
}

struct Asking {
  RoomClaims claims;
  uint32_t initialShape = 0;

  uint32_t ask(double x, PlacePath path, double rank = 0, RoomCondition condition = kAlways) {
    RoomClaims::Claim c{.initialShape = initialShape, .condition = condition, .asks = true};
    c.group = kHouse;
    c.rank = rank;
    return claims.add(c, path, boxAt(x), Frame{});
  }
  void label(double x, PlacePath path, RoomCondition condition = kAlways, StringId name = kHouse) {
    RoomClaims::Claim c{.initialShape = initialShape, .condition = condition};
    c.group = name;
    claims.add(c, path, boxAt(x), Frame{});
  }
};

RoomPlan planOf(Asking a) { return RoomPlan({std::move(a.claims)}); }

Room answer(const RoomPlan& plan, double x, const PlacePath& path, uint32_t initialShape = 0) {
  return plan.answer(initialShape, path, {x, 0, 0}, {2, 2, 2});
}

TEST(RoomPlan, TheFirstKeepsItsRoom) {
  Asking a;
  a.ask(0, {0});
  a.ask(1, {1});
  a.ask(2, {2});
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 0, {0}), Room::Free);
  EXPECT_EQ(answer(plan, 1, {1}), Room::Taken);
  EXPECT_EQ(answer(plan, 2, {2}), Room::Free) << "they touch";
  ASSERT_EQ(plan.counts().size(), 1u);
  EXPECT_EQ(plan.counts()[0].kept, 2u);
  EXPECT_EQ(plan.counts()[0].dropped, 1u);
}

TEST(RoomPlan, LowerRanksComeFirst) {
  Asking a;
  a.ask(0, {0});
  a.ask(1, {1}, -1);
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 0, {0}), Room::Taken);
  EXPECT_EQ(answer(plan, 1, {1}), Room::Free);
}

TEST(RoomPlan, WorkersAreOrderedByInitialShapes) {
  Asking first, second;
  first.initialShape = 3;
  second.initialShape = 1;
  first.ask(0, {0});
  second.ask(1, {0});
  std::vector<RoomClaims> claims;
  claims.push_back(std::move(first.claims));
  claims.push_back(std::move(second.claims));
  const RoomPlan plan(std::move(claims));
  EXPECT_EQ(answer(plan, 0, {0}, 3), Room::Taken);
  EXPECT_EQ(answer(plan, 1, {0}, 1), Room::Free);
  EXPECT_EQ(answer(plan, 1, {0}, 0), Room::Unknown);
  EXPECT_EQ(answer(plan, 1, {0}, 2), Room::Unknown);
  EXPECT_EQ(answer(plan, 1, {0}, 9), Room::Unknown);
}

TEST(RoomPlan, LabelsStandThereFromTheStart) {
  Asking a;
  a.ask(0, {0});
  a.label(1, {1});
  a.label(5, {2}, kAlways, kTree);
  a.ask(5, {3});
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 0, {0}), Room::Taken);
  EXPECT_EQ(answer(plan, 5, {3}), Room::Free);
}

TEST(RoomPlan, RelatedOnesAreNotInTheWay) {
  Asking a;
  a.label(0, {0});
  a.ask(0, {0, 1});
  a.ask(0, {0, 1, 0, 4});
  a.ask(0, {0, 2});
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 0, {0, 1}), Room::Free);
  EXPECT_EQ(answer(plan, 0, {0, 1, 0, 4}), Room::Free);
  EXPECT_EQ(answer(plan, 0, {0, 2}), Room::Taken);
}

TEST(RoomPlan, WhatComesOfTheOtherWayIsNotMade) {
  Asking a;
  a.ask(0, {0});
  const uint32_t second = a.ask(1, {1});
  a.label(10, {1, 0}, conditionOf(second, true));
  a.ask(20, {1, 0, 0}, 0, conditionOf(second, true));
  a.ask(30, {1, 1, 0}, 0, conditionOf(second, false));
  a.ask(10, {2});
  a.ask(20, {3});
  a.ask(30, {4});
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 1, {1}), Room::Taken);
  EXPECT_EQ(answer(plan, 20, {1, 0, 0}), Room::Unknown);
  EXPECT_EQ(answer(plan, 30, {1, 1, 0}), Room::Free);
  EXPECT_EQ(answer(plan, 10, {2}), Room::Free);
  EXPECT_EQ(answer(plan, 20, {3}), Room::Free);
  EXPECT_EQ(answer(plan, 30, {4}), Room::Taken);
  EXPECT_TRUE(plan.holds(0, conditionOf(second, false)));
  EXPECT_FALSE(plan.holds(0, conditionOf(second, true)));
  EXPECT_TRUE(plan.holds(0, kAlways));
  EXPECT_EQ(plan.counts()[0].kept + plan.counts()[0].dropped, 6u)
      << "what is not made is not counted";
}

TEST(RoomPlan, AnotherShapeAtThePlaceIsUnknown) {
  Asking a;
  a.ask(0, {0});
  const RoomPlan plan = planOf(std::move(a));
  EXPECT_EQ(answer(plan, 0.5, {0}), Room::Unknown);
  EXPECT_EQ(plan.answer(0, {0}, Vec3{}, {2, 2, 3}), Room::Unknown);
}

}  // namespace
}  // namespace gable
