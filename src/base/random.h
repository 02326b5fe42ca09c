// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Addressed randomness: a draw is a pure function of its address, never the next number of a
// stream. An address is made by folding its parts with hashCombine (see base/hash.h); equal
// addresses give equal draws whatever the thread, the order or the compiler.
#pragma once

#include <cstdint>

#include "base/hash.h"

namespace gable {

/// 64 random bits of an address. Two rounds of a bijective finaliser over a Weyl step, so that
/// neighbouring addresses are independent to the tests of base/random_test.cpp.
constexpr uint64_t randomBits(uint64_t address) {
  return mix64(mix64(address + 0x9e3779b97f4a7c15ULL) ^ 0x6a09e667f3bcc909ULL);
}

/// Uniform in [0, 1), on the grid of 2^-53.
constexpr double randomUnit(uint64_t address) {
  return static_cast<double>(randomBits(address) >> 11) * 0x1.0p-53;
}

/// Uniform in [lo, hi); lo when the interval is empty or reversed bounds are equal.
constexpr double randomIn(uint64_t address, double lo, double hi) {
  return lo + (hi - lo) * randomUnit(address);
}

/// A draw from the normal distribution N(0, 1), by the inverse of its distribution function
/// (Acklam's rational approximation, relative error under 1.2e-9).
double randomNormal(uint64_t address);

}  // namespace gable
