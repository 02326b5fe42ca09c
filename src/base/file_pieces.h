// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file read piece by piece, in order or at a place: for what does not fit into memory. Like
// readFile() it opens regular files only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/result.h"

namespace gable {

class FilePieces {
 public:
  FilePieces() = default;
  ~FilePieces();
  FilePieces(const FilePieces&) = delete;
  FilePieces& operator=(const FilePieces&) = delete;

  /// Gives its size. Codes: file-missing, file-unreadable.
  Result<uint64_t> open(const std::string& path);
  /// Up to `bytes` from where the last call ended; 0 at the end of the file.
  Result<size_t> read(char* to, size_t bytes);
  /// All of `bytes` from `offset`; less than that is an error.
  Result<size_t> readAt(uint64_t offset, char* to, size_t bytes) const;
  /// read() begins again.
  void rewind() { at_ = 0; }
  uint64_t size() const { return size_; }

 private:
  std::string path_;
  int file_ = -1;
  uint64_t at_ = 0, size_ = 0;
};

}  // namespace gable
