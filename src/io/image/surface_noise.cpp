// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/image/surface_noise.h"

#include <array>

namespace gable::surface {

double noise(double u, double v, int cellsU, int cellsV, uint64_t seed) {
  const double x = u * cellsU, y = v * cellsV;
  const int ix = floorOf(x), iy = floorOf(y);
  const double tx = smooth(x - ix), ty = smooth(y - iy);
  const auto at = [&](int i, int j) {
    return chance(static_cast<uint64_t>(wrapped(ix + i, cellsU)),
                  static_cast<uint64_t>(wrapped(iy + j, cellsV)), seed);
  };
  const double low = at(0, 0) * (1 - tx) + at(1, 0) * tx;
  const double high = at(0, 1) * (1 - tx) + at(1, 1) * tx;
  return low * (1 - ty) + high * ty;
}

double clouds(double u, double v, int cellsU, int cellsV, int octaves, uint64_t seed) {
  double sum = 0, weight = 0, part = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += part * noise(u, v, cellsU, cellsV, seed + static_cast<uint64_t>(i));
    weight += part;
    part *= 0.55;
    cellsU *= 2;
    cellsV *= 2;
  }
  return sum / weight;
}

Cell cellAt(double u, double v, const Cells& c) {
  const double x = u * c.columns, y = v * c.rows;
  const double wide = c.width / c.columns, high = c.height / c.rows;
  const int ix = floorOf(x), iy = floorOf(y);
  struct Site {
    double x = 0, y = 0;
    uint64_t i = 0, j = 0;
  };
  // Two cells away is as far as a border can come from.
  std::array<Site, 25> sites;
  size_t near = 0;
  double best = 1e9;
  for (size_t k = 0; k < sites.size(); ++k) {
    const int i = ix - 2 + static_cast<int>(k % 5), j = iy - 2 + static_cast<int>(k / 5);
    Site& s = sites[k];
    s.i = static_cast<uint64_t>(wrapped(i, c.columns));
    s.j = static_cast<uint64_t>(wrapped(j, c.rows));
    s.x = (i + 0.5 + c.jitter * (chance(s.i, s.j, c.seed) - 0.5) - x) * wide;
    s.y = (j + 0.5 + c.jitter * (chance(s.i, s.j, c.seed + 1) - 0.5) - y) * high;
    const double d = s.x * s.x + s.y * s.y;
    if (d >= best) continue;
    best = d;
    near = k;
  }
  const Site& own = sites[near];
  Cell out;
  out.point = std::sqrt(best);
  out.dx = -own.x;
  out.dy = -own.y;
  out.id = chance(own.i, own.j, c.seed + 2);
  out.second = chance(own.i, own.j, c.seed + 3);
  out.border = 1e9;
  for (size_t k = 0; k < sites.size(); ++k) {
    const double ax = sites[k].x - own.x, ay = sites[k].y - own.y;
    const double far = std::sqrt(ax * ax + ay * ay);
    if (k == near || far == 0) continue;
    const double border = ((sites[k].x + own.x) * ax + (sites[k].y + own.y) * ay) / (2 * far);
    out.border = std::min(out.border, border);
  }
  return out;
}

Vec3 toneOf(const LibraryMaterial& m, double id) {
  return mix(rgb(m.color), rgb(m.second), m.variety * id * id);
}

uint64_t seedOf(const LibraryMaterial& m) { return hashBytes(m.name); }

}  // namespace gable::surface
