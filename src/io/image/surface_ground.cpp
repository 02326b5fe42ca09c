// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Stones that touch, mineral grounds and coats, water, cloth, glass.

#include "io/image/surface_noise.h"
#include "math/trig.h"

namespace gable::surface {

namespace {

// Moves a point by noise, so that borders of cells are not straight.
struct Point {
  double u = 0, v = 0;
};
Point bent(double u, double v, int cells, double by, uint64_t seed) {
  return {u + by * (clouds(u, v, cells, cells, 3, seed) - 0.5),
          v + by * (clouds(u, v, cells, cells, 3, seed + 40) - 0.5)};
}

// Thin dark lines between large cells.
double crack(const LibraryMaterial& m, double u, double v, int cells, double width) {
  const uint64_t seed = seedOf(m) + 70;
  const Point p = bent(u, v, cells * 2, 0.06, seed);
  const Cell c = cellAt(p.u, p.v, {cells, cells, m.width, m.height, 1, seed});
  // Not every border is broken.
  const double broken = ramp(0.5, 0.58, clouds(u, v, cells, cells, 2, seed + 9));
  return broken * (1 - ramp(width * 0.3, width, c.border));
}

}  // namespace

SurfaceTexel drawStones(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double size = std::min(m.width / m.columns, m.height / m.rows);
  const Point p = bent(u, v, 2 * std::max(m.columns, m.rows), 0.18 * size / m.width, seed + 30);
  // Long stones are round ones drawn out, but for lenticels, which count in metres.
  const bool lenticels = m.joint < -0.01;
  const double high = lenticels ? m.height : m.rows * m.width / m.columns;
  const Cell c = cellAt(p.u, p.v, {m.columns, m.rows, m.width, high, m.wander, seed});
  const double grain = clouds(u, v, 70, 70, 4, seed + 5);
  const double fine = clouds(u, v, 180, 180, 2, seed + 6);
  SurfaceTexel t;
  Vec3 color = toneOf(m, c.id) * (1 + 0.2 * m.variety * (c.second - 0.5));
  color = color * (1 + m.grain * 0.6 * (0.6 * grain + 0.4 * fine - 0.5));
  if (lenticels) {
    // Lenticels: thin dark marks within the cells, most of them faint.
    const double mark = c.id > 0.5 ? 1 - ramp(0.002, 0.005, std::fabs(c.dy)) : 0;
    const double length = 1 - ramp(0.02, 0.06 + 0.08 * c.second, std::fabs(c.dx));
    const double dark = mark * length * (0.4 + 0.6 * c.second);
    t.color = mix(color, rgb(m.between), dark);
    t.height = -m.relief * dark + m.grainHeight * grain;
    t.roughness = m.roughness + 0.2 * dark;
    return t;
  }
  const double gap = std::fabs(m.joint) / 2;
  const double round = std::max(size * 0.22, gap);
  const double face = ramp(m.joint < 0 ? -gap : gap * 0.5, gap + round, c.border);
  const double body = ramp(gap * 0.5, gap + 0.004, c.border);
  // Faces of rock and clods have no joints, only shade between them.
  const double cover = m.joint < 0 ? 0.8 + 0.2 * face : body;
  t.color = mix(rgb(m.between) * (0.85 + 0.3 * fine), color, cover);
  // Stones tilt and stand unlike.
  const double tilt = (c.id - 0.5) * c.dx + (c.second - 0.5) * c.dy;
  const double rise = m.joint < 0 ? 0.3 : 1, slant = m.joint < 0 ? 0.6 : 0.25;
  t.height = rise * m.relief * face * (0.75 + 0.5 * (c.second - 0.5)) + slant * tilt * body +
             m.grainHeight * (0.7 * grain + 0.3 * fine);
  t.roughness = m.roughness + 0.08 * (1 - body) + 0.1 * (grain - 0.5);
  return t;
}

// Two families of waves that lean against each other: a ridge is where either stands, so ridges
// part and meet in long diamonds. `joint` is the share of the furrows.
SurfaceTexel drawFurrows(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double bend = 0.5 * m.wander / m.columns;
  const double x = u + bend * (clouds(u, v, m.columns, m.rows * 3, 3, seed) - 0.5) * 2;
  const double slow = 1.2 * m.wander * (clouds(u, v, 3, 4, 2, seed + 1) - 0.5);
  const auto wave = [&](double lean, double shift) {
    return sinDeg(360 * (m.columns * x + lean * v + lean * slow + shift));
  };
  const double high = std::max(wave(m.rows, 0), wave(-m.rows, 0.37));
  const double fine = clouds(u, v, 9 * m.columns, 24, 4, seed + 2);
  const double cracks = clouds(u, v, 2 * m.columns, 30, 3, seed + 3);
  // Ridges break across here and there.
  const double body =
      ramp(-1 + m.joint, 1 - m.joint, high + 1.2 * (fine - 0.5) - 1.6 * ramp(0.56, 0.68, cracks));
  SurfaceTexel t;
  const Vec3 ridge = mix(rgb(m.color), rgb(m.second), m.variety * clouds(u, v, 5, 3, 3, seed + 4));
  t.color = mix(rgb(m.between), ridge * (1 + m.grain * (fine - 0.5)), body);
  t.height = m.relief * body + m.grainHeight * fine;
  t.roughness = m.roughness;
  return t;
}

// The bark below, patches of the second colour on it, and over both the oldest flakes. Rims follow
// clouds at a height, so they are ragged and nowhere straight.
SurfaceTexel drawFlakes(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double young = clouds(u, v, m.columns, m.rows, 5, seed);
  const double old = clouds(u, v, m.columns + 2, m.rows + 1, 5, seed + 11);
  const double fine = clouds(u, v, 70, 50, 4, seed + 23);
  const double patch = ramp(0.49, 0.515, young), flake = ramp(0.545, 0.57, old);
  SurfaceTexel t;
  const Vec3 tone = mix(rgb(m.color), rgb(m.second), m.variety * patch);
  t.color = mix(tone, rgb(m.between), m.variety * flake) * (1 + m.grain * (fine - 0.5));
  // A flake is thickest at its rim, where it comes off.
  t.height = m.relief * (patch * (1.6 - young) + flake * (1.6 - old)) + m.grainHeight * fine;
  t.roughness = m.roughness;
  return t;
}

SurfaceTexel drawGrain(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double fine = clouds(u, v, m.columns / 2, m.rows / 2, 2, seed);
  const double middle = clouds(u, v, 24, 24, 3, seed + 3);
  const double large = clouds(u, v, 3, 3, 4, seed + 6);
  SurfaceTexel t;
  const double stain = ramp(0.38, 0.68, large);
  Vec3 c = mix(rgb(m.color), rgb(m.second), m.variety * stain);
  c = c * (1 + m.grain * (0.5 * (fine - 0.5) + 0.25 * (middle - 0.5)));
  t.height = m.grainHeight * fine + m.relief * 0.4 * middle;
  t.roughness = m.roughness + 0.15 * (stain - 0.5) * m.variety + 0.1 * (fine - 0.5);
  if (m.extra == SurfaceExtra::Chips) {
    const Cell chip = cellAt(u, v, {m.columns / 2, m.rows / 2, m.width, m.height, 0.9, seed + 12});
    c = mix(c, rgb(chip.id > 0.6 ? m.second : m.between), 0.45 * chip.second);
    t.height += m.grainHeight * (1 - ramp(0, 0.006, chip.point)) * chip.id;
  }
  if (m.extra == SurfaceExtra::Ripples) {
    // They run along u and fork here and there.
    const double bend = 1.6 * (clouds(u, v, 5, 3, 3, seed + 15) - 0.5);
    const double wave = sinDeg(360 * (m.height / m.joint * v + bend * 2));
    t.height += m.relief * 0.5 * wave;
    c = c * (1 + 0.05 * wave);
  }
  if (m.bond == Bond::Random && m.joint > 0) {
    const double open = crack(m, u, v, 4, m.joint);
    c = mix(c, rgb(m.between), 0.8 * open);
    t.height -= m.relief * open;
    if (m.height < 4) {
      // Rain runs down from above.
      const double runs = ramp(0.55, 0.75, clouds(u, v, 60, 3, 3, seed + 18));
      c = mix(c, rgb(m.between), 0.22 * runs);
    }
  }
  if (m.metallic > 0) {
    // Rust: scales over a darker ground.
    const double scale = ramp(0.42, 0.6, clouds(u, v, 14, 14, 5, seed + 21));
    c = mix(c, rgb(m.between), 0.55 * scale);
    t.height += m.relief * (1 - scale);
    t.metallic = m.metallic * scale;
  }
  t.color = c;
  return t;
}

SurfaceTexel drawWater(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const Point p = bent(u, v, 4, 0.12, seed + 3);
  const double waves = clouds(p.u, p.v, m.columns, m.rows + 5, 3, seed);
  const double small = clouds(p.u, p.v, 40, 52, 2, seed + 9);
  SurfaceTexel t;
  t.color = mix(rgb(m.second), rgb(m.color), waves);
  t.height = m.relief * waves + m.grainHeight * small;
  t.roughness = m.roughness;
  return t;
}

SurfaceTexel drawWeave(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double x = u * m.columns, y = v * m.rows;
  const double across = 2 * fraction(x) - 1, along = 2 * fraction(y) - 1;
  const bool over = (floorOf(x) + floorOf(y)) % 2 == 0;
  // The thread on top is round across and bends down at its ends.
  const double a = over ? across : along, b = over ? along : across;
  const double thread = (1 - a * a) * (1 - 0.5 * b * b);
  const double slub = over ? noise(u, v, m.columns, 6, seed) : noise(u, v, 6, m.rows, seed + 1);
  SurfaceTexel t;
  t.color = mix(rgb(m.between), mix(rgb(m.color), rgb(m.second), m.variety * slub),
                0.35 + 0.65 * ramp(0, 0.8, thread));
  t.height = m.relief * thread;
  t.roughness = m.roughness;
  return t;
}

SurfaceTexel drawPanes(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double wave = clouds(u, v, 4, 4, 2, seed);
  SurfaceTexel t;
  t.color = mix(rgb(m.color), rgb(m.second), m.variety * 0.4 * wave);
  t.height = m.grainHeight * wave;
  t.roughness = m.roughness;
  if (m.joint == 0) return t;
  const double module = m.width / m.columns, storey = m.height / m.rows;
  const double x = fraction(u * m.columns) * module, y = fraction(v * m.rows) * storey;
  const auto column = static_cast<uint64_t>(floorOf(u * m.columns));
  const auto row = static_cast<uint64_t>(floorOf(v * m.rows));
  // A spandrel of 1.1 m below each row of panes; some have blinds.
  constexpr double kSpandrel = 1.1;
  const bool spandrel = y < kSpandrel;
  const double id = chance(column, row, seed + 4), blind = chance(column, row, seed + 5);
  if (spandrel) {
    t.color = rgb(m.second) * 0.8;
    t.roughness = 0.25;
  } else {
    t.color = t.color * (0.85 + 0.25 * id);
    const double down = blind > 0.75 ? 1.0 : blind > 0.5 ? 0.5 : 0;
    if (storey - y < down * (storey - kSpandrel)) t.color = mix(t.color, rgb(0xd8d2c4), 0.4);
  }
  const double half = m.joint / 2;
  const double side = std::min(x, module - x);
  const double level = std::min({y, storey - y, std::fabs(y - kSpandrel)});
  const double bar =
      std::max(1 - ramp(half * 0.9, half * 1.1, side), 1 - ramp(half * 0.6, half * 0.8, level));
  t.color = mix(t.color, rgb(m.between), bar);
  t.height = m.relief * bar + (1 - bar) * (t.height + 0.0006 * (id - 0.5) * (x - module / 2));
  t.roughness += bar * (0.35 - t.roughness);
  return t;
}

}  // namespace gable::surface
