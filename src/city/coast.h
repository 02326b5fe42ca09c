// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The sea of a map: coastlines have the land on their left and the water on their right. They are
// cut at the border of the area and closed along it; those that end within the area are led to the
// nearest border. Plan coordinates, metres.
#pragma once

#include <vector>

#include "geom/region/region.h"
#include "math/box.h"

namespace gable {

/// Rings that enclose the sea within the area, islands left out, by even-odd. Empty without coasts.
/// O(n log n).
std::vector<Ring> seaOf(const std::vector<std::vector<Vec2>>& coastlines, const Box2& area);

}  // namespace gable
