// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How files are opened with libtiff: from memory, the first directory only, with handlers of errors
// and a limit on memory for each file. Its global handlers are left alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

struct tiff;

namespace gable {

/// What one call of the library may allocate, in bytes: strips and tiles of a hostile file can be
/// larger than the picture.
constexpr int64_t kMostTiffMemory = int64_t{1} << 29;

struct TiffSource {
  std::string_view bytes;
  size_t at = 0;
  /// The last error that the library told.
  char why[200] = "it has no picture";
};

using Tiff = std::unique_ptr<tiff, void (*)(tiff*)>;

/// Null where the file is no TIFF; the source outlives it.
Tiff openTiff(TiffSource& source);

}  // namespace gable
