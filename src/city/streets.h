// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The streets of a map: stretches between the places where they meet, what each covers of the
// ground, and the junctions. Streets meet where they share a position; bridges and tunnels are left
// out. Plan coordinates, metres.
//
// Promises:
//   1. Where three stretches or more meet there is a junction, whose outline covers what its
//      stretches leave free of each other, with rounded kerbs; where two of different width meet
//      there is no gap.
//   2. A stretch that several ways describe is one, that of the more important way.
//   3. Equal input gives equal output. O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "city/surface.h"
#include "geom/region/region.h"

namespace gable {

/// From the tags of a way, and what is usual where they say nothing.
struct StreetProfile {
  /// 0 for the least important.
  int rank = 0;
  /// From kerb to kerb.
  double width = 0;
  double leftWalk = 0, rightWalk = 0;
  int lanes = 1;
  bool oneway = false;
  bool operator==(const StreetProfile&) const = default;
};

/// Nothing where a feature is no street for cars, or does not lie on the ground and is not asked
/// for `anywhere`.
std::optional<StreetProfile> streetProfileOf(const MapFeature& f, bool anywhere = false);

struct Stretch {
  /// Index among the features.
  uint32_t feature = 0;
  StreetProfile profile;
  /// From node to node.
  std::vector<Vec2> line;
  /// What junctions take of it, in metres from its beginning and from its end.
  double cutBegin = 0, cutEnd = 0;
  /// To be filled where they go round positively.
  std::vector<Ring> carriageway, sidewalk;
};

struct StreetJunction {
  Vec2 point;
  /// Stretches that begin or end here; one that does both is there twice.
  std::vector<uint32_t> stretches;
  std::vector<Ring> outline;
};

struct Streets {
  std::vector<Stretch> stretches;
  std::vector<StreetJunction> junctions;
};

Streets streetsOf(const std::vector<MapFeature>& features);

}  // namespace gable
