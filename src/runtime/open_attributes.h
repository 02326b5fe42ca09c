// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OpenAttributes: attributes that a shape gets one after the other, as all of an import at a call
// of its rules. Their values see those before them, but the set with all of them is put into the
// table once: one for each would be a hundred where a hundred are given, each one longer.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/services.h"

namespace gable {

class OpenAttributes {
 public:
  bool isOpen() const { return shape_ != nullptr; }
  /// `shape`'s attributes as they are now are the base of those that come.
  void open(Shape& shape) { shape_ = &shape; }
  void set(uint32_t key, const Value& value);
  /// What the shape has got since; null for another shape, and where it has got none.
  const Value* find(const Shape* shape, uint32_t key) const {
    if (shape != shape_ || key >= places_.size() || places_[key] == 0) return nullptr;
    return &given_[places_[key] - 1].value;
  }
  /// Gives the shape the set of all; nothing where none are open.
  void close(AttributePool& pool);
  /// Forgets what is open.
  void drop();

 private:
  Shape* shape_ = nullptr;
  /// In the order of giving.
  std::vector<AttributePool::Entry> given_;
  /// By key: one more than the place in `given_`, 0 for none.
  std::vector<uint32_t> places_;
};

}  // namespace gable
