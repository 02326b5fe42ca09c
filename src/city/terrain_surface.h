// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The ground of a place in space: the triangles of its pieces. Pieces that touch share the heights
// of their common border, or a wall stands between them. Plan coordinates with heights, metres.
//
// Promises: a look finds the triangle that holds a place, the first of several; O(1) about.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "city/grid_point.h"
#include "math/box.h"
#include "math/vec.h"

namespace gable {

class TerrainSurface {
 public:
  static constexpr uint32_t kNothing = 0xffffffff;

  struct Facet {
    std::array<uint32_t, 3> points{};
    /// The piece of the ground that it is of.
    uint32_t piece = 0;
  };
  /// Of a piece: its facets, and how many of their points are its outline's, which come first.
  struct Piece {
    uint32_t firstFacet = 0, facetCount = 0;
    uint32_t firstPoint = 0, pointCount = 0;
    /// All of it has one height.
    bool level = false;
  };

  TerrainSurface(std::vector<Vec3> points, std::vector<Facet> facets, std::vector<Piece> pieces);

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Facet>& facets() const { return facets_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// kNothing outside of the place.
  uint32_t facetAt(Vec2 p) const;
  /// Outside of the place: that of the nearest place of its box.
  double heightAt(Vec2 p) const;
  /// Of the plane of a facet.
  double heightOn(uint32_t facet, Vec2 p) const;
  bool holds(uint32_t facet, Vec2 p) const;

  /// Calls visit(facet) once for each facet whose box meets another.
  template <class Visit>
  void near(const Box2& box, Visit&& visit) const {
    const GridPoint low = gridPoint(box.min), high = gridPoint(box.max);
    const int64_t firstRow = grid_.row(low.y), firstColumn = grid_.column(low.x);
    for (int64_t r = firstRow; r <= grid_.row(high.y); ++r) {
      for (int64_t c = firstColumn; c <= grid_.column(high.x); ++c) {
        const size_t cell = grid_.cell(c, r);
        for (const uint32_t* i = lists_.begin(cell); i != lists_.end(cell); ++i) {
          work();
          const Box2 own = boxOf(*i);
          if (!own.meets(box)) continue;
          // Where the boxes begin to meet, so that no facet comes twice.
          const GridPoint first = gridPoint(own.min);
          if (std::max(firstRow, grid_.row(first.y)) != r ||
              std::max(firstColumn, grid_.column(first.x)) != c) {
            continue;
          }
          visit(*i);
        }
      }
    }
  }

 private:
  Box2 boxOf(uint32_t facet) const;
  // In a crack between facets: of a corner of those around it.
  double nearestHeight(Vec2 p) const;
  Vec2 flat(uint32_t point) const { return {points_[point].x, points_[point].y}; }

  std::vector<Vec3> points_;
  std::vector<Facet> facets_;
  std::vector<Piece> pieces_;
  Box2 area_;
  CellGrid grid_;
  CellLists lists_;
};

}  // namespace gable
