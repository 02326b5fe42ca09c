// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The graded ground: the natural one, cut and filled so that streets, railways and paths have
// bounded slopes and lie level across their width. Beside them a bank leads back to the natural
// ground. Plan coordinates and heights, metres.
//
// Promises:
//   1. Along the lines heights differ by no more than the slope of their kind allows; lines that
//      share a position share its height.
//   2. Heights are finite, and depend on nothing but the input. O(n log n) for n metres of lines,
//      and about constant time a look.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "city/streets.h"
#include "io/geo/height_field.h"
#include "math/box.h"

namespace gable {

/// The greatest slopes, as a rise per metre.
constexpr double kStreetSlope = 0.12, kJunctionSlope = 0.06, kRailSlope = 0.04, kPathSlope = 0.25,
                 kStepsSlope = 0.6;

class StreetGrade {
 public:
  StreetGrade(const HeightField& field, const std::vector<MapFeature>& features,
              const Streets& streets, const Box2& area);
  ~StreetGrade();
  double heightAt(Vec2 p) const;

  /// A piece of a line, a few metres long.
  struct Piece {
    Vec2 a, b;
    double from = 0, to = 0, slope = 0;
  };
  std::vector<Piece> pieces() const;

 private:
  struct Lines;
  const HeightField& field_;
  std::unique_ptr<Lines> lines_;
};

}  // namespace gable
