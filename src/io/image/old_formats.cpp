// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// stb_image reads all three; only these of its readers are compiled in. It trusts heads that we
// have checked: sizes are bounded before it allocates.
#include "io/image/old_formats.h"

#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS (1 << 20)
#define STBI_ASSERT(x) ((void)0)
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace gable {
namespace {

const char* nameOf(ImageFormat format) {
  return format == ImageFormat::Bmp ? "BMP" : format == ImageFormat::Gif ? "GIF" : "TGA";
}

Error broken(ImageFormat format, const char* why) {
  return {
      "image-broken", std::string("the ") + nameOf(format) + " picture cannot be read: " + why, {}};
}

uint8_t byteAt(std::string_view bytes, size_t i) {
  return i < bytes.size() ? static_cast<uint8_t>(bytes[i]) : 0;
}

// Passes over the blocks before the first picture: whether one of them names a clear colour.
bool gifHasClearColour(std::string_view bytes) {
  const uint8_t flags = byteAt(bytes, 10);
  size_t at = 13 + ((flags & 0x80) ? size_t{3} << ((flags & 7) + 1) : 0);
  bool clear = false;
  while (byteAt(bytes, at) == 0x21) {
    if (byteAt(bytes, at + 1) == 0xf9) clear = (byteAt(bytes, at + 3) & 1) != 0;
    at += 2;
    while (byteAt(bytes, at) != 0) at += size_t{1} + byteAt(bytes, at);
    ++at;
  }
  return clear;
}

// The data must be there for as many pixels as an uncompressed picture says: stb reads zeros where
// it ends.
bool isCutOff(std::string_view bytes, const ImageHeader& header) {
  const ImageFormat format = header.format;
  const uint64_t pixels = uint64_t{header.width} * header.height;
  if (format == ImageFormat::Tga) {
    const uint8_t kind = byteAt(bytes, 2);
    if (kind > 8) return bytes.size() < 18 + pixels / 128;
    return bytes.size() < 18 + pixels * ((byteAt(bytes, 16) + 7u) / 8);
  }
  if (format == ImageFormat::Bmp) {
    const uint8_t bits = byteAt(bytes, 28), compression = byteAt(bytes, 30);
    const bool plain = compression == 0 || compression == 3;
    // Rows are whole words of 32 bits; nothing of the last one's padding is needed.
    const uint64_t row = (uint64_t{header.width} * bits + 7) / 8;
    const uint64_t start = byteAt(bytes, 10) | byteAt(bytes, 11) << 8;
    return plain && bits > 0 &&
           bytes.size() < start + (row + 3) / 4 * 4 * (header.height - 1) + row;
  }
  // The trailer of a GIF.
  return bytes.empty() || bytes.find('\x3b', 13) == std::string_view::npos;
}

}  // namespace

bool looksLikeTga(std::string_view bytes) {
  if (bytes.size() < 19) return false;
  const uint8_t mapped = byteAt(bytes, 1), kind = byteAt(bytes, 2), bits = byteAt(bytes, 16);
  const bool known =
      mapped ? kind == 1 || kind == 9 : kind == 2 || kind == 3 || kind == 10 || kind == 11;
  const bool depth = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  const bool sized =
      (byteAt(bytes, 12) | byteAt(bytes, 13)) && (byteAt(bytes, 14) | byteAt(bytes, 15));
  return mapped <= 1 && known && depth && sized && (byteAt(bytes, 17) & 0xc0) == 0;
}

Result<ImageHeader> readOldHeader(std::string_view bytes, ImageFormat format) {
  // The library counts in int.
  if (bytes.size() > (size_t{1} << 30)) return broken(format, "the file is too large");
  int width = 0, height = 0, channels = 0;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  if (!stbi_info_from_memory(data, static_cast<int>(bytes.size()), &width, &height, &channels) ||
      width <= 0 || height <= 0) {
    return broken(format, "its head is wrong");
  }
  const bool alpha =
      format == ImageFormat::Gif ? gifHasClearColour(bytes) : channels == 4 || channels == 2;
  return ImageHeader{format, static_cast<uint32_t>(width), static_cast<uint32_t>(height), alpha};
}

Result<Image> decodeOld(std::string_view bytes, ImageFormat format, uint64_t maxPixels) {
  Result<ImageHeader> header = readOldHeader(bytes, format);
  if (!header.ok()) return header.error();
  const uint64_t pixels = uint64_t{header->width} * header->height;
  if (pixels > maxPixels) {
    return Error{"image-too-large",
                 std::string("the ") + nameOf(format) + " picture has too many pixels",
                 {}};
  }
  if (isCutOff(bytes, *header)) return broken(format, "it is cut off");
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> read(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                            static_cast<int>(bytes.size()), &width, &height, &channels, 4),
      stbi_image_free);
  if (!read || static_cast<uint32_t>(width) != header->width ||
      static_cast<uint32_t>(height) != header->height) {
    const char* why = stbi_failure_reason();
    return broken(format, why ? why : "its data is wrong");
  }
  Image image;
  image.width = header->width;
  image.height = header->height;
  image.rgba.assign(read.get(), read.get() + pixels * 4);
  return image;
}

}  // namespace gable
