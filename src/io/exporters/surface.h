// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// DrawSurface: the triangles of a mesh with the vertices that writers of triangle formats need: one
// a corner, with its normal; faces grouped by material slot.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/mesh/face_triangles.h"
#include "geom/mesh/mesh.h"
#include "material/laying.h"
#include "math/frame.h"

namespace gable {

/// The unit normal of a surface after a scale per axis: the inverse transpose of the scale times
/// the magnitude of its determinant, so that a flattening scale has a normal too. Points to the
/// outer side of a mirrored surface whose faces have been turned round. Has the length 1 when `n`
/// has.
Vec3 scaledNormal(const Vec3& n, const Vec3& scale);

/// What a mesh has in one material slot, without its triangles: upper bounds of a SurfacePart.
struct SlotTally {
  uint16_t slot = 0;
  uint32_t corners = 0;
  uint32_t triangles = 0;
};
/// Ascending slots; linear in the mesh.
std::vector<SlotTally> slotTallies(const Mesh& m);

/// Vertices and triangles that belong together; triangles count from the face's first vertex.
struct SurfaceFace {
  uint32_t firstVertex = 0, vertexCount = 0;
  uint32_t firstTriangle = 0, triangleCount = 0;
};

struct SurfacePart {
  uint16_t slot = 0;
  uint32_t firstFace = 0, faceCount = 0;
};

class DrawSurface {
 public:
  /// The mesh corner of each vertex: its position and uv coordinates.
  std::vector<uint32_t> corners;
  /// In the mesh's frame, as cornerNormals has them.
  std::vector<Vec3> normals;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<SurfaceFace> faces;
  /// Ascending slots.
  std::vector<SurfacePart> parts;

  /// Replaces the content. Meshes with corner normals have equal vertices of a part merged, so that
  /// a part of such a mesh is one face; not where `apart`.
  void build(const Mesh& m, FaceTriangulator& triangulator, bool apart = false);
  /// The part of a slot, or nullptr.
  const SurfacePart* part(uint16_t slot) const;

 private:
  void addFace(const Mesh& m, size_t face, const std::vector<Vec3>& cornerNormals,
               FaceTriangulator& triangulator);
  void mergeVertices(const Mesh& m, SurfacePart& part);
  std::vector<std::array<uint32_t, 3>> scratch_;
};

/// How a material that counts in metres lies on a face of a placed mesh: the axes are those of the
/// frame around it.
FaceAxes layingOf(const Mesh& m, const DrawSurface& surface, const SurfaceFace& face,
                  const Frame& frame, const Vec3& scale);

/// The directions in which a uv set grows over a mesh, at each vertex of a surface: not unit, in
/// the mesh's frame; zero where the uv set is flat.
struct Tangents {
  std::vector<Vec3> u, v;
};
Tangents tangentsOf(const Mesh& m, const DrawSurface& surface, int uvSet);

}  // namespace gable
