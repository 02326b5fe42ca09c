// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SmallBuffer<T, N>: a growing list of trivial values whose first N lie in the object itself, so
// that short lists on the stack allocate nothing.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace gable {

template <class T, size_t N>
class SmallBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  // The first N are raw memory: a buffer on the stack costs nothing before it is used.
  SmallBuffer() {}

  void push_back(const T& value) {
    if (count_ < N) {
      ::new (static_cast<void*>(here_ + count_ * sizeof(T))) T(value);
    } else {
      if (count_ == N) more_.assign(begin(), end());
      more_.push_back(value);
    }
    ++count_;
  }
  void assign(std::span<const T> values) {
    clear();
    if (values.size() <= N) {
      if (!values.empty()) std::memcpy(here_, values.data(), values.size_bytes());
    } else {
      more_.assign(values.begin(), values.end());
    }
    count_ = values.size();
  }
  void clear() {
    count_ = 0;
    more_.clear();
  }
  size_t size() const { return count_; }
  /// How many fit without allocating.
  static constexpr size_t capacityHere() { return N; }
  bool empty() const { return count_ == 0; }
  T* begin() { return count_ <= N ? reinterpret_cast<T*>(here_) : more_.data(); }
  T* end() { return begin() + count_; }
  const T* begin() const { return count_ <= N ? reinterpret_cast<const T*>(here_) : more_.data(); }
  const T* end() const { return begin() + count_; }
  T& operator[](size_t i) { return begin()[i]; }
  const T& operator[](size_t i) const { return begin()[i]; }

 private:
  alignas(T) std::byte here_[N * sizeof(T)];
  std::vector<T> more_;
  size_t count_ = 0;
};

}  // namespace gable
