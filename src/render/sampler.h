// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Low-discrepancy samples for the pixels of a picture. A sample is a pure function of pixel,
// sample index, dimension and seed, so neither threads nor the order of work can change it.
//
// Each use of randomness on a path has a dimension of its own; within one the points of a pixel
// form a scrambled (0,2)-sequence, so n of them cover the square evenly for every n.
#pragma once

#include <cstdint>

#include "render/vec3f.h"

namespace gable::rt {

class Sampler {
 public:
  Sampler(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed);
  /// A point of [0,1)^2.
  Vec2f point(uint32_t dimension) const;
  /// A number in [0,1).
  float number(uint32_t dimension) const;

 private:
  /// The sample's bits are reversed.
  uint32_t pixel_, sample_;
};

/// A point of [0,1)^2 for light that is smoothed: pixels share them in blocks of 4 x 4. Each four
/// samples of a pixel are spread evenly, and so are the n-th samples of squares of 2 x 2 and of
/// blocks.
Vec2f pointOfBlock(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed);

/// The unit disc from the unit square, keeping areas and neighbours (Shirley and Chiu 1997).
Vec2f onDisc(Vec2f u);
/// A direction about the unit vector `n` with density cos / pi.
Vec3f cosineDirection(const Vec3f& n, Vec2f u);

/// 32 well mixed bits.
constexpr uint32_t mix32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x21f0aaadU;
  x ^= x >> 15;
  x *= 0xd35a2d97U;
  return x ^ (x >> 15);
}

/// A number in [0,1) of the upper 24 bits.
constexpr float toUnit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }
/// The k-th of independent numbers in [0,1) that belong to something with that hash.
constexpr float drawnBy(uint32_t hash, uint32_t k) { return toUnit(mix32(hash + k * 0x9e3779b9U)); }

}  // namespace gable::rt
