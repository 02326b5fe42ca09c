// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_content.h"

#include <algorithm>
#include <iterator>

namespace gable {

void TileContent::append(TileContent&& other) {
  const auto firstScene = static_cast<uint32_t>(scenes.size());
  const auto firstFeature = static_cast<uint32_t>(features.size());
  scenes.insert(scenes.end(), other.scenes.begin(), other.scenes.end());
  std::move(other.features.begin(), other.features.end(), std::back_inserter(features));
  leaves.reserve(leaves.size() + other.leaves.size());
  for (TileLeaf l : other.leaves) {
    l.scene += firstScene;
    l.feature += firstFeature;
    leaves.push_back(l);
  }
  triangles += other.triangles;
}

Box3 localBox(const Scene& scene, const Leaf& leaf) {
  const Box3 mesh = scene.meshes[leaf.mesh]->bounds();
  Box3 out;
  if (mesh.empty()) return out;
  out.include(scaled(mesh.min, leaf.scale));
  out.include(scaled(mesh.max, leaf.scale));
  return out;
}

double widthOf(const Box3& box) {
  const Vec3 s = box.size();
  return std::max(std::min(s.x, s.y), std::min(std::max(s.x, s.y), s.z));
}

}  // namespace gable
