// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/image.h"

#include <algorithm>

#include "base/work.h"
#include "io/image/jpeg.h"
#include "io/image/old_formats.h"
#include "io/image/png.h"
#include "io/image/tiff.h"
#include "io/image/webp.h"

namespace gable {
namespace {

Error unknown() {
  return {"image-unknown", "the file is no picture that can be read",
          "convert it to PNG or JPEG; TIFF, BMP, GIF, TGA and WebP are read, too"};
}

}  // namespace

const char* extensionOf(ImageFormat format) {
  switch (format) {
    case ImageFormat::Png: return ".png";
    case ImageFormat::Jpeg: return ".jpg";
    case ImageFormat::Tiff: return ".tif";
    case ImageFormat::Bmp: return ".bmp";
    case ImageFormat::Gif: return ".gif";
    case ImageFormat::Tga: return ".tga";
    case ImageFormat::WebP: return ".webp";
    case ImageFormat::Unknown: break;
  }
  return "";
}

ImageFormat imageFormat(std::string_view bytes) {
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n") return ImageFormat::Png;
  if (bytes.substr(0, 3) == "\xff\xd8\xff") return ImageFormat::Jpeg;
  const std::string_view four = bytes.substr(0, 4);
  for (const std::string_view mark : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                      std::string_view("II+\0", 4), std::string_view("MM\0+", 4)}) {
    if (four == mark) return ImageFormat::Tiff;
  }
  if (bytes.substr(0, 6) == "GIF87a" || bytes.substr(0, 6) == "GIF89a") return ImageFormat::Gif;
  if (four == "RIFF" && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP") {
    return ImageFormat::WebP;
  }
  if (bytes.substr(0, 2) == "BM" && bytes.size() > 26) return ImageFormat::Bmp;
  if (looksLikeTga(bytes)) return ImageFormat::Tga;
  return ImageFormat::Unknown;
}

Result<ImageHeader> readImageHeader(std::string_view bytes) {
  const ImageFormat format = imageFormat(bytes);
  switch (format) {
    case ImageFormat::Png: return readPngHeader(bytes);
    case ImageFormat::Jpeg: return readJpegHeader(bytes);
    case ImageFormat::Tiff: return readTiffHeader(bytes);
    case ImageFormat::Bmp:
    case ImageFormat::Gif:
    case ImageFormat::Tga: return readOldHeader(bytes, format);
    case ImageFormat::WebP: return readWebpHeader(bytes);
    case ImageFormat::Unknown: break;
  }
  return unknown();
}

Result<Image> decodeImage(std::string_view bytes, uint64_t maxPixels) {
  // Asked for here, as nothing may unwind through the libraries.
  if (const Result<ImageHeader> header = readImageHeader(bytes); header.ok()) {
    const uint64_t pixels = uint64_t{header.value().width} * header.value().height;
    if (pixels <= maxPixels) workMemory(8 * pixels);
  }
  const ImageFormat format = imageFormat(bytes);
  switch (format) {
    case ImageFormat::Png: return decodePng(bytes, maxPixels);
    case ImageFormat::Jpeg: return decodeJpeg(bytes, maxPixels);
    case ImageFormat::Tiff: return decodeTiff(bytes, maxPixels);
    case ImageFormat::Bmp:
    case ImageFormat::Gif:
    case ImageFormat::Tga: return decodeOld(bytes, format, maxPixels);
    case ImageFormat::WebP: return decodeWebp(bytes, maxPixels);
    case ImageFormat::Unknown: break;
  }
  return unknown();
}

Image halved(const Image& image) {
  Image out;
  out.width = (image.width + 1) / 2;
  out.height = (image.height + 1) / 2;
  reserveWork(out.rgba, 4.0 * out.width * out.height);
  for (uint32_t y = 0; y < out.height; ++y) {
    work(out.width);
    for (uint32_t x = 0; x < out.width; ++x) {
      const uint32_t right = std::min(2 * x + 1, image.width - 1);
      const uint32_t below = std::min(2 * y + 1, image.height - 1);
      const uint8_t* const four[] = {image.at(2 * x, 2 * y), image.at(right, 2 * y),
                                     image.at(2 * x, below), image.at(right, below)};
      uint32_t alpha = 0;
      for (const uint8_t* p : four) alpha += p[3];
      for (size_t c = 0; c < 3; ++c) {
        uint32_t plain = 0, weighed = 0;
        for (const uint8_t* p : four) {
          plain += p[c];
          weighed += uint32_t{p[c]} * p[3];
        }
        const uint32_t mean = alpha > 0 ? (weighed + alpha / 2) / alpha : (plain + 2) / 4;
        out.rgba.push_back(static_cast<uint8_t>(mean));
      }
      out.rgba.push_back(static_cast<uint8_t>((alpha + 2) / 4));
    }
  }
  return out;
}

}  // namespace gable
