// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace gable {
namespace {

std::string reason() {
  // The texts of strerror depend on the locale only after setlocale, which the library never calls.
  return std::strerror(errno);
}

// A read may return less than asked for.
bool readAll(int file, std::string& text, uint64_t maxBytes, bool& tooLarge) {
  constexpr size_t kStep = 1 << 20;
  for (;;) {
    const size_t have = text.size();
    if (have > maxBytes) {
      tooLarge = true;
      return false;
    }
    if (text.capacity() - have < kStep / 2) text.reserve(have + std::max(have, kStep));
    text.resize(text.capacity());
    const ssize_t n = ::read(file, text.data() + have, text.size() - have);
    text.resize(have + static_cast<size_t>(std::max<ssize_t>(n, 0)));
    if (n == 0) return true;
    if (n < 0 && errno != EINTR) return false;
  }
}

}  // namespace

Result<std::string> readFile(const std::string& path, uint64_t maxBytes) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    return Error{missing ? "file-missing" : "file-unreadable",
                 "'" + path + "' cannot be opened: " + reason(),
                 {}};
  }
  struct stat info {};
  std::string text;
  bool ok = ::fstat(file, &info) == 0;
  bool tooLarge = false;
  if (ok && S_ISDIR(info.st_mode)) {
    errno = EISDIR;
    ok = false;
  }
  if (ok && info.st_size > 0 && static_cast<uint64_t>(info.st_size) > maxBytes) {
    tooLarge = true;
    ok = false;
  }
  if (ok) {
    // One byte more than the file has, so that the end is seen without growing.
    text.reserve(static_cast<size_t>(info.st_size) + (1 << 19) + 1);
    ok = readAll(file, text, maxBytes, tooLarge);
  }
  const std::string why = reason();
  ::close(file);
  if (ok) return text;
  if (tooLarge) {
    return Error{"file-too-large",
                 "'" + path + "' has more than the allowed " + std::to_string(maxBytes) + " bytes",
                 {}};
  }
  return Error{"file-unreadable", "'" + path + "' cannot be read: " + why, {}};
}

bool fileExists(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISDIR(info.st_mode);
}

Result<uint64_t> writeFile(const std::string& path, std::string_view bytes) {
  FileWriter file(path);
  file.append(bytes);
  return file.finish();
}

FileWriter::FileWriter(std::string path) : path_(std::move(path)), buffer_(new char[kBuffer]) {
  static std::atomic<uint32_t> serial{0};
  struct stat info {};
  const bool exists = ::stat(path_.c_str(), &info) == 0;
  if (exists && !S_ISREG(info.st_mode)) {
    // A device or a pipe must not be replaced by a file.
    file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    // A link stays a link: what it points to is replaced.
    if (char* real = exists ? ::realpath(path_.c_str(), nullptr) : nullptr) {
      path_ = real;
      std::free(real);
    }
    temporary_ = path_ + ".part" + std::to_string(::getpid()) + "-" +
                 std::to_string(serial.fetch_add(1, std::memory_order_relaxed));
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  if (file_ < 0) fail("made");
}

FileWriter::~FileWriter() {
  if (file_ < 0) return;
  ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileWriter::fail(const char* what) {
  if (failed_) return;
  failed_ = true;
  error_ = {"file-unwritable", "'" + path_ + "' cannot be " + what + ": " + reason(),
            "check that the folder exists, may be written and has room"};
}

void FileWriter::writeOut(const char* data, size_t bytes) {
  while (bytes > 0 && !failed_) {
    const ssize_t n = ::write(file_, data, std::min<size_t>(bytes, 1 << 30));
    if (n < 0) {
      if (errno != EINTR) fail("written");
      continue;
    }
    data += n;
    bytes -= static_cast<size_t>(n);
  }
}

void FileWriter::flush() {
  writeOut(buffer_.get(), used_);
  flushed_ += used_;
  used_ = 0;
}

void FileWriter::append(const void* data, size_t bytes) {
  if (bytes > kBuffer / 4) {
    flush();
    writeOut(static_cast<const char*>(data), bytes);
    flushed_ += bytes;
    return;
  }
  std::memcpy(reserve(bytes), data, bytes);
  advance(bytes);
}

void FileWriter::fill(char c, uint64_t count) {
  while (count > 0) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(count, kBuffer / 4));
    std::memset(reserve(n), c, n);
    advance(n);
    count -= n;
  }
}

void FileWriter::patch(uint64_t offset, const void* data, size_t bytes) {
  flush();
  const char* p = static_cast<const char*>(data);
  while (bytes > 0 && !failed_) {
    const ssize_t n = ::pwrite(file_, p, bytes, static_cast<off_t>(offset));
    if (n < 0) {
      if (errno != EINTR) fail("written");
      continue;
    }
    p += n;
    offset += static_cast<uint64_t>(n);
    bytes -= static_cast<size_t>(n);
  }
}

Result<uint64_t> FileWriter::finish() {
  flush();
  if (failed_) return error_;
  const bool closed = ::close(file_) == 0;
  file_ = -1;
  const bool placed =
      closed && (temporary_.empty() || ::rename(temporary_.c_str(), path_.c_str()) == 0);
  if (!placed) {
    fail("put in its place");
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    return error_;
  }
  return flushed_;
}

std::string extensionOf(const std::string& path) {
  const std::string name = fileNameOf(path);
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  std::string e = name.substr(dot + 1);
  for (char& c : e) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return e;
}

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string{} : path.substr(0, slash + 1);
}

std::string fileNameOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

}  // namespace gable
