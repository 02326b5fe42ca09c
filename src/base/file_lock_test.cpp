// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/file_lock.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "base/files.h"

namespace gable {
namespace {

class FileLockTest : public ::testing::Test {
 protected:
  const std::string path_ = ::testing::TempDir() + "gable-lock-test";
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(FileLockTest, isHeldByOneUntilItIsGivenBack) {
  std::optional<FileLock> first(path_);
  EXPECT_TRUE(first->held());
  {
    const FileLock second(path_);
    EXPECT_FALSE(second.held());
    EXPECT_EQ(second.failure(), "");
  }
  first.reset();
  EXPECT_TRUE(FileLock(path_).held());
  EXPECT_TRUE(fileExists(path_));
}

TEST_F(FileLockTest, finishedWorkLeavesNoFile) {
  const FileLock lock(path_);
  lock.finish();
  EXPECT_FALSE(fileExists(path_));
}

TEST_F(FileLockTest, tellsWhyItCannotBeTaken) {
  const FileLock lock(path_ + "/nowhere/1");
  EXPECT_FALSE(lock.held());
  EXPECT_NE(lock.failure(), "");
}

}  // namespace
}  // namespace gable
