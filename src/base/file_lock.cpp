// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace gable {

FileLock::FileLock(std::string path) : path_(std::move(path)) {
  const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    failure_ = std::generic_category().message(errno);
    return;
  }
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) {
    file_ = file;
    return;
  }
  if (errno != EWOULDBLOCK) failure_ = std::generic_category().message(errno);
  ::close(file);
}

FileLock::~FileLock() {
  if (held()) ::close(file_);
}

void FileLock::finish() const {
  if (held()) ::unlink(path_.c_str());
}

}  // namespace gable
