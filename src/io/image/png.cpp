// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// libpng reports errors by longjmp. Everything that lives across a jump is declared outside the
// guarded call (a struct of the caller), so that no destructor is skipped.
#include "io/image/png.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <optional>
#include <vector>

#include "base/work.h"
#include "io/image/palette.h"

namespace gable {
namespace {

constexpr uint32_t kLongestSide = 1 << 20;

struct PngReading {
  std::string_view bytes;
  size_t position = 0;
  char why[160] = "the data ends too early";
  png_structp png = nullptr;
  png_infop info = nullptr;
  Image image;
  std::vector<png_bytep> rows;
  ImageHeader header;
  uint64_t maxPixels = 0;
  bool tooLarge = false;
};

void keepReason(char* to, size_t room, const char* message) {
  std::strncpy(to, message, room - 1);
  to[room - 1] = 0;
}

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  auto* r = static_cast<PngReading*>(png_get_error_ptr(png));
  keepReason(r->why, sizeof r->why, message);
  png_longjmp(png, 1);
}
void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep out, size_t count) {
  auto* r = static_cast<PngReading*>(png_get_io_ptr(png));
  if (count > r->bytes.size() - r->position) png_error(png, "the data ends too early");
  std::memcpy(out, r->bytes.data() + r->position, count);
  r->position += count;
}

