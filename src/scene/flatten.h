// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Flattened views of a scene: leaves in the world, meshes where they stand, and one hash of all
// that a reader of the flattened model can see. Sharing on or off gives the same flattened scene.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace gable {

struct PlacedLeaf {
  const Leaf* leaf = nullptr;
  Frame world;
};

/// Instances expanded; linear in what is stored, and the largest number when there are more.
uint64_t leafCount(const Scene& scene);

/// The same for each prototype.
std::vector<uint64_t> prototypeLeafCounts(const Scene& scene);

/// In path order, instances expanded.
std::vector<PlacedLeaf> flatLeaves(const Scene& scene);

/// The leaf's mesh in the world.
Mesh worldMesh(const Scene& scene, const PlacedLeaf& placed);

/// The material of a mesh slot of a leaf; the default material where the scene names none.
const Material& materialOf(const Scene& scene, const Leaf& leaf, uint32_t slot);
/// Its index in Scene::materials, or kNoMaterial.
constexpr uint32_t kNoMaterial = 0xffffffff;
uint32_t materialIndexOf(const Scene& scene, const Leaf& leaf, uint32_t slot);

/// Leaves, their places, meshes, materials, names, sources and attributes, reports and prints, by
/// content and in path order: equal for scenes that differ in prototypes, pools or threads only.
uint64_t contentHash(const Scene& scene);

/// Adds and multiplies without wrapping round: a small scene can stand for more leaves than a
/// number can count.
inline uint64_t saturatingAdd(uint64_t a, uint64_t b) {
  uint64_t sum = 0;
  return __builtin_add_overflow(a, b, &sum) ? ~uint64_t{0} : sum;
}
uint64_t saturatingMultiply(uint64_t a, uint64_t b);

}  // namespace gable
