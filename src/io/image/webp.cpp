// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/webp.h"

#include <webp/decode.h>

namespace gable {
namespace {

const uint8_t* dataOf(std::string_view bytes) {
  return reinterpret_cast<const uint8_t*>(bytes.data());
}

Error broken(const char* why) {
  return {"image-broken", std::string("the WebP picture cannot be read: ") + why, {}};
}

}  // namespace

Result<ImageHeader> readWebpHeader(std::string_view bytes) {
  WebPBitstreamFeatures f;
  if (WebPGetFeatures(dataOf(bytes), bytes.size(), &f) != VP8_STATUS_OK || f.width <= 0 ||
      f.height <= 0) {
    return broken("its head is wrong");
  }
  if (f.has_animation) return broken("it is a film");
  return ImageHeader{ImageFormat::WebP, static_cast<uint32_t>(f.width),
                     static_cast<uint32_t>(f.height), f.has_alpha != 0};
}

Result<Image> decodeWebp(std::string_view bytes, uint64_t maxPixels) {
  Result<ImageHeader> header = readWebpHeader(bytes);
  if (!header.ok()) return header.error();
  if (uint64_t{header->width} * header->height > maxPixels) {
    return Error{"image-too-large", "the WebP picture has too many pixels", {}};
  }
  Image image;
  image.width = header->width;
  image.height = header->height;
  image.rgba.resize(size_t{4} * image.width * image.height);
  if (!WebPDecodeRGBAInto(dataOf(bytes), bytes.size(), image.rgba.data(), image.rgba.size(),
                          static_cast<int>(image.width * 4))) {
    return broken("its data is cut off or wrong");
  }
  return image;
}

}  // namespace gable
