// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Overlay: the plane divided among layers that lie on each other. Each place belongs to the last
// layer that covers it; the first layer is the area that is divided. Plan coordinates, metres.
//
//   std::vector<OverlayLayer> layers;                 // ground, lawn, street, building
//   for (const OverlayPiece& p : overlay(layers)) ... // what is left to be seen of each
//
// Promises:
//   1. Pieces make up the first layer: areas add up to it, none overlap, no place is left out.
//   2. What two pieces share they share to the bit: each edge of a piece is an edge of its
//      neighbour the other way round, and `beyond` says whose.
//   3. Every piece is one polygon, outer ring counter-clockwise, holes clockwise, whose insides are
//      connected; rings may touch in points. Corners lie on a grid, so areas add up exactly.
//   4. Equal input gives equal output. Layers may be any finite rings: they may cross themselves,
//      and repeat points. What is not finite or too far away is left out.
// O((n + k) log n) for n corners and k crossings, where outlines do not crowd in one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/boolean.h"
#include "geom/region/region.h"

namespace gable {

struct OverlayLayer {
  std::vector<Ring> rings;
  FillRule fill = FillRule::EvenOdd;
};

struct OverlayPiece {
  static constexpr uint32_t kNothing = 0xffffffff;
  /// The layer that it is a part of.
  uint32_t layer = 0;
  Polygon polygon;
  /// By edge, through the outer ring and the holes: the piece on the other side, or kNothing at the
  /// border of the first layer.
  std::vector<uint32_t> beyond;
};

struct OverlayOptions {
  /// Metres between places that are told apart: a power of two. It grows for areas of more than
  /// 200 km.
  double grid = 0x1.0p-8;
  /// Pieces that are thinner than this, in metres, or smaller than its square go to the neighbour
  /// with which they share most.
  double thin = 0.05;
};

std::vector<OverlayPiece> overlay(std::span<const OverlayLayer> layers,
                                  const OverlayOptions& options = {});

}  // namespace gable
