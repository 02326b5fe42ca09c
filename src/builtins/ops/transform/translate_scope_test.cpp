// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

TEST(TranslateScope, movesAlongTheAxesOfTheScope) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.scope = rotationXyz(0, 90, 0);
  const Ran ran = Op("t").args(1, relative(0.5), 0).on(s, services);
  ASSERT_TRUE(ran.status.ok());
  EXPECT_EQ(ran.shape.scope.origin, (Vec3{0, 1.5, -1}));
  EXPECT_EQ(ran.shape.size, s.size);
}

}  // namespace
}  // namespace gable
