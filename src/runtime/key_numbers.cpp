// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/key_numbers.h"

#include <algorithm>
#include <bit>

namespace gable {

namespace {

constexpr size_t kLeastEntries = 64;

// So many entries for a count that they are at most two thirds full.
size_t entriesFor(size_t count) {
  return std::bit_ceil(std::max(kLeastEntries, count + count / 2 + 1));
}

}  // namespace

size_t KeyNumbers::placeOf(const ShareKey& key) const {
  const size_t last = entries_.size() - 1;
  size_t at = key.a & last;
  while (entries_[at].number != kFree && !(entries_[at].key == key)) at = (at + 1) & last;
  return at;
}

const uint32_t* KeyNumbers::find(const ShareKey& key) const {
  if (size_ == 0) return nullptr;
  const Entry& e = entries_[placeOf(key)];
  return e.number == kFree ? nullptr : &e.number;
}

void KeyNumbers::emplace(const ShareKey& key, uint32_t number) {
  if (entriesFor(size_ + 1) > entries_.size()) rehash(entriesFor(size_ + 1));
  Entry& e = entries_[placeOf(key)];
  if (e.number != kFree) return;
  e = {key, number};
  ++size_;
}

void KeyNumbers::prefetch(const ShareKey& key) const {
  if (!entries_.empty()) __builtin_prefetch(&entries_[key.a & (entries_.size() - 1)], 1);
}

void KeyNumbers::reserve(size_t count) {
  if (entriesFor(count) > entries_.size()) rehash(entriesFor(count));
}

bool KeyNumbers::hasRoom(size_t count) const { return entries_.size() >= entriesFor(count); }

void KeyNumbers::clear() {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  size_ = 0;
}

void KeyNumbers::restart(size_t count) {
  constexpr size_t kTimesTooLarge = 4;
  const size_t entries = entriesFor(count);
  if (entries_.size() < entries || entries_.size() > kTimesTooLarge * entries) {
    std::vector<Entry>().swap(entries_);
    entries_.resize(entries);
  } else {
    std::fill(entries_.begin(), entries_.end(), Entry{});
  }
  size_ = 0;
}

void KeyNumbers::rehash(size_t entries) {
  std::vector<Entry> before(entries);
  before.swap(entries_);
  for (const Entry& e : before) {
    if (e.number != kFree) entries_[placeOf(e.key)] = e;
  }
}

}  // namespace gable
