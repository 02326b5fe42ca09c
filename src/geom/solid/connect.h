// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Connect: makes the faces of a mesh neighbours where they touch.
//
// Promises: all faces stay, with all attributes. Positions within 1e-9 of the extent are one, and
// an edge on which a position of another face lies runs through it. Faces and loops that collapse
// by that go. O(n log n) where no edge has many positions near it.
#pragma once

#include "geom/mesh/mesh.h"

namespace gable {

Mesh connected(const Mesh& m);

}  // namespace gable
