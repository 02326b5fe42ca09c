// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The largest rectangle inside a polygon with holes. Plan coordinates, metres.
//
// Promises: the rectangle lies in the polygon up to rounding (1e-9 of its size); its area is within
// 1e-6 of the largest of its orientation. Equal input gives equal output. The polygon must be valid
// (region/clean.h); of others some rectangle of their even-odd area is given. A polygon without
// area gives a rectangle without area. Cost grows with the square of the number of vertices; mostly
// less, since what cannot win is cut off.
#pragma once

#include "geom/region/hull.h"
#include "geom/region/region.h"

namespace gable {

/// Sides along a direction and across it.
OrientedRect largestInnerRect(const Polygon& p, Vec2 direction = {1, 0});

/// One side parallel to an edge: for each ring only edges longer than a quarter of its longest, and
/// of more than 64 directions those of the longest edges.
OrientedRect largestInnerRectByEdge(const Polygon& p);

}  // namespace gable
