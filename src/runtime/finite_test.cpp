// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/finite.h"

#include <gtest/gtest.h>

#include <limits>

namespace gable {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Finite, findsWhatIsNot) {
  Shape s;
  s.size = {1, 2, 3};
  EXPECT_TRUE(hasFiniteScope(s));
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    Shape placed = s, sized = s, turned = s;
    placed.scope.origin.y = bad;
    sized.size.z = bad;
    turned.scope.turned = true;
    turned.scope.x.z = bad;
    EXPECT_FALSE(hasFiniteScope(placed) || hasFiniteScope(sized) || hasFiniteScope(turned));
  }
}

TEST(Finite, moderateNumbersCannotOverflow) {
  Shape s;
  EXPECT_TRUE(isModerate(s));
  for (const double bad : {kNan, kInfinity, 1e31, -1e200}) {
    Shape far = s, large = s;
    far.scope.origin.x = bad;
    large.size.y = bad;
    EXPECT_FALSE(isModerate(far) || isModerate(large));
  }
}

}  // namespace
}  // namespace gable
