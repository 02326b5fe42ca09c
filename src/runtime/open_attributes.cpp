// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/open_attributes.h"

#include <algorithm>

namespace gable {

void OpenAttributes::set(uint32_t key, const Value& value) {
  if (key >= places_.size()) places_.resize(key + 1);
  if (places_[key] != 0) {
    given_[places_[key] - 1].value = value;
    return;
  }
  given_.push_back({key, value});
  places_[key] = static_cast<uint32_t>(given_.size());
}

void OpenAttributes::close(AttributePool& pool) {
  if (!isOpen()) return;
  const auto isBefore = [](const auto& a, const auto& b) { return a.key < b.key; };
  std::sort(given_.begin(), given_.end(), isBefore);
  shape_->attributes = pool.with(shape_->attributes, given_);
  drop();
}

void OpenAttributes::drop() {
  for (const AttributePool::Entry& e : given_) places_[e.key] = 0;
  given_.clear();
  shape_ = nullptr;
}

}  // namespace gable
