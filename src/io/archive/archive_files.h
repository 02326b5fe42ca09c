// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Whole archives in memory: 7z and zip. Nothing is ever unpacked to a disk. An archive that a
// stranger has made can neither flood the memory nor name a file outside of itself.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "base/result.h"

namespace gable {

/// By path: plain relative paths with '/', without "." and "..".
using ArchiveFiles = std::map<std::string, std::string>;

struct ArchiveLimits {
  uint64_t files = 100'000;
  /// Of all files together.
  uint64_t bytes = 2ull << 30;
  /// How many times larger the files may be than the archive, once they are larger than `free`.
  /// Texts of models shrink to a twentieth, bombs to a thousandth.
  uint64_t ratio = 200;
  uint64_t free = 64ull << 20;
};

/// The files of an archive. Folders are left out. Codes: archive-unreadable (no archive, or one
/// that is broken off), archive-encrypted, archive-too-large, archive-path (a link, or a path that
/// leads out of it). Costs what the files are large.
Result<ArchiveFiles> readArchive(std::string_view bytes, const std::string& name,
                                 const ArchiveLimits& limits = {});

enum class ArchiveKind : uint8_t { SevenZip, Zip };

/// The same files give the same bytes. Code: archive-unwritable.
Result<std::string> writeArchive(const ArchiveFiles& files, ArchiveKind kind);

}  // namespace gable
