// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// KeyNumbers: numbers by key, in one block of memory. A derivation looks up millions of keys, most
// of them once; a map with a node for each would wait for memory more than it works.
//
// Open addressing with linear probing: keys are hashes already, so their bits are even.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gable {

/// The inputs of something that is derived, hashed; equal keys mean equal results.
struct ShareKey {
  uint64_t a = 0, b = 0;
  bool operator==(const ShareKey&) const = default;
};

class KeyNumbers {
 public:
  /// So many keys ahead, who goes through many asks for the memory of each: prefetch().
  static constexpr uint32_t kAhead = 16;

  /// Null where the key is unknown. Good until the next change.
  const uint32_t* find(const ShareKey& key) const;
  /// A key that is known keeps its number.
  void emplace(const ShareKey& key, uint32_t number);
  /// Asks the processor for the memory where the key is or belongs, so that a look-up or an emplace
  /// of it a little later need not wait.
  void prefetch(const ShareKey& key) const;
  void reserve(size_t count);
  /// Whether so many find room without more memory.
  bool hasRoom(size_t count) const;
  /// Keeps the memory.
  void clear();
  /// Forgets all and has room for so many. Keeps the memory, unless it is too little or many times
  /// too much.
  void restart(size_t count);
  /// Bytes of memory.
  size_t bytes() const { return entries_.capacity() * sizeof(Entry); }
  size_t size() const { return size_; }

 private:
  struct Entry {
    ShareKey key;
    uint32_t number = kFree;
  };
  static constexpr uint32_t kFree = 0xffffffff;
  /// Where the key is, or belongs. There is always a free entry.
  size_t placeOf(const ShareKey& key) const;
  void rehash(size_t entries);

  std::vector<Entry> entries_;
  size_t size_ = 0;
};

}  // namespace gable
