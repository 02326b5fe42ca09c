// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The addresses for randomness that rules choose themselves (`seedian`, `variants`): they follow
// from a number alone, and the number can be read from them again.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/hash.h"

namespace gable {

inline constexpr uint64_t kSeedName = hashBytes("seedian");

/// The address that a seed stands for. A seed is a float; what is finer is rounded.
inline uint64_t seededPath(double seed) {
  constexpr double kMost = std::numeric_limits<float>::max();
  const auto single = static_cast<double>(static_cast<float>(std::clamp(seed, -kMost, kMost)));
  return hashCombine(kSeedName, hashDouble(single));
}

/// The bits that `hashCombine(seed, bits)` was made of: each step of mix64 backwards.
constexpr uint64_t hashedBits(uint64_t seed, uint64_t hash) {
  hash ^= (hash >> 31) ^ (hash >> 62);
  hash *= 0x319642b2d24d8ec3ULL;
  hash ^= (hash >> 27) ^ (hash >> 54);
  hash *= 0x96de1b173f119089ULL;
  hash ^= (hash >> 30) ^ (hash >> 60);
  return (hash - 0x9e3779b97f4a7c15ULL - seed) * 0x572b5ee77a54e3bdULL;
}
static_assert(hashedBits(5, hashCombine(5, 7)) == 7);

/// The seed that a shape's address stands for; absent for addresses that no rule has chosen. One of
/// 500 million of those is taken for a chosen one, the same wherever it is asked.
inline std::optional<double> seedOf(uint64_t path) {
  // The bits of a double that a float does not have.
  constexpr uint64_t kBeyondFloat = (1ULL << 29) - 1;
  const uint64_t bits = hashedBits(kSeedName, path);
  const double seed = std::bit_cast<double>(bits);
  const bool given = (bits & kBeyondFloat) == 0 &&
                     std::abs(seed) <= static_cast<double>(std::numeric_limits<float>::max());
  return given ? std::optional(seed) : std::nullopt;
}

}  // namespace gable
