// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a picture: reading ends in a status, or in as many pixels as the header says.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "io/image/image.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gable;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  (void)readImageHeader(bytes);
  Result<Image> image = decodeImage(bytes, 1u << 20);
  if (image.ok()) {
    GABLE_CHECK_EQ(image.value().rgba.size(),
                   size_t{4} * image.value().width * image.value().height);
  }
  return 0;
}
