// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a map knows of its buildings, and a guess of what it does not: the storeys of those around,
// of the same kind if there are some. A guess depends on the map alone, so it is the same each
// time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/importers/map_features.h"

namespace gable {

struct BuildingFacts {
  /// From the middle of its box.
  Vec2 place;
  double area = 0;
  /// Storeys as the map has them, or from its height; 0 where it has neither. A part that has
  /// neither has those of its building.
  double levels = 0;
  /// Storeys by the neighbours; 0 where none is near.
  double guessedLevels = 0;
  /// Parts of a building cover most of it, and stand for it.
  bool hasParts = false;
  /// Of a part: the building that it is of, or none.
  static constexpr uint32_t kNone = 0xffffffff;
  uint32_t owner = kNone;
  /// The value of `landuse` of the smallest area around it; the features own it.
  std::string_view landUse;
  /// From 0 to 1, the same for all that stand wall to wall; below 0: it stands alone.
  double rowChance = -1;
  /// The value of `roof:shape` that most of those have; empty where none has one.
  std::string_view rowRoof;
};

/// By feature; those of what is no building say nothing. O(n log n), mostly.
std::vector<BuildingFacts> buildingFactsOf(const std::vector<MapFeature>& features);

/// The buildings that a place within `area` lacks: those the middle of whose box is not in it, and
/// their parts. So of two places beside each other just one has a building at their border.
std::vector<bool> buildingsBeyond(const std::vector<MapFeature>& features,
                                  const std::vector<BuildingFacts>& facts, const Box2& area);

bool isBuilding(const MapFeature& f);
bool isBuildingPart(const MapFeature& f);

}  // namespace gable
