// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/image.h"

#include <array>

#include <gtest/gtest.h>

#include <webp/encode.h>

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
  EXPECT_EQ(decodeImage(encodePng(image, 4, 1).value()).value().rgba, image.rgba);
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

// A TIFF of one strip: red, green, blue and alpha where there are four samples.
std::string tiff(uint32_t width, uint32_t height, uint16_t samples, const std::string& pixels) {
  std::string out("II*\0", 4);
  const auto put = [&](uint64_t v, int n) {
    for (int i = 0; i < n; ++i) out += static_cast<char>(v >> (8 * i));
  };
  put(8, 4);
  const uint16_t entries = samples == 4 ? 10 : 9;
  const uint32_t behind = 8 + 2 + entries * 12u + 4;
  put(entries, 2);
  const auto entry = [&](uint16_t tag, uint16_t type, uint32_t count, uint32_t value) {
    put(tag, 2), put(type, 2), put(count, 4), put(value, 4);
  };
  entry(256, 4, 1, width);
  entry(257, 4, 1, height);
  entry(258, 3, samples, behind);
  entry(259, 3, 1, 1);
  entry(262, 3, 1, 2);
  entry(273, 4, 1, behind + 2u * samples);
  entry(277, 3, 1, samples);
  entry(278, 4, 1, height);
  entry(279, 4, 1, static_cast<uint32_t>(pixels.size()));
  if (samples == 4) entry(338, 3, 1, 2);
  put(0, 4);
  for (int i = 0; i < samples; ++i) put(8, 2);
  return out + pixels;
}

std::string bmp() {
  std::string out = "BM";
  const auto put = [&](uint32_t v, int n) {
    for (int i = 0; i < n; ++i) out += static_cast<char>(v >> (8 * i));
  };
  put(54 + 16, 4), put(0, 4), put(54, 4);
  put(40, 4), put(2, 4), put(2, 4), put(1, 2), put(24, 2);
  for (int i = 0; i < 6; ++i) put(0, 4);
  // From the bottom, blue first, rows of whole words: blue and white, red and green.
  return out + std::string("\xff\0\0\xff\xff\xff\0\0\0\0\xff\0\xff\0\0\0", 16);
}

std::string tga() {
  std::string out("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28", 18);
  return out + std::string("\0\0\xff\xff\0\xff\0\x40", 8);
}

std::string gif() {
  // Two colours, red and clear; the data says 0, 1.
  return std::string("GIF89a\2\0\1\0\x80\0\0\xff\0\0\0\xff\0", 19) +
         std::string("!\xf9\4\1\0\0\1\0", 8) + std::string(",\0\0\0\0\2\0\1\0\0", 10) +
         std::string("\2\2\x44\x0a\0;", 6);
}

std::string webp() {
  const uint8_t pixels[] = {255, 0, 0, 255, 0, 255, 0, 64};
  uint8_t* made = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(pixels, 2, 1, 8, &made);
  std::string out(reinterpret_cast<char*>(made), size);
  WebPFree(made);
  return out;
}

std::vector<std::string> otherPictures() {
  const std::string four("\xff\0\0\xff\0\x80\0\x80", 8), three("\xff\0\0\0\xff\0", 6);
  return {tiff(2, 1, 4, four), tiff(2, 1, 3, three), bmp(), tga(), gif(), webp()};
}

TEST(Image, otherFormatsAreRead) {
  const auto pixel = [](const Image& image, uint32_t x) {
    const uint8_t* p = image.at(x, 0);
    return std::array<int, 4>{p[0], p[1], p[2], p[3]};
  };
  const ImageFormat formats[] = {ImageFormat::Tiff, ImageFormat::Tiff, ImageFormat::Bmp,
                                 ImageFormat::Tga,  ImageFormat::Gif,  ImageFormat::WebP};
  const bool alpha[] = {true, false, false, true, true, true};
  const std::array<int, 4> second[] = {{0, 128, 0, 128}, {0, 255, 0, 255}, {0, 255, 0, 255},
                                       {0, 255, 0, 64},  {0, 0, 0, 0},     {0, 255, 0, 64}};
  const std::vector<std::string> all = otherPictures();
  for (size_t i = 0; i < all.size(); ++i) {
    Result<ImageHeader> h = readImageHeader(all[i]);
    ASSERT_TRUE(h.ok()) << i << h.error().message;
    EXPECT_EQ(h->format, formats[i]) << i;
    EXPECT_EQ(h->width, 2u) << i;
    EXPECT_EQ(h->height, i == 2 ? 2u : 1u) << i;
    EXPECT_EQ(h->hasAlpha, alpha[i]) << i;
    Result<Image> image = decodeImage(all[i]);
    ASSERT_TRUE(image.ok()) << i << image.error().message;
    EXPECT_EQ(pixel(*image, 0), (std::array<int, 4>{255, 0, 0, 255})) << i;
    if (i == 4) {
      EXPECT_EQ(image->at(1, 0)[3], 0);
    } else {
      EXPECT_EQ(pixel(*image, 1), second[i]) << i;
    }
    EXPECT_EQ(decodeImage(all[i], 1).error().code, "image-too-large") << i;
  }
}

TEST(Image, hugeSizesInHeadsTakeNoMemory) {
  EXPECT_EQ(decodeImage(tiff(1000000, 1000000, 3, "abc")).error().code, "image-too-large");
  EXPECT_FALSE(decodeImage(tiff(8000, 8000, 3, "abc")).ok());
  std::string big = tga();
  big[13] = big[15] = '\x7f';
  EXPECT_FALSE(decodeImage(big).ok());
}

TEST(Image, everyCutOffPictureIsAnError) {
  const std::string jpeg(testing::kRedGreenJpeg, sizeof testing::kRedGreenJpeg);
  const std::string png = testing::picture(16, true);
  for (const std::string& good : otherPictures()) {
    // The last two bytes of a BMP are padding.
    const size_t needed = good.size() - (good[0] == 'B' ? 2 : 0);
    for (size_t n = 0; n < needed; ++n) {
      EXPECT_FALSE(decodeImage(std::string_view(good).substr(0, n)).ok())
          << good.size() << " " << n;
    }
  }
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
  std::vector<std::string> all = otherPictures();
  all.push_back(testing::picture(16, true));
  all.push_back(jpeg);
  for (const std::string& good : all) {
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
  EXPECT_EQ(decodeImage("no picture").error().code, "image-unknown");
  EXPECT_EQ(decodeImage("").error().code, "image-unknown");
  EXPECT_FALSE(encodePng(Image{}, 4).ok());
}

TEST(Image, halvesWeighPixelsByTheirAlpha) {
  Image image;
  image.width = 3;
  image.height = 2;
  image.rgba = {100, 0, 0, 255, 200, 0, 0, 255, 8, 8, 8, 0,  //
                100, 0, 0, 255, 0,   0, 0, 0,   8, 8, 8, 0};
  const Image half = halved(image);
  EXPECT_EQ(half.width, 2u);
  EXPECT_EQ(half.height, 1u);
  EXPECT_EQ(half.rgba, (std::vector<uint8_t>{133, 0, 0, 191, 8, 8, 8, 0}));
}

}  // namespace
}  // namespace gable
