// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/skeleton/wide_int.h"

#include <gtest/gtest.h>

#include "base/hash.h"

namespace gable::skeleton {
namespace {

// Numbers of each size, with squares and their neighbours among them, where a root that is one off
// would show.
TEST(WideInt, rootsAreThoseOfTheLibrary) {
  EXPECT_EQ(rootOf(0), 0);
  for (unsigned bits = 1; bits <= 210; ++bits) {
    for (uint64_t i = 0; i < 20; ++i) {
      WideInt n = mix64(bits * 1000 + i);
      for (uint64_t k = 1; k < 4; ++k) n = (n << 64) + mix64(bits * 1000 + i + k * 77'777);
      n >>= 256 - bits;
      const WideInt root = sqrt(n);
      EXPECT_EQ(rootOf(n), root) << n;
      EXPECT_EQ(rootOf(root * root), root);
      if (!root.is_zero()) {
        EXPECT_EQ(rootOf(root * root - 1), root - 1);
      }
    }
  }
}

}  // namespace
}  // namespace gable::skeleton
