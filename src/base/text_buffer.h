// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A text in memory that numbers are formatted into, as into a FileWriter.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

namespace gable {

/// On cache lines of its own: threads write one each, side by side.
class alignas(64) TextBuffer {
 public:
  /// Room for `bytes` at the end; follow with advanceTo(). The pointer is good until the next call.
  char* reserve(size_t bytes) {
    if (used_ + bytes > room_) grow(used_ + bytes);
    return text_.get() + used_;
  }
  /// The end of what was written.
  void advanceTo(const char* end) { used_ = static_cast<size_t>(end - text_.get()); }
  void append(std::string_view text) {
    std::memcpy(reserve(text.size()), text.data(), text.size());
    used_ += text.size();
  }
  std::string_view text() const { return {text_.get(), used_}; }
  /// Keeps the memory.
  void clear() { used_ = 0; }

 private:
  void grow(size_t least) {
    room_ = std::max(least, room_ + room_ / 2 + 4096);
    std::unique_ptr<char[]> more(new char[room_]);
    if (used_ > 0) std::memcpy(more.get(), text_.get(), used_);
    text_ = std::move(more);
  }

  std::unique_ptr<char[]> text_;
  size_t used_ = 0, room_ = 0;
};

}  // namespace gable
