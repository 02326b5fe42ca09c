// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/spare_memory.h"

#include <gtest/gtest.h>

#include "runtime/derive.h"

namespace gable {
namespace {

template <class T = Leaf>
std::vector<T> roomFor(size_t count) {
  std::vector<T> out;
  out.reserve(count);
  return out;
}

TEST(SpareMemory, keepsTheLargerBlock) {
  SpareMemory memory;
  for (const size_t count : {100, 400, 200}) memory.keep({.leaves = roomFor(count)});
  EXPECT_EQ(memory.take().leaves.capacity(), 400u);
  EXPECT_EQ(memory.take().leaves.capacity(), 0u);
}

TEST(SpareMemory, takesABlockThatFits) {
  std::vector<Leaf> spare(300);
  const Leaf* const place = spare.data();
  const std::vector<Leaf> list = withRoom(std::move(spare), 200);
  EXPECT_EQ(list.data(), place);
  EXPECT_TRUE(list.empty());
  EXPECT_GE(list.capacity(), 200u);
}

TEST(SpareMemory, aListHasRoomForALittleMoreTheNextTime) {
  std::vector<Leaf> spare = withRoom(std::vector<Leaf>(), 1000);
  const Leaf* const place = spare.data();
  EXPECT_EQ(withRoom(std::move(spare), 1100).data(), place);
}

TEST(SpareMemory, isReadyForAResultLikeTheOneBefore) {
  DeriveResult result;
  result.scene.leaves.resize(5000);
  result.scene.instances.resize(300);
  result.scene.prototypes.resize(200);
  SpareMemory memory;
  memory.keep({.leaves = roomFor(12'000), .instances = roomFor<Instance>(300)});
  memory.prepare(result);
  const SpareBlocks blocks = memory.take();
  EXPECT_EQ(blocks.leaves.capacity(), 12'000u) << "what is there is large enough";
  EXPECT_GE(blocks.instances.capacity(), 600u) << "there may be twice as many";
  EXPECT_GE(blocks.prototypes.capacity(), 200u);
  EXPECT_GE(blocks.notes.capacity(), 200u);
  EXPECT_TRUE(blocks.prototypeNumbers.hasRoom(400));
  EXPECT_TRUE(blocks.bare.hasRoom(400));
}

TEST(SpareMemory, givesBackWhatIsTooSmallOrMuchTooLarge) {
  EXPECT_GE(withRoom(roomFor(100), 200).capacity(), 200u);
  EXPECT_LT(withRoom(roomFor(100'000), 200).capacity(), 100'000u);
}

}  // namespace
}  // namespace gable
