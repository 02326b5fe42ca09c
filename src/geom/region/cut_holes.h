// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Regions without holes, for whatever cannot take them: a region with holes is cut through each of
// them. Plan coordinates, metres.
//
// Promises: the pieces make up the region and none has a hole; cut edges say so. O(h * n log n) for
// h holes.
#pragma once

#include <vector>

#include "geom/region/piece.h"

namespace gable {

/// Each cut runs through the middle of a hole and the middle of the outline's longest side.
std::vector<RegionPiece> withoutHoles(const Polygon& p);

}  // namespace gable
