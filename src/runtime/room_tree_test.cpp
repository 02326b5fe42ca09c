// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/room_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"

namespace gable {
namespace {

std::vector<Box3> randomBoxes(size_t count, double reach) {
  std::vector<Box3> out;
  for (size_t i = 0; i < count; ++i) {
    Box3 b;
    const auto at = [&](uint64_t k) { return randomIn(10 * i + k, 0, reach); };
    const Vec3 from{at(0), at(1), at(2)};
    b.include(from);
    b.include(from + Vec3{randomIn(10 * i + 3, 0, 2), randomIn(10 * i + 4, 0, 2),
                          randomIn(10 * i + 5, 0, 2)});
    out.push_back(b);
  }
  return out;
}

bool meet(const Box3& a, const Box3& b, bool anyHeight) {
  for (size_t i = 0; i < 3; ++i) {
    if (i == 1 && anyHeight) continue;
    if (a.min[i] > b.max[i] || b.min[i] > a.max[i]) return false;
  }
  return true;
}

TEST(RoomTree, FindsWhatWasPutAndNothingElse) {
  const std::vector<Box3> boxes = randomBoxes(300, 20);
  RoomTree tree(boxes, true);
  std::vector<uint32_t> put;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    const bool anyHeight = i % 7 == 0;
    std::vector<uint32_t> found, expected;
    tree.any(boxes[i], anyHeight, [&](uint32_t item) {
      found.push_back(item);
      return false;
    });
    for (const uint32_t p : put) {
      if (meet(boxes[i], boxes[p], anyHeight || p % 5 == 0)) expected.push_back(p);
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << i;
    if (i % 3 == 0) continue;
    tree.put(i, boxes[i], i % 5 == 0);
    put.push_back(i);
  }
}

TEST(RoomTree, StopsWhenItIsTold) {
  const std::vector<Box3> boxes(50, randomBoxes(1, 1)[0]);
  RoomTree tree(boxes, false);
  for (uint32_t i = 0; i < boxes.size(); ++i) tree.put(i, boxes[i], true);
  int visits = 0;
  EXPECT_TRUE(tree.any(boxes[0], false, [&](uint32_t) { return ++visits == 3; }));
  EXPECT_EQ(visits, 3);
}

TEST(RoomTree, MayBeEmpty) {
  RoomTree tree({}, false);
  EXPECT_FALSE(tree.any(randomBoxes(1, 1)[0], true, [](uint32_t) { return true; }));
}

}  // namespace
}  // namespace gable
