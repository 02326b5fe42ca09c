// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// libtiff reads from memory through our functions, with handlers of errors and a limit on memory
// for each file: its global ones are left alone. Its RGBA reader knows all kinds of pixels, but
// multiplies colours by alpha, which is undone.
#include "io/image/tiff.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>

#include <tiffio.h>

namespace gable {
namespace {

// What one call of the library may allocate: strips and tiles of a hostile file can be larger than
// the picture.
constexpr tmsize_t kMostMemory = tmsize_t{1} << 29;

struct Source {
  std::string_view bytes;
  size_t at = 0;
  char why[200] = "it has no picture";
};

int onError(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto* source = static_cast<Source*>(user);
  std::vsnprintf(source->why, sizeof source->why, format, arguments);
  return 1;
}
int onWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

tmsize_t readBytes(thandle_t handle, void* to, tmsize_t size) {
  auto* s = static_cast<Source*>(handle);
  const size_t n = std::min(static_cast<size_t>(std::max<tmsize_t>(size, 0)),
                            s->bytes.size() - std::min(s->at, s->bytes.size()));
  if (n > 0) std::memcpy(to, s->bytes.data() + s->at, n);
  s->at += n;
  return static_cast<tmsize_t>(n);
}
tmsize_t writeBytes(thandle_t, void*, tmsize_t) { return 0; }
toff_t seekTo(thandle_t handle, toff_t offset, int from) {
  auto* s = static_cast<Source*>(handle);
  const toff_t base = from == SEEK_CUR ? s->at : from == SEEK_END ? s->bytes.size() : 0;
  s->at = static_cast<size_t>(base + offset);
  return s->at;
}
int closeSource(thandle_t) { return 0; }
toff_t sizeOf(thandle_t handle) { return static_cast<Source*>(handle)->bytes.size(); }
int mapFile(thandle_t, void**, toff_t*) { return 0; }
void unmapFile(thandle_t, void*, toff_t) {}

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

Tiff open(Source& source) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (!options) return {nullptr, TIFFClose};
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, kMostMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options, onError, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options, onWarning, nullptr);
  // Read only, without mapping, and only the first directory.
  Tiff tiff(TIFFClientOpenExt("picture", "rm", &source, readBytes, writeBytes, seekTo, closeSource,
                              sizeOf, mapFile, unmapFile, options),
            TIFFClose);
  TIFFOpenOptionsFree(options);
  return tiff;
}

Error broken(const char* why) {
  return {"image-broken", std::string("the TIFF picture cannot be read: ") + why, {}};
}

Result<ImageHeader> headerOf(TIFF* tiff, const Source& source) {
  ImageHeader h{ImageFormat::Tiff};
  if (!TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &h.width) ||
      !TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &h.height) || h.width == 0 || h.height == 0) {
    return broken(source.why);
  }
  uint16_t extras = 0;
  uint16_t* kinds = nullptr;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extras, &kinds);
  h.hasAlpha = extras > 0 && kinds && kinds[0] != EXTRASAMPLE_UNSPECIFIED;
  return h;
}

uint8_t straight(uint32_t colour, uint32_t alpha) {
  return static_cast<uint8_t>(std::min<uint32_t>((colour * 255 + alpha / 2) / alpha, 255));
}

}  // namespace

Result<ImageHeader> readTiffHeader(std::string_view bytes) {
  Source source{bytes};
  const Tiff tiff = open(source);
  return tiff ? headerOf(tiff.get(), source) : broken(source.why);
}

Result<Image> decodeTiff(std::string_view bytes, uint64_t maxPixels) {
  Source source{bytes};
  const Tiff tiff = open(source);
  if (!tiff) return broken(source.why);
  Result<ImageHeader> header = headerOf(tiff.get(), source);
  if (!header.ok()) return header.error();
  const uint64_t pixels = uint64_t{header->width} * header->height;
  if (pixels > maxPixels) {
    return Error{"image-too-large", "the TIFF picture has too many pixels", {}};
  }
  std::vector<uint32_t> raster(pixels);
  // With 1, data that ends in the middle is an error.
  if (!TIFFReadRGBAImageOriented(tiff.get(), header->width, header->height, raster.data(),
                                 ORIENTATION_TOPLEFT, 1)) {
    return broken(source.why);
  }
  Image image;
  image.width = header->width;
  image.height = header->height;
  image.rgba.resize(pixels * 4);
  uint8_t* out = image.rgba.data();
  for (const uint32_t p : raster) {
    const uint32_t alpha = header->hasAlpha ? TIFFGetA(p) : 255;
    const bool undo = alpha > 0 && alpha < 255;
    for (const uint32_t c : {TIFFGetR(p), TIFFGetG(p), TIFFGetB(p)}) {
      *out++ = undo ? straight(c, alpha) : static_cast<uint8_t>(c);
    }
    *out++ = static_cast<uint8_t>(alpha);
  }
  return image;
}

}  // namespace gable
