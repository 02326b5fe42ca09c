// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rays cast from centres to a region's boundary: paths along them, regions between them. Plan
// coordinates, metres.
//
// Promises:
//   1. The pieces make up the region.
//   2. Paths between centres and to targets do not cross; what is not visible within the region
//   gets
//      no path.
//   3. Every edge has its origin.
// O(targets * n), and the booleans.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/grid_partition.h"
#include "geom/region/piece.h"

namespace gable {

struct RayTarget {
  enum class Kind : uint8_t { Point, Direction } kind = Kind::Point;
  /// A place of the plane, or a direction; need not be a unit vector.
  Vec2 value;
};

/// How several centres are joined: not at all, in a round, by the shortest tree, two and two, each
/// with the one across (these may cross), or by the tree and a share of the shortest links besides.
enum class CentreLinks : uint8_t { None, Loop, Tree, Pairs, Opposite, Thin };

struct RayOptions {
  double pathWidth = 0;
  /// Around each centre; its reach may be 0.
  PlanFigure centre;
  /// A target that something hides: no ray, or a ray that ends at what hides it.
  bool stopHidden = false;
  CentreLinks links = CentreLinks::Tree;
  double thin = 0;
};

struct RayResult {
  /// Regions, paths, centres.
  std::vector<RegionPiece> pieces;
  /// Rays that were cast.
  uint32_t rays = 0, links = 0;
  /// A centre outside was moved to the middle.
  bool moved = false;
};

/// Targets go to the nearest centre that sees them. With fewer than two rays and no links nothing
/// is divided: the region is the only piece.
RayResult castRays(const Polygon& p, std::span<const Vec2> centres,
                   std::span<const RayTarget> targets, const RayOptions& options);

}  // namespace gable
