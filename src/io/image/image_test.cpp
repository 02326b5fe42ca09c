// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/image.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "io/testing/jpeg_sample.h"
#include "io/testing/scenes.h"

namespace gable {
namespace {

TEST(Image, pngReadsBackAsWritten) {
  Image image;
  image.width = 37;
  image.height = 11;
  for (uint32_t i = 0; i < 37 * 11 * 4; ++i)
    image.rgba.push_back(static_cast<uint8_t>(randomBits(i)));
  const std::string four = encodePng(image, 4).value(), three = encodePng(image, 3).value();
  EXPECT_EQ(decodeImage(four).value().rgba, image.rgba);
  const Image opaque = decodeImage(three).value();
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    EXPECT_EQ(opaque.rgba[i], i % 4 == 3 ? 255 : image.rgba[i]);
  }
  EXPECT_TRUE(readImageHeader(four).value().hasAlpha);
  EXPECT_FALSE(readImageHeader(three).value().hasAlpha);
  EXPECT_EQ(readImageHeader(four).value().width, 37u);
  EXPECT_EQ(readImageHeader(four).value().height, 11u);
}

TEST(Image, jpegIsRead) {
  const std::string bytes(testing::kRedGreenJpeg, sizeof testing::kRedGreenJpeg);
  const ImageHeader h = readImageHeader(bytes).value();
  EXPECT_EQ(h.format, ImageFormat::Jpeg);
  EXPECT_EQ(h.width, 16u);
  EXPECT_EQ(h.height, 8u);
  EXPECT_FALSE(h.hasAlpha);
  const Image image = decodeImage(bytes).value();
  // Red on the left, green on the right.
  EXPECT_GT(image.at(2, 4)[0], 200);
  EXPECT_LT(image.at(2, 4)[1], 60);
  EXPECT_GT(image.at(13, 4)[1], 200);
  EXPECT_LT(image.at(13, 4)[0], 60);
  EXPECT_EQ(image.at(0, 0)[3], 255);
}

TEST(Image, everyCutOffPictureIsAnError) {
  const std::string jpeg(testing::kRedGreenJpeg, sizeof testing::kRedGreenJpeg);
  const std::string png = testing::picture(16, true);
  for (const std::string& good : {png, jpeg}) {
    for (size_t n = 0; n + 16 < good.size(); ++n) {
      const auto r = decodeImage(std::string_view(good).substr(0, n));
      ASSERT_FALSE(r.ok()) << n;
      EXPECT_FALSE(r.error().message.empty());
    }
  }
}

TEST(Image, changedPicturesNeverHurt) {
  const std::string jpeg(testing::kRedGreenJpeg, sizeof testing::kRedGreenJpeg);
  for (const std::string& good : {testing::picture(16, true), jpeg}) {
    for (uint64_t seed = 0; seed < 2000; ++seed) {
      std::string bytes = good;
      for (uint64_t k = 0; k < 3; ++k) {
        const uint64_t bits = randomBits(hashCombine(seed, k));
        bytes[bits % bytes.size()] = static_cast<char>(bits >> 32);
      }
      const auto r = decodeImage(bytes, 1 << 20);
      if (r.ok()) {
        EXPECT_EQ(r.value().rgba.size(), size_t{4} * r.value().width * r.value().height);
      }
    }
  }
}

TEST(Image, largePicturesAreRefusedBeforeMemoryIsTaken) {
  std::string png = testing::picture(16, false);
  // Width and height of the header; the checksum no longer fits, which libpng tells first.
  for (size_t i = 16; i < 24; ++i) png[i] = '\x0f';
  EXPECT_FALSE(decodeImage(png).ok());
  EXPECT_EQ(decodeImage(testing::picture(16, false), 255).error().code, "image-too-large");
  EXPECT_EQ(decodeImage("GIF89a").error().code, "image-unknown");
  EXPECT_EQ(decodeImage("").error().code, "image-unknown");
  EXPECT_FALSE(encodePng(Image{}, 4).ok());
}

}  // namespace
}  // namespace gable
