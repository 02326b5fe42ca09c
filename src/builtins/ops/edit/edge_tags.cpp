// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/work.h"
#include "builtins/edge_sampling.h"
#include "builtins/lists.h"
#include "builtins/ops/subdivide/shared/components.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The texts of an attribute by edge, each as a tag; empty texts give none.
std::vector<std::string> tagsOf(const std::string& name, const Value& list, const ValuePool& pool) {
  std::vector<std::string> out;
  for (const StringId text : pool.array(list).strings) {
    work();
    std::string value(pool.text(text));
    std::erase_if(value, [](char c) { return c == '?' || c == '*'; });
    out.push_back(value.empty() ? value : "edgeattr." + name + "." + value);
  }
  return out;
}

Status applySetTags(OpCall& call) {
  Shape& s = call.shape();
  const EdgeSampler sampler(call.services(), s);
  const EdgeAttributes* edges = sampler.attributes();
  if (!edges || s.geometry.kind == GeometryKind::None) return {};
  const ValuePool& pool = call.services().pool();
  std::vector<std::vector<std::string>> texts;
  for (const auto& [name, list] : edges->attributes()) {
    if (list.type == ValueType::StringArray) texts.push_back(tagsOf(name, list, pool));
  }
  if (texts.empty()) return {};
  TagTable& tags = call.services().tags();
  Mesh mesh = *meshInScope(s);
  const Components parts(mesh, ComponentKind::FaceEdges);
  std::vector<uint32_t> sets = mesh.edgeTags;
  sets.resize(mesh.corners.size());
  for (const Component& c : parts.list()) {
    work();
    const Vec3 ends[] = {mesh.positions[c.from], mesh.positions[c.to]};
    const int32_t edge = sampler.edgeAt(ends, c.what.normal);
    if (edge < 0) continue;
    for (const std::vector<std::string>& of : texts) {
      const auto at = static_cast<size_t>(edge);
      if (at < of.size() && !of[at].empty()) sets[c.corner] = tags.with(sets[c.corner], of[at]);
    }
  }
  if (std::ranges::all_of(sets, [](uint32_t set) { return set == 0; })) return {};
  mesh.edgeTags = std::move(sets);
  setMesh(s, std::move(mesh), ScopeFit::Keep);
  return {};
}

constexpr Signature kNone[] = {{}};
constexpr OpSpec kSpecs[] = {
    {"setTagsFromEdgeAttrs", "edit",
     "Gives edges the texts that the initial shape's edges have as attributes, as tags.", kNone,
     applySetTags, BlockKind::None, kReadsWorld | kReadsInitialShape},
};

}  // namespace

extern const OpList kOps_edge_tags;
const OpList kOps_edge_tags = kSpecs;

}  // namespace gable
