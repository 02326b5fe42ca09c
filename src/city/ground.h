// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The ground of a place: its area, divided so that every place has one surface. What a map draws
// over each other (a lawn, a street along it, a house at its edge) is decided by levels: the land,
// the sea, what areas say of the land, water, piers, paths, tracks, sidewalks, carriageways,
// junctions, buildings. Within a level the smaller one is above the larger.
//
// Promises: those of overlay(). Areas of the pieces add up to the area; pieces do not overlap and
// leave nothing out; what they share they share to the bit.
#pragma once

#include <cstdint>
#include <vector>

#include "city/streets.h"
#include "city/surface.h"

namespace gable {

struct GroundPiece {
  static constexpr uint32_t kNothing = 0xffffffff;
  Surface surface = Surface::Lot;
  /// The feature that it comes from; nothing for what is left between features, for the sea and for
  /// junctions.
  uint32_t feature = kNothing;
  Polygon polygon;
  /// By edge, through the outer ring and the holes: the piece on the other side, or kNothing at the
  /// border of the area.
  std::vector<uint32_t> beyond;
};

/// Without the features that are left out, by their numbers; an empty list leaves out none.
std::vector<GroundPiece> groundOf(const std::vector<MapFeature>& features, const Streets& streets,
                                  const Box2& area, const std::vector<bool>& leftOut = {});

/// How wide a line of the map is on the ground that is no street for cars, and what surface it
/// makes; nothing where it makes none, or does not lie on the ground and is not asked for
/// `anywhere`.
struct LineGround {
  Surface surface = Surface::Path;
  double width = 0;
};
std::optional<LineGround> lineGroundOf(const MapFeature& f, bool anywhere = false);

/// Finds the piece at a place. Piece numbers are those of the ground, which outlives it.
class GroundIndex {
 public:
  explicit GroundIndex(const std::vector<GroundPiece>& ground);
  ~GroundIndex();
  /// kNothing outside of the area. O(edges at its height), mostly.
  uint32_t pieceAt(Vec2 p);

 private:
  struct Cells;
  std::unique_ptr<Cells> cells_;
};

}  // namespace gable
