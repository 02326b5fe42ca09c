// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The library's RGBA reader knows all kinds of pixels, but multiplies colours by alpha, which is
// undone.
#include "io/image/tiff.h"

#include <algorithm>

#include <tiffio.h>

#include "io/image/tiff_source.h"

namespace gable {
namespace {

Error broken(const char* why) {
  return {"image-broken", std::string("the TIFF picture cannot be read: ") + why, {}};
}

Result<ImageHeader> headerOf(TIFF* tiff, const TiffSource& source) {
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
  TiffSource source{bytes};
  const Tiff tiff = openTiff(source);
  return tiff ? headerOf(tiff.get(), source) : broken(source.why);
}

Result<Image> decodeTiff(std::string_view bytes, uint64_t maxPixels) {
  TiffSource source{bytes};
  const Tiff tiff = openTiff(source);
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
