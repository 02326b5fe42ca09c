// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Provenance: where a face of a region and its edges come from. The operations on regions write and
// read it; it lies beside the tags of a face or an edge (shape/tags.h) and goes wherever these go.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "geom/region/piece.h"

namespace gable {

/// A strip that an edge took part in: the depth of the region that it came of, and as what.
struct PeelMark {
  uint32_t depth = 0;
  EdgeRole role = EdgeRole::Base;
  bool operator==(const PeelMark&) const = default;
};

struct EdgeProvenance {
  static constexpr uint32_t kNoLogical = 0xffffffff;
  /// The partition that made it; 0 for the outline of the initial region.
  uint32_t level = 0;
  /// The logical edge that it is of.
  uint32_t logical = kNoLogical;
  EdgeRole role = EdgeRole::Kept;
  std::vector<PeelMark> peels;
  bool operator==(const EdgeProvenance&) const = default;
  uint64_t hash() const;
};

/// How a grid of more than two cells is mirrored; see the page of grid.
enum class CellPattern : uint8_t {
  Auto,
  Centre,
  Pair,
  Mirror,
  Extend,
  ExtendL,
  ExtendR,
  Local,
  Radial
};

struct CellMark {
  uint32_t ix = 0, iy = 0, nx = 1, ny = 1;
  double w = 0, h = 0;
  CellPattern pattern = CellPattern::Auto;
  /// Parts of one cell are numbered; of junctions `choice` is the figure, from 1.
  uint32_t part = 0, choice = 0;
  /// Not of a grid: ix counts the cells, and iy how many lie between it and the boundary.
  bool free = false;
  /// The distances from the border are told smaller one first.
  bool symmetric = false;

  bool operator==(const CellMark&) const = default;
  /// How many cells lie between this one and the border.
  uint32_t bx() const { return free ? iy : symmetric ? std::min(byX(), byY()) : byX(); }
  uint32_t by() const { return free ? 0 : symmetric ? std::max(byX(), byY()) : byY(); }

  bool mirroredX() const { return mirrored(ix, nx); }
  bool mirroredY() const { return mirrored(iy, ny); }
  /// Quarter turns to the left of a radial pattern.
  uint32_t turns() const;
  /// The side (0 west, 1 north, 2 east, 3 south) that a side of the first cell is here.
  uint32_t side(uint32_t k) const;
  /// An address with 0 at the border side, as the cell sees it; false when the pattern places
  /// nothing here.
  bool address(double& u, double& v) const;

 private:
  uint32_t byX() const { return std::min(ix, nx - 1 - ix); }
  uint32_t byY() const { return std::min(iy, ny - 1 - iy); }
  bool along(bool y, double& u) const;
  bool mirrored(uint32_t i, uint32_t n) const;
};

struct RegionProvenance {
  /// How many partitions lie behind the region.
  uint32_t depth = 0;
  /// The cell that it is, or was cut from.
  std::optional<CellMark> cell;
  bool operator==(const RegionProvenance&) const = default;
  uint64_t hash() const;
};

}  // namespace gable
