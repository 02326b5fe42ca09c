// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/memory.h"

#include <gtest/gtest.h>

#include <memory>

namespace gable {
namespace {

constexpr size_t kBytes = size_t{64} << 20;

TEST(Memory, populatedPagesAreResidentAndKeepWhatIsWritten) {
  const std::unique_ptr<char[]> room(new char[kBytes]);
  room[5] = 'a';
  const uint64_t before = residentBytes();
  if (!populate(room.get() + 3, kBytes - 3)) GTEST_SKIP() << "this system gives no pages before";
  EXPECT_GT(residentBytes(), before + kBytes / 16);
  EXPECT_EQ(room[5], 'a');
  EXPECT_EQ(room[kBytes - 1], 0);
}

TEST(Memory, populatingNothingOrNowhereDoesNoHarm) {
  EXPECT_TRUE(populate(nullptr, 0));
  EXPECT_FALSE(populate(nullptr, 1 << 20));
}

}  // namespace
}  // namespace gable
