// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What text cases measure on the leaves of a scene. Lengths in metres, in the world.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace gable::cases {

/// A leaf with its mesh brought into the world.
struct PlacedLeaf {
  const Leaf* leaf = nullptr;
  std::string_view name;
  Mesh mesh;
  /// Size of the mesh's bounds along the axes of the leaf's own frame.
  Vec3 size;
};

/// All leaves in the order of derivation, instances expanded.
std::vector<PlacedLeaf> placedLeaves(const Scene& scene);

/// Enclosed by faces that look outwards, by the divergence theorem; meaningful for closed meshes.
double volume(const Mesh& mesh);
/// Whether every edge runs as often one way as the other. Positions that agree to 0.00001 are one.
bool isClosed(const Mesh& mesh);
/// Whether all positions lie within 0.0001 of one plane.
bool isFlat(const Mesh& mesh);

}  // namespace gable::cases
