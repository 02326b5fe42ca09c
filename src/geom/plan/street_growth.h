// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Streets where there are none: centre lines grown over an area, as a grid, as rings and spokes, or
// along a field of directions. Plan coordinates, metres.
//
// Promises
//  1. Lines lie within the area, up to a step beyond its border.
//  2. Streets of one direction keep apart: half of their spacing at the least in a field.
//  3. Draws are addressed; equal input gives equal output.
//  4. Work is bounded: at most kMostGrown streets.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/plan/street_graph.h"
#include "geom/region/region.h"

namespace gable {

constexpr size_t kMostGrown = 20000;

/// The parts of streets that lie within an area. O(points * edges of the area).
std::vector<Street> streetsWithin(const Region& area, const std::vector<Street>& streets);

struct GridStreets {
  /// Of the streets along the grid's x axis and those across.
  double spacing = 80, crossSpacing = 120;
  /// Of the grid's x axis, degrees counter-clockwise.
  double angle = 0;
  /// How far each street may be moved, as a share of its spacing: 0 to 0.4.
  double irregularity = 0;
  double width = 12;
  uint64_t address = 0;
};
std::vector<Street> gridStreets(const Region& area, const GridStreets& options);

struct RadialStreets {
  Vec2 center;
  /// Between rings, and between spokes at most: outer rings get more of them.
  double spacing = 80;
  /// From the first ring outwards.
  uint32_t spokes = 6;
  double irregularity = 0;
  double width = 12;
  uint64_t address = 0;
};
std::vector<Street> radialStreets(const Region& area, const RadialStreets& options);

/// Two crossing directions at every place, the sum of what is put in.
class DirectionField {
 public:
  /// Streets along an angle (degrees) and square to it. With a `reach` the influence fades with the
  /// distance from the centre; 0: everywhere the same.
  void addGrid(Vec2 center, double angle, double reach);
  /// Rings around a centre, and spokes.
  void addRadial(Vec2 center, double reach);
  /// Turns all directions by up to so many degrees, changing over `scale` metres.
  void setNoise(double degrees, double scale, uint64_t address);

  /// A unit vector along the first direction, of either sign; zero where there is none.
  Vec2 direction(Vec2 p) const;

 private:
  struct Source {
    Vec2 center;
    double angle, reach;
    bool radial;
  };
  std::vector<Source> sources_;
  double noise_ = 0, scale_ = 1;
  uint64_t address_ = 0;
};

struct FieldStreets {
  /// Between main streets, and between those that divide what they leave; 0: none of them.
  double mainSpacing = 300, spacing = 80;
  double mainWidth = 20, width = 12;
  /// Streets shorter than this are not begun.
  double shortest = 40;
  uint64_t address = 0;
};
std::vector<Street> fieldStreets(const Region& area, const DirectionField& field,
                                 const FieldStreets& options);

}  // namespace gable
