// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/interned.h"

#include <gtest/gtest.h>

#include "base/work.h"

namespace gable {
namespace {

TEST(Interned, givesEqualValuesOneId) {
  Interned<int> table;
  const uint32_t five = table.intern(1, 5), six = table.intern(1, 6);
  EXPECT_NE(five, six);
  EXPECT_EQ(table.intern(1, 5), five);
  EXPECT_EQ(table.get(six), 6);
}

TEST(Interned, unwindsWhenItIsFull) {
  const TableCapacityScope small(2);
  Interned<int> table;
  table.intern(1, 1);
  table.intern(2, 2);
  const Status status = guarded([&] {
    table.intern(3, 3);
    return Status();
  });
  EXPECT_EQ(status.code(), kTableFull);
  // What it holds it goes on giving.
  EXPECT_EQ(table.intern(2, 2), 1u);
}

}  // namespace
}  // namespace gable
