// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/image/palette.h"

#include <gtest/gtest.h>

#include <set>

namespace gable {
namespace {

// A square of colours that all differ, clear in its left half.
Image manyColors(uint32_t side) {
  Image image{side, side, {}};
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      const auto byte = [&](uint32_t v) { return static_cast<uint8_t>(v * 255 / (side - 1)); };
      image.rgba.insert(image.rgba.end(),
                        {byte(x), byte(y), 90, static_cast<uint8_t>(2 * x < side ? 0 : 255)});
    }
  }
  return image;
}

size_t colorsOf(const Image& image) {
  std::set<std::vector<uint8_t>> colors;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    colors.insert({image.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                   image.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4)});
  }
  return colors.size();
}

TEST(Palette, isThePictureAgain) {
  const Image image = manyColors(16);
  const std::optional<Palette> p = paletteOf(image);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->colors.size(), 256u);
  EXPECT_EQ(p->colors.front()[3], 0);
  EXPECT_EQ(p->colors.back()[3], 255);
  for (size_t i = 0; i < p->numbers.size(); ++i) {
    const auto& c = p->colors[p->numbers[i]];
    EXPECT_TRUE(std::equal(c.begin(), c.end(), image.at(0, 0) + 4 * i));
  }
}

TEST(Palette, whatHasMoreColoursHasNone) {
  EXPECT_FALSE(paletteOf(manyColors(17)));
  // Without alpha, colours that differ in that only are one.
  Image two{2, 1, {9, 9, 9, 0, 9, 9, 9, 255}};
  EXPECT_EQ(paletteOf(two, 4)->colors.size(), 2u);
  EXPECT_EQ(paletteOf(two, 3)->colors.size(), 1u);
}

TEST(Palette, fewColoursAreNearThoseThatWere) {
  const Image before = manyColors(64);
  Image after = before;
  reduceColors(after, 64);
  EXPECT_LE(colorsOf(after), 64u);
  double worst = 0;
  for (size_t i = 0; i < before.rgba.size(); ++i) {
    const double off = 1.0 * after.rgba[i] - 1.0 * before.rgba[i];
    worst = std::max(worst, off * off);
    if (i % 4 == 3) {
      EXPECT_EQ(after.rgba[i], before.rgba[i]);
    }
  }
  // 64 of a square of 255 steps: none is farther than a cell is wide.
  EXPECT_LE(worst, 32 * 32);
}

TEST(Palette, fewColoursStay) {
  const Image before = manyColors(16);
  Image after = before;
  reduceColors(after, 256);
  EXPECT_EQ(after.rgba, before.rgba);
  reduceColors(after, 1);
  EXPECT_EQ(colorsOf(after), 1u);
}

}  // namespace
}  // namespace gable
