// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each face becomes a key of 128 bits: two hashes of its rounded corners, begun at the least one,
// so that neither the order of faces nor the start of a ring counts. Both lists of keys are sorted
// and merged, and equal keys take each other away.

#include "gable/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/hash.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "material/material.h"

namespace gable {
namespace {

/// Corners that round to the same millimetre are at the same place.
constexpr double kGrid = 1e-3;

struct FaceKey {
  uint64_t first = 0, second = 0;
  /// Where the face is: a leaf of the walk and a face of its mesh.
  uint32_t leaf = 0, face = 0;
  /// Index of its look.
  uint32_t look = 0;

  bool sameFace(const FaceKey& o) const { return first == o.first && second == o.second; }
  bool operator<(const FaceKey& o) const {
    return first != o.first ? first < o.first : second < o.second;
  }
};

using Cell = std::array<int64_t, 3>;

Cell cellOf(const Vec3& p) {
  const auto cell = [](double v) {
    return static_cast<int64_t>(std::llround(std::clamp(v / kGrid, -4e18, 4e18)));
  };
  return {cell(p.x), cell(p.y), cell(p.z)};
}

void fold(FaceKey& key, uint64_t value) {
  key.first = hashCombine(key.first, value);
  key.second = hashCombine(key.second ^ 0x5851f42d4c957f2dULL, value);
}

/// A leaf in the world.
struct Placed {
  Mesh mesh;
  const Leaf* leaf = nullptr;
};

/// What two materials have in common where they look the same.
struct Look {
  std::string name;
  std::string color;
  double opacity = 1;
  auto operator<=>(const Look&) const = default;
};

class Side {
 public:
  explicit Side(const Scene& scene) : scene_(scene) {
    looks_.push_back({"", "#ffffff", 1});
    for (const Material& m : scene.materials) {
      looks_.push_back({m.name, colorText(m.color), m.opacity});
    }
    for (const Look& look : looks_) {
      const uint64_t hash = hashCombine(hashBytes(look.name), hashBytes(look.color));
      lookHashes_.push_back(hashCombine(hash, hashDouble(look.opacity)));
    }
    forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
      leaves_.push_back({transformed(*scene.meshes[leaf.mesh], leaf.scale, world), &leaf});
      addKeys(static_cast<uint32_t>(leaves_.size() - 1));
    });
    std::stable_sort(keys_.begin(), keys_.end());
  }

  const std::vector<FaceKey>& keys() const { return keys_; }
  const Mesh& meshOf(const FaceKey& key) const { return leaves_[key.leaf].mesh; }
  double area(const FaceKey& key) const { return meshOf(key).area(key.face); }

  /// The area of each look; those of no face have 0.
  std::map<Look, double> areas() const {
    std::vector<double> sums(looks_.size());
    for (const FaceKey& key : keys_) sums[key.look] += area(key);
    std::map<Look, double> out;
    for (size_t i = 0; i < looks_.size(); ++i) out[looks_[i]] += sums[i];
    return out;
  }

 private:
  /// Looks are numbered as materials are, behind the one of no material.
  uint32_t lookOf(uint32_t leaf, uint32_t face) const {
    const Placed& placed = leaves_[leaf];
    const std::vector<uint32_t>& list = scene_.materialLists[placed.leaf->materials];
    if (list.empty()) return 0;
    const uint16_t slot = placed.mesh.faces[face].materialSlot;
    return list[slot < list.size() ? slot : 0] + 1;
  }

  void addKeys(uint32_t leaf) {
    const Mesh& mesh = leaves_[leaf].mesh;
    for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
      work();
      FaceKey key{0, 0, leaf, face, lookOf(leaf, face)};
      fold(key, lookHashes_[key.look]);
      for (const MeshLoop& loop : mesh.loopsOf(face)) addLoop(mesh, loop, key);
      keys_.push_back(key);
    }
  }

  void addLoop(const Mesh& mesh, const MeshLoop& loop, FaceKey& key) {
    cells_.clear();
    for (uint32_t corner : mesh.cornersOf(loop)) cells_.push_back(cellOf(mesh.positions[corner]));
    const auto least = std::min_element(cells_.begin(), cells_.end());
    std::rotate(cells_.begin(), least, cells_.end());
    fold(key, cells_.size());
    for (const Cell& cell : cells_) {
      for (int64_t v : cell) fold(key, static_cast<uint64_t>(v));
    }
  }

  const Scene& scene_;
  std::vector<Look> looks_;
  std::vector<uint64_t> lookHashes_;
  std::vector<Placed> leaves_;
  std::vector<FaceKey> keys_;
  std::vector<Cell> cells_;
};

