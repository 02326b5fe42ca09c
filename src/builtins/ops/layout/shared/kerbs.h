// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which edges of a roadway are its kerbs.
#pragma once

#include <span>
#include <vector>

#include "builtins/ops/layout/shared/polylines.h"
#include "geom/region/region.h"

namespace gable {

/// By edge of the outer ring, then of the holes: it runs along the nearest of the centre lines and
/// lies about half of the width from it. O(edges * points of the lines).
std::vector<bool> kerbsAlong(const Polygon& roadway, std::span<const Polyline2> centres,
                             double width);

}  // namespace gable