void readHeader(PngReading& r) {
  png_set_user_limits(r.png, kLongestSide, kLongestSide);
  // Ancillary chunks are bounded, so that none can ask for memory.
  png_set_chunk_malloc_max(r.png, 1 << 24);
  png_set_chunk_cache_max(r.png, 256);
  png_set_read_fn(r.png, &r, onRead);
  png_read_info(r.png, r.info);
  r.header.format = ImageFormat::Png;
  r.header.width = png_get_image_width(r.png, r.info);
  r.header.height = png_get_image_height(r.png, r.info);
  r.header.hasAlpha = (png_get_color_type(r.png, r.info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                      png_get_valid(r.png, r.info, PNG_INFO_tRNS) != 0;
}

void readPixels(PngReading& r) {
  if (static_cast<uint64_t>(r.header.width) * r.header.height > r.maxPixels) {
    r.tooLarge = true;
    return;
  }
  png_set_expand(r.png);
  png_set_scale_16(r.png);
  png_set_gray_to_rgb(r.png);
  png_set_filler(r.png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  if (png_get_rowbytes(r.png, r.info) != static_cast<size_t>(r.header.width) * 4) {
    png_error(r.png, "unexpected row size");
  }
  r.image.width = r.header.width;
  r.image.height = r.header.height;
  r.image.rgba.resize(static_cast<size_t>(r.header.width) * r.header.height * 4);
  r.rows.resize(r.header.height);
  for (uint32_t y = 0; y < r.header.height; ++y) {
    r.rows[y] = r.image.rgba.data() + static_cast<size_t>(y) * r.header.width * 4;
  }
  png_read_image(r.png, r.rows.data());
}

// False when libpng gave up; `r.why` then says why.
bool guarded(PngReading& r, void (*step)(PngReading&)) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  step(r);
  return true;
}

bool read(PngReading& r, bool pixels) {
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, onError, onWarning);
  if (!r.png) return false;
  r.info = png_create_info_struct(r.png);
  const bool ok = r.info && guarded(r, readHeader) && (!pixels || guarded(r, readPixels));
  png_destroy_read_struct(&r.png, &r.info, nullptr);
  return ok;
}

Error broken(const char* why) {
  return {"image-broken", std::string("the PNG picture cannot be read: ") + why, {}};
}

struct PngWriting {
  std::string out;
  char why[160] = "out of memory";
  png_structp png = nullptr;
  png_infop info = nullptr;
  const Image* image = nullptr;
  const NumberImage* numbers = nullptr;
  int channels = 4, level = 6;
  bool filtered = true;
  // In place of colours, where they are few.
  std::optional<Palette> palette;
  std::vector<png_color> colors;
  std::vector<png_byte> alphas;

  PngWriting() = default;
  ~PngWriting() { png_destroy_write_struct(&png, &info); }
  PngWriting(const PngWriting&) = delete;
  PngWriting& operator=(const PngWriting&) = delete;
};

[[noreturn]] void onWriteError(png_structp png, png_const_charp message) {
  auto* w = static_cast<PngWriting*>(png_get_error_ptr(png));
  keepReason(w->why, sizeof w->why, message);
  png_longjmp(png, 1);
}
void onWrite(png_structp png, png_bytep data, size_t count) {
  static_cast<PngWriting*>(png_get_io_ptr(png))
      ->out.append(reinterpret_cast<const char*>(data), count);
}
void onFlush(png_structp) {}

// Colours of few tones repeat as they are, but not their differences, which filters make.
bool hasFewTones(const Image& image) {
  constexpr int kFew = 64;
  std::array<bool, 256> seen{};
  int tones = 0;
  for (size_t i = 0; i < image.rgba.size() && tones <= kFew; ++i) {
    if (i % 4 == 3 || seen[image.rgba[i]]) continue;
    seen[image.rgba[i]] = true;
    ++tones;
  }
  return tones <= kFew;
}

// A palette, where it takes less than it saves. A picture with alpha says so, whatever its colours.
void choosePalette(PngWriting& w) {
  constexpr size_t kChunks = 24;
  const auto channels = static_cast<size_t>(w.channels);
  w.palette = paletteOf(*w.image, w.channels);
  if (!w.palette) return;
  if (channels * w.palette->colors.size() + kChunks > (channels - 1) * w.palette->numbers.size()) {
    w.palette.reset();
    return;
  }
  for (const auto& c : w.palette->colors) {
    w.colors.push_back({c[0], c[1], c[2]});
    if (c[3] < 255) w.alphas.push_back(c[3]);
  }
  if (w.channels == 4 && w.alphas.empty()) w.alphas.push_back(w.palette->colors[0][3]);
}

// What all pictures begin with. Called where libpng may jump back to.
void begin(PngWriting& w, uint32_t width, uint32_t height, int bits, int colorType) {
  png_set_write_fn(w.png, &w, onWrite, onFlush);
  png_set_user_limits(w.png, kLongestSide, kLongestSide);
  png_set_IHDR(w.png, w.info, width, height, bits, colorType, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(w.png, w.level);
  // Who asks for the least level is in haste: trying filters takes as long as the compression.
  constexpr int kHasty = 1;
  if (!w.filtered || w.level <= kHasty) {
    png_set_filter(w.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  }
}

bool writePalette(PngWriting& w) {
  if (setjmp(png_jmpbuf(w.png))) return false;
  const size_t count = w.colors.size();
  const int bits = count <= 2 ? 1 : count <= 4 ? 2 : count <= 16 ? 4 : 8;
  begin(w, w.image->width, w.image->height, bits, PNG_COLOR_TYPE_PALETTE);
  png_set_sRGB_gAMA_and_cHRM(w.png, w.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_PLTE(w.png, w.info, w.colors.data(), static_cast<int>(count));
  if (!w.alphas.empty()) {
    png_set_tRNS(w.png, w.info, w.alphas.data(), static_cast<int>(w.alphas.size()), nullptr);
  }
  png_write_info(w.png, w.info);
  png_set_packing(w.png);
  for (uint32_t y = 0; y < w.image->height; ++y) {
    png_write_row(w.png, w.palette->numbers.data() + size_t{y} * w.image->width);
  }
  png_write_end(w.png, w.info);
  return true;
}

bool writePixels(PngWriting& w) {
  if (setjmp(png_jmpbuf(w.png))) return false;
  begin(w, w.image->width, w.image->height, 8,
        w.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB);
  png_set_sRGB_gAMA_and_cHRM(w.png, w.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(w.png, w.info);
  if (w.channels == 3) png_set_filler(w.png, 0, PNG_FILLER_AFTER);
  for (uint32_t y = 0; y < w.image->height; ++y) {
    work(w.image->width);
    png_write_row(w.png, w.image->at(0, y));
  }
  png_write_end(w.png, w.info);
  return true;
}

bool writeNumbers(PngWriting& w, std::vector<uint8_t>& bytes) {
  const NumberImage& image = *w.numbers;
  if (setjmp(png_jmpbuf(w.png))) return false;
  begin(w, image.width, image.height, image.bits,
        image.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY);
  png_write_info(w.png, w.info);
  const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
  for (size_t y = 0; y < image.height; ++y) {
    for (size_t i = 0; i < row; ++i) {
      const uint16_t v = image.numbers[y * row + i];
      if (image.bits == 8) {
        bytes[i] = static_cast<uint8_t>(v);
      } else {
        bytes[2 * i] = static_cast<uint8_t>(v >> 8);
        bytes[2 * i + 1] = static_cast<uint8_t>(v & 0xff);
      }
    }
    png_write_row(w.png, bytes.data());
  }
  png_write_end(w.png, w.info);
  return true;
}

}  // namespace

Result<ImageHeader> readPngHeader(std::string_view bytes) {
  PngReading r;
  r.bytes = bytes;
  if (!read(r, false)) return broken(r.why);
  return r.header;
}

Result<Image> decodePng(std::string_view bytes, uint64_t maxPixels) {
  PngReading r;
  r.bytes = bytes;
  r.maxPixels = maxPixels;
  if (!read(r, true)) return broken(r.why);
  if (r.tooLarge) return Error{"image-too-large", "the PNG picture has too many pixels", {}};
  return std::move(r.image);
}

Result<std::string> encodePng(const NumberImage& image, int level) {
  const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(image.channels);
  if (row == 0 || image.numbers.size() != row * image.height) {
    return Error{"image-broken", "a picture without pixels cannot be written", {}};
  }
  PngWriting w;
  w.numbers = &image;
  w.level = level;
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w, onWriteError, onWarning);
  if (!w.png) return Error{"image-broken", w.why, {}};
  w.info = png_create_info_struct(w.png);
  // Two bytes a number at most, the high one first.
  std::vector<uint8_t> bytes(row * 2);
  const bool ok = w.info && writeNumbers(w, bytes);
  if (!ok) {
    return Error{"image-broken", std::string("the PNG picture cannot be written: ") + w.why, {}};
  }
  return std::move(w.out);
}

Result<std::string> encodePng(const Image& image, int channels, int level) {
  if (image.width == 0 || image.height == 0 ||
      image.rgba.size() != static_cast<size_t>(image.width) * image.height * 4) {
    return Error{"image-broken", "a picture without pixels cannot be written", {}};
  }
  PngWriting w;
  w.image = &image;
  w.channels = channels;
  w.level = level;
  choosePalette(w);
  w.filtered = !w.palette && !hasFewTones(image);
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w, onWriteError, onWarning);
  if (!w.png) return Error{"image-broken", w.why, {}};
  w.info = png_create_info_struct(w.png);
  const bool ok = w.info && (w.palette ? writePalette(w) : writePixels(w));
  if (!ok) {
    return Error{"image-broken", std::string("the PNG picture cannot be written: ") + w.why, {}};
  }
  return std::move(w.out);
}

}  // namespace gable
