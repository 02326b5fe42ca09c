// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Deformed shapes: few operations make them, and few understand them (kTakesDeformed). For all
// others bakeDeformation puts the deformation into the geometry and gives the shape an orthonormal
// scope again.
#pragma once

#include "geom/mesh/mesh.h"
#include "shape/shape.h"

namespace gable {

inline bool isDeformed(const Shape& s) { return s.extra && s.extra->deformed; }

/// Which parts of a body in unit coordinates (its pivot at 0) a deformation means. Axes are
/// numbers.
struct DeformedSides {
  /// Along this axis the near side lies at `low`, the far side at `high`.
  size_t axis = 1;
  double low = 0, high = 1;
  /// Deformation::front is for points beyond 0 along this axis, top (if at all) for those with y.
  size_t frontAxis = 2;
  bool hasTop = false;
};

/// A mesh of unit coordinates as the deformation places it, in scope coordinates at the shape's
/// present size. Faces look outwards whatever is mirrored; those that are no longer flat become
/// triangles, those that collapse are left out. O(size of the mesh).
Mesh deformedMesh(const Shape& s, const Mesh& unit, const DeformedSides& sides);

/// The mesh with faces that are no longer flat as triangles, and without those that collapse.
Mesh flatFaces(const Mesh& m);

/// Ends the deformation: the geometry takes it up (its far side being that of y), and the scope
/// becomes the box of the new geometry along its present axes. A shape without geometry gets the
/// scope that comes nearest to the near map.
void bakeDeformation(Shape& s);

}  // namespace gable
