// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The Sobol sequence's first two dimensions, scrambled by hashing as in Burley, Practical
// Hash-based Owen Scrambling (2020): each dimension shuffles the sample index with one nested
// uniform scramble and scrambles the two coordinates with two more.

#include "render/sampler.h"

#include <bit>

namespace gable::rt {

namespace {

constexpr uint32_t reverseBits(uint32_t x) {
  x = ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
  return __builtin_bswap32(x);
}

/// A permutation in which a bit depends on lower bits only (Laine and Karras 2011, with the
/// constants of Vegdahl 2021).
constexpr uint32_t permuteUpwards(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

/// Of a number whose bits are reversed already.
constexpr uint32_t nestedScramble(uint32_t reversed, uint32_t seed) {
  return reverseBits(permuteUpwards(reversed, seed));
}

/// The second Sobol dimension: its generator matrix is Pascal's triangle modulo 2, whose product
/// with the index takes five steps of folding; the result is bit-reversed.
constexpr uint32_t sobolSecondReversed(uint32_t i) {
  i ^= (i & 0xaaaaaaaaU) >> 1;
  i ^= (i & 0xccccccccU) >> 2;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= (i & 0xffff0000U) >> 16;
  return i;
}

}  // namespace

Sampler::Sampler(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed)
    : pixel_(mix32(x + mix32(y + mix32(seed + 0x9e3779b9U)))), sample_(reverseBits(sample)) {}

namespace {

/// The point of that index, its coordinates scrambled by `h`.
Vec2f sobolPoint(uint32_t index, uint32_t h) {
  // Reversed index and reversed second dimension are scrambled upwards and reversed at the end.
  const uint32_t a = reverseBits(permuteUpwards(index, mix32(h ^ 0x68bc21ebU)));
  const uint32_t b =
      reverseBits(permuteUpwards(sobolSecondReversed(index), mix32(h ^ 0x02e5be93U)));
  return {toUnit(a), toUnit(b)};
}

}  // namespace

Vec2f Sampler::point(uint32_t dimension) const {
  const uint32_t h = mix32(pixel_ + dimension * 0x9e3779b9U);
  return sobolPoint(nestedScramble(sample_, h), h);
}

Vec2f pointOfBlock(uint32_t x, uint32_t y, uint32_t sample, uint32_t seed) {
  // The place along a Z through the block. Of each four points one is the pixel's n-th: by one of
  // the few choices, linear in the bits of the place, that make nets in base 2 of the n-th ones of
  // squares and blocks.
  const uint32_t x0 = x & 1, y0 = y & 1, x1 = x >> 1 & 1, y1 = y >> 1 & 1;
  const uint32_t place = x0 | y0 << 1 | x1 << 2 | y1 << 3;
  const uint32_t first = (x0 ^ y0 ^ y1) | (x0 ^ x1 ^ y1) << 1;
  const uint32_t index = (sample & ~3u) << 4 | place << 2 | (first ^ (sample & 3));
  return sobolPoint(index, mix32((x >> 2) + mix32((y >> 2) + mix32(seed + 0x7f4a7c15U))));
}

float Sampler::number(uint32_t dimension) const {
  const uint32_t h = mix32(pixel_ + dimension * 0x9e3779b9U);
  return toUnit(reverseBits(permuteUpwards(nestedScramble(sample_, h), mix32(h ^ 0x68bc21ebU))));
}

namespace {

/// Cosine and sine of so many eighths of a turn, up to one to either side: their power series.
inline Vec2f ofEighths(float eighths) {
  const float x = kPif / 4 * eighths, s = x * x;
  return {1 + s * (-1 / 2.0f + s * (1 / 24.0f + s * (-1 / 720.0f + s * (1 / 40320.0f)))),
          x * (1 + s * (-1 / 6.0f + s * (1 / 120.0f + s * (-1 / 5040.0f + s * (1 / 362880.0f)))))};
}

/// The first where all bits of the mask are set, the second where none is. Either is as likely,
/// which no processor foresees: so there are no two ways through the program.
inline float chosen(uint32_t mask, float first, float second) {
  return std::bit_cast<float>((std::bit_cast<uint32_t>(first) & mask) |
                              (std::bit_cast<uint32_t>(second) & ~mask));
}

}  // namespace

Vec2f onDisc(Vec2f u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {};
  const uint32_t isAlongX = std::abs(a) > std::abs(b) ? 0xffffffff : 0;
  const float radius = chosen(isAlongX, a, b);
  const Vec2f turn = ofEighths(chosen(isAlongX, b, a) / radius);
  const float along = radius * turn.x, across = radius * turn.y;
  return {chosen(isAlongX, along, across), chosen(isAlongX, across, along)};
}

Vec3f cosineDirection(const Vec3f& n, Vec2f u) {
  const Vec2f d = onDisc(u);
  Vec3f t, b;
  basisAround(n, t, b);
  return normalized(t * d.x + b * d.y + n * std::sqrt(std::max(1e-8f, 1 - d.x * d.x - d.y * d.y)));
}

}  // namespace gable::rt
