// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/image.h"

#include "base/work.h"
#include "io/image/jpeg.h"
#include "io/image/png.h"

namespace gable {
namespace {

Error unknown() {
  return {"image-unknown", "the file is neither a PNG nor a JPEG picture",
          "convert it to PNG or JPEG"};
}

}  // namespace

ImageFormat imageFormat(std::string_view bytes) {
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n") return ImageFormat::Png;
  if (bytes.substr(0, 3) == "\xff\xd8\xff") return ImageFormat::Jpeg;
  return ImageFormat::Unknown;
}

Result<ImageHeader> readImageHeader(std::string_view bytes) {
  switch (imageFormat(bytes)) {
    case ImageFormat::Png: return readPngHeader(bytes);
    case ImageFormat::Jpeg: return readJpegHeader(bytes);
    case ImageFormat::Unknown: break;
  }
  return unknown();
}

Result<Image> decodeImage(std::string_view bytes, uint64_t maxPixels) {
  // Asked for here, as nothing may unwind through the libraries.
  if (const Result<ImageHeader> header = readImageHeader(bytes); header.ok()) {
    const uint64_t pixels = uint64_t{header.value().width} * header.value().height;
    if (pixels <= maxPixels) workMemory(4 * pixels);
  }
  switch (imageFormat(bytes)) {
    case ImageFormat::Png: return decodePng(bytes, maxPixels);
    case ImageFormat::Jpeg: return decodeJpeg(bytes, maxPixels);
    case ImageFormat::Unknown: break;
  }
  return unknown();
}

}  // namespace gable
