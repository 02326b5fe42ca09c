// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/file_pieces.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace gable {
namespace {

Error refused(const std::string& path, const char* what, const std::string& why) {
  const bool missing = errno == ENOENT || errno == ENOTDIR;
  return {missing ? "file-missing" : "file-unreadable",
          "'" + path + "' cannot be " + what + ": " + why,
          {}};
}

}  // namespace

FilePieces::~FilePieces() {
  if (file_ >= 0) ::close(file_);
}

Result<uint64_t> FilePieces::open(const std::string& path) {
  path_ = path;
  struct stat info {};
  // Opening a pipe could wait for ever, so it is looked at first.
  if (::stat(path.c_str(), &info) != 0) return refused(path, "opened", std::strerror(errno));
  errno = 0;
  if (!S_ISREG(info.st_mode)) return refused(path, "opened", "it is not a regular file");
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file < 0) return refused(path, "opened", std::strerror(errno));
  if (file_ >= 0) ::close(file_);
  file_ = file;
  at_ = 0;
  if (::fstat(file_, &info) != 0) return refused(path, "read", std::strerror(errno));
  size_ = static_cast<uint64_t>(info.st_size);
  return size_;
}

Result<size_t> FilePieces::read(char* to, size_t bytes) {
  for (;;) {
    const ssize_t n = ::pread(file_, to, bytes, static_cast<off_t>(at_));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return refused(path_, "read", std::strerror(errno));
    at_ += static_cast<uint64_t>(n);
    return static_cast<size_t>(n);
  }
}

Result<size_t> FilePieces::readAt(uint64_t offset, char* to, size_t bytes) const {
  size_t done = 0;
  while (done < bytes) {
    const ssize_t n = ::pread(file_, to + done, bytes - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return refused(path_, "read", std::strerror(errno));
    errno = 0;
    if (n == 0) return refused(path_, "read", "it ends too early");
    done += static_cast<size_t>(n);
  }
  return done;
}

}  // namespace gable
