// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recomposition: parts that were taken out of a mesh, edited each by itself, and glued back.
//
// Where a vertex of a part came from, its origin, travels with it in the last two uv sets of its
// mesh, so that cutting finds the origins of new vertices as it finds their uv coordinates.
// Vertices of the same origin become one again. How far each part moved it is added up: parts that
// were cut out of one component count once where they moved it alike.
//
// Promises of recomposed():
//   1. A vertex in the middle of an edge of another face is put into that edge. Where it lies
//      there is between the edge's own ends.
//   2. Geometry without origins is taken as it is.
//   3. Equal input gives equal output, in the order of the faces: first those of `whole`, then
//      those of the parts.
// O(n log n) for n corners, unless many vertices lie beside each other along the longest axis.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// Whether the last two uv sets are free.
bool hasRoomForOrigins(const Mesh& m);
/// Notes for each corner that it comes from where it is now, and from a component.
void setOrigins(Mesh& m, uint32_t component);
bool hasOrigins(const Mesh& m);
void dropOrigins(Mesh& m);
/// The shape was deleted: its faces are gone, but where it moved its vertices counts.
void markDeleted(Mesh& m);
bool isDeleted(const Mesh& m);

/// All in the axes of `whole`, which are the faces that nobody took. Faces of two corners and of
/// one stand for edges and vertices of it: they move it and are no part of the result.
Mesh recomposed(const Mesh& whole, const std::vector<Mesh>& parts);

}  // namespace gable
