// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The JPEG half of io/image/image.h.
#pragma once

#include "io/image/image.h"

namespace gable {

Result<ImageHeader> readJpegHeader(std::string_view bytes);
Result<Image> decodeJpeg(std::string_view bytes, uint64_t maxPixels);

}  // namespace gable
