// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Triangles of a mesh's faces, holes respected, without new vertices; what writers and the renderer
// need. Triangles turn as their face does; none has zero area in the plane of its face.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// Buffers that calls reuse; one a thread.
struct FaceTriangulator {
  /// Appends the triangles of a face as corner indices of the mesh (into Mesh::corners). A face
  /// without area gives none. O(n) for convex faces, else as region/triangulate.h.
  void add(const Mesh& m, size_t face, std::vector<std::array<uint32_t, 3>>& out);

 private:
  bool addFan(uint32_t firstCorner, uint32_t count, std::vector<std::array<uint32_t, 3>>& out);

  std::vector<Vec2> points_;
  std::vector<uint32_t> ringEnds_;
  std::vector<uint32_t> cornerOf_;
};

}  // namespace gable