/// Faces of one kind, with a mesh of them to look at.
class Pile {
 public:
  void add(const Side& side, const FaceKey& key) {
    const Mesh& from = side.meshOf(key);
    std::vector<uint32_t> map(from.positions.size(), MeshBuilder::kNoPosition);
    builder_.copyFace(from, key.face, map);
    ++sum_.faces;
    sum_.area += side.area(key);
    for (const MeshLoop& loop : from.loopsOf(key.face)) {
      for (uint32_t corner : from.cornersOf(loop)) box_.include(from.positions[corner]);
    }
  }

  FaceSum sum() const {
    FaceSum out = sum_;
    if (!box_.empty()) out.bounds = boundingBoxOf(box_);
    return out;
  }

  Mesh take() {
    Mesh mesh = builder_.take();
    for (MeshFace& face : mesh.faces) face.materialSlot = 0;
    return mesh;
  }

 private:
  MeshBuilder builder_;
  FaceSum sum_;
  Box3 box_;
};

struct Piles {
  Pile kept, removed, added;
};

Piles sorted(const Side& before, const Side& after) {
  Piles piles;
  auto a = before.keys().begin(), b = after.keys().begin();
  while (a != before.keys().end() || b != after.keys().end()) {
    work();
    if (b == after.keys().end() || (a != before.keys().end() && *a < *b)) {
      piles.removed.add(before, *a++);
    } else if (a == before.keys().end() || *b < *a) {
      piles.added.add(after, *b++);
    } else {
      piles.kept.add(after, *b++);
      ++a;
    }
  }
  return piles;
}

/// One leaf a pile, in its colour.
std::shared_ptr<const Model::Impl> pictureOf(Piles& piles) {
  auto impl = std::make_shared<Model::Impl>();
  Scene& scene = impl->result.scene;
  scene.names = {"difference"};
  scene.materialLists.clear();
  const auto add = [&](Pile& pile, const Vec3& color, const char* name) {
    Mesh mesh = pile.take();
    if (mesh.empty()) return;
    Material material;
    material.color = color;
    material.name = name;
    Leaf leaf;
    leaf.mesh = static_cast<uint32_t>(scene.meshes.size());
    leaf.materials = static_cast<uint32_t>(scene.materialLists.size());
    leaf.name = static_cast<uint32_t>(scene.names.size());
    scene.names.emplace_back(name);
    scene.meshes.push_back(makeRef<Mesh>(std::move(mesh)));
    scene.materialLists.push_back({static_cast<uint32_t>(scene.materials.size())});
    scene.materials.push_back(material);
    scene.leaves.push_back(leaf);
  };
  add(piles.kept, {0.72, 0.72, 0.72}, "kept");
  add(piles.removed, {0.85, 0.16, 0.12}, "removed");
  add(piles.added, {0.13, 0.62, 0.22}, "added");
  Prototype whole;
  whole.leafCount = static_cast<uint32_t>(scene.leaves.size());
  whole.shapes = 1;
  scene.prototypes = {whole};
  scene.roots = {Root{}};
  impl->makeSound();
  return impl;
}

using Areas = std::map<Look, double>;

std::vector<MaterialChange> materialChanges(const Areas& before, const Areas& after) {
  std::map<Look, Change<double>> areas;
  for (const auto& [look, area] : before) areas[look].first = area;
  for (const auto& [look, area] : after) areas[look].second = area;
  std::vector<MaterialChange> changes;
  for (const auto& [look, area] : areas) {
    const double larger = std::max(area.first, area.second);
    if (std::fabs(area.first - area.second) <= 1e-6 * larger) continue;
    changes.push_back({look.name, look.color, area});
  }
  return changes;
}

double total(const Areas& areas) {
  double sum = 0;
  for (const auto& [look, area] : areas) sum += area;
  return sum;
}

}  // namespace

Comparison compare(const Model& before, const Model& after, const FileLimits& limits) {
  return guardedResult<Comparison>(Task("comparing", "models", limits), [&] {
    Comparison out;
    out.statistics = {before.statistics(), after.statistics()};
    const Side a(before.impl().scene()), b(after.impl().scene());
    const Areas areasBefore = a.areas(), areasAfter = b.areas();
    out.area = {total(areasBefore), total(areasAfter)};
    out.materials = materialChanges(areasBefore, areasAfter);
    Piles piles = sorted(a, b);
    out.kept = piles.kept.sum();
    out.removed = piles.removed.sum();
    out.added = piles.added.sum();
    out.picture = Model(pictureOf(piles));
    return out;
  });
}

}  // namespace gable
