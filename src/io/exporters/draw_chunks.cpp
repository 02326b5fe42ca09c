// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Content-defined chunking (Muthitacharoen, Chen, Mazieres: A Low-bandwidth Network File System,
// SOSP 2001): a chunk ends behind an item whose hash says so. Items are leaves, and instances of
// prototypes with few leaves; their hashes are computed once each, from the inside out.

#include "io/exporters/draw_chunks.h"

#include <algorithm>
#include <optional>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/work.h"
#include "geom/mesh/untagged_hash.h"
#include "scene/scene.h"

namespace gable {

namespace {

/// Larger prototypes are looked into.
constexpr uint64_t kMostOfAnItem = 128;
/// Of a chunk: an edit sends some hundred leaves around each that it changes, and a town has two
/// thousand chunks. With smaller ones less is sent, but a page that moves through a town goes
/// through what each has of each batch, picture by picture.
constexpr uint32_t kFewLeaves = 768, kManyLeaves = 2048;
/// Beyond the few, one item of so many ends a chunk.
constexpr uint64_t kItemsAnEnd = 8;
constexpr size_t kItemsATask = 1 << 14;

uint64_t hashOf(const Vec3& v) {
  return hashCombine(hashCombine(hashDouble(v.x), hashDouble(v.y)), hashDouble(v.z));
}

// Vector by vector, which a processor does side by side.
uint64_t hashOf(const Frame& f) {
  return hashCombine(hashCombine(hashOf(f.origin), hashOf(f.x)),
                     hashCombine(hashOf(f.y), hashOf(f.z)));
}

class Cutter {
 public:
  Cutter(const DrawPlan& plan, unsigned jobs) : plan_(plan), scene_(plan.scene()), jobs_(jobs) {
    hashLists();
    hashMeshes();
    hashLeaves();
    hashPrototypes();
  }

  std::vector<DrawChunk> cut() {
    for (const Root& r : scene_.roots) {
      if (!enter(r.instance, r.instance.frame)) continue;
      walk(
          scene_, scene_.prototypes[r.instance.prototype], r.instance.frame,
          [&](uint32_t leaf, const Frame& world, size_t) {
            add(hashCombine(hashOf(world), leaves_[leaf]), 1);
          },
          [&](const Instance& instance, const Frame& world, size_t) {
            return enter(instance, world);
          });
    }
    if (open_.leaves > 0) chunks_.push_back(open_);
    return std::move(chunks_);
  }

 private:
  // What is drawn in the materials of each list.
  void hashLists() {
    const auto paintHash = [&](uint32_t number) {
      const Paint& paint = plan_.paint(number);
      return hashCombine(paint.look.hash(), paint.color);
    };
    std::vector<uint64_t> paints;
    for (uint32_t p = 0; p < plan_.paints(); ++p) paints.push_back(paintHash(p));
    for (const std::vector<uint32_t>& list : scene_.materialLists) {
      uint64_t h = list.size();
      for (const uint32_t m : list) h = hashCombine(h, paints[std::min(m, plan_.lastPaint())]);
      lists_.push_back(h);
    }
  }

  // Calls task(i) for each i under count, several threads a run of them each.
  template <class Task>
  void forEach(size_t count, Task&& task) {
    WorkMeter* const meter = detail::workState.meter;
    parallelFor((count + kItemsATask - 1) / kItemsATask, jobs_, [&](size_t part, unsigned) {
      std::optional<WorkScope> scope;
      if (meter) scope.emplace(*meter);
      const size_t end = std::min(count, (part + 1) * kItemsATask);
      work(kItemsATask);
      for (size_t i = part * kItemsATask; i < end; ++i) task(i);
    });
  }

  void hashMeshes() {
    meshes_.resize(scene_.meshes.size());
    forEach(meshes_.size(), [&](size_t i) { meshes_[i] = untaggedHash(*scene_.meshes[i]); });
  }

  uint64_t leafHash(const Leaf& leaf) const {
    const uint64_t mesh = hashCombine(meshes_[leaf.mesh], uint64_t{plan_.isOften(leaf)});
    const uint64_t paints = leaf.materials < lists_.size() ? lists_[leaf.materials] : 0;
    return hashCombine(hashCombine(hashOf(leaf.frame), hashOf(leaf.scale)),
                       hashCombine(mesh, paints));
  }

  void hashLeaves() {
    leaves_.resize(scene_.leaves.size());
    forEach(leaves_.size(), [&](size_t i) { leaves_[i] = leafHash(scene_.leaves[i]); });
  }

  // A prototype comes behind those that it holds.
  void hashPrototypes() {
    prototypes_.reserve(scene_.prototypes.size());
    for (const Prototype& p : scene_.prototypes) {
      work(p.leafCount + p.instanceCount + 1);
      uint64_t h = p.leafCount;
      for (uint32_t l = 0; l < p.leafCount; ++l) h = hashCombine(h, leaves_[p.firstLeaf + l]);
      for (uint32_t i = 0; i < p.instanceCount; ++i) {
        const Instance& in = scene_.instances[p.firstInstance + i];
        h = hashCombine(hashCombine(h, in.leavesBefore),
                        hashCombine(hashOf(in.frame), prototypes_[in.prototype]));
      }
      prototypes_.push_back(h);
    }
  }

  // True where the instance is to be looked into; else it has been added.
  bool enter(const Instance& instance, const Frame& world) {
    const uint64_t inside = plan_.leavesOf(instance.prototype);
    if (inside > kMostOfAnItem) return true;
    if (inside > 0) {
      add(hashCombine(hashOf(world), prototypes_[instance.prototype]),
          static_cast<uint32_t>(inside));
    }
    return false;
  }

  void add(uint64_t item, uint32_t leaves) {
    open_.key = hashCombine(open_.key, item);
    open_.leaves += leaves;
    const bool isEnd =
        open_.leaves >= kManyLeaves || (open_.leaves >= kFewLeaves && item % kItemsAnEnd == 0);
    if (!isEnd) return;
    chunks_.push_back(open_);
    open_ = {};
  }

  const DrawPlan& plan_;
  const Scene& scene_;
  const unsigned jobs_;
  std::vector<uint64_t> lists_, meshes_, leaves_, prototypes_;
  DrawChunk open_;
  std::vector<DrawChunk> chunks_;
};

}  // namespace

std::vector<DrawChunk> chunksOf(const DrawPlan& plan, unsigned jobs) {
  return Cutter(plan, jobs).cut();
}

}  // namespace gable
