// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/arguments.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(Arguments, FindsAWordAmongWords) {
  EXPECT_EQ(wordIndex("origin center corner", "origin"), 0);
  EXPECT_EQ(wordIndex("origin center corner", "center"), 1);
  EXPECT_EQ(wordIndex("origin center corner", "corner"), 2);
  EXPECT_EQ(wordIndex("xy x", "x"), 1);
}

TEST(Arguments, FindsNoPartsOfWordsAndNoTwo) {
  using namespace std::string_view_literals;
  for (const std::string_view other :
       {""sv, "c"sv, "cent"sv, "centers"sv, "origin center"sv, " "sv, "center\0"sv, "\0"sv}) {
    EXPECT_EQ(wordIndex("origin center", other), -1) << other;
  }
  EXPECT_EQ(wordIndex("", "x"), -1);
  EXPECT_EQ(wordIndex("", ""), -1);
  EXPECT_EQ(wordIndex(nullptr, "x"), -1);
}

}  // namespace
}  // namespace gable
