// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// K. Perlin, "Improving Noise", SIGGRAPH 2002: the quintic fade and gradients to the edges of a
// cube, with a hash of cell and address in the place of his table.
#include "math/noise.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace gable {

namespace {

constexpr double kFurthest = 1e9;

bool isPlace(double v) { return std::fabs(v) < kFurthest; }

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mix(double a, double b, double t) { return a + (b - a) * t; }

uint64_t cellAddress(uint64_t address, int64_t x, int64_t y, int64_t z) {
  return hashCombine(
      hashCombine(hashCombine(address, static_cast<uint64_t>(x)), static_cast<uint64_t>(y)),
      static_cast<uint64_t>(z));
}

// The offset along one of twelve directions to the edges of a cube.
double slope(uint64_t cell, const Vec3& d) {
  const uint64_t h = randomBits(cell) % 12;
  const double u = h < 8 ? d.x : d.y, v = h < 4 ? d.y : d.z;
  return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

// In the plane: one of eight directions, all of a length.
double slope(uint64_t cell, Vec2 d) {
  constexpr double kHalf = 0.70710678118654752;
  const uint64_t h = randomBits(cell) % 8;
  const double x = (h & 1) ? -d.x : d.x, y = (h & 2) ? -d.y : d.y;
  if (h < 4) return (x + y) * kHalf;
  return (h & 1) ? x : y;
}

}  // namespace

double gradientNoise(Vec2 p, uint64_t address) {
  if (!isPlace(p.x) || !isPlace(p.y)) return 0;
  const double fx = std::floor(p.x), fy = std::floor(p.y);
  const auto x = static_cast<int64_t>(fx), y = static_cast<int64_t>(fy);
  const Vec2 d{p.x - fx, p.y - fy};
  const auto corner = [&](int i, int j) {
    return slope(cellAddress(address, x + i, y + j, 0), Vec2{d.x - i, d.y - j});
  };
  const double u = fade(d.x), v = fade(d.y);
  const double value =
      mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
  // The corners of a cell are at most the root of a half away from where they all pull one way.
  return std::clamp(value * 1.4142135623730951, -1.0, 1.0);
}

double gradientNoise(const Vec3& p, uint64_t address) {
  if (!isPlace(p.x) || !isPlace(p.y) || !isPlace(p.z)) return 0;
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const auto x = static_cast<int64_t>(fx), y = static_cast<int64_t>(fy),
             z = static_cast<int64_t>(fz);
  const Vec3 d{p.x - fx, p.y - fy, p.z - fz};
  const auto corner = [&](int i, int j, int k) {
    return slope(cellAddress(address, x + i, y + j, z + k), Vec3{d.x - i, d.y - j, d.z - k});
  };
  const double u = fade(d.x), v = fade(d.y), w = fade(d.z);
  const auto layer = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u),
               v);
  };
  return std::clamp(mix(layer(0), layer(1), w), -1.0, 1.0);
}

namespace {

template <class Place>
double sumOfOctaves(Place p, int octaves, uint64_t address) {
  double sum = 0, strength = 1, whole = 0;
  for (int i = 0; i < std::clamp(octaves, 1, 16); ++i) {
    sum += strength * gradientNoise(p, hashCombine(address, static_cast<uint64_t>(i)));
    whole += strength;
    strength /= 2;
    p = p * 2;
  }
  return sum / whole;
}

}  // namespace

double fractalNoise(Vec2 p, int octaves, uint64_t address) {
  return sumOfOctaves(p, octaves, address);
}

double fractalNoise(const Vec3& p, int octaves, uint64_t address) {
  return sumOfOctaves(p, octaves, address);
}

}  // namespace gable
