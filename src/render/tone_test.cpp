// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/tone.h"

#include <gtest/gtest.h>

namespace gable::rt {
namespace {

TEST(Tone, levelsAreThoseOfTheEncoding) {
  for (int i = 0; i <= 10000; ++i) {
    const float v = static_cast<float>(i) / 10000;
    EXPECT_NEAR(srgbLevel(v), 255 * linearToSrgb(v), 0.01f) << v;
  }
}

}  // namespace
}  // namespace gable::rt
