// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/worlds.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

Frame quarterTurn(const Vec3& origin) {
  Frame f;
  f.origin = origin;
  f.x = {0, 1, 0};
  f.y = {-1, 0, 0};
  f.turned = true;
  return f;
}

void expectAt(const Frame& f, const Vec3& place) { EXPECT_EQ(f.origin, place); }

TEST(Worlds, ComposeTheFramesOfCalls) {
  Worlds worlds;
  worlds.begin(quarterTurn({10, 0, 0}));
  worlds.open(Frame::moved({1, 2, 3}));
  expectAt(worlds.present(), {8, 1, 3});
  worlds.open(quarterTurn({1, 0, 0}));
  expectAt(worlds.present(), {8, 2, 3});
  EXPECT_EQ(worlds.present().x, (Vec3{-1, 0, 0}));
  worlds.close();
  expectAt(worlds.present(), {8, 1, 3});
  expectAt(worlds.after(0), {10, 0, 0});
  EXPECT_EQ(&worlds.ofLeaves(), &worlds.present());
}

TEST(Worlds, PlaceLeavesInTheCallThatGathers) {
  Worlds worlds;
  worlds.begin(Frame::moved({100, 0, 0}));
  worlds.open(Frame::moved({10, 0, 0}));
  worlds.beginGather();
  expectAt(worlds.ofLeaves(), {0, 0, 0});
  worlds.open(Frame::moved({1, 0, 0}));
  expectAt(worlds.ofLeaves(), {1, 0, 0});
  expectAt(worlds.present(), {111, 0, 0});
  worlds.close();
  worlds.endGather();
  expectAt(worlds.ofLeaves(), {110, 0, 0});
}

TEST(Worlds, GathersNest) {
  Worlds worlds;
  worlds.begin(Frame{});
  worlds.beginGather();
  worlds.open(Frame::moved({5, 0, 0}));
  worlds.beginGather();
  worlds.open(Frame::moved({2, 0, 0}));
  expectAt(worlds.ofLeaves(), {2, 0, 0});
  worlds.close();
  worlds.endGather();
  expectAt(worlds.ofLeaves(), {5, 0, 0});
}

TEST(Worlds, AGatherThatALimitEndsLeavesNothing) {
  Worlds worlds;
  worlds.begin(Frame{});
  worlds.open(Frame::moved({5, 0, 0}));
  worlds.beginGather();
  worlds.open(Frame::moved({2, 0, 0}));
  // The calls inside have not ended.
  worlds.endGather();
  worlds.begin(Frame::moved({7, 0, 0}));
  expectAt(worlds.ofLeaves(), {7, 0, 0});
  worlds.beginGather();
  expectAt(worlds.ofLeaves(), {0, 0, 0});
}

}  // namespace
}  // namespace gable
