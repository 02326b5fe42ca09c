// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/image/leaf_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "material/builtin_textures.h"

namespace gable {
namespace {

TEST(LeafPictures, areTwigsOnNothing) {
  for (size_t i = 0; i < kBuiltinLeaves.size(); ++i) {
    SCOPED_TRACE(kBuiltinLeaves[i]);
    const Image image = drawLeaves(i);
    ASSERT_EQ(image.width, kLeafPictureSize);
    ASSERT_EQ(image.rgba.size(), size_t{4} * kLeafPictureSize * kLeafPictureSize);
    // By cell: how much is covered, and that its foot is.
    constexpr uint32_t kHalf = kLeafPictureSize / 2;
    for (uint32_t cell = 0; cell < 4; ++cell) {
      const uint32_t left = cell % 2 * kHalf, top = cell / 2 * kHalf;
      size_t covered = 0, foot = 0;
      for (uint32_t y = 0; y < kHalf; ++y) {
        for (uint32_t x = 0; x < kHalf; ++x) {
          if (image.at(left + x, top + y)[3] < 128) continue;
          ++covered;
          if (y + 12 >= kHalf) ++foot;
        }
      }
      const double share = static_cast<double>(covered) / (kHalf * kHalf);
      EXPECT_GT(share, 0.1);
      EXPECT_LT(share, 0.85);
      EXPECT_GT(foot, 0u);
    }
  }
}

TEST(LeafPictures, areLightSoThatTheColourShows) {
  for (size_t i = 0; i < kBuiltinLeaves.size(); ++i) {
    const Image image = drawLeaves(i);
    double sum = 0, count = 0;
    for (size_t k = 0; k < image.rgba.size(); k += 4) {
      if (image.rgba[k + 3] < 255) continue;
      sum += image.rgba[k + 1];
      ++count;
    }
    EXPECT_GT(sum / count, 120) << kBuiltinLeaves[i];
  }
}

TEST(LeafPictures, areSmallFiles) {
  const Image image = drawLeaves(builtinLeaves("builtin:leaves/lime.png"));
  const std::string png = encodePng(image, 4).value();
  EXPECT_EQ(decodeImage(png).value().rgba, image.rgba);
  EXPECT_LT(png.size(), 75'000u);
}

TEST(LeafPictures, haveNoDarkRims) {
  const Image image = drawLeaves(builtinLeaves("builtin:leaves/lime.png"));
  for (size_t k = 0; k < image.rgba.size(); k += 4) {
    if (image.rgba[k + 3] == 0) ASSERT_GT(image.rgba[k + 1], 100);
  }
}

TEST(LeafPictures, areFoundByTheirPath) {
  EXPECT_TRUE(std::is_sorted(kBuiltinLeaves.begin(), kBuiltinLeaves.end(),
                             [](const char* a, const char* b) { return std::string(a) < b; }));
  EXPECT_EQ(builtinLeaves("builtin:leaves/birch.png"), 0u);
  for (const char* none : {"builtin:leaves/", "builtin:leaves/.png", "builtin:leaves/elm.png",
                           "leaves/birch.png", "builtin:leaves/birch.jpg"}) {
    EXPECT_EQ(builtinLeaves(none), kBuiltinLeaves.size()) << none;
  }
  EXPECT_TRUE(isBuiltinTexture("builtin:leaves/willow.png"));
}

}  // namespace
}  // namespace gable
