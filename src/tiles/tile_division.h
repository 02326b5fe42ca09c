// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How a place is divided before anything is derived: the square around the middles of all shapes,
// in quarters until each has few enough. Such a square is a unit: it is made on its own, by
// whatever process, and what comes of it does not depend on the others.
//
// Promises: the same middles in the same order give the same units, in the order of a walk through
// the quarters; every shape is in one unit, and the shapes of a unit are in their order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "math/box.h"

namespace gable {

/// Seen from above: x and z.
struct TileSquare {
  Vec2 low;
  double side = 0;

  Vec2 middle() const { return {low.x + side / 2, low.y + side / 2}; }
  /// 0 to 3.
  size_t quarterOf(Vec2 p) const;
  TileSquare quarter(size_t q) const;
  bool holds(const Box2& box) const;
};

/// Squares are divided so many times at most.
constexpr int kDeepestSquare = 30;
constexpr double kSmallestSquare = 1;

TileSquare squareAround(const Box2& box);

struct TileUnit {
  /// "0" is the whole square, "03" its last quarter, and so on.
  std::string name;
  std::vector<uint32_t> shapes;
};

struct TileDivision {
  TileSquare square;
  std::vector<TileUnit> units;

  /// Of a square by its name.
  TileSquare squareOf(std::string_view name) const;
};

/// The name as a path of folders with few entries: "0123012" is "01230/12".
std::string squarePath(std::string_view name);
/// Whether a path without its ending may be one of those.
bool isSquarePath(std::string_view path);

/// `most`: shapes of a unit; 0: all are one unit.
TileDivision divided(const std::vector<Vec2>& middles, size_t most);

}  // namespace gable
