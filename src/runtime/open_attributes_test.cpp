// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/open_attributes.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(OpenAttributes, areTheSetThatOneAfterTheOtherMakes) {
  AttributePool pool;
  Shape shape, other;
  shape.attributes = other.attributes =
      pool.with(pool.with(0, 5, Value::of(50.0)), 2, Value::of(20.0));
  OpenAttributes open;
  open.open(shape);
  for (const uint32_t key : {9u, 5u, 1u, 9u}) {
    open.set(key, Value::of(key * 1.5));
    other.attributes = pool.with(other.attributes, key, Value::of(key * 1.5));
  }
  open.close(pool);
  EXPECT_EQ(shape.attributes, other.attributes);
  EXPECT_FALSE(open.isOpen());
}

TEST(OpenAttributes, areSeenByTheirShapeAloneUntilTheyAreClosedOrDropped) {
  AttributePool pool;
  Shape shape, other;
  OpenAttributes open;
  EXPECT_EQ(open.find(&shape, 3), nullptr);
  open.open(shape);
  open.set(3, Value::of(7.0));
  ASSERT_NE(open.find(&shape, 3), nullptr);
  EXPECT_EQ(open.find(&shape, 3)->number, 7);
  EXPECT_EQ(open.find(&shape, 2), nullptr);
  EXPECT_EQ(open.find(&shape, 4), nullptr);
  EXPECT_EQ(open.find(&other, 3), nullptr);
  open.drop();
  EXPECT_EQ(open.find(&shape, 3), nullptr);
  open.close(pool);
  EXPECT_EQ(shape.attributes, 0u);
}

}  // namespace
}  // namespace gable
