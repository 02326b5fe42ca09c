// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Fewer vertices with the least change: edges collapse, the cheapest first.
//
// Promises: about `share` of the vertices that faces use are gone, less where more would change the
// topology or fold the surface; the others stay where they were; a closed mesh stays closed. Faces
// that no collapse met stay polygons, the others are triangles. Borders, seams of texture
// coordinates and edges between materials keep their course. Materials, uvs and smoothness go on;
// tags and corner normals do not. Nothing but the mesh and the share decides. O(n log n).
#pragma once

#include "geom/mesh/mesh.h"

namespace gable {

/// `share` is from 0 to 1.
Mesh simplified(const Mesh& m, double share);

}  // namespace gable
