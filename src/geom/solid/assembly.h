// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Assembly: outlines become faces of a mesh, with the attributes of the faces that they come from.
#pragma once

#include <vector>

#include "geom/solid/boolean.h"
#include "geom/solid/outlines.h"

namespace gable::solid {

/// Vertices go that are new, divide no edge of any face, and lie on a straight line.
SolidResult assemble(const Mesh& m, const Facets& facets, const Splits& splits,
                     const std::vector<uint64_t>& cuts, std::vector<Outline> outlines);

}  // namespace gable::solid
