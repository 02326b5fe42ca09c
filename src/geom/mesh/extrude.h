// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Extrusion of the faces of a mesh into solids. Frame and units are the mesh's.
//
// Promises:
//   1. For each face in order: the original face, its side faces along the loops, the moved face.
//      Caps are faces with the holes of the original; all faces look outward, whatever the sign.
//   2. Seen from outside, a side face starts at its lower left corner: (a, b, b', a') for the edge
//      from a to b, where the distance is positive.
//   3. Where neighbours move together (all of them but in FaceNormal mode, there the coplanar ones)
//      no face is made between them; where they do not, each group becomes a solid of its own.
//   4. A closed result encloses its volume: every edge has two faces that run opposite ways.
//   5. uvs are inherited corner by corner; edge tags stay with their edges and go to the moved
//   ones;
//      normals are dropped. Side faces that have no height are left out or become triangles.
// A face of two corners (an edge) becomes one face (a, b, b', a'). O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

enum class ExtrudeMode : uint8_t {
  /// Along each face's own normal. Edges move along their corner normals, else along `direction`.
  FaceNormal,
  /// Along the normals of the positions, so that faces stay together.
  VertexNormal,
  /// All along `direction`.
  Along,
  /// All along `direction`, up to one height: the lowest vertex's plus the distance, at least that
  /// of the highest; with a negative distance down from the highest vertex in the same way.
  FlatTop,
};

struct ExtrudeOptions {
  ExtrudeMode mode = ExtrudeMode::FaceNormal;
  double distance = 0;
  /// A unit vector.
  Vec3 direction{0, 1, 0};
};

enum class ExtrudeRole : uint8_t { Bottom, SideOuter, SideInner, Top };

struct ExtrudeResult {
  Mesh mesh;
  /// By face: its part in the solid and the face that it was made from.
  std::vector<ExtrudeRole> roles;
  std::vector<uint32_t> faceSource;
};

/// A distance of zero gives the mesh as it is, with all faces Bottom (but for FlatTop).
ExtrudeResult extrude(const Mesh& m, const ExtrudeOptions& options);

}  // namespace gable
