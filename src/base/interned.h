// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Interned<T>: gives equal values one small id, thread-safely. Values lie in blocks that never
// move, so get() takes no lock and its result stays valid as long as the table. The hash is the
// caller's.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "base/check.h"

namespace gable {

template <class T, uint32_t kBlock = 256, uint32_t kBlocks = 1u << 14>
class Interned {
 public:
  uint32_t intern(uint64_t hash, const T& value) {
    std::lock_guard lock(mutex_);
    auto [first, last] = index_.equal_range(hash);
    for (; first != last; ++first) {
      if (at(first->second) == value) return first->second;
    }
    const uint32_t id = count_++;
    GABLE_CHECK_LT(id / kBlock, kBlocks);
    auto& block = blocks_[id / kBlock];
    if (!block) block = std::make_unique<std::array<T, kBlock>>();
    at(id) = value;
    index_.emplace(hash, id);
    return id;
  }
  const T& get(uint32_t id) const { return (*blocks_[id / kBlock])[id % kBlock]; }

 private:
  T& at(uint32_t id) { return (*blocks_[id / kBlock])[id % kBlock]; }

  std::mutex mutex_;
  uint32_t count_ = 0;
  std::unordered_multimap<uint64_t, uint32_t> index_;
  std::vector<std::unique_ptr<std::array<T, kBlock>>> blocks_{kBlocks};
};

}  // namespace gable
