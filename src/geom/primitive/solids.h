// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Round primitives as meshes, with uv set 0. Radius 1 around the y axis, y from 0 to 1 (the sphere:
// from -1 to 1); the first point of each ring lies on +x, rings run counter-clockwise seen from
// above. Curved faces carry corner normals.
#pragma once

#include <cstdint>

#include "geom/mesh/mesh.h"

namespace gable {

/// A primitive of more faces than this helps nobody and is taken for a mistake.
constexpr uint32_t kMaxSolidFaces = 1u << 18;

/// In the plane y = 0, normal +y; uv as a photograph from above.
Mesh makeDisk(uint32_t sides);
/// Bottom, top, then the sides from +x on; u runs around, v up.
Mesh makeCylinder(uint32_t sides);
/// Bottom, then the sides.
Mesh makeCone(uint32_t sides);
/// Rings of faces from the bottom up; triangles at the poles.
Mesh makeSphere(uint32_t sides, uint32_t divisions);

}  // namespace gable
