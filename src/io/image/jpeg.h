// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The JPEG half of io/image/image.h.
#pragma once

#include "io/image/image.h"

namespace gable {

Result<ImageHeader> readJpegHeader(std::string_view bytes);
Result<Image> decodeJpeg(std::string_view bytes, uint64_t maxPixels);

/// Alpha is left out. `quality`: 1 to 100; `thinColor` keeps a quarter of the colour differences.
/// The same bytes for the same picture on one version of the JPEG library.
Result<std::string> encodeJpeg(const Image& image, int quality, bool thinColor);

}  // namespace gable
