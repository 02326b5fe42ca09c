// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Kept tags: edges and vertices of a boolean's result have the tags of those edges and vertices of
// the operands on which they lie, whichever operand that is.
#pragma once

#include "geom/mesh/mesh.h"
#include "shape/services.h"

namespace gable {

/// Adds to an edge of the result the tags of all edges of the input along which it runs, and to a
/// vertex those of all vertices at its place. O(n log n) where few edges meet a box.
void keepTags(Mesh& result, const Mesh& input, const Services& services);

}  // namespace gable
