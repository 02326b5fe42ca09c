// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The TIFF part of io/image/image.h: the first picture of the file.
#pragma once

#include "io/image/image.h"

namespace gable {

Result<ImageHeader> readTiffHeader(std::string_view bytes);
Result<Image> decodeTiff(std::string_view bytes, uint64_t maxPixels);

}  // namespace gable
