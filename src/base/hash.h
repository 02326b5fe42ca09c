// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// 64-bit hashing that gives the same value on every machine, compiler and run.
// mix64 is the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gable {

constexpr uint64_t mix64(uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Folds `value` into `seed`; the order of folding matters.
constexpr uint64_t hashCombine(uint64_t seed, uint64_t value) {
  return mix64(seed + 0x9e3779b97f4a7c15ULL + value * 0xd1342543de82ef95ULL);
}

/// The bits of `v`, with -0 as 0 so that equal numbers hash equally.
constexpr uint64_t hashDouble(double v) { return v == 0 ? 0 : std::bit_cast<uint64_t>(v); }

constexpr uint64_t hashBytes(std::string_view bytes, uint64_t seed = 0) {
  uint64_t h = hashCombine(seed, bytes.size());
  uint64_t word = 0;
  size_t i = 0;
  for (; i < bytes.size(); ++i) {
    word |= static_cast<uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * (i % 8));
    if (i % 8 == 7) {
      h = hashCombine(h, word);
      word = 0;
    }
  }
  return i % 8 ? hashCombine(h, word) : h;
}

}  // namespace gable
