// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>

#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyReset(OpCall& call) {
  Shape& s = call.shape();
  const Shape& initial = call.services().initialShape().shape;
  const Frame object = objectFrame(call.services());
  s.geometry = initial.geometry;
  s.assetMaterials = initial.assetMaterials;
  s.size = initial.size;
  s.scope = object * initial.scope;
  s.pivot = object * initial.pivot;
  if (s.extra && !s.extra->trim.empty()) {
    ShapeExtra extra = extraOf(s);
    extra.trim.clear();
    s.extra = makeRef<ShapeExtra>(std::move(extra));
  }
  return {};
}

// Copies the outer loops alone, with all that belongs to their corners.
Mesh withoutHoles(const Mesh& m) {
  Mesh out;
  out.positions = m.positions;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    MeshFace face = m.faces[f];
    MeshLoop loop = m.loopsOf(f)[0];
    const auto copy = [&](const auto& from, auto& to) {
      if (from.empty()) return;
      to.insert(to.end(), from.begin() + loop.firstCorner,
                from.begin() + loop.firstCorner + loop.cornerCount);
    };
    const auto first = static_cast<uint32_t>(out.corners.size());
    copy(m.corners, out.corners);
    out.notes.resize(m.notes.size());
    for (int set = 0; set < m.setCount(); ++set) copy(m.set(set), out.set(set));
    copy(m.normals, out.normals);
    copy(m.edgeTags, out.edgeTags);
    loop.firstCorner = first;
    face.firstLoop = static_cast<uint32_t>(out.loops.size());
    face.loopCount = 1;
    out.loops.push_back(loop);
    out.faces.push_back(face);
  }
  // Positions that only holes used would still count as vertices.
  std::vector<uint32_t> map(m.positions.size(), MeshBuilder::kNoPosition);
  uint32_t used = 0;
  for (uint32_t& c : out.corners) {
    if (map[c] == MeshBuilder::kNoPosition) map[c] = used++;
    c = map[c];
  }
  std::vector<Vec3> kept(used);
  out.vertexTags.resize(m.vertexTags.empty() ? 0 : used);
  for (uint32_t p = 0; p < map.size(); ++p) {
    if (map[p] == MeshBuilder::kNoPosition) continue;
    kept[map[p]] = m.positions[p];
    if (!out.vertexTags.empty()) out.vertexTags[map[p]] = m.vertexTagsAt(p);
  }
  out.positions = std::move(kept);
  return out;
}

Status applyDeleteHoles(OpCall& call) {
  Shape& s = call.shape();
  if (countsOf(s.geometry).holes == 0) return {};
  editMesh(s, [](Mesh& m) { m = withoutHoles(m); });
  return {};
}

constexpr Signature kNoArguments[] = {{}};

constexpr OpSpec kSpecs[] = {
    {"resetGeometry", "edit",
     "Brings back geometry, scope and pivot of the initial shape; attributes stay.", kNoArguments,
     applyReset, BlockKind::None, kReadsWorld | kReadsInitialShape},
    {"deleteHoles", "edit", "Fills the holes of all faces.", kNoArguments, applyDeleteHoles},
};

}  // namespace

extern const OpList kOps_reset;
const OpList kOps_reset = kSpecs;

}  // namespace gable
