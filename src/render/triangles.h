// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A mesh as triangles over its own corners, with the normals of its smooth faces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable::rt {

struct MeshTriangles {
  /// Corner indices of the mesh.
  std::vector<std::array<uint32_t, 3>> corners;
  /// The face each came from.
  std::vector<uint32_t> faces;
  /// By corner of the mesh; empty when every face is flat.
  std::vector<Vec3> normals;
  /// By triangle, when there are normals: whether they count for it.
  std::vector<bool> smooth;
};

MeshTriangles triangulated(const Mesh& mesh);

}  // namespace gable::rt
