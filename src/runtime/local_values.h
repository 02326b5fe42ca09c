// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LocalValues: the values that blocks of `local` give to attributes. They form a chain from the
// innermost block outwards that shapes point into: so they are no part of the shape's attributes,
// cost no interning, and end with their block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "program/value.h"

namespace gable {

class LocalValues {
 public:
  /// Binds a value in front of a chain, and gives the new chain. 0 is the empty chain.
  uint32_t bind(uint32_t chain, uint32_t attribute, const Value& v) {
    values_.push_back({chain, attribute, v});
    return static_cast<uint32_t>(values_.size());
  }
  /// The innermost value of an attribute; null when the chain has none.
  const Value* find(uint32_t chain, uint32_t attribute) const {
    for (uint32_t at = chain; at != 0; at = values_[at - 1].outer) {
      if (values_[at - 1].attribute == attribute) return &values_[at - 1].value;
    }
    return nullptr;
  }
  /// Calls visit(attribute, value) from the innermost outwards.
  template <class Visit>
  void forEach(uint32_t chain, Visit&& visit) const {
    for (uint32_t at = chain; at != 0; at = values_[at - 1].outer) {
      visit(values_[at - 1].attribute, values_[at - 1].value);
    }
  }

  size_t size() const { return values_.size(); }
  /// Those bound after there were `count` end.
  void cut(size_t count) {
    if (values_.size() > count) values_.resize(count);
  }
  /// The first `count`, for another worker.
  LocalValues first(size_t count) const {
    LocalValues out = *this;
    out.cut(count);
    return out;
  }

 private:
  struct Bound {
    uint32_t outer = 0;
    uint32_t attribute = 0;
    Value value;
  };
  std::vector<Bound> values_;
};

}  // namespace gable
