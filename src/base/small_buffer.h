// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SmallBuffer<T, N>: a growing list of trivial values whose first N lie in the object itself, so
// that short lists on the stack allocate nothing.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace gable {

template <class T, size_t N>
class SmallBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void push_back(const T& value) {
    if (count_ < N) {
      here_[count_] = value;
    } else {
      if (count_ == N) more_.assign(here_.begin(), here_.end());
      more_.push_back(value);
    }
    ++count_;
  }
  void clear() {
    count_ = 0;
    more_.clear();
  }
  size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  T* begin() { return count_ <= N ? here_.data() : more_.data(); }
  T* end() { return begin() + count_; }
  const T* begin() const { return count_ <= N ? here_.data() : more_.data(); }
  const T* end() const { return begin() + count_; }
  T& operator[](size_t i) { return begin()[i]; }
  const T& operator[](size_t i) const { return begin()[i]; }

 private:
  std::array<T, N> here_;
  std::vector<T> more_;
  size_t count_ = 0;
};

}  // namespace gable
