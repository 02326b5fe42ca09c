// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Chance on the unit square that wraps round: smooth noise on lattices (Perlin 1985 in manner) and
// cells around jittered points (Worley 1996).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hash.h"
#include "io/image/surface.h"

namespace gable::surface {

inline double fraction(double v) { return v - std::floor(v); }
inline double smooth(double t) { return t * t * (3 - 2 * t); }
/// From 0 at `low` to 1 at `high`.
inline double ramp(double low, double high, double v) {
  return smooth(std::clamp((v - low) / (high - low), 0.0, 1.0));
}
inline Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a * (1 - t) + b * t; }
inline Vec3 rgb(uint32_t hex) {
  return {(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

inline int wrapped(int v, int period) {
  // Nearly all are within: a division takes as long as all else here.
  return v >= 0 && v < period ? v : (v % period + period) % period;
}
inline int floorOf(double v) { return static_cast<int>(std::floor(v)); }

/// In [0, 1), by address; `column` is hashCombine(seed, x).
inline double chanceOf(uint64_t column, uint64_t y) {
  return static_cast<double>(mix64(hashCombine(column, y)) >> 11) * 0x1.0p-53;
}
inline double chance(uint64_t x, uint64_t y, uint64_t seed) {
  return chanceOf(hashCombine(seed, x), y);
}

/// Smooth noise in [0, 1) with so many lattice cells along u and v.
double noise(double u, double v, int cellsU, int cellsV, uint64_t seed);
/// Octaves of it; the mean is 0.5.
double clouds(double u, double v, int cellsU, int cellsV, int octaves, uint64_t seed);

struct Cell {
  /// To the border of the cell and to its point; in metres of a tile of `width` x `height`.
  double border = 0, point = 0;
  /// In [0, 1) each.
  double id = 0, second = 0;
  /// From the point, in metres.
  double dx = 0, dy = 0;
};
struct Cells {
  int columns = 1, rows = 1;
  double width = 1, height = 1;
  double jitter = 1;
  uint64_t seed = 0;

  bool operator==(const Cells&) const = default;
};
Cell cellAt(double u, double v, const Cells& c);

/// Draws a texel; u and v in [0, 1).
using Draw = SurfaceTexel (*)(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawMasonry(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawStones(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawFurrows(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawFlakes(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawGrain(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawBoards(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawLappedBoards(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawCourses(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawRolls(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawSeams(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawFrame(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawPanes(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawWater(const LibraryMaterial& m, double u, double v);
SurfaceTexel drawWeave(const LibraryMaterial& m, double u, double v);
/// Strands and leaves lie over one another: drawn one by one.
SurfaceField drawPlants(const LibraryMaterial& m);

/// The colour of a unit: from the material's own towards its second.
Vec3 toneOf(const LibraryMaterial& m, double id);
/// A number of the material, so that no two share their chance.
uint64_t seedOf(const LibraryMaterial& m);

}  // namespace gable::surface
