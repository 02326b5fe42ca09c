// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Walls and paving. A course is a row of units; the bond says how long they are and how far a
// course is shifted. A unit's face is a rectangle with worn corners in a bed of joints.

#include <array>
#include <span>

#include "io/image/surface_noise.h"

namespace gable::surface {

namespace {

// Where a point lies in its unit, all in metres.
struct Unit {
  double left = 0, right = 0, bottom = 0, top = 0;
  double x = 0, y = 0;
  uint64_t column = 0, row = 0;
};

// The lengths of a bond's units, in shares of what repeats along a course, and the shift of every
// other course.
struct Course {
  std::array<double, 2> lengths{1, 0};
  double shift = 0;
  int repeats = 1;
};

Course courseOf(const LibraryMaterial& m, int row) {
  const bool odd = row % 2 != 0;
  switch (m.bond) {
    case Bond::Stretcher:
    case Bond::Header: return {{1, 0}, odd ? 0.5 : 0.0, m.columns};
    // A header lies over the middle of a stretcher.
    case Bond::Flemish: return {{2.0 / 3, 1.0 / 3}, odd ? 0.5 : 0.0, m.columns};
    // A quarter of a stretcher is half a header.
    case Bond::English: return {{1, 0}, odd ? 0.5 : 0.0, odd ? 2 * m.columns : m.columns};
    case Bond::Stack: return {{1, 0}, 0, m.columns};
    case Bond::Random: break;
  }
  return {{1, 0}, chance(static_cast<uint64_t>(row), 0, seedOf(m)), m.columns};
}

// The joint before unit i, in units along the course.
double startOf(const LibraryMaterial& m, int i, int row, int repeats) {
  if (m.wander == 0) return i;
  const double free =
      chance(static_cast<uint64_t>(wrapped(i, repeats)), static_cast<uint64_t>(row), seedOf(m) + 1);
  return i + m.wander * (free - 0.5);
}

Unit unitAt(const LibraryMaterial& m, double u, double v) {
  const int row = std::min(floorOf(v * m.rows), m.rows - 1);
  const Course c = courseOf(m, row);
  const double metres = m.width / c.repeats;
  const double x = u * c.repeats + c.shift;
  int i = floorOf(x);
  if (x < startOf(m, i, row, c.repeats)) --i;
  if (x >= startOf(m, i + 1, row, c.repeats)) ++i;
  double left = startOf(m, i, row, c.repeats), right = startOf(m, i + 1, row, c.repeats);
  uint64_t column = 2 * static_cast<uint64_t>(wrapped(i, c.repeats));
  if (c.lengths[1] > 0) {
    const double cut = left + c.lengths[0];
    if (x < cut) {
      right = cut;
    } else {
      left = cut;
      ++column;
    }
  }
  const double high = m.height / m.rows;
  return {left * metres, right * metres, row * high, (row + 1) * high,
          x * metres,    v * m.height,   column,     static_cast<uint64_t>(row)};
}

// How far inside a rectangle with round corners a point lies; negative outside.
double inside(const Unit& b, double border, double corner) {
  const double dx = std::min(b.x - b.left, b.right - b.x) - border - corner;
  const double dy = std::min(b.y - b.bottom, b.top - b.y) - border - corner;
  if (dx < 0 && dy < 0) return corner - std::sqrt(dx * dx + dy * dy);
  return corner + std::min(dx, dy);
}

bool isBrick(const LibraryMaterial& m) { return m.height / m.rows < 0.08; }

}  // namespace

SurfaceTexel drawMasonry(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const Unit b = unitAt(m, u, v);
  // Edges are not ruled: they wander by a tenth of the joint.
  const double wander = m.joint * 0.35 * (noise(u, v, 160, 160, seed + 7) - 0.5);
  const double d = inside(b, m.joint / 2, std::min(0.006, m.joint * 0.6)) + wander;
  const double edge = std::max(0.0025, m.relief * 0.6);
  const double face = ramp(-edge * 0.4, edge, d);
  const double grain = clouds(u, v, 90, 90, 3, seed + 8);
  const double large = clouds(u, v, 9, 9, 4, seed + 9);
  const double id = chance(b.column, b.row, seed + 3), second = chance(b.column, b.row, seed + 4);
  SurfaceTexel t;
  Vec3 c = toneOf(m, id) * (1 + 0.12 * m.variety * (second - 0.5));
  c = c * (1 + m.grain * 0.55 * (0.55 * grain + 0.45 * large - 0.5));
  // Some bricks are burnt darker than the rest.
  if (isBrick(m) && second > 0.93) c = c * (1 - 0.35 * m.variety);
  const double bed = clouds(u, v, 140, 140, 2, seed + 10);
  t.color = mix(rgb(m.between) * (0.9 + 0.2 * bed), c, face);
  // Units stand a little unlike.
  const double proud = m.relief * (0.85 + 0.3 * (id - 0.5));
  t.height = face * proud + m.grainHeight * (face * grain + (1 - face) * bed);
  t.roughness = m.roughness + 0.1 * (1 - face) + 0.12 * (grain - 0.5);
  if (m.extra == SurfaceExtra::Ties) {
    const Cell hole = cellAt(u, v, {4, 4, m.width, m.height, 0, seed});
    const double deep = 1 - ramp(0.011, 0.016, hole.point);
    t.height -= 0.012 * deep;
    t.color = t.color * (1 - 0.45 * deep);
  }
  return t;
}

SurfaceTexel drawFrame(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double x = u * m.width, y = v * m.height;
  const double panel = m.width / m.columns, storey = m.height / m.rows;
  const double half = m.joint / 2;
  // Distances to the middle of the next post, rail and brace, along which wood runs.
  const double post = std::fabs(fraction(x / panel + 0.5) - 0.5) * panel;
  const double rail = std::fabs(fraction(y / storey + 0.5) - 0.5) * storey;
  const int column = floorOf(u * m.columns), row = floorOf(v * m.rows);
  double brace = 1;
  if ((column + row) % 2 == 0) {
    // From the foot of a post to the head of the next.
    const double px = fraction(x / panel), py = fraction(y / storey);
    const double along = row % 2 == 0 ? px - py : px + py - 1;
    brace = std::fabs(along) * panel / 1.4142135623730951;
  }
  const bool onRail = rail < half, onPost = post < half && !onRail;
  const double d = std::min({half - std::min(post, rail), 1.0});
  const double db = half * 0.8 - brace;
  const double wood = ramp(-0.002, 0.004, std::max(d, db));
  // Grain along the member.
  const double fibre = onRail   ? clouds(u, v, 5, 150, 3, seed)
                       : onPost ? clouds(u, v, 150, 5, 3, seed + 20)
                                : clouds(u, v, 60, 60, 3, seed + 21);
  const double plaster = clouds(u, v, 160, 160, 3, seed + 22);
  SurfaceTexel t;
  const Vec3 timber = rgb(m.between) * (0.75 + 0.5 * fibre);
  const Vec3 fill = mix(rgb(m.color), rgb(m.second), 0.5 * clouds(u, v, 5, 5, 4, seed + 23)) *
                    (0.97 + 0.06 * plaster);
  // A shadow gap where panels meet the wood.
  const double gap = ramp(0.0, 0.008, std::fabs(std::max(d, db)));
  t.color = mix(fill, timber, wood) * (0.75 + 0.25 * gap);
  t.height = m.relief * wood + (wood > 0.5 ? 0.0015 * fibre : m.grainHeight * plaster);
  t.roughness = m.roughness - 0.1 * wood;
  return t;
}

}  // namespace gable::surface
