// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The WebP part of io/image/image.h: pictures that do not move.
#pragma once

#include "io/image/image.h"

namespace gable {

Result<ImageHeader> readWebpHeader(std::string_view bytes);
Result<Image> decodeWebp(std::string_view bytes, uint64_t maxPixels);

}  // namespace gable
