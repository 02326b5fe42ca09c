// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures: PNG, JPEG, TIFF, BMP, GIF, TGA and WebP, to eight bits of red, green, blue and alpha
// (sRGB, straight alpha), rows from the top. Broken input ends in an Error, in bounded time and
// memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace gable {

enum class ImageFormat : uint8_t { Unknown, Png, Jpeg, Tiff, Bmp, Gif, Tga, WebP };

/// ".png", ".tif": what names of such files end in.
const char* extensionOf(ImageFormat format);

struct ImageHeader {
  ImageFormat format = ImageFormat::Unknown;
  uint32_t width = 0, height = 0;
  /// An alpha channel or a transparent palette entry.
  bool hasAlpha = false;
};

struct Image {
  uint32_t width = 0, height = 0;
  /// Four bytes a pixel.
  std::vector<uint8_t> rgba;
  const uint8_t* at(uint32_t x, uint32_t y) const {
    return rgba.data() + (static_cast<size_t>(y) * width + x) * 4;
  }
};

/// 8192 x 8192.
constexpr uint64_t kMostPixels = 1ULL << 26;

/// By the first bytes, whatever the file is called.
ImageFormat imageFormat(std::string_view bytes);

/// Codes: image-unknown, image-broken, image-too-large: a pixel takes four bytes, whatever the file
/// has.
Result<ImageHeader> readImageHeader(std::string_view bytes);
Result<Image> decodeImage(std::string_view bytes, uint64_t maxPixels = kMostPixels);

/// Half as wide and half as high, a pixel at least: the mean of four pixels each, weighed by their
/// alpha.
Image halved(const Image& image);

/// `channels`: 3 drops alpha, 4 keeps it. `level`: zlib's, 1 fast to 9 small. The same bytes for
/// the same picture on one version of the PNG library.
Result<std::string> encodePng(const Image& image, int channels = 4, int level = 6);

/// Numbers a pixel that are no colours for the eye.
struct NumberImage {
  uint32_t width = 0, height = 0;
  /// 1 or 3 numbers a pixel, of 8 or 16 bits.
  int channels = 1, bits = 8;
  std::vector<uint16_t> numbers;
};

/// Without a colour space, so that no program bends the numbers.
Result<std::string> encodePng(const NumberImage& image, int level = 6);

}  // namespace gable
