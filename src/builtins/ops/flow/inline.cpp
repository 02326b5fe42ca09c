// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Waits for all that comes of a rule, a subdivision or a block, and puts it into the present shape.
#include <utility>

#include "builtins/lists.h"
#include "builtins/ops/shared/joined.h"
#include "geom/mesh/origins.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Merge : uint8_t { Append, Unify, Recompose };

}  // namespace

template <>
struct WordsOf<Merge> {
  static constexpr const char* text = "append unify recompose";
};

namespace {

struct Inline {
  Merge geometryMergeStrategy = Merge::Append;
};

Status beginInline(OpCall& call, const Inline& args) {
  const bool glued = args.geometryMergeStrategy == Merge::Recompose;
  Shape child = call.shape();
  if (glued && child.geometry.kind != GeometryKind::None) {
    Mesh mesh = *meshInScope(child);
    noteOrigins(mesh, 1);
    setMesh(child, std::move(mesh), ScopeFit::Keep);
  }
  uint32_t piece = 0;
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) call.emit(child, item.slot, piece++);
  }
  call.gather(glued);
  return {};
}

Status joinShapes(Shape& s, const Parts& parts, Merge merge, Services& services) {
  Joiner joiner(services, parts);
  JoinedMesh joined = joiner.join(s.scope, parts);
  if (merge == Merge::Unify) {
    if (Status status = unify(joined, services); !status.ok()) return status;
  }
  joiner.giveMaterials(s);
  giveAttributes(s, parts);
  s.geometry = {};
  if (!joined.mesh.empty()) setMesh(s, std::move(joined.mesh), ScopeFit::Refit);
  return {};
}

void takeWithoutOrigins(Shape& s, const Shape& other) {
  take(s, other);
  if (s.geometry.kind != GeometryKind::Mesh) return;
  Mesh mesh = *meshInScope(s);
  if (originLevels(mesh) == 0) return;
  dropOrigins(mesh, originLevels(mesh) - 1);
  setMesh(s, std::move(mesh), ScopeFit::Keep);
}

Status finishInline(OpCall& call, std::span<Gathered> leaves) {
  Inline args;
  if (Status status = call.bind(&args); !status.ok()) return status;
  if (args.geometryMergeStrategy == Merge::Recompose) {
    const bool one = leaves.size() == 1 && !isDeleted(leaves[0].shape);
    if (one) {
      leaves[0].taken = true;
      takeWithoutOrigins(call.shape(), leaves[0].shape);
    } else {
      recompose(call.shape(), nullptr, leaves, call.services());
    }
    return {};
  }
  Parts parts;
  for (Gathered& leaf : leaves) {
    leaf.taken = true;
    if (leaf.shape.geometry.kind != GeometryKind::None) parts.push_back(&leaf.shape);
  }
  Shape& s = call.shape();
  if (parts.size() > 1) return joinShapes(s, parts, args.geometryMergeStrategy, call.services());
  if (parts.empty()) {
    s.geometry = {};
  } else {
    take(s, *parts[0]);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Inline::geometryMergeStrategy>(
        "geometryMergeStrategy",
        "append: all faces as they are, side by side; unify: the boolean "
        "union of the shapes; recompose: all faces, which share vertices "
        "and edges where they touch.",
        "append"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"inline",
     "flow",
     "Puts all that a rule, a subdivision or a block makes into one shape, and goes on with it.",
     kSignatures,
     typed<beginInline>,
     BlockKind::Operations,
     kReadsTags,
     kNoParts,
     false,
     false,
     {},
     1,
     finishInline},
};

}  // namespace

extern const OpList kOps_inline;
const OpList kOps_inline = kSpecs;

}  // namespace gable
