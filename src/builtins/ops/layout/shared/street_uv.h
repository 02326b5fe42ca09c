// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Texture coordinates of streets, as CityEngine gives them to its street shapes: u runs along the
// street, v across it from the right kerb to the left one.
#pragma once

#include <vector>

#include "geom/curve/curve.h"
#include "geom/region/region.h"

namespace gable {

/// The sets 0, 1, ... of a corner.
using StreetUvs = std::vector<Vec2>;

/// By corner of the outer ring, then of the holes, three sets. Set 0 has 0 to 1 along the roadway
/// and 0 to 1 across it; set 1 has metres from its beginning and from its right kerb; set 2 has
/// metres from its end and from its right kerb. O(corners * points of the line).
std::vector<StreetUvs> roadwayUvs(const Polygon& roadway, const Line& centre, double width);

/// Where several streets meet there is no such direction: set 0 alone, 0 to 1 over the box of the
/// polygon, for rings as above. O(corners).
std::vector<StreetUvs> junctionUvs(const Polygon& junction);

}  // namespace gable
