// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Whole files in, whole files out: the one door to the file system. Only regular files are opened,
// so that a pipe, a device or a socket in a project can neither block nor flood a reader. A file is
// written beside its place, in one with `.part` in its name, and renamed when it is complete: a
// reader never sees half of one, and a failure leaves the old one as it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace gable {

/// Codes: file-missing, file-unreadable, file-too-large.
Result<std::string> readFile(const std::string& path, uint64_t maxBytes = 1ULL << 31);

/// Whether there is a regular file.
bool fileExists(const std::string& path);

/// Replaces a file whole; does so only when the new content is on the disk. Code: file-unwritable.
Result<uint64_t> writeFile(const std::string& path, std::string_view bytes);

/// Removes the files that writers of this process have not finished. May be called by a signal
/// handler just before the process ends, and only then.
void removeUnfinishedFiles();

/// Writes a file piece by piece through a buffer that fits the second-level cache. The first
/// failure is kept and later calls do nothing; finish() tells.
class FileWriter {
 public:
  /// Makes the temporary file, and removes those that killed processes have left for the same path.
  /// `failed()` is true when that is not possible. A character device (/dev/null) is written to as
  /// it is.
  explicit FileWriter(std::string path);
  /// Removes the temporary file unless finish() succeeded.
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Room for `bytes` (up to kBuffer) at the write position; follow with advance(). The pointer is
  /// good until the next call of any other member.
  char* reserve(size_t bytes) {
    if (used_ + bytes > kBuffer) flush();
    return buffer_.get() + used_;
  }
  void advance(size_t bytes) { used_ += bytes; }
  /// The same with the end of what was written.
  void advanceTo(const char* end) { used_ = static_cast<size_t>(end - buffer_.get()); }

  void append(const void* data, size_t bytes);
  void append(std::string_view text) { append(text.data(), text.size()); }
  void fill(char c, uint64_t count);
  /// Replaces bytes that were written before.
  void patch(uint64_t offset, const void* data, size_t bytes);

  /// Bytes written so far.
  uint64_t offset() const { return flushed_ + used_; }
  bool failed() const { return failed_; }
  /// Waits until all is on the disk.
  void sync();
  /// Puts the file in its place, with the permissions of the one before. The number of bytes, or
  /// file-unwritable.
  Result<uint64_t> finish();

  static constexpr size_t kBuffer = 512 * 1024;

 private:
  void open();
  void flush();
  void writeOut(const char* data, size_t bytes);
  void fail(const char* what, const std::string& why);

  std::string path_, temporary_;
  std::unique_ptr<char[]> buffer_;
  size_t used_ = 0;
  uint64_t flushed_ = 0;
  int file_ = -1;
  /// The place of `temporary_` among the unfinished files; -1: none.
  int slot_ = -1;
  bool failed_ = false;
  Error error_;
};

/// "out.tar.GZ" gives "gz"; empty without a dot in the last part of the path.
std::string extensionOf(const std::string& path);
/// Everything before the last '/', with it; empty when there is none.
std::string folderOf(const std::string& path);
/// Everything after the last '/'.
std::string fileNameOf(const std::string& path);

}  // namespace gable
