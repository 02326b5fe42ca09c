// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The first half of an offset: outlines whose edges are moved and whose corners are joined. They
// cross themselves and each other; what they go round counter-clockwise more often than clockwise
// is the offset region.
#pragma once

#include "geom/region/boolean.h"

namespace gable {

/// Moves every edge to its right by `distance` (outward where rings lie around a region as they
/// should; to its left where negative). Corners that open are joined as the options say; at corners
/// that close, the outline goes back to the corner itself. Duplicates of points must be gone. O(n).
Ring movedOutline(const Ring& r, double distance, const OffsetOptions& options);

}  // namespace gable
