// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Interned<T>: gives equal values one small id, thread-safely. Values lie in blocks that never
// move, so get() takes no lock and its result stays valid as long as the table. The hash is the
// caller's.
//
// Rules choose what is interned, so a table can be full: what is new then unwinds (base/work.h)
// with the code kTableFull.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace gable {

/// The code of the Status that comes of a full table.
extern const char* const kTableFull;

[[noreturn]] void tableIsFull();

/// For tests: tables that this thread makes while it lives hold no more than so many values.
class TableCapacityScope {
 public:
  explicit TableCapacityScope(uint32_t most) : before_(most_) { most_ = most; }
  ~TableCapacityScope() { most_ = before_; }
  TableCapacityScope(const TableCapacityScope&) = delete;
  TableCapacityScope& operator=(const TableCapacityScope&) = delete;

  static uint32_t most() { return most_; }

 private:
  static inline thread_local uint32_t most_ = 0xffffffff;
  uint32_t before_;
};

template <class T, uint32_t kBlock = 256, uint32_t kBlocks = 1u << 14>
class Interned {
 public:
  uint32_t intern(uint64_t hash, const T& value) {
    std::lock_guard lock(mutex_);
    auto [first, last] = index_.equal_range(hash);
    for (; first != last; ++first) {
      if (at(first->second) == value) return first->second;
    }
    if (count_ >= capacity_) tableIsFull();
    const uint32_t id = count_++;
    auto& block = blocks_[id / kBlock];
    if (!block) block = std::make_unique<std::array<T, kBlock>>();
    at(id) = value;
    index_.emplace(hash, id);
    return id;
  }
  const T& get(uint32_t id) const { return (*blocks_[id / kBlock])[id % kBlock]; }
  uint32_t capacity() const { return capacity_; }

 private:
  T& at(uint32_t id) { return (*blocks_[id / kBlock])[id % kBlock]; }

  std::mutex mutex_;
  const uint32_t capacity_ = std::min(kBlock * kBlocks, TableCapacityScope::most());
  uint32_t count_ = 0;
  std::unordered_multimap<uint64_t, uint32_t> index_;
  std::vector<std::unique_ptr<std::array<T, kBlock>>> blocks_{kBlocks};
};

}  // namespace gable
