// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What lies over what is below: courses of slates, shingles and tiles, boards, sheets with seams.

#include "io/image/surface_noise.h"
#include "math/trig.h"

namespace gable::surface {

namespace {

// Wood along the second coordinate: rings drawn out to lines, fibres.
struct Wood {
  double line = 0, fibre = 0;
};
Wood woodAt(double across, double along, double metresAcross, uint64_t seed) {
  const int cells = std::max(1, static_cast<int>(metresAcross * 30));
  const double bend = clouds(across, along, cells, 2, 3, seed);
  const double rings = fraction(6 * bend + across * metresAcross * 22);
  return {smooth(std::fabs(2 * rings - 1)), noise(across, along, cells * 14, 6, seed + 5)};
}

}  // namespace

SurfaceTexel drawBoards(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double x = u * m.columns;
  const auto board = static_cast<uint64_t>(floorOf(x));
  const double wide = m.width / m.columns;
  const double edge = std::min(fraction(x), 1 - fraction(x)) * wide - m.joint / 2;
  const double id = chance(board, 0, seed), second = chance(board, 1, seed);
  const Wood w = woodAt(u, fraction(v + second), m.width, seed + board);
  const double face = ramp(-0.001, 0.003, edge);
  SurfaceTexel t;
  Vec3 c = toneOf(m, id) * (1 - m.grain * (0.22 * w.line + 0.25 * (w.fibre - 0.5)));
  // Knots.
  const Cell knot = cellAt(u, fraction(v + second), {m.columns, 3, m.width, m.height, 0.6, seed});
  const double dark = knot.id > 0.6 ? 1 - ramp(0.006, 0.016, knot.point) : 0;
  c = c * (1 - 0.45 * dark);
  t.color = mix(rgb(m.between), c, face);
  t.height = m.relief * face + m.grainHeight * (w.line + w.fibre) + 0.002 * face * (id - 0.5);
  t.roughness = m.roughness + 0.1 * w.fibre;
  return t;
}

SurfaceTexel drawLappedBoards(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double y = v * m.rows;
  const auto row = static_cast<uint64_t>(floorOf(y));
  const double up = fraction(y), high = m.height / m.rows;
  const double id = chance(0, row, seed), shift = chance(1, row, seed);
  // Boards meet end to end once a tile.
  const double joint = std::fabs(fraction(u + shift + 0.5) - 0.5) * m.width;
  const double butt = ramp(m.joint * 0.4, m.joint, joint);
  const Wood w = woodAt(v, fraction(u + shift), m.height, seed + row);
  SurfaceTexel t;
  const Vec3 c = toneOf(m, id) * (1 - m.grain * (0.18 * w.line + 0.2 * (w.fibre - 0.5)));
  // The lower edge shades the top of the board below.
  const double shade = ramp(0, 0.008 / high, 1 - up);
  t.color = mix(rgb(m.between), c, butt * (0.45 + 0.55 * shade));
  t.height =
      m.relief * (1 - up) * ramp(0, 0.003 / high, up) - 0.003 * (1 - butt) + m.grainHeight * w.line;
  t.roughness = m.roughness + 0.06 * w.fibre;
  return t;
}

SurfaceTexel drawCourses(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double exposure = m.height / m.rows, wide = m.width / m.columns;
  // Round tails: a point above the tail's edge is of this course, below it of the one before.
  const bool tails = m.bond == Bond::Header;
  const auto startOf = [&](int i, int row) {
    if (m.wander == 0) return static_cast<double>(i);
    return i + m.wander * (chance(static_cast<uint64_t>(wrapped(i, m.columns)),
                                  static_cast<uint64_t>(wrapped(row, m.rows)), seed + 1) -
                           0.5);
  };
  int row = floorOf(v * m.rows);
  for (int pass = 0;; ++pass) {
    const double x = u * m.columns + (wrapped(row, m.rows) % 2 != 0 ? 0.5 : 0);
    int i = floorOf(x);
    if (x < startOf(i, row)) --i;
    if (x >= startOf(i + 1, row)) ++i;
    const double left = startOf(i, row), right = startOf(i + 1, row);
    const double middle = 2 * (x - left) / (right - left) - 1;
    const auto column = static_cast<uint64_t>(wrapped(i, m.columns));
    const auto r = static_cast<uint64_t>(wrapped(row, m.rows));
    const double id = chance(column, r, seed + 2), second = chance(column, r, seed + 3);
    // Where the unit's lower edge lies, in exposures above the course's line.
    double lower = m.wander > 0 ? 0.12 * (second - 0.5) * m.wander : 0;
    if (tails) lower = 0.55 * (1 - std::sqrt(std::max(0.0, 1 - middle * middle)));
    const double up = v * m.rows - row - lower;
    if (up < 0 && pass == 0) {
      --row;
      continue;
    }
    const double side = std::min(x - left, right - x) * wide - m.joint / 2;
    const double face = ramp(-0.001, 0.002, side);
    const double grain =
        m.roughness > 0.9 ? clouds(u, v, 190, 190, 2, seed + 5) : clouds(u, v, 90, 24, 3, seed + 5);
    SurfaceTexel t;
    Vec3 c = toneOf(m, id) * (1 + 0.2 * m.variety * (second - 0.5));
    c = c * (1 + m.grain * 0.6 * (grain - 0.5));
    // Dust below the edge of the course above.
    const double shade = ramp(0.0, 0.012 / exposure, 1 + 0.5 * lower - up * 0.999);
    t.color = mix(rgb(m.between), c, face * (0.6 + 0.4 * shade));
    const double rim = ramp(0, 0.003 / exposure, up);
    t.height = m.relief * (0.25 + 0.75 * (1 - 0.75 * up)) * rim * (0.3 + 0.7 * face) +
               0.002 * (id - 0.5) + m.grainHeight * grain;
    t.roughness = m.roughness + 0.12 * (grain - 0.5) + 0.06 * (id - 0.5);
    return t;
  }
}

SurfaceTexel drawRolls(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double wide = m.width / m.columns, exposure = m.height / m.rows;
  const double x = u * m.columns;
  const double along = fraction(x) * wide;
  const bool onCover = along < m.joint;
  const auto column = static_cast<uint64_t>(2 * floorOf(x) + (onCover ? 0 : 1));
  // Covers lie half a course away from pans, if they are tiles of their own.
  const double y = v * m.rows + (m.wander >= 0.5 && onCover ? 0.5 : 0);
  const auto row = static_cast<uint64_t>(wrapped(floorOf(y), m.rows));
  const double up = fraction(y);
  const double id = chance(column, row, seed), second = chance(column, row, seed + 1);
  // Half an ellipse up over the cover; down between, or flat.
  const double a = 2 * along / m.joint - 1;
  const double b = 2 * (along - m.joint) / (wide - m.joint) - 1;
  const bool barrel = m.wander >= 0.5;
  const double across = onCover  ? m.relief * std::sqrt(std::max(0.0, 1 - a * a))
                        : barrel ? -0.35 * m.relief * (1 - b * b)
                                 : 0;
  const double grain = clouds(u, v, 90, 90, 3, seed + 5);
  SurfaceTexel t;
  Vec3 c = toneOf(m, id) * (1 + 0.25 * m.variety * (second - 0.5));
  c = c * (1 + m.grain * 0.6 * (grain - 0.5));
  const double lip = ramp(0, 0.006 / exposure, up);
  const double shade = ramp(0, 0.02 / exposure, 1 - up);
  // Dark where the pan goes under the cover.
  const double under = onCover ? 1 : ramp(0, 0.012, std::min(along - m.joint, wide - along));
  t.color = mix(rgb(m.between), c, (0.55 + 0.45 * shade) * (0.5 + 0.5 * under));
  t.height = across + 0.014 * lip * (1 - up) + 0.003 * (id - 0.5) + m.grainHeight * grain;
  t.roughness = m.roughness + 0.1 * (grain - 0.5);
  return t;
}

SurfaceTexel drawSeams(const LibraryMaterial& m, double u, double v) {
  const uint64_t seed = seedOf(m);
  const double sheet = m.width / m.columns;
  const double off = std::fabs(fraction(u * m.columns + 0.5) - 0.5) * sheet;
  const auto column = static_cast<uint64_t>(floorOf(u * m.columns));
  const double seam = 1 - ramp(m.joint * 0.5, m.joint * 0.5 + 0.006, off);
  // A flat cross seam a sheet, not beside its neighbour's.
  const double place = column % 2 == 0 ? 0.3 : 0.8;
  const double cross = std::fabs(fraction(v - place + 0.5) - 0.5) * m.height;
  const double fold = 1 - ramp(0.004, 0.01, cross);
  const double id = chance(column, v < place ? 0 : 1, seed);
  const double patina = clouds(u, v, 6, 9, 5, seed + 2);
  const double runs = clouds(u, v, 60, 4, 3, seed + 8);
  SurfaceTexel t;
  const double age = ramp(0.3, 0.7, 0.6 * patina + 0.4 * runs);
  Vec3 c = mix(rgb(m.color), rgb(m.second), m.variety * age) * (0.97 + 0.06 * id);
  c = c * (1 + 0.3 * m.grain * (runs - 0.5));
  t.color = mix(c, rgb(m.between), 0.45 * std::max(seam, 0.8 * fold));
  // Sheets are never quite flat.
  t.height = m.relief * seam + 0.003 * fold + 0.004 * clouds(u, v, 3, 4, 2, seed + 11) +
             m.grainHeight * runs;
  t.roughness = m.roughness + 0.2 * (age - 0.5) + 0.08 * (runs - 0.5);
  t.metallic = m.metallic * (1 - 0.35 * age * m.grain);
  return t;
}

}  // namespace gable::surface
