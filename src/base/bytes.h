// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values as bytes and back, for files that only this program reads: numbers as they lie in memory,
// texts and lists with their length before them. Reading never goes beyond the end: once it would,
// ok() is false and all further values are zero or empty.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gable {

class ByteWriter {
 public:
  explicit ByteWriter(std::string& out) : out_(out) {}

  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void text(std::string_view v) {
    value(uint64_t{v.size()});
    out_.append(v);
  }
  template <class T>
  void list(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(uint64_t{v.size()});
    if (!v.empty()) out_.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
  }

 private:
  std::string& out_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  bool atEnd() const { return rest_.empty(); }

  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T v{};
    if (!has(sizeof v)) return v;
    std::memcpy(static_cast<void*>(&v), rest_.data(), sizeof v);
    rest_.remove_prefix(sizeof v);
    return v;
  }
  std::string_view bytes() {
    const auto size = value<uint64_t>();
    if (!has(size)) return {};
    const std::string_view v = rest_.substr(0, static_cast<size_t>(size));
    rest_.remove_prefix(v.size());
    return v;
  }
  std::string text() { return std::string(bytes()); }
  template <class T>
  std::vector<T> list() {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto count = value<uint64_t>();
    if (count > rest_.size() / sizeof(T)) ok_ = false;
    if (!ok_ || count == 0) return {};
    std::vector<T> v(static_cast<size_t>(count));
    std::memcpy(static_cast<void*>(v.data()), rest_.data(), v.size() * sizeof(T));
    rest_.remove_prefix(v.size() * sizeof(T));
    return v;
  }
  /// A number of things to come, each of at least `least` bytes; 0 where there is no room for them.
  size_t count(size_t least) {
    const auto n = value<uint64_t>();
    if (n > rest_.size() / least) ok_ = false;
    return ok_ ? static_cast<size_t>(n) : 0;
  }

 private:
  bool has(uint64_t bytes) {
    ok_ = ok_ && bytes <= rest_.size();
    return ok_;
  }

  std::string_view rest_;
  bool ok_ = true;
};

/// A hash of many bytes, eight at a time: for telling whether a file is what was written. Its value
/// depends on the order of bytes in the machine's words.
inline uint64_t checksum(std::string_view bytes) {
  uint64_t h = bytes.size() + 0x9e3779b97f4a7c15ULL;
  while (!bytes.empty()) {
    uint64_t word = 0;
    const size_t n = bytes.size() < sizeof word ? bytes.size() : sizeof word;
    std::memcpy(&word, bytes.data(), n);
    bytes.remove_prefix(n);
    h = (h ^ word) * 0xd1342543de82ef95ULL;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace gable
