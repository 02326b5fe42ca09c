// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// ValueStack: the values that the code at work computes with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "program/stack.h"
#include "program/value.h"

namespace gable {

class ValueStack {
 public:
  static constexpr uint32_t kSize = 1u << 18;

  ValueStack()
      : memory_(new std::byte[kSize * sizeof(Value)]),
        values_(reinterpret_cast<Value*>(memory_.get())) {}

  // Without checks: whoever begins a rule or a function looks at isNearlyFull() first, and the
  // compiler holds each to kMostOnStack.
  void push(const Value& v) { values_[size_++] = v; }
  Value pop() { return values_[--size_]; }
  Value& top() { return values_[size_ - 1]; }
  /// Takes the topmost `count` away and says where they begin. They stay as they are until
  /// something is pushed.
  const Value* take(uint32_t count) { return values_ + (size_ -= count); }
  uint32_t size() const { return size_; }
  void cut(uint32_t size) { size_ = size; }
  const Value* at(uint32_t place) const { return values_ + place; }
  /// Those from `first` up to `end`.
  std::span<const Value> range(uint32_t first, uint32_t end) const {
    return {values_ + first, values_ + end};
  }
  std::span<const Value> from(uint32_t first) const { return range(first, size_); }
  bool isNearlyFull() const { return size_ + kMostOnStack > kSize; }

  // A call reads the values that it took while code that it asks for pushes others.
  /// So many that were taken are being read; 0: none any more.
  void hold(uint32_t count) { held_ = count; }
  /// Puts what is held below the top. Gives how much that is, for uncover().
  uint32_t cover() {
    const uint32_t count = held_;
    size_ += count;
    held_ = 0;
    return count;
  }
  void uncover(uint32_t count) {
    held_ = count;
    size_ -= count;
  }

 private:
  /// Untouched until it is used: clearing it would cost more than a small derivation.
  std::unique_ptr<std::byte[]> memory_;
  Value* const values_;
  uint32_t size_ = 0;
  uint32_t held_ = 0;
};

}  // namespace gable
