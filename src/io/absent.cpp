// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// In place of image/tiff*.cpp, image/webp.cpp and archive/archive_files.cpp where their libraries
// are not: in a browser. What would need them is refused, and says where it works.
#include "io/archive/archive_files.h"
#include "io/image/tiff.h"
#include "io/image/tiff_grid.h"
#include "io/image/webp.h"

namespace gable {
namespace {

Error notHere(const char* code, const std::string& what) {
  return {code, what + " cannot be read in a browser", "convert it, or use the program gable"};
}

}  // namespace

Result<ImageHeader> readTiffHeader(std::string_view) {
  return notHere("image-unknown", "a TIFF picture");
}

Result<Image> decodeTiff(std::string_view, uint64_t) {
  return notHere("image-unknown", "a TIFF picture");
}

Result<TiffGrid> readTiffGrid(std::string_view, uint64_t) {
  return notHere("heights-kind", "a TIFF file of heights");
}

Result<ImageHeader> readWebpHeader(std::string_view) {
  return notHere("image-unknown", "a WebP picture");
}

Result<Image> decodeWebp(std::string_view, uint64_t) {
  return notHere("image-unknown", "a WebP picture");
}

Result<ArchiveFiles> readArchive(std::string_view, const std::string& name, const ArchiveLimits&) {
  return notHere("archive-unreadable", "the package '" + name + "'");
}

Result<std::string> writeArchive(const ArchiveFiles&, ArchiveKind) {
  return Error{"archive-unwritable", "packages cannot be made in a browser",
               "use the program gable"};
}

}  // namespace gable
