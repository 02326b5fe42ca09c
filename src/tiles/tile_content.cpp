// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_content.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace gable {

void TileContent::append(TileContent&& other) {
  const auto firstScene = static_cast<uint32_t>(scenes.size());
  const auto firstFeature = static_cast<uint32_t>(features.size());
  const auto firstPlacement = static_cast<uint32_t>(placements.size());
  scenes.insert(scenes.end(), other.scenes.begin(), other.scenes.end());
  std::move(other.features.begin(), other.features.end(), std::back_inserter(features));
  leaves.reserve(leaves.size() + other.leaves.size());
  for (TileLeaf l : other.leaves) {
    l.scene += firstScene;
    l.feature += firstFeature;
    if (l.placement != TileLeaf::kNone) l.placement += firstPlacement;
    leaves.push_back(l);
  }
  for (TilePlacement p : other.placements) {
    p.scene += firstScene;
    p.feature += firstFeature;
    placements.push_back(p);
  }
  triangles += other.triangles;
}

namespace {

constexpr uint64_t kTimesCheaper = 8;

}  // namespace

uint64_t costOf(uint64_t triangles, uint64_t times) {
  return times == 0 ? 0 : triangles + triangles * (times - 1) / kTimesCheaper;
}

void TileContent::measure() {
  std::set<std::pair<uint32_t, uint32_t>> known;
  uint32_t placement = TileLeaf::kNone;
  bool again = false;
  triangles = 0;
  for (const TileLeaf& l : leaves) {
    if (l.placement != placement) {
      placement = l.placement;
      again = placement != TileLeaf::kNone &&
              !known.emplace(placements[placement].scene, placements[placement].prototype).second;
    }
    triangles += again ? (l.triangles + kTimesCheaper - 1) / kTimesCheaper : l.triangles;
  }
}

std::vector<TileGroup> groupsOf(const TileContent& content) {
  // A draw call is worth so many triangles, about 20 kB, and a page does not wait for many.
  constexpr uint64_t kLeastSaved = 512;
  constexpr size_t kMostGroups = 64;
  std::vector<uint64_t> triangles(content.placements.size());
  for (const TileLeaf& l : content.leaves) {
    if (l.placement != TileLeaf::kNone) triangles[l.placement] += l.triangles;
  }
  std::map<std::pair<uint32_t, uint32_t>, TileGroup> found;
  for (uint32_t i = 0; i < content.placements.size(); ++i) {
    const TilePlacement& p = content.placements[i];
    TileGroup& group = found[{p.scene, p.prototype}];
    group.scene = p.scene;
    group.prototype = p.prototype;
    group.placements.push_back(i);
  }
  const auto saved = [&](const TileGroup& g) {
    return triangles[g.placements[0]] * (g.placements.size() - 1);
  };
  std::vector<TileGroup> groups;
  for (auto& [key, group] : found) {
    if (saved(group) >= kLeastSaved) groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const TileGroup& a, const TileGroup& b) { return saved(a) > saved(b); });
  if (groups.size() > kMostGroups) groups.resize(kMostGroups);
  return groups;
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
