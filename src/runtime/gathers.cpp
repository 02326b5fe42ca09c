// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/gathers.h"

#include <algorithm>
#include <utility>

#include "geom/mesh/origins.h"
#include "runtime/leaf_shape.h"

namespace gable {

void Gathers::begin(Call call) {
  Open& g = open_.emplace_back();
  g.call = std::move(call);
  g.firstLeaf = static_cast<uint32_t>(output_.openLeaves.size());
  g.firstNode = static_cast<uint32_t>(tracer_.size());
  due_ = g.call.activation + 1;
  worlds_.beginGather();
}

void Gathers::beginChild(uint32_t slot) {
  open_.back().children.emplace_back(static_cast<uint32_t>(output_.openLeaves.size()), slot);
}

bool Gathers::anyTagged() const {
  return std::any_of(open_.begin(), open_.end(), [](const Open& g) { return g.call.tagged; });
}

Gathers::Open Gathers::close() {
  Open g = std::move(open_.back());
  open_.pop_back();
  due_ = open_.empty() ? 0 : open_.back().call.activation + 1;
  worlds_.endGather();
  return g;
}

Gathers::Ended Gathers::end() {
  Open g = close();
  const std::vector<Leaf>& open = output_.openLeaves;
  Ended out{std::move(g.call), {}, {}, {}, g.firstLeaf, g.firstNode};
  // What a trace shows of shapes on their way is no leaf.
  out.shown = tracer_.shownShapes(g.firstNode, g.firstLeaf, open.size() - g.firstLeaf);
  auto child = g.children.begin();
  uint32_t slot = 0;
  for (uint32_t k = 0; k < out.shown.size(); ++k) {
    const uint32_t leaf = g.firstLeaf + k;
    for (; child != g.children.end() && child->first <= leaf; ++child) slot = child->second;
    if (out.shown[k]) continue;
    out.leaves.push_back({shapeOf(open[leaf], output_), false});
    out.slots.push_back(slot);
  }
  return out;
}

void Gathers::putBack(const Ended& ended, bool done) {
  std::vector<bool> gone(ended.shown.size(), false);
  for (size_t k = 0, next = 0; k < gone.size(); ++k) {
    if (ended.shown[k]) continue;
    const Gathered& leaf = ended.leaves[next++];
    Leaf& was = output_.openLeaves[ended.firstLeaf + k];
    if (!done) {
      if (ended.call.keepsOrigins) gone[k] = !forgetOrigins(leaf.shape, was);
      continue;
    }
    gone[k] = leaf.taken || leaf.shape.geometry.kind == GeometryKind::None;
    if (gone[k] || leaf.shape.geometry.mesh == meshOf(was, output_)) continue;
    setShape(was, leaf.shape, output_);
  }
  keepLeaves(ended.firstLeaf, ended.firstNode, ended.call.flat, gone);
}

// A leaf that stays though the operation failed. False where it stands for a deleted shape.
bool Gathers::forgetOrigins(const Shape& s, Leaf& leaf) {
  if (s.geometry.kind != GeometryKind::Mesh || originLevels(*s.geometry.mesh) == 0) return true;
  if (isDeleted(*s.geometry.mesh)) return false;
  Mesh mesh = *s.geometry.mesh;
  dropOrigins(mesh, originLevels(mesh) - 1);
  Shape without = s;
  without.geometry.mesh = makeRef<Mesh>(std::move(mesh));
  setShape(leaf, without, output_);
  return true;
}

Gathers::Call Gathers::drop() {
  Open g = close();
  const size_t count = output_.openLeaves.size() - g.firstLeaf;
  keepLeaves(g.firstLeaf, g.firstNode, g.call.flat, std::vector<bool>(count, true));
  return std::move(g.call);
}

// Of the leaves since the call began those that are not gone, where they lie outside of it.
void Gathers::keepLeaves(uint32_t firstLeaf, uint32_t firstNode, bool flat,
                         const std::vector<bool>& gone) {
  std::vector<Leaf>& open = output_.openLeaves;
  std::vector<uint32_t> number(gone.size(), TraceNode::kNone);
  uint32_t kept = firstLeaf;
  for (size_t k = 0; k < gone.size(); ++k) {
    if (gone[k]) continue;
    number[k] = kept;
    Leaf& leaf = open[kept++] = open[firstLeaf + k];
    if (flat) leaf.frame = worlds_.ofLeaves() * leaf.frame;
  }
  open.resize(kept);
  tracer_.renumberLeaves(firstNode, firstLeaf, number);
}

}  // namespace gable
