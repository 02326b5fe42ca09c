// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// BatchBuilder: leaves in the world, sorted into batches of a draw plan.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "io/exporters/draw_plan.h"

namespace gable {

struct DrawGeometry {
  std::vector<float> positions, normals, uvs;
  std::vector<uint32_t> indices;
};

/// Vertices and corners that follow each other in a batch and have one leaf and colour.
struct BatchRun {
  uint32_t leaf = 0, color = 0;
  uint32_t vertices = 0, corners = 0;
};

/// Triangles in the world; or, of instances, one geometry and where it stands.
struct Batch {
  DrawGeometry own;
  /// What is drawn: `own`, or what all instances have in common.
  DrawGeometry* geometry = nullptr;
  /// Of triangles.
  std::vector<BatchRun> runs;
  /// Each instance; each vertex where spreadRuns() was called.
  std::vector<float> leaves;
  std::vector<uint32_t> colors;
  std::vector<float> matrices;

  bool empty() const { return runs.empty() && leaves.empty(); }
  void addRun(const BatchRun& run);
  /// The leaf and the colour of each vertex, out of the runs.
  void spreadRuns();
  /// Keeps its memory, and the geometry of instances.
  void clear();
};

class BatchBuilder {
 public:
  explicit BatchBuilder(const DrawPlan& plan)
      : plan_(plan), scene_(plan.scene()), met_(plan.paints(), false) {}

  /// `number`: what the triangles of the leaf say that they belong to.
  void add(const Leaf& leaf, const Frame& world, uint32_t number);
  /// By keys whose look is the group of its paint. Some may be empty.
  std::map<BatchKey, Batch>& batches() { return batches_; }
  /// Of each look a paint that has it, as they came.
  const std::vector<uint32_t>& looks() const { return looks_; }
  /// Of the batches of instances.
  const std::map<BatchKey, DrawGeometry>& geometries() const { return geometries_; }
  /// Begins all batches anew, in the memory that they have; geometries stay.
  void clear();

 private:
  void reserve(Batch& batch, const BatchKey& key) const;
  Batch& batchOf(const BatchKey& key, uint32_t paint);
  const DrawSurface& surfaceOf(uint32_t mesh, bool apart);
  void addPart(DrawGeometry& to, uint32_t mesh, const DrawSurface& surface, const SurfacePart& part,
               const Frame& world, const Vec3& scale, bool laid);

  const DrawPlan& plan_;
  const Scene& scene_;
  FaceTriangulator triangulator_;
  /// By paint: whether its look has come.
  std::vector<bool> met_;
  std::vector<uint32_t> looks_;
  /// Of meshes that stand more than once; of the others only the last.
  std::map<std::pair<uint32_t, bool>, DrawSurface> surfaces_;
  DrawSurface single_;
  std::map<BatchKey, DrawGeometry> geometries_;
  std::map<BatchKey, Batch> batches_;
  BatchKey lastKey_;
  Batch* last_ = nullptr;
};

/// Of leaves in path order, those from one up to another.
struct LeafRange {
  uint64_t from = 0, to = 0;
};

/// Calls `visit(leaf, world, number, range)` for the leaves of ranges that ascend and lie apart.
/// What lies outside of all is passed by: instances of instances can stand for more than time
/// allows.
template <class Visit>
void forEachLeafIn(const DrawPlan& plan, std::span<const LeafRange> ranges, Visit&& visit) {
  const Scene& scene = plan.scene();
  uint64_t passed = 0;
  size_t at = 0;
  const auto reach = [&] {
    while (at < ranges.size() && ranges[at].to <= passed) ++at;
    return at < ranges.size();
  };
  const auto enter = [&](const Instance& instance) {
    const uint64_t inside = plan.leavesOf(instance.prototype);
    if (inside == 0 || !reach()) return false;
    if (saturatingAdd(passed, inside) > ranges[at].from) return true;
    passed += inside;
    return false;
  };
  const auto visitLeaf = [&](uint32_t leaf, const Frame& world, size_t) {
    const uint64_t number = passed++;
    while (at < ranges.size() && ranges[at].to <= number) ++at;
    if (at == ranges.size() || number < ranges[at].from) return;
    const Leaf& l = scene.leaves[leaf];
    visit(l, world * l.frame, number, at);
  };
  for (const Root& r : scene.roots) {
    if (!enter(r.instance)) continue;
    walk(scene, scene.prototypes[r.instance.prototype], r.instance.frame, visitLeaf,
         [&](const Instance& instance, const Frame&, size_t) { return enter(instance); });
  }
}

}  // namespace gable
