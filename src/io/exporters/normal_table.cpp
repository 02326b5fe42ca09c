// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/normal_table.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/hash.h"

namespace gable {

namespace {

constexpr size_t kFewPlaces = 64;
constexpr size_t kBytes = 3 * sizeof(float);

uint64_t hashOf(const float* n) {
  const auto word = [](float f) { return uint64_t{std::bit_cast<uint32_t>(f)}; };
  return hashCombine(word(n[0]) << 32 | word(n[1]), word(n[2]));
}

}  // namespace

const std::vector<uint32_t>& NormalTable::number(std::span<const float> normals) {
  normals_.clear();
  numbers_.clear();
  places_.assign(kFewPlaces, 0);
  for (size_t i = 0; i < normals.size(); i += 3) {
    const float* const n = normals.data() + i;
    // The vertices of a face follow each other.
    const bool isLast = i > 0 && std::memcmp(n, n - 3, kBytes) == 0;
    numbers_.push_back(isLast ? numbers_.back() : find(n));
  }
  return numbers_;
}

uint32_t NormalTable::find(const float* n) {
  const size_t mask = places_.size() - 1;
  size_t at = hashOf(n) & mask;
  for (; places_[at] != 0; at = (at + 1) & mask) {
    const uint32_t number = places_[at] - 1;
    if (std::memcmp(normals_.data() + size_t{number} * 3, n, kBytes) == 0) return number;
  }
  normals_.insert(normals_.end(), n, n + 3);
  const auto count = static_cast<uint32_t>(normals_.size() / 3);
  places_[at] = count;
  if (2 * count > places_.size()) grow();
  return count - 1;
}

void NormalTable::grow() {
  places_.assign(places_.size() * 2, 0);
  const size_t mask = places_.size() - 1;
  for (size_t i = 0; i < normals_.size(); i += 3) {
    size_t at = hashOf(normals_.data() + i) & mask;
    while (places_[at] != 0) at = (at + 1) & mask;
    places_[at] = static_cast<uint32_t>(i / 3 + 1);
  }
}

}  // namespace gable
