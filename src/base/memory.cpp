// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Linux tells in /proc/self/statm: two numbers of pages, the second those that are resident. Pages
// are given out in advance since Linux 5.14.

#include "base/memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>

namespace gable {

namespace {

// A sanitizer keeps its own record of the program's memory, a multiple of it, in the same process.
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_THREAD__) || __has_feature(thread_sanitizer)
constexpr uint64_t kTimesOwn = 6;
#elif defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
constexpr uint64_t kTimesOwn = 3;
#else
constexpr uint64_t kTimesOwn = 1;
#endif

}  // namespace

uint64_t residentBytes() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[128];
  const ssize_t n = ::read(file, text, sizeof text);
  ::close(file);
  if (n <= 0) return 0;
  const char* const end = text + n;
  uint64_t total = 0, resident = 0;
  const auto first = std::from_chars(text, end, total);
  if (first.ec != std::errc() || first.ptr == end) return 0;
  if (std::from_chars(first.ptr + 1, end, resident).ec != std::errc()) return 0;
  return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) / kTimesOwn;
}

bool populate(void* begin, size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  const auto page = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
  const uintptr_t at = reinterpret_cast<uintptr_t>(begin) / page * page;
  const uintptr_t end = reinterpret_cast<uintptr_t>(begin) + bytes;
  return bytes == 0 || ::madvise(reinterpret_cast<void*>(at), end - at, MADV_POPULATE_WRITE) == 0;
#else
  return begin == nullptr && bytes == 0;
#endif
}

}  // namespace gable
