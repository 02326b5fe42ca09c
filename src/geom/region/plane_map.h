// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// PlaneMap: the faces between edges that meet in their ends only, as snap rounding makes them.
// Every edge has two half-edges: 2 e runs from its lower to its higher point, 2 e + 1 back. A
// half-edge has the face on its left.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/cell_grid.h"

namespace gable {

class PlaneMap {
 public:
  struct Edge {
    /// Points; low < high.
    uint32_t low = 0, high = 0;
  };
  /// The points are sorted. Both outlive the map. O(n log n), mostly.
  PlaneMap(std::span<const GridPoint> points, std::span<const Edge> edges);

  uint32_t halfEdgeCount() const { return static_cast<uint32_t>(2 * edges_.size()); }
  uint32_t from(uint32_t h) const { return h % 2 == 0 ? edges_[h / 2].low : edges_[h / 2].high; }
  uint32_t to(uint32_t h) const { return from(h ^ 1); }
  /// The next half-edge to the right around the point where h begins.
  uint32_t clockwise(uint32_t h) const {
    const uint32_t first = starts_[from(h)];
    const uint32_t at = places_[h];
    return around_[at == first ? starts_[from(h) + 1] - 1 : at - 1];
  }
  /// The half-edge that follows h along the face on its left.
  uint32_t next(uint32_t h) const { return clockwise(h ^ 1); }

  /// Face 0 is what lies outside of all edges.
  uint32_t faceCount() const { return faceCount_; }
  uint32_t left(uint32_t h) const { return faces_[h]; }

 private:
  void sortAround();
  void traceFaces();
  uint32_t halfEdgeBelow(uint32_t point, const CellGrid& grid, const CellLists& lists) const;

  std::span<const GridPoint> points_;
  std::span<const Edge> edges_;
  // Half-edges by the point where they begin, counter-clockwise; where each one stands there.
  std::vector<uint32_t> starts_, around_, places_;
  std::vector<uint32_t> faces_;
  uint32_t faceCount_ = 1;
};

}  // namespace gable
