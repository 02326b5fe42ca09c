// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grids: a region divided into rows and columns of cells with straight paths and crossings between.
// Plan coordinates, metres, degrees.
//
// Promises:
//   1. The pieces make up the region: their areas sum up to its area.
//   2. Without paths neighbours share the same points, bit for bit; lines of one family do not meet
//      inside the region.
//   3. Every edge of a piece has its origin; made edges have the side (0 west, 1 north, 2 east,
//      3 south) of the cell that they are.
// Sizes and angles that are ranges are drawn by address from `seed`. O(lines * n log n).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geom/region/autoindex.h"
#include "geom/region/piece.h"

namespace gable {

/// Drawn evenly, or by what `other` says; low and high then tell about it.
struct DrawnRange {
  double low = 0, high = 0;
  std::function<double(uint64_t address)> other = {};
  double drawn(uint64_t address) const;
  double mean() const { return (low + high) / 2; }
};

struct GridSize {
  std::optional<DrawnRange> size;
  DrawnRange angle;
  /// The size is a share of what the others leave.
  bool share = false;
};

/// Sizes are used in turn. Without a count as many cells as the sizes fill; without both, two equal
/// cells.
struct GridDim {
  uint32_t count = 0;
  /// In the place of a count: whole numbers that one is drawn from.
  std::optional<DrawnRange> drawnCount;
  std::vector<GridSize> sizes;
};

/// What becomes of a length that the sizes do not fill: cells are scaled, the margins become path,
/// or the grid is not made.
enum class GridFit : uint8_t { Stretch, Center, Fail };

/// Where the lines are laid: between the corners of the region, in its smallest box, in the box
/// along the axes, in its largest rectangle. Auto takes the first of corners, oriented and inner
/// that suits.
enum class GridTemplate : uint8_t { Auto, Corners, Oriented, Axes, Inner };

enum class PlanShape : uint8_t { None, Rhombus, Circle, Square, Rect, Polygon };

/// A shape around a place: of a rhombus `a` is half the diagonals, of circles and polygons the
/// radius, of squares the side, of rectangles width and height.
struct PlanFigure {
  PlanShape shape = PlanShape::None;
  double a = 0, b = 0;
  uint32_t segments = 24;
  /// From the middle to the farthest point.
  double reach() const;
};

/// Counter-clockwise; x is the figure's first axis.
Ring ringOf(const PlanFigure& figure, Vec2 middle, Vec2 x = {1, 0});

/// What stands at a crossing: a figure, or the plain crossing, and the number that its piece gets.
struct JunctionPick {
  PlanFigure figure;
  uint32_t choice = 0;
};

struct GridOptions {
  GridDim x, y;
  /// Of paths; never more than a quarter of the shorter extent.
  double pathWidth = 0;
  GridFit fit = GridFit::Stretch;
  GridTemplate base = GridTemplate::Auto;
  /// In the place of plain crossings; may be empty. Columns and rows count the crossings, from 0.
  std::function<JunctionPick(uint32_t ix, uint32_t iy, uint32_t nx, uint32_t ny, uint64_t address)>
      junctionAt;
  uint64_t seed = 0;
  /// Beneath these a piece goes to a neighbour; the area counts at most as two hundredths of the
  /// mean cell.
  double sliver = 0.02, minArea = 0.25;
  /// The area holds however small the cells are.
  bool minAreaHolds = false;
};

enum class GridProblem : uint8_t { None, NoArea, TooManyCells, DoesNotFit, NotFinite };

struct GridResult {
  GridProblem problem = GridProblem::None;
  /// Cells row by row, then paths, then junctions, then remainders.
  std::vector<RegionPiece> pieces;
  uint32_t nx = 0, ny = 0;
  /// The junctions were made smaller to keep clear of each other.
  bool junctionClamped = false;
  Quad base{};
};

constexpr uint32_t kMostCells = 100000;

GridResult gridPartition(const Polygon& p, const GridOptions& options);

}  // namespace gable
