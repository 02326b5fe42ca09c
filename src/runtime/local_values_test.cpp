// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/local_values.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

constexpr uint32_t kHeight = 3, kWidth = 8;

TEST(LocalValues, TheInnermostCounts) {
  LocalValues values;
  const uint32_t outer = values.bind(0, kHeight, Value::of(1.0));
  const uint32_t inner = values.bind(outer, kHeight, Value::of(2.0));
  EXPECT_EQ(values.find(inner, kHeight)->number, 2);
  EXPECT_EQ(values.find(outer, kHeight)->number, 1);
  EXPECT_EQ(values.find(inner, kWidth), nullptr);
  EXPECT_EQ(values.find(0, kHeight), nullptr);
}

TEST(LocalValues, ChainsBranch) {
  LocalValues values;
  const uint32_t trunk = values.bind(0, kHeight, Value::of(1.0));
  const uint32_t left = values.bind(trunk, kWidth, Value::of(2.0));
  const uint32_t right = values.bind(trunk, kWidth, Value::of(3.0));
  EXPECT_EQ(values.find(left, kWidth)->number, 2);
  EXPECT_EQ(values.find(right, kWidth)->number, 3);
  std::vector<double> seen;
  values.forEach(right, [&](uint32_t, const Value& v) { seen.push_back(v.number); });
  EXPECT_EQ(seen, (std::vector<double>{3, 1}));
}

TEST(LocalValues, EndWithTheirBlock) {
  LocalValues values;
  const uint32_t outer = values.bind(0, kHeight, Value::of(1.0));
  const size_t before = values.size();
  values.bind(outer, kHeight, Value::of(2.0));
  const LocalValues copy = values.first(before);
  values.cut(before);
  EXPECT_EQ(values.size(), before);
  EXPECT_EQ(copy.size(), before);
  EXPECT_EQ(copy.find(outer, kHeight)->number, 1);
  values.cut(before + 5);
  EXPECT_EQ(values.size(), before);
}

}  // namespace
}  // namespace gable
