// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Slices: a mesh cut by parallel planes, or along lines of equal uv coordinate.
//
// Promises
//  1. The parts together are the mesh: areas add up, and where `cap` closes them, volumes too. A
//  cut
//     that passes through no face changes nothing.
//  2. Faces that were cut keep material, tags, and the tags of what is left of their edges; uv
//     coordinates and normals are interpolated. Edges along a cut and faces that close one have no
//     tags. Edge and point faces are cut as well.
//  3. Corners of faces that shared a position share it in each part; new points of a shared edge
//  are
//     shared. A vertex within the tolerance of a cut lies on it, so no slivers arise from rounding.
//  4. A face that lies in a cut belongs to the part behind it, seen from its normal.
//  5. Parts that have no geometry are empty meshes.
// Faces should be planar and simple; others are cut as well as they allow and never fail.
// O(corners + new corners * log) for all cuts together.
#pragma once

#include <span>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// Cuts at dot(normal, p) = cuts[i], ascending; part i lies below cut i, the last above all. With
/// `cap`, closed outlines that a cut leaves open are closed by faces in it.
std::vector<Mesh> sliceMesh(const Mesh& m, const Vec3& normal, std::span<const double> cuts,
                            bool cap);

/// The part with dot(normal, p) <= distance.
Mesh clippedBelow(const Mesh& m, const Vec3& normal, double distance, bool cap);

/// Cuts where a coordinate (0: u, 1: v) of a uv set takes the values `cuts`, ascending. A mesh
/// without the set goes whole into the first part.
std::vector<Mesh> sliceMeshByUv(const Mesh& m, int set, int coordinate,
                                std::span<const double> cuts);

}  // namespace gable
