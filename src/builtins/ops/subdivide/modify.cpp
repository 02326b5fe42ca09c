// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The components become shapes with origins, and the shape keeps the others until all that comes of
// them is glued to it.
#include <algorithm>
#include <vector>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/joined.h"
#include "builtins/ops/subdivide/shared/component_split.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The faces that no component took: all of them where components are edges or vertices.
Mesh untouched(const Mesh& m, const Components& all, const std::vector<bool>& taken,
               ComponentKind kind, const std::vector<uint16_t>& firstSlots) {
  std::vector<bool> gone(m.faceCount(), false);
  std::vector<bool> slotGone(size_t{1} << 16, false);
  for (size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;
    if (kind == ComponentKind::Faces) gone[all.list()[i].face] = true;
    if (kind == ComponentKind::Slots) slotGone[all.list()[i].face] = true;
  }
  MeshBuilder builder;
  std::vector<uint32_t> map;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    const uint16_t own = m.faces[f].materialSlot;
    const uint16_t slot = own < firstSlots.size() ? firstSlots[own] : own;
    if (!gone[f] && !slotGone[slot]) builder.copyFace(m, f, map);
  }
  return builder.take();
}

Status beginModify(OpCall& call, const Comp& args) {
  const ComponentKind kind = kindOf(args);
  const ComponentCall context{call, args.alignment == Alignment::ZUp, true};
  const MeshRef mesh = meshInScope(call.shape());
  const std::vector<uint16_t> slots = componentSlots(args, call.shape(), call.services());
  Components all = componentsOf(call, args, *mesh);
  const std::vector<bool> taken = splitMesh(context, all, *mesh, kind);
  if (std::find(taken.begin(), taken.end(), true) == taken.end()) return {};
  setMesh(call.shape(), untouched(*mesh, all, taken, kind, slots), ScopeFit::Keep);
  call.gather(true);
  return {};
}

Status finishModify(OpCall& call, std::span<Gathered> leaves) {
  Shape& s = call.shape();
  const Shape whole = s;
  recompose(s, &whole, leaves, call.services());
  return {};
}

constexpr OpSpec kSpecs[] = {
    heavy({"modify",
           "subdivide",
           "Edits components of the shape and glues what comes of them back into it.",
           kCompSignatures,
           typed<beginModify>,
           BlockKind::Selectors,
           kReadsWorld | kReadsWorldByWord | kReadsPivotAxes | kReadsTags,
           kNoParts,
           false,
           false,
           {},
           1,
           finishModify}),
};

}  // namespace

extern const OpList kOps_modify;
const OpList kOps_modify = kSpecs;

}  // namespace gable
