// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bridges of a map: decks above the ground, which stays whole beneath them. A deck is as high as
// its layer asks for, clear of what passes below, and comes down to the ground at its ends, no
// steeper than its kind allows: within the bridge, and along the street that goes on from it, up
// to the next junction. Where that is too short the deck stays lower. Bridges that meet have one
// height there. On terrain all of this counts from the ground at the ends: between them the deck
// falls evenly from one to the other, and is nowhere below the ground. Plan coordinates and
// heights, metres.
//
// Promises: equal input gives equal output. O(n log n).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "city/ground.h"
#include "city/streets.h"
#include "math/box.h"

namespace gable {

/// A point of the plan and its height.
using SpacePoint = Vec3;

struct Bridge {
  uint32_t feature = 0;
  double width = 0, thickness = 0;
  /// Of a street for cars, of a railway, else of a path.
  bool isStreet = false, isRail = false;
  /// Solid down to the ground: what leads up to a bridge.
  bool isRamp = false;
  /// The middle of the deck's upper side.
  std::vector<SpacePoint> line;
};

/// Of the ground at a place; without one it is flat, at 0.
using GroundHeight = std::function<double(Vec2)>;

std::vector<Bridge> bridgesOf(const std::vector<MapFeature>& features, const Streets& streets,
                              const GroundHeight& ground = {});

/// What stands in the area, as faces in space, by the rule that they begin with.
struct BridgeShape {
  /// "BridgeDeck": the upper side; "BridgeParapet": a strip along an edge of it; "BridgeRail": one
  /// along a rail; "BridgeWall": sides of a ramp; "BridgePier": its foot.
  const char* rule = "";
  std::vector<std::vector<SpacePoint>> faces;
  /// Of a pier.
  double height = 0;
};
std::vector<BridgeShape> shapesOf(const Bridge& bridge, const Box2& area,
                                  const std::vector<GroundPiece>& ground, GroundIndex& index,
                                  const GroundHeight& height = {});

}  // namespace gable
