// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Counts of a scene. Those that do not depend on the place are worked out once a prototype, from
// the first to the last (an instance's prototype has the smaller index); only the bounds visit
// every leaf.

#include "scene/scene.h"

namespace gable {

namespace {

/// A polygon of n corners with h holes falls into n + 2h - 2 triangles.
uint64_t triangleCount(const Mesh& mesh, size_t face) {
  uint64_t corners = 0;
  for (const MeshLoop& loop : mesh.loopsOf(face)) corners += loop.cornerCount;
  const uint64_t loops = mesh.loopsOf(face).size();
  return corners < 3 ? 0 : corners + 2 * (loops - 1) - 2;
}

SceneCounts countMesh(const Mesh& mesh) {
  SceneCounts counts;
  counts.leaves = 1;
  counts.faces = mesh.faceCount();
  counts.vertices = mesh.positions.size();
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    counts.triangles += triangleCount(mesh, face);
  }
  return counts;
}

void add(SceneCounts& to, const SceneCounts& from) {
  to.leaves += from.leaves;
  to.faces += from.faces;
  to.vertices += from.vertices;
  to.triangles += from.triangles;
}

}  // namespace

SceneCounts count(const Scene& scene) {
  std::vector<SceneCounts> meshes;
  for (const MeshRef& mesh : scene.meshes) meshes.push_back(countMesh(*mesh));
  std::vector<SceneCounts> prototypes;
  for (const Prototype& p : scene.prototypes) {
    SceneCounts counts;
    for (uint32_t i = 0; i < p.leafCount; ++i) {
      add(counts, meshes[scene.leaves[p.firstLeaf + i].mesh]);
    }
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      add(counts, prototypes[scene.instances[p.firstInstance + i].prototype]);
    }
    prototypes.push_back(counts);
  }
  SceneCounts total;
  for (const Root& root : scene.roots) {
    add(total, prototypes[root.instance.prototype]);
    total.shapes += scene.prototypes[root.instance.prototype].shapes;
  }
  total.instances = scene.instances.size();
  total.prototypes = scene.prototypes.size();
  total.materials = scene.materials.size();
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    for (const Vec3& p : scene.meshes[leaf.mesh]->positions) {
      total.bounds.include(world.point(scaled(p, leaf.scale)));
    }
  });
  return total;
}

}  // namespace gable
