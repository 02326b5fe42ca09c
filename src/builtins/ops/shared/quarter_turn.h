// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Quarter turns of a scope alone: the box that it covers and the geometry in it stay where they
// are, and only the names of its axes and the corner that is its origin change. Boxes stay boxes,
// and upright rectangles stay rectangles while their normal stays z; other geometry becomes a mesh.
#pragma once

#include "shape/shape.h"

namespace gable {

/// A turn that takes axes to axes: the turned scope's axis i is the present scope's axis `from[i]`,
/// reversed where `back[i]`. The axes must stay right-handed.
struct QuarterTurn {
  size_t from[3] = {0, 1, 2};
  bool back[3] = {false, false, false};
};

/// `quarters` turns by 90 degrees about an axis of the scope, counter-clockwise seen from its end.
QuarterTurn quarterTurn(size_t axis, int quarters);

/// First `a`, then `b` about the axes that `a` made.
QuarterTurn followed(const QuarterTurn& a, const QuarterTurn& b);

/// The turn by angles about x, then y, then z of the scope as it is; false when one is no multiple
/// of 90 degrees.
bool quarterTurnOf(const Vec3& degrees, QuarterTurn& out);

void turnScope(Shape& s, const QuarterTurn& turn);

}  // namespace gable
