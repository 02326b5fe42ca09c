// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/files.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/text.h"

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

// "did you mean 'town.cga'?" for a file that is not there, by what its folder holds.
std::string nearestFile(const std::string& path) {
  constexpr size_t kMostEntries = 10'000;
  const std::string folder = folderOf(path);
  DIR* entries = ::opendir(folder.empty() ? "." : folder.c_str());
  if (!entries) return "there is no such folder";
  std::vector<std::string> names;
  while (const dirent* entry = ::readdir(entries)) {
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
    if (names.size() == kMostEntries) break;
  }
  ::closedir(entries);
  // The order of a folder is its own; that of equally near names must not be.
  std::sort(names.begin(), names.end());
  return didYouMean(fileNameOf(path), {names.begin(), names.end()});
}

// Nothing but a regular file is opened: the open itself can wait for ever at a pipe, and acts on
// some devices. The second look is at what was opened in fact.
int openRegular(const std::string& path, struct stat& info, Error& error) {
  const auto refuse = [&](const std::string& why, const char* hint) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    error = {missing ? "file-missing" : "file-unreadable",
             "'" + path + "' cannot be opened: " + why, missing ? nearestFile(path) : hint};
    return -1;
  };
  const char* const kOnlyFiles = "name a file; pipes, devices and sockets are not read";
  if (::stat(path.c_str(), &info) != 0) return refuse(reason(), "");
  errno = 0;
  if (S_ISDIR(info.st_mode)) return refuse("it is a folder", "");
  if (!S_ISREG(info.st_mode)) return refuse("it is not a regular file", kOnlyFiles);
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file < 0) return refuse(reason(), "");
  if (::fstat(file, &info) == 0 && S_ISREG(info.st_mode)) return file;
  ::close(file);
  errno = 0;
  return refuse("it is not a regular file", kOnlyFiles);
}

// The names of files that are being written, for a signal handler: a table of fixed size, since
// such a handler may wait for nothing. Files beyond it are left to the next writer of their path.
constexpr size_t kMostUnfinished = 64;
std::array<std::atomic<const char*>, kMostUnfinished> unfinished;

int remember(const char* path) {
  for (size_t i = 0; i < kMostUnfinished; ++i) {
    const char* none = nullptr;
    if (unfinished[i].compare_exchange_strong(none, path)) return static_cast<int>(i);
  }
  return -1;
}

// The process that writes "<name>.part<process>-<number>"; 0 for another name.
pid_t writerOf(const char* entry, const std::string& name) {
  constexpr char kPart[] = ".part";
  if (std::strncmp(entry, name.c_str(), name.size()) != 0) return 0;
  const char* rest = entry + name.size();
  if (std::strncmp(rest, kPart, sizeof kPart - 1) != 0) return 0;
  rest += sizeof kPart - 1;
  const size_t digits = std::strspn(rest, "0123456789");
  if (digits == 0 || digits > 9 || rest[digits] != '-') return 0;
  const char* serial = rest + digits + 1;
  if (*serial == '\0' || serial[std::strspn(serial, "0123456789")] != '\0') return 0;
  return static_cast<pid_t>(std::atoi(rest));
}

// A killed process leaves its file behind. It is taken for dead when it is not there and holds no
// lock, which also tells processes that another machine or container runs.
void removeStale(const std::string& path) {
  const std::string folder = folderOf(path), name = fileNameOf(path);
  DIR* entries = ::opendir(folder.empty() ? "." : folder.c_str());
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries)) {
    const pid_t writer = writerOf(entry->d_name, name);
    if (writer <= 0 || ::kill(writer, 0) == 0 || errno != ESRCH) continue;
    const std::string stale = folder + entry->d_name;
    const int file = ::open(stale.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (file < 0) continue;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(stale.c_str());
    ::close(file);
  }
  ::closedir(entries);
}

}  // namespace

Result<std::string> readFile(const std::string& path, uint64_t maxBytes) {
  struct stat info {};
  Error error;
  const int file = openRegular(path, info, error);
  if (file < 0) return error;
  std::string text;
  bool tooLarge = info.st_size > 0 && static_cast<uint64_t>(info.st_size) > maxBytes;
  bool ok = !tooLarge;
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
  return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

Result<uint64_t> writeFile(const std::string& path, std::string_view bytes) {
  const bool replaces = fileExists(path);
  FileWriter file(path);
  file.append(bytes);
  if (replaces) file.sync();
  return file.finish();
}

void removeUnfinishedFiles() {
  for (std::atomic<const char*>& name : unfinished) {
    if (const char* path = name.load()) ::unlink(path);
  }
}

FileWriter::FileWriter(std::string path) : path_(std::move(path)), buffer_(new char[kBuffer]) {
  struct stat info {};
  const bool exists = ::stat(path_.c_str(), &info) == 0;
  if (exists && S_ISCHR(info.st_mode)) {
    // A device must not be replaced by a file.
    file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } else if (exists && !S_ISREG(info.st_mode)) {
    fail("made", S_ISDIR(info.st_mode) ? "it is a folder" : "it is a pipe, a socket or a disk");
  } else if (!exists || ::access(path_.c_str(), W_OK) == 0) {
    // A link stays a link: what it points to is replaced.
    if (char* real = exists ? ::realpath(path_.c_str(), nullptr) : nullptr) {
      path_ = real;
      std::free(real);
    }
    open();
    if (file_ >= 0 && exists) ::fchmod(file_, info.st_mode & 07777);
  }
  if (file_ < 0) fail("made", reason());
}

void FileWriter::open() {
  static std::atomic<uint32_t> serial{0};
  removeStale(path_);
  temporary_ = path_ + ".part" + std::to_string(::getpid()) + "-" +
               std::to_string(serial.fetch_add(1, std::memory_order_relaxed));
  slot_ = remember(temporary_.c_str());
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ >= 0) ::flock(file_, LOCK_EX | LOCK_NB);
}

FileWriter::~FileWriter() {
  if (file_ >= 0) {
    ::close(file_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }
  if (slot_ >= 0) unfinished[static_cast<size_t>(slot_)].store(nullptr);
}

void FileWriter::fail(const char* what, const std::string& why) {
  if (failed_) return;
  failed_ = true;
  error_ = {"file-unwritable", "'" + path_ + "' cannot be " + what + ": " + why,
            "check that the folder exists, may be written and has room"};
}

void FileWriter::writeOut(const char* data, size_t bytes) {
  while (bytes > 0 && !failed_) {
    const ssize_t n = ::write(file_, data, std::min<size_t>(bytes, 1 << 30));
    if (n < 0) {
      if (errno != EINTR) fail("written", reason());
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
      if (errno != EINTR) fail("written", reason());
      continue;
    }
    p += n;
    offset += static_cast<uint64_t>(n);
    bytes -= static_cast<size_t>(n);
  }
}

void FileWriter::sync() {
  flush();
  // Pipes and devices cannot be waited for, and say so.
  if (!failed_ && !temporary_.empty() && ::fsync(file_) != 0 && errno != EINVAL)
    fail("written", reason());
}

Result<uint64_t> FileWriter::finish() {
  flush();
  if (failed_) return error_;
  const bool closed = ::close(file_) == 0;
  file_ = -1;
  const bool placed =
      closed && (temporary_.empty() || ::rename(temporary_.c_str(), path_.c_str()) == 0);
  if (!placed) {
    fail("put in its place", reason());
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    return error_;
  }
  return flushed_;
}

std::string extensionOf(const std::string& path) {
  const std::string name = fileNameOf(path);
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  return lowerCase(std::string_view(name).substr(dot + 1));
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
