// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// DrawPlan: how a scene is divided into draw calls. A batch is named by what a draw call cannot
// change: geometry, textures and the class of the material. What stands often is an instance of a
// geometry of its own, what stands seldom is merged.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "io/exporters/surface.h"
#include "scene/flatten.h"

namespace gable {

class JsonWriter;

/// The mesh of batches of what is merged.
constexpr uint32_t kMerged = 0xffffffff;

/// The part of a material that a batch has in common. Roughness and the like in steps nobody sees.
struct DrawLook {
  std::string map;
  double su = 1, sv = 1, tu = 0, tv = 0, rw = 0;
  int roughness = 10, metallic = 0, opacity = 20;
  int cutoff = -1;
  uint32_t emissive = 0;
  /// Its coordinates are metres.
  bool laid = false;
  auto tie() const {
    return std::tie(map, su, sv, tu, tv, rw, roughness, metallic, opacity, cutoff, emissive, laid);
  }
  bool operator<(const DrawLook& o) const { return tie() < o.tie(); }
  bool operator==(const DrawLook& o) const { return tie() == o.tie(); }
  uint64_t hash() const;
};
void writeLook(JsonWriter& json, const DrawLook& look);

/// What is drawn of a material. `group`: the first paint of the same look.
struct Paint {
  DrawLook look;
  uint32_t color = 0;
  uint32_t group = 0;
};

struct BatchKey {
  uint32_t look = 0;
  uint32_t mesh = kMerged;
  uint16_t slot = 0;
  bool mirrored = false;
  auto tie() const { return std::tie(look, mesh, slot, mirrored); }
  bool operator<(const BatchKey& o) const { return tie() < o.tie(); }
  bool operator==(const BatchKey& o) const { return tie() == o.tie(); }
};

/// What a batch will hold; upper bounds.
struct BatchTally {
  uint64_t instances = 0, corners = 0, triangles = 0;
};

/// What all threads look up: who draws which material, what stands how often.
class DrawPlan {
 public:
  explicit DrawPlan(const Scene& scene);

  const Scene& scene() const { return scene_; }
  /// Those that are drawn: no more than kMostLeaves.
  uint64_t leaves() const;
  bool truncated() const { return leaves() < all_; }
  uint64_t leavesOf(uint32_t prototype) const { return leavesOf_[prototype]; }
  const Paint& paint(uint32_t number) const { return paints_[number]; }
  size_t paints() const { return paints_.size(); }
  /// That of leaves without a material.
  uint32_t lastPaint() const { return static_cast<uint32_t>(paints_.size() - 1); }
  bool isSingle(uint32_t mesh) const { return uses_[mesh] == 1; }
  /// What is laid in metres stands often only where it is not scaled.
  bool isOften(const Leaf& leaf) const;
  bool isLaidLeaf(const Leaf& leaf) const {
    return leaf.materials < laidLists_.size() && laidLists_[leaf.materials];
  }
  bool isLaidPaint(uint32_t number) const;
  /// The place of a leaf's material among the paints.
  uint32_t paintOf(const Leaf& leaf, uint16_t slot) const;
  /// `look`: what stands for it.
  static BatchKey keyOf(const Leaf& leaf, uint16_t slot, bool often, uint32_t look);

  /// Counts how much each batch will hold, by what is stored.
  void tallyBatches();
  /// By a key whose look is the group of its paint; null where it is not known.
  const BatchTally* tally(const BatchKey& byGroup) const;

 private:
  void countPrototypes();
  void countMeshes();
  void findOften();
  void findPaints();
  void count(const Leaf& leaf, uint64_t times);

  const Scene& scene_;
  const std::vector<uint64_t> leavesOf_;
  uint64_t all_ = 0;
  /// By prototype, by mesh: how often it stands.
  std::vector<uint64_t> times_, uses_;
  std::vector<bool> often_;
  /// By list of materials: whether one of them is laid in metres.
  std::vector<bool> laidLists_;
  /// By material, the default one last.
  std::vector<Paint> paints_;
  std::unordered_map<uint32_t, std::vector<SlotTally>> slots_;
  std::map<BatchKey, BatchTally> tallies_;
};

}  // namespace gable
