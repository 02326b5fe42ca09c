// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How far texture coordinates reach, in their own units and in metres on the surface.
#pragma once

#include "geom/mesh/mesh.h"

namespace gable {

struct UvExtent {
  double min = 0, max = 0;
  /// The range times the metres that one unit of the coordinate is long: the length of dp/du,
  /// averaged over the faces by area.
  double metres = 0;
};

/// Of a coordinate (0: u, 1: v) of a uv set that the mesh has. O(corners).
UvExtent uvExtent(const Mesh& m, int set, int coordinate);

}  // namespace gable
