// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// New scopes around new geometry.
#pragma once

#include "geom/mesh/mesh.h"
#include "shape/shape.h"

namespace gable {

/// A direction that differs from a coordinate axis only by rounding, put on it; others as unit
/// vectors. Scopes stay exactly upright that way.
Vec3 straightened(const Vec3& direction);

/// Axes with the given y, x as near as possible to `x`; some x where they are parallel.
Frame axesWithY(const Vec3& y, const Vec3& x);

/// Gives the shape a mesh in coordinates of its scope, and a scope with `axes` (in the same
/// coordinates, origin ignored) that is the mesh's bounding box. With `downward` the scope hangs
/// from its origin: its y size is negative.
void refit(Shape& s, Mesh mesh, const Frame& axes, bool downward = false);

}  // namespace gable
