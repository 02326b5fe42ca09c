// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A pattern gives each point of the unit square a colour and a height; light from above left on the
// heights makes the relief. Chance comes from value noise on lattices that wrap round (Perlin 1985
// in manner), stones from a jittered grid of cells (Worley 1996).

#include "io/image/patterns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/hash.h"
#include "base/work.h"
#include "material/builtin_textures.h"
#include "math/trig.h"
#include "math/vec.h"

namespace gable {

namespace {

struct Sample {
  Vec3 color;
  double height = 0;
};

double fraction(double v) { return v - std::floor(v); }
double smooth(double t) { return t * t * (3 - 2 * t); }
double step(double low, double high, double v) {
  return smooth(std::clamp((v - low) / (high - low), 0.0, 1.0));
}
Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a * (1 - t) + b * t; }
Vec3 rgb(int hex) {
  return {(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

// Almost all numbers are in the period or next to it: a division takes longer than all the rest.
uint64_t wrapped(int v, int period) {
  if (v < 0) v += period;
  if (v >= period) v -= period;
  if (v < 0 || v >= period) v = (v % period + period) % period;
  return static_cast<uint64_t>(v);
}

double share(uint64_t hash) { return static_cast<double>(mix64(hash) >> 11) * 0x1.0p-53; }

/// In [0, 1), by whole numbers that wrap at `period`.
double chance(int x, int y, int periodX, int periodY, uint64_t seed) {
  return share(hashCombine(hashCombine(seed, wrapped(x, periodX)), wrapped(y, periodY)));
}

int floorOf(double v) {
  const int i = static_cast<int>(v);
  return v < i ? i - 1 : i;
}

/// Cells around jittered points of an n x n grid: distances to the nearest and the next, in cells.
struct Cell {
  double near = 9, next = 9;
  double id = 0;
};

/// Chance for the points of one pattern, row by row. Neighbours mostly ask for the same lattice
/// cells in the same order, so what was drawn for the cells of the last point is kept.
class Chances {
 public:
  /// Goes to another point.
  void next() { nextNoise_ = nextCell_ = 0; }

  /// Smooth noise in [0, 1) with so many lattice cells along u and v.
  double noise(double u, double v, int cellsU, int cellsV, uint64_t seed) {
    const double x = u * cellsU, y = v * cellsV;
    const int ix = floorOf(x), iy = floorOf(y);
    const double tx = smooth(x - ix), ty = smooth(y - iy);
    Corners& c = noise_[nextNoise_++ % noise_.size()];
    const Corners wanted{seed, cellsU, cellsV, ix, iy, {}};
    if (!c.isOf(wanted)) c = drawn(wanted);
    const double low = c.at[0] * (1 - tx) + c.at[1] * tx;
    const double high = c.at[2] * (1 - tx) + c.at[3] * tx;
    return low * (1 - ty) + high * ty;
  }

  /// Sum of octaves, about 0.5 in the middle.
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

  Cell cell(double u, double v, int n, double jitter, uint64_t seed) {
    const double x = u * n, y = v * n;
    const int ix = floorOf(x), iy = floorOf(y);
    Points& around = cells_[nextCell_++ % cells_.size()];
    if (around.seed != seed || around.n != n || around.x != ix || around.y != iy) {
      around = drawn(ix, iy, n, jitter, seed);
    }
    Cell c;
    for (size_t k = 0; k < 9; ++k) {
      const double px = around.px[k], py = around.py[k];
      const double d = std::sqrt((px - x) * (px - x) + (py - y) * (py - y));
      if (d < c.near) {
        c.next = c.near;
        c.near = d;
        c.id = around.id[k];
      } else if (d < c.next) {
        c.next = d;
      }
    }
    return c;
  }

 private:
  /// Of a lattice cell: the lower two, the upper two.
  struct Corners {
    uint64_t seed = 0;
    int cellsU = 0, cellsV = 0, x = 0, y = 0;
    double at[4] = {};
    bool isOf(const Corners& o) const {
      return seed == o.seed && cellsU == o.cellsU && cellsV == o.cellsV && x == o.x && y == o.y;
    }
  };
  struct Points {
    uint64_t seed = 0;
    int n = 0, x = 0, y = 0;
    double px[9] = {}, py[9] = {}, id[9] = {};
  };

  static Corners drawn(Corners c) {
    for (int k = 0; k < 4; ++k) {
      c.at[k] = chance(c.x + k % 2, c.y + k / 2, c.cellsU, c.cellsV, c.seed);
    }
    return c;
  }
  static Points drawn(int ix, int iy, int n, double jitter, uint64_t seed) {
    Points p{seed, n, ix, iy, {}, {}, {}};
    for (int k = 0; k < 9; ++k) {
      const int i = ix - 1 + k % 3, j = iy - 1 + k / 3;
      p.px[k] = i + 0.5 + jitter * (chance(i, j, n, n, seed) - 0.5);
      p.py[k] = j + 0.5 + jitter * (chance(i, j, n, n, seed + 1) - 0.5);
      p.id[k] = chance(i, j, n, n, seed + 2);
    }
    return p;
  }

  std::array<Corners, 32> noise_;
  std::array<Points, 4> cells_;
  size_t nextNoise_ = 0, nextCell_ = 0;
};

/// A wall of blocks in courses: where a point lies in its block, and a number of the block.
struct Block {
  /// 0 in the joint, 1 on the block.
  double face = 1;
  double id = 0, second = 0;
  double u = 0, v = 0;
};

Block block(double u, double v, int columns, int rows, double jointU, double jointV,
            double offset) {
  const int row = static_cast<int>(std::floor(v * rows));
  const double x = u * columns + (row % 2 != 0 ? offset : 0);
  const int column = static_cast<int>(std::floor(x));
  Block b;
  b.u = x - column;
  b.v = v * rows - row;
  const double edgeU = std::min(b.u, 1 - b.u), edgeV = std::min(b.v, 1 - b.v);
  b.face = step(jointU * 0.5, jointU, edgeU) * step(jointV * 0.5, jointV, edgeV);
  b.id = chance(column, row, columns, rows, 17);
  b.second = chance(column, row, columns, rows, 18);
  return b;
}

// --- Masonry ---

Sample bricks(Chances& random, double u, double v, const std::array<Vec3, 3>& tones,
              const Vec3& joint) {
  const Block b = block(u, v, 8, 24, 0.045, 0.13, 0.5);
  const double grain = random.clouds(u, v, 64, 64, 3, 5);
  Vec3 c = mix(mix(tones[0], tones[1], b.id), tones[2], b.second * b.second);
  c = c * (0.84 + 0.32 * grain);
  const Vec3 mortar = joint * (0.9 + 0.2 * random.clouds(u, v, 96, 96, 2, 6));
  return {mix(mortar, c, b.face), b.face * 0.9 + 0.22 * grain};
}

Sample ashlar(Chances& random, double u, double v) {
  const Block b = block(u, v, 4, 8, 0.015, 0.03, 0.5);
  const double grain = random.clouds(u, v, 24, 24, 5, 7);
  const Vec3 c = mix(rgb(0xcfc4ae), rgb(0xb3a68d), b.id) * (0.88 + 0.24 * grain);
  return {mix(rgb(0x8d8474), c, b.face), b.face + 0.35 * grain};
}

Sample clinkerTiles(Chances& random, double u, double v) {
  const Block b = block(u, v, 8, 8, 0.025, 0.025, 0);
  const double grain = random.clouds(u, v, 40, 40, 3, 9);
  const Vec3 c = mix(rgb(0xb9b2a6), rgb(0xa39a8c), b.id) * (0.92 + 0.16 * grain);
  return {mix(rgb(0x77716a), c, b.face), b.face * 0.8 + 0.1 * grain};
}

Sample roofTiles(Chances& random, double u, double v) {
  const int rows = 16, columns = 16;
  const Block b = block(u, v, columns, rows, 0.02, 0.02, 0.5);
  // Rounded across, each row over the one below it.
  const double across = 1 - 4 * (b.u - 0.5) * (b.u - 0.5);
  const double lip = step(0, 0.18, b.v);
  const double grain = random.clouds(u, v, 64, 64, 3, 11);
  Vec3 c = mix(rgb(0xa8492f), rgb(0xc4663f), b.id);
  c = mix(c, rgb(0x7c3a2b), 0.5 * b.second * b.second) * (0.86 + 0.28 * grain);
  return {c * (0.55 + 0.45 * lip), 1.8 * across + 1.3 * lip};
}

Sample slates(Chances& random, double u, double v) {
  const Block b = block(u, v, 10, 16, 0.035, 0.02, 0.5);
  const double lip = step(0, 0.1, b.v);
  const double grain = random.clouds(u, v, 20, 60, 4, 13);
  const Vec3 c = mix(rgb(0x565d66), rgb(0x6d7078), b.id) * (0.84 + 0.32 * grain);
  return {c * (0.5 + 0.5 * lip * (0.4 + 0.6 * b.face)), lip + 0.7 * b.face + 0.4 * grain};
}

Sample cobbles(Chances& random, double u, double v) {
  const Cell c = random.cell(u, v, 14, 0.6, 15);
  const double face = step(0.06, 0.26, c.next - c.near);
  const double grain = random.clouds(u, v, 64, 64, 3, 16);
  const Vec3 stone = mix(rgb(0x77726c), rgb(0x9b958b), c.id) * (0.85 + 0.3 * grain);
  return {mix(rgb(0x3f3b36), stone, face), 2.2 * face * (1 - 0.5 * c.near) + 0.3 * grain};
}

Sample gravel(Chances& random, double u, double v) {
  const Cell c = random.cell(u, v, 44, 0.9, 19);
  const double face = step(0.02, 0.35, c.next - c.near);
  const Vec3 stone = mix(rgb(0x8b8478), rgb(0xc0b8a8), c.id);
  return {mix(rgb(0x5a544b), stone, face), 1.1 * face};
}

// --- Wood ---

Sample boards(Chances& random, double u, double v, int count, const Vec3& light, const Vec3& dark,
              double gap, double weather) {
  const int board = static_cast<int>(std::floor(u * count));
  const double inBoard = u * count - board;
  const double id = chance(board, 0, count, 1, 23), shift = chance(board, 1, count, 2, 24);
  // Grain runs along v, bent by slow noise.
  const double bend = random.clouds(u, fraction(v + shift), 6, 3, 3, 25);
  const double rings = fraction(7 * bend + 3 * id + 1.5 * inBoard);
  const double ring = smooth(std::fabs(2 * rings - 1));
  const double fibre = random.noise(u, fraction(v + shift), count * 24, 8, 26);
  const double edge = step(gap * 0.4, gap, std::min(inBoard, 1 - inBoard));
  Vec3 c = mix(light, dark, 0.45 * ring + 0.3 * fibre + 0.25 * id);
  c = mix(c, rgb(0x9a968e), weather * random.clouds(u, v, 12, 5, 3, 27));
  return {c * (0.35 + 0.65 * edge), edge + 0.12 * fibre};
}

// --- Stone and mineral ---

Sample speckled(Chances& random, double u, double v, const Vec3& light, const Vec3& dark, int cells,
                double contrast) {
  const double large = random.clouds(u, v, 5, 5, 4, 31);
  const double fine = random.clouds(u, v, cells, cells, 3, 32);
  return {
      mix(dark, light, std::clamp(0.5 + contrast * (fine - 0.5) + 0.7 * (large - 0.5), 0.0, 1.0)),
      0.35 * fine};
}

Sample concrete(Chances& random, double u, double v) {
  Sample s = speckled(random, u, v, rgb(0xb4b2ad), rgb(0x97958f), 48, 0.7);
  // Pores, and the joints of the formwork.
  const Cell pore = random.cell(u, v, 34, 0.95, 33);
  const double hole = pore.id > 0.72 ? 1 - step(0.03, 0.11, pore.near) : 0;
  const double seam = std::min(fraction(u * 4), 1 - fraction(u * 4));
  const double line =
      1 - step(0.004, 0.012, std::min(seam, 2 * std::min(fraction(v * 2), 1 - fraction(v * 2))));
  s.color = s.color * (1 - 0.35 * hole) * (1 - 0.22 * line);
  s.height -= 0.8 * hole + 0.7 * line;
  return s;
}

Sample stucco(Chances& random, double u, double v) {
  const double bumps = random.clouds(u, v, 56, 56, 3, 35);
  const double large = random.clouds(u, v, 4, 4, 4, 36);
  return {mix(rgb(0xd9bd8f), rgb(0xe9d4ad), 0.6 * bumps + 0.4 * large), 1.0 * bumps};
}

Sample plaster(Chances& random, double u, double v) {
  const double strokes = random.clouds(u, v, 14, 30, 4, 37);
  const double large = random.clouds(u, v, 4, 4, 3, 38);
  return {mix(rgb(0xdedad1), rgb(0xf2efe8), 0.6 * strokes + 0.4 * large), 0.4 * strokes};
}

Sample sandstone(Chances& random, double u, double v) {
  const double bend = random.clouds(u, v, 4, 4, 4, 39);
  const double layer = random.noise(u, fraction(v + 0.12 * bend), 3, 22, 40);
  const double grain = random.clouds(u, v, 90, 90, 2, 41);
  const Vec3 c = mix(rgb(0xc9a26b), rgb(0xe0c394), 0.6 * layer + 0.4 * bend);
  return {c * (0.9 + 0.2 * grain), 0.4 * layer + 0.3 * grain};
}

Sample marble(Chances& random, double u, double v) {
  const double bend = random.clouds(u, v, 4, 4, 5, 43);
  const double wave = std::fabs(sinDeg(360 * (u + v) + 900 * (bend - 0.5)));
  const double vein = 1 - step(0, 0.22, wave);
  const double cloud = random.clouds(u, v, 6, 6, 4, 44);
  return {mix(mix(rgb(0xe4e2de), rgb(0xf7f6f3), cloud), rgb(0x8e9096), 0.7 * vein * cloud), 0};
}

Sample granite(Chances& random, double u, double v) {
  const Cell large = random.cell(u, v, 60, 1, 45), small = random.cell(u, v, 110, 1, 46);
  Vec3 c = mix(rgb(0xa09a96), rgb(0xc8c1bb), large.id);
  if (small.id > 0.78) c = mix(c, rgb(0x3d3b3c), 1 - step(0.2, 0.5, small.near));
  if (small.id < 0.14) c = mix(c, rgb(0xc59a86), 1 - step(0.2, 0.5, small.near));
  return {c, 0.1 * small.id};
}

Sample asphalt(Chances& random, double u, double v) {
  const Cell grain = random.cell(u, v, 120, 1, 47);
  const double large = random.clouds(u, v, 4, 4, 4, 48);
  return {mix(rgb(0x37383a), rgb(0x626365), 0.55 * grain.id + 0.45 * large),
          0.5 * (1 - grain.near)};
}

// --- Metal, glass, cloth, green ---

Sample steel(Chances& random, double u, double v) {
  const double brushed =
      random.noise(u, v, 4, 256, 51) * 0.6 + random.noise(u, v, 9, 128, 52) * 0.4;
  const double panel =
      std::min({fraction(u * 4), 1 - fraction(u * 4), fraction(v * 4), 1 - fraction(v * 4)});
  const double line = 1 - step(0.006, 0.016, panel);
  return {mix(rgb(0x969ba0), rgb(0xb9bec2), brushed) * (1 - 0.5 * line), -0.9 * line};
}

Sample corrugated(Chances& random, double u, double v) {
  const double wave = 0.5 + 0.5 * cosDeg(360 * 16 * u);
  const double stain = random.clouds(u, v, 24, 4, 4, 53);
  return {mix(rgb(0x8f979c), rgb(0xb4babd), stain) * (0.7 + 0.3 * wave), 3.0 * wave};
}

Sample copper(Chances& random, double u, double v) {
  const double patina = random.clouds(u, v, 6, 6, 5, 55);
  const double run = random.clouds(u, v, 40, 5, 3, 56);
  const double seam = std::min(fraction(u * 6), 1 - fraction(u * 6));
  const double fold = 1 - step(0.012, 0.05, seam);
  const double age = std::clamp(0.25 + 1.5 * (0.6 * patina + 0.4 * run - 0.28), 0.0, 1.0);
  return {mix(rgb(0x6f5540), rgb(0x7fae9b), age), 2.4 * fold};
}

Sample glass(Chances& random, double u, double v) {
  const double edge =
      std::min({fraction(u * 4), 1 - fraction(u * 4), fraction(v * 4), 1 - fraction(v * 4)});
  const double frame = 1 - step(0.035, 0.045, edge);
  const int column = static_cast<int>(std::floor(u * 4)), row = static_cast<int>(std::floor(v * 4));
  const double id = chance(column, row, 4, 4, 57);
  const double sky = 0.5 * fraction(v * 4) + 0.5 * random.clouds(u, v, 3, 3, 3, 58);
  const Vec3 pane = mix(rgb(0x35505f), rgb(0x9fc0cf), 0.8 * sky + 0.2 * id);
  return {mix(pane, rgb(0x2f3337), frame), 1.5 * frame};
}

Sample linen(Chances& random, double u, double v) {
  const double along = std::fabs(sinDeg(180 * 96 * u)), up = std::fabs(sinDeg(180 * 96 * v));
  const bool over =
      (static_cast<int>(std::floor(u * 96)) + static_cast<int>(std::floor(v * 96))) % 2 == 0;
  const double thread = over ? along : up;
  const double slub = random.clouds(u, v, 80, 14, 2, 61);
  return {mix(rgb(0xb9a98a), rgb(0xe0d4ba), 0.55 * thread + 0.45 * slub), 0.5 * thread};
}

Sample grass(Chances& random, double u, double v) {
  const double blades =
      random.noise(u, v, 150, 60, 63) * 0.6 + random.noise(u, v, 90, 130, 64) * 0.4;
  const double patch = random.clouds(u, v, 5, 5, 4, 65);
  const Vec3 c = mix(rgb(0x3f5a24), rgb(0x86a14a), blades);
  return {mix(c, rgb(0x9c9a52), 0.35 * step(0.5, 0.75, patch)), 0.9 * blades};
}

Sample pattern(Chances& random, size_t number, double u, double v) {
  const std::string_view name = kBuiltinTextures[number];
  if (name == "concrete") return concrete(random, u, v);
  if (name == "plaster") return plaster(random, u, v);
  if (name == "brick") {
    return bricks(random, u, v, {rgb(0x9c4a35), rgb(0xb5634a), rgb(0x6f3429)}, rgb(0xbdb3a4));
  }
  if (name == "oak") return boards(random, u, v, 5, rgb(0xc79c63), rgb(0x8f6234), 0.02, 0);
  if (name == "sandstone") return sandstone(random, u, v);
  if (name == "ashlar") return ashlar(random, u, v);
  if (name == "roof_tiles") return roofTiles(random, u, v);
  if (name == "slate") return slates(random, u, v);
  if (name == "marble") return marble(random, u, v);
  if (name == "granite") return granite(random, u, v);
  if (name == "planks") return boards(random, u, v, 10, rgb(0xb98c5a), rgb(0x7a5230), 0.06, 0.15);
  if (name == "steel") return steel(random, u, v);
  if (name == "walnut") return boards(random, u, v, 4, rgb(0x7d5236), rgb(0x3f2617), 0.02, 0);
  if (name == "corrugated") return corrugated(random, u, v);
  if (name == "copper") return copper(random, u, v);
  if (name == "driftwood") return boards(random, u, v, 12, rgb(0xa49a8a), rgb(0x6e6456), 0.07, 0.6);
  if (name == "floor_tiles") return clinkerTiles(random, u, v);
  if (name == "stucco") return stucco(random, u, v);
  if (name == "grass") return grass(random, u, v);
  if (name == "gravel") return gravel(random, u, v);
  if (name == "asphalt") return asphalt(random, u, v);
  if (name == "cobblestone") return cobbles(random, u, v);
  if (name == "glass") return glass(random, u, v);
  return linen(random, u, v);
}

}  // namespace

Image drawPattern(size_t number) {
  GABLE_CHECK_LT(number, kBuiltinTextures.size());
  constexpr int n = static_cast<int>(kPatternSize);
  std::vector<Sample> samples(size_t{kPatternSize} * kPatternSize);
  const auto at = [&](int x, int y) -> Sample& {
    return samples[static_cast<size_t>((y + n) % n) * kPatternSize +
                   static_cast<size_t>((x + n) % n)];
  };
  Chances random;
  for (int y = 0; y < n; ++y) {
    work(kPatternSize);
    for (int x = 0; x < n; ++x) {
      random.next();
      at(x, y) = pattern(random, number, (x + 0.5) / n, (y + 0.5) / n);
    }
  }
  Image image{kPatternSize, kPatternSize, {}};
  image.rgba.resize(samples.size() * 4);
  for (int y = 0; y < n; ++y) {
    work(kPatternSize);
    for (int x = 0; x < n; ++x) {
      // v runs up, rows of an image run down: light from above left.
      const double slope =
          (at(x + 1, y).height - at(x - 1, y).height) - (at(x, y + 1).height - at(x, y - 1).height);
      const double light = std::clamp(1 + 0.28 * slope, 0.6, 1.35);
      uint8_t* out = image.rgba.data() +
                     (static_cast<size_t>(n - 1 - y) * kPatternSize + static_cast<size_t>(x)) * 4;
      for (size_t k = 0; k < 3; ++k) {
        const double c = std::clamp(at(x, y).color[k] * light, 0.0, 1.0);
        out[k] = static_cast<uint8_t>(std::lround(c * 255));
      }
      out[3] = 255;
    }
  }
  return image;
}

}  // namespace gable
