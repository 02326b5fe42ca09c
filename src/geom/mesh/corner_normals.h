// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The normals that a surface is lit by, one a corner.
#pragma once

#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// `v` with the length 1, however short or long it is; zero where `v` is zero or not finite.
Vec3 unitOf(const Vec3& v);

/// By corner: its own normal where it has one of some length, else of a smooth face the mean of the
/// smooth faces around its position by their areas, else the face's, and up where that has none.
/// All have the length 1, whatever the mesh holds.
std::vector<Vec3> cornerNormals(const Mesh& m);

}  // namespace gable
