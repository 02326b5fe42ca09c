// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(DisjointSets, joinedNumbersShareTheirSmallest) {
  DisjointSets sets(6);
  sets.join(5, 4);
  sets.join(2, 3);
  sets.join(4, 2);
  const uint32_t expected[] = {0, 1, 2, 2, 2, 2};
  for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(sets.find(i), expected[i]) << i;
  sets.join(2, 5);
  EXPECT_EQ(sets.find(5), 2u);
}

TEST(DisjointSets, aNumberThatIsAddedStandsAlone) {
  DisjointSets sets(1);
  sets.addOne();
  EXPECT_EQ(sets.find(1), 1u);
  sets.join(1, 0);
  EXPECT_EQ(sets.find(1), 0u);
}

}  // namespace
}  // namespace gable
