// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Outlines along lines, to be filled where they go round positively (FillRule::Positive): what a
// street, a path or a stream covers, exact at its ends and without a boolean. Plan coordinates,
// metres.
#pragma once

#include <vector>

#include "geom/region/region.h"

namespace gable {

/// What lies up to `left` metres to the left of a line and `right` to its right. Ends are square to
/// the line and lie `more` metres beyond it. The line has two points or more, none repeated.
Ring ribbonAlong(const std::vector<Vec2>& line, double left, double right, double more = 0);

/// Counter-clockwise.
Ring discAround(Vec2 middle, double radius);

/// The part of a line between two lengths from its beginning; two points at least.
std::vector<Vec2> linePart(const std::vector<Vec2>& line, double from, double to);

double lineLength(const std::vector<Vec2>& line);

}  // namespace gable
