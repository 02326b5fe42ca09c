// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/status.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(Status, TellsWhatWentWrong) {
  EXPECT_TRUE(Status().ok());
  EXPECT_EQ(Status().code(), nullptr);
  EXPECT_EQ(Status().message(), "");
  const Status s = Status::failure("no-area", "the face has no area", "draw it larger");
  EXPECT_FALSE(s.ok());
  EXPECT_STREQ(s.code(), "no-area");
  EXPECT_EQ(s.message(), "the face has no area");
  EXPECT_EQ(s.hint(), "draw it larger");
}

TEST(Status, IsCopiedMovedAndAssigned) {
  Status first = Status::failure("a", "one");
  Status copy = first;
  first = Status::failure("b", "two");
  EXPECT_EQ(copy.message(), "one");
  EXPECT_EQ(first.message(), "two");
  const Status taken = std::move(first);
  EXPECT_EQ(taken.message(), "two");
  Status& self = copy;
  copy = self;
  EXPECT_EQ(copy.message(), "one");
  copy = Status();
  EXPECT_TRUE(copy.ok());
}

}  // namespace
}  // namespace gable
