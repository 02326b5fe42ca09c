// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recomposition: parts that were taken out of a mesh, edited each by itself, and glued together.
//
// What belongs together is told by the origins of the corners (mesh/origins.h) alone, wherever the
// parts lie now. Vertices of the same origin become one again, and what the shapes moved it adds
// up: each shape counts once, however many parts it ended as.
//
// Promises of recomposed():
//   1. A vertex in the middle of an edge of another face is put into that edge. Where the edge
//      moves, it takes the vertex along.
//   2. Corners without origins stay where they are, and share nothing.
//   3. A part that is deleted moves the others and is no part of the result.
//   4. The result keeps the origins of outer levels. Corner normals stay where no other part moves
//      the face.
//   5. Equal input gives equal output, in the order of the faces: first those of `whole`, then
//      those of the parts.
// O(n log n) for n corners, where no edge has many vertices near it.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// Faces of two corners and of one, which stand for edges and vertices.
enum class LooseParts : uint8_t {
  /// They move the faces around them and are no part of the result.
  Move,
  /// They are glued like faces.
  Stay
};

/// All in the axes of `whole`, which are the faces that nobody took; it has the outer levels only.
Mesh recomposed(const Mesh& whole, const std::vector<Mesh>& parts, LooseParts loose);

}  // namespace gable
