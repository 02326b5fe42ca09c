// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// union, subtract, intersect: each operand is derived at once, its shapes are united, and the
// geometries are combined.
#include <optional>
#include <utility>

#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/joined.h"
#include "builtins/ops/shared/kept_tags.h"
#include "geom/solid/boolean.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class OperandOrder : uint8_t { Plain, Swap };

}  // namespace

template <>
struct WordsOf<OperandOrder> {
  static constexpr const char* text = "plain swap";
};

namespace {

struct Boolean {
  OperandOrder order = OperandOrder::Plain;
};

Status beginBoolean(OpCall& call, const Boolean&) {
  for (uint32_t slot = 0; slot < call.slotCount(); ++slot) call.emit(call.shape(), slot, 0);
  call.gather();
  return {};
}

/// The shapes of both operands.
struct Operands {
  Parts a, b;
};

Operands operandsOf(OpCall& call, const Boolean& args, const Shape& present,
                    std::span<Gathered> leaves) {
  Operands out;
  // With one operand the other is the present shape.
  const bool one = call.slotCount() == 1;
  if (one && present.geometry.kind != GeometryKind::None) out.a.push_back(&present);
  for (size_t k = 0; k < leaves.size(); ++k) {
    leaves[k].taken = true;
    if (leaves[k].shape.geometry.kind == GeometryKind::None) continue;
    const bool second = one || call.selectors()[k].slot == 1;
    (second ? out.b : out.a).push_back(&leaves[k].shape);
  }
  if (args.order == OperandOrder::Swap) std::swap(out.a, out.b);
  return out;
}

// bool.A and bool.B on faces, bool.cut on the edges where the operands meet.
void tagResult(SolidResult& r, const JoinedMesh& both, Services& services) {
  AutoTags tags(services, "bool");
  Mesh& m = r.mesh;
  keepTags(m, both.mesh, services);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    bool of[2] = {false, false};
    of[both.partOf[r.faceSource[f]]] = true;
    TagSetId set = tags.without(m.faces[f].tags);
    for (const uint32_t o : r.faceOthers[f]) {
      of[both.partOf[o]] = true;
      set = tags.merged(set, tags.without(both.mesh.faces[o].tags));
    }
    if (of[0]) set = services.tags().with(set, "bool.A");
    if (of[1]) set = services.tags().with(set, "bool.B");
    m.faces[f].tags = set;
  }
  m.edgeTags.resize(m.corners.size());
  for (size_t c = 0; c < m.corners.size(); ++c) {
    const TagSetId set = tags.without(m.edgeTags[c]);
    m.edgeTags[c] = r.cut[c] ? services.tags().with(set, "bool.cut") : set;
  }
}

template <SolidOp kOp>
Status finishBoolean(OpCall& call, std::span<Gathered> leaves) {
  Boolean args;
  if (Status status = call.bind(&args); !status.ok()) return status;
  Services& services = call.services();
  Shape& s = call.shape();
  const Shape present = s;
  const Operands operands = operandsOf(call, args, present, leaves);
  Parts all = operands.a;
  all.insert(all.end(), operands.b.begin(), operands.b.end());
  if (all.empty()) {
    s.geometry = {};
    return {};
  }
  // The first operand says what shape it is.
  if (operands.a.size() == 1) {
    take(s, *operands.a[0]);
  } else {
    giveAttributes(s, operands.a);
  }
  Joiner joiner(services, all);
  JoinedMesh both;
  for (uint32_t k = 0; k < 2; ++k) {
    const Parts& parts = k == 0 ? operands.a : operands.b;
    JoinedMesh operand = joiner.join(s.scope, parts);
    if (parts.size() > 1) {
      if (Status status = unify(operand, services); !status.ok()) return status;
    }
    append(both.mesh, operand.mesh);
    both.partOf.resize(both.mesh.faceCount(), k);
  }
  std::optional<SolidResult> r = solidBoolean(both.mesh, both.partOf, kOp);
  if (!r) return tooConfused();
  tagResult(*r, both, services);
  joiner.giveMaterials(s);
  s.geometry = {};
  if (!r->mesh.empty()) setMesh(s, std::move(r->mesh), ScopeFit::Refit);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Boolean::order>("order", "swap: the operands change places.", "plain"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec boolean(OpSpec spec, Status (*finish)(OpCall&, std::span<Gathered>)) {
  spec.gathered = finish;
  return heavy(spec);
}

constexpr OpSpec kSpecs[] = {
    boolean({"union", "flow", "Combines two operands: what lies in one of them.", kSignatures,
             typed<beginBoolean>, BlockKind::Operands, kReadsTags},
            finishBoolean<SolidOp::Union>),
    boolean({"subtract", "flow", "Takes the second operand out of the first.", kSignatures,
             typed<beginBoolean>, BlockKind::Operands, kReadsTags},
            finishBoolean<SolidOp::Subtract>),
    boolean({"intersect", "flow", "Combines two operands: what lies in both of them.", kSignatures,
             typed<beginBoolean>, BlockKind::Operands, kReadsTags},
            finishBoolean<SolidOp::Intersect>),
};

}  // namespace

extern const OpList kOps_booleans;
const OpList kOps_booleans = kSpecs;

}  // namespace gable
