// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Light parts. Most leaves of a facade come of a part of a split by a slot like
//
//   0.15 : Frame          Frame --> s('1, '1, 0.2) primitiveCube()
//
// whose code is a straight line of plain operations with constant arguments. Such parts are never
// made as shapes: the steps run on a LightPart, a few numbers, and write the leaf. What they cannot
// do (a size of zero, a box that a trim plane meets) is done the long way, part by part, and both
// ways give the same leaves, counts and numbers of children.

#include "runtime/machine.h"

namespace gable {

namespace {

// A chain of calls longer than this is not worth following.
constexpr uint8_t kMostCalls = 8;

uint32_t unitMesh(GeometryKind kind, bool uv) {
  switch (kind) {
    case GeometryKind::QuadXy: return uv ? kUnitQuadXyUv : kUnitQuadXy;
    case GeometryKind::QuadXz: return uv ? kUnitQuadXzUv : kUnitQuadXz;
    default: return uv ? kUnitBoxUv : kUnitBox;
  }
}

}  // namespace

Machine::LightSlot Machine::lightSlot(uint32_t rule, uint32_t entry) const {
  LightSlot slot;
  slot.name = program_.rules[rule].name;
  slot.source = program_.rules[rule].entry;
  const Instruction* at = program_.code.data() + entry;
  for (;; ++at) {
    switch (at->code) {
      case Code::Operation:
      case Code::OperationConstant: {
        const OpSpec& spec = *program_.operations[at->a];
        if (!spec.applyLight || at->y > 0) return {};
        if (at->code == Code::Operation && at->x > 0) return {};
        const Value* args = at->x > 0 ? &program_.constants[at[1].a] : nullptr;
        slot.steps.push_back({spec.applyLight, {args, at->x}});
        if (at->code == Code::OperationConstant) ++at;
        break;
      }
      case Code::CallRule: {
        const RuleCode& called = program_.rules[at->a];
        if (at->x > 0 || at[1].code != Code::End || called.shared || called.needsPrevious ||
            slot.calls == kMostCalls) {
          return {};
        }
        ++slot.calls;
        slot.name = called.name;
        slot.source = called.entry;
        at = program_.code.data() + called.entry - 1;
        break;
      }
      case Code::Leaf:
        if (at[1].code != Code::End) return {};
        slot.named = true;
        slot.name = program_.constants[at->a].id;
        slot.source = pcOf(at);
        slot.light = true;
        return slot;
      case Code::Drop: slot.drop = true; [[fallthrough]];
      case Code::End: slot.light = true; return slot;
      default: return {};
    }
  }
}

// Makes parts of the current block as long as they are light.
void Machine::makeLightParts(Activation& a) {
  const Shape& s = a.shape;
  const bool plain = lightPartsAllowed_ && s.geometry.kind != GeometryKind::None && s.size.x >= 0 &&
                     s.size.y >= 0 && s.size.z >= 0 && s.assetMaterials == 0;
  if (!plain) return;
  std::vector<LightSlot>& slots = splits_[a.block].slots;
  if (slots.empty()) {
    for (uint32_t entry : program_.blocks[a.block].slots) {
      slots.push_back(lightSlot(a.rule, entry));
    }
  }
  // Only the first part that is light needs to know where the parent lies.
  if (a.childNext == a.childEnd || !slots[pieces_[a.childNext].slot].light) return;
  const LightRun run{flat_ && !s.scope.turned ? worlds_.back()
                     : flat_                  ? worlds_.back() * s.scope
                                              : s.scope,
                     directionOf(s, a.plan.axis), output_.materialNumber(s.material, 0)};
  while (a.childNext < a.childEnd) {
    const SplitPiece& piece = pieces_[a.childNext];
    const LightSlot& slot = slots[piece.slot];
    if (!slot.light || !makeLightPart(a, run, piece, slot)) return;
    ++a.childNext;
  }
}

bool Machine::makeLightPart(Activation& a, const LightRun& run, const SplitPiece& piece,
                            const LightSlot& slot) {
  if (a.depth + slot.calls > options().limits.depth) return false;
  const Shape& s = a.shape;
  LightPart part{s, s.scope.origin + run.along * piece.start, s.size, s.geometry.kind};
  part.size[static_cast<size_t>(a.plan.axis)] = a.plan.flat ? 0 : piece.size;
  for (const LightSlot::Step& step : slot.steps) {
    if (!step.apply(part, step.args)) return false;
  }
  // Each call is a shape, and so is a leaf or an end that belongs to no call.
  const uint32_t shapes = slot.named ? slot.calls + 1u : std::max<uint32_t>(slot.calls, 1);
  shapes_ += shapes;
  shapesExpanded_ += shapes;
  if (slot.calls > 0 || slot.named) ++activations_[a.owner].childCount;
  if (!tick()) return false;
  if (slot.drop) return true;
  Leaf& leaf = output_.openLeaves.emplace_back(run.frame, part.size, unitMesh(part.kind, part.uv),
                                               run.materials, slot.name, slot.source, s.attributes);
  leaf.frame.origin = flat_ ? worlds_.back().point(part.origin) : part.origin;
  passLeaves();
  return true;
}

}  // namespace gable
