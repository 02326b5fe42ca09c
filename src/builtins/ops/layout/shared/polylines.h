// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines as the geometry of a shape: faces of two corners, one for each stretch, that follow each
// other. Operations see them from above, in the plan coordinates (x, -z) of the scope.
#pragma once

#include <vector>

#include "builtins/ops/shared/face_plan.h"
#include "geom/curve/curve.h"
#include "geom/mesh/mesh.h"
#include "shape/tags.h"

namespace gable {

struct Polyline2 {
  /// A closed one does not repeat its first point.
  Line line;
  bool closed = false;
  /// Above the scope's ground.
  double height = 0;
  /// Of a street, as its faces have it; 0 where nobody has told one.
  double width = 0;
};

/// The lines of a mesh, in its order. O(n).
std::vector<Polyline2> polylinesOf(const Mesh& mesh, const TagTable& tags);

/// Appends a line to the mesh that is being built.
void addPolyline(MeshBuilder& b, const Line& line, bool closed, double height, uint32_t tags);

/// The ground as polylinesOf sees it: at that height, z upwards.
Frame groundAt(double height);

}  // namespace gable
