// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/key_numbers.h"

#include <gtest/gtest.h>

#include "base/hash.h"

namespace gable {
namespace {

ShareKey keyOf(uint64_t i) { return {mix64(i), mix64(i + 1)}; }

TEST(KeyNumbers, knowsWhatWasPutIn) {
  constexpr uint32_t kCount = 20000;
  KeyNumbers numbers;
  EXPECT_EQ(numbers.find(keyOf(0)), nullptr);
  for (uint32_t i = 0; i < kCount; ++i) numbers.emplace(keyOf(i), i);
  EXPECT_EQ(numbers.size(), kCount);
  for (uint32_t i = 0; i < kCount; ++i) {
    const uint32_t* const found = numbers.find(keyOf(i));
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(*found, i);
  }
  EXPECT_EQ(numbers.find(keyOf(kCount)), nullptr);
}

TEST(KeyNumbers, keepsTheFirstNumberOfAKey) {
  KeyNumbers numbers;
  numbers.emplace(keyOf(7), 1);
  numbers.emplace(keyOf(7), 2);
  EXPECT_EQ(numbers.size(), 1u);
  EXPECT_EQ(*numbers.find(keyOf(7)), 1u);
}

TEST(KeyNumbers, tellsKeysApartThatBeginInTheSamePlace) {
  KeyNumbers numbers;
  for (uint32_t i = 0; i < 40; ++i) numbers.emplace({63, i}, i);
  for (uint32_t i = 0; i < 40; ++i) EXPECT_EQ(*numbers.find({63, i}), i);
  EXPECT_EQ(numbers.find({63, 40}), nullptr);
}

TEST(KeyNumbers, forgetsAll) {
  KeyNumbers numbers;
  for (uint32_t i = 0; i < 100; ++i) numbers.emplace(keyOf(i), i);
  numbers.clear();
  EXPECT_EQ(numbers.size(), 0u);
  EXPECT_EQ(numbers.find(keyOf(5)), nullptr);
  numbers.emplace(keyOf(5), 9);
  EXPECT_EQ(*numbers.find(keyOf(5)), 9u);
}

TEST(KeyNumbers, startsAgainInTheSameMemory) {
  KeyNumbers numbers;
  for (uint32_t i = 0; i < 1000; ++i) numbers.emplace(keyOf(i), i);
  const size_t bytes = numbers.bytes();
  numbers.restart(900);
  EXPECT_EQ(numbers.bytes(), bytes);
  EXPECT_EQ(numbers.find(keyOf(5)), nullptr);
  numbers.emplace(keyOf(5), 9);
  EXPECT_EQ(*numbers.find(keyOf(5)), 9u);
  numbers.restart(10);
  EXPECT_LT(numbers.bytes(), bytes);
  EXPECT_EQ(numbers.size(), 0u);
  numbers.restart(5000);
  const size_t more = numbers.bytes();
  for (uint32_t i = 0; i < 5000; ++i) numbers.emplace(keyOf(i), i);
  EXPECT_EQ(numbers.bytes(), more);
}

}  // namespace
}  // namespace gable
