// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations that wait for what comes of their children: these are derived as ever, but without
// prototypes and in the frame of the call that waits, so that sharing makes no difference; then the
// operation sees their leaves, and those that it takes leave the result.
#include <algorithm>

#include "runtime/machine.h"

namespace gable {

namespace {

// The leaf with the geometry and the place of the shape; what else it is stays.
void placeAs(Leaf& leaf, const Shape& s, Output& output) {
  leaf.frame = s.scope;
  leaf.scale = s.size;
  if (s.geometry.kind != GeometryKind::Mesh) return;
  leaf.mesh = kFirstMesh + output.meshNumber(s.geometry.mesh);
  const Vec3& ref = s.geometry.refSize;
  for (size_t k = 0; k < 3; ++k) leaf.scale[k] = ref[k] != 0 ? s.size[k] / ref[k] : 1;
}

// The leaf as the shape that it was.
Shape shapeOf(const Leaf& leaf, const Output& output) {
  Shape s;
  s.scope = leaf.frame;
  s.size = leaf.scale;
  Geometry& g = s.geometry;
  g.uv = leaf.mesh == kUnitBoxUv || leaf.mesh == kUnitQuadXyUv || leaf.mesh == kUnitQuadXzUv;
  switch (leaf.mesh) {
    case kUnitBox:
    case kUnitBoxUv: g.kind = GeometryKind::Box; break;
    case kUnitQuadXy:
    case kUnitQuadXyUv: g.kind = GeometryKind::QuadXy; break;
    case kUnitQuadXz:
    case kUnitQuadXzUv: g.kind = GeometryKind::QuadXz; break;
    default:
      g.kind = GeometryKind::Mesh;
      g.mesh = output.meshes[leaf.mesh - kFirstMesh];
      g.refSize = {1, 1, 1};
  }
  return s;
}

}  // namespace

void Machine::beginGather(const Instruction& i, std::span<const Value> arguments) {
  OpenGather g;
  g.at = &i;
  g.activation = activationCount_ - 1;
  g.leaves = static_cast<uint32_t>(output_.openLeaves.size());
  g.traced = static_cast<uint32_t>(tracer_.size());
  g.made = current().made;
  g.flat = flat_;
  g.light = lightPartsAllowed_;
  g.arguments.assign(arguments.begin(), arguments.end());
  gathers_.push_back(std::move(g));
  worlds_.beginGather();
  nowGathering();
  flat_ = true;
  lightPartsAllowed_ = false;
}

void Machine::nowGathering() { gatherEnd_ = gathers_.empty() ? 0 : gathers_.back().activation + 1; }

OpenGather Machine::closeGather() {
  OpenGather g = std::move(gathers_.back());
  gathers_.pop_back();
  worlds_.endGather();
  nowGathering();
  flat_ = g.flat;
  lightPartsAllowed_ = g.light;
  return g;
}

void Machine::endGather() {
  const OpenGather g = closeGather();
  Activation& a = current();
  // What a trace shows of shapes on their way is no leaf.
  const std::vector<bool> shown =
      tracer_.shownShapes(g.traced, g.leaves, output_.openLeaves.size() - g.leaves);
  std::vector<Gathered> leaves;
  for (size_t k = 0; k < shown.size(); ++k) {
    if (!shown[k]) leaves.push_back({shapeOf(output_.openLeaves[g.leaves + k], output_), false});
  }
  // A leaf that the operation gives another mesh stays, with that and its place.
  std::vector<MeshRef> was;
  for (const Gathered& leaf : leaves) was.push_back(leaf.shape.geometry.mesh);
  const OpSpec& spec = *program_.operations[g.at->a];
  const CallPlace place{a.previousScope, a.previousSize,
                        program_.files[program_.rules[a.rule].file], program_.sites[pcOf(g.at)]};
  OpCall call(spec, a.shape, g.arguments, *this, place);
  instruction_ = g.at;
  const Shape before = a.shape;
  const Status status = guarded([&] { return call.runGathered(leaves); });
  if (status.ok()) {
    a.made = g.made;
  } else {
    a.shape = before;
    tellFailure(spec.name, status);
  }
  std::vector<bool> gone(shown.size(), false);
  for (size_t k = 0, l = 0; k < shown.size(); ++k) {
    if (shown[k]) continue;
    const Gathered& leaf = leaves[l++];
    gone[k] = status.ok() && leaf.taken;
    if (status.ok() && leaf.shape.geometry.mesh != was[l - 1]) {
      placeAs(output_.openLeaves[g.leaves + k], leaf.shape, output_);
    }
  }
  keepLeaves(g, gone);
}

// Of the leaves since the gather began those that are not gone, where they lie outside of it.
void Machine::keepLeaves(const OpenGather& g, const std::vector<bool>& gone) {
  std::vector<Leaf>& open = output_.openLeaves;
  std::vector<uint32_t> number(gone.size(), TraceNode::kNone);
  uint32_t kept = g.leaves;
  for (size_t k = 0; k < gone.size(); ++k) {
    if (gone[k]) continue;
    number[k] = kept;
    Leaf& leaf = open[kept++] = open[g.leaves + k];
    if (flat_) leaf.frame = worlds_.ofLeaves() * leaf.frame;
  }
  open.resize(kept);
  tracer_.renumberLeaves(g.traced, g.leaves, number);
}

// A limit struck within: what has not been gathered goes.
void Machine::dropGathers() {
  while (!gathers_.empty()) {
    const OpenGather g = closeGather();
    keepLeaves(g, std::vector<bool>(output_.openLeaves.size() - g.leaves, true));
  }
}

}  // namespace gable
