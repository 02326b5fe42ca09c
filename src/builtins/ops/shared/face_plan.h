// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces as plane polygons for operations that work in the plane.
#pragma once

#include "geom/mesh/mesh.h"
#include "geom/region/region.h"

namespace gable {

/// A frame with z along the normal of a face and its xy plane in the face. For a face square to a
/// coordinate axis the axes are coordinate axes and the origin has no part in the plane, so that
/// going there and back changes no bit; otherwise x runs along the first edge.
Frame planFrame(const Mesh& m, size_t face);

/// Axes square to a coordinate axis (0 to 2) with z along it, or against it for a negative sign. x
/// and y lie as rectangles have them: a ring that starts at the least x and y and runs along x
/// first is that of a rectangle that fills a scope.
Frame axisFrame(size_t axis, double sign);

/// A point of a polygon of planFrame, at a height above it.
inline Vec3 fromPlanFrame(const Frame& f, Vec2 p, double height = 0) {
  return f.point({p.x, p.y, height});
}

}  // namespace gable
