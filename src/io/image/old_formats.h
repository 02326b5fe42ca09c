// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The BMP, GIF and TGA parts of io/image/image.h: of a GIF the first picture.
#pragma once

#include "io/image/image.h"

namespace gable {

/// TGA has no mark: true when the first bytes make sense as its head.
bool looksLikeTga(std::string_view bytes);
Result<ImageHeader> readOldHeader(std::string_view bytes, ImageFormat format);
Result<Image> decodeOld(std::string_view bytes, ImageFormat format, uint64_t maxPixels);

}  // namespace gable
