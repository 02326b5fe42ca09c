// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Light parts. Most leaves of a facade come of rules like
//
//   Bay   --> split(x) { 0.15 : Frame | ~1 : Glass. | 0.15 : Frame }
//   Frame --> s('1, '1, 0.2) primitiveCube()
//
// whose code is a straight line of plain operations with constant arguments, and perhaps a split by
// constant sizes at its end. Such parts are never made as shapes: the steps run on a LightPart, a
// few numbers, and write the leaf. What they cannot do (a size of zero, a box that a trim plane
// meets, a length that was not divided before) is done the long way, part by part, and both ways
// give the same leaves, counts and numbers of children.

#include <algorithm>
#include <optional>

#include "runtime/door.h"
#include "runtime/machine.h"

namespace gable {

namespace {

// Chains of calls and splits within splits longer than this are not worth following.
constexpr uint8_t kMostCalls = 8;
constexpr uint32_t kMostNested = 8;

// The frame of a rule that works in its own: the local one.
constexpr Frame kOwnFrame{};

uint32_t unitMesh(GeometryKind kind, bool uv) {
  switch (kind) {
    case GeometryKind::QuadXy: return uv ? kUnitQuadXyUv : kUnitQuadXy;
    case GeometryKind::QuadXz: return uv ? kUnitQuadXzUv : kUnitQuadXz;
    default: return uv ? kUnitBoxUv : kUnitBox;
  }
}

}  // namespace

// A split that ends its code and has nothing to be computed.
bool Machine::isPlainSplit(const Instruction& at) const {
  if (!flat_ || at.code != Code::OperationConstant || at.y == 0) return false;
  const BlockCode& block = program_.blocks[at.y - 1u];
  return block.kind == BlockKind::Split && !block.constantSizes.empty() &&
         (&at)[2].code == Code::End;
}

Machine::LightSlot Machine::lightSlot(uint32_t rule, uint32_t entry) const {
  LightSlot slot;
  slot.rule = rule;
  slot.name = program_.rules[rule].name;
  slot.source = program_.rules[rule].entry;
  const Instruction* at = program_.code.data() + entry;
  for (;; ++at) {
    switch (at->code) {
      case Code::Operation:
      case Code::OperationConstant: {
        if (isPlainSplit(*at)) {
          slot.block = at->y;
          slot.light = true;
          return slot;
        }
        const OpSpec& spec = *program_.operations[at->a];
        if (!spec.light.apply || at->y > 0) return {};
        if (at->code == Code::Operation && at->x > 0) return {};
        const Value* args = at->x > 0 ? program_.constants.data() + at[1].a : nullptr;
        if (!allHold({args, at->x}, pool())) return {};
        LightSlot::Step step;
        step.apply = spec.light.apply;
        spec.light.construct(step.arguments);
        const ArgumentProblem problem =
            bindArguments(spec.signatures, program_.operations[at->a].form, {args, at->x}, pool(),
                          step.arguments);
        if (problem.kind != ArgumentProblem::Kind::None) return {};
        slot.steps.push_back(step);
        if (at->code == Code::OperationConstant) ++at;
        break;
      }
      case Code::CallRule: {
        const RuleCode& called = program_.rules[at->a];
        if (at->x > 0 || at[1].code != Code::End || called.needsPrevious || slot.boundary ||
            slot.calls == kMostCalls) {
          return {};
        }
        // The steps behind it work in the rule's own frame.
        if (called.shared && (!flat_ || !slot.steps.empty())) return {};
        slot.boundary = called.shared;
        ++slot.calls;
        slot.rule = at->a;
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

const std::vector<Machine::LightSlot>& Machine::lightSlots(uint32_t block, uint32_t rule) {
  std::vector<LightSlot>& slots = splits_[block].slots;
  if (slots.empty()) {
    for (uint32_t entry : program_.blocks[block].slots) {
      LightSlot slot = lightSlot(rule, entry);
      const uint32_t own = slot.named ? 1 : 0;
      slot.shapes = slot.block > 0 ? slot.calls : std::max<uint32_t>(slot.calls + own, 1);
      slot.work = slot.shapes + static_cast<uint32_t>(slot.steps.size()) + (slot.block > 0 ? 1 : 0);
      slots.push_back(std::move(slot));
    }
  }
  return slots;
}

// Makes parts of the current block as long as they are light.
void Machine::makeLightParts(Activation& a) {
  const Shape& s = a.shape;
  const bool plain = lightPartsAllowed_ && s.geometry.kind != GeometryKind::None && s.size.x >= 0 &&
                     s.size.y >= 0 && s.size.z >= 0 && s.assetMaterials == 0;
  if (!plain || a.childNext == a.childEnd) return;
  const std::vector<LightSlot>& slots = lightSlots(a.block, a.rule);
  // Only a part that is light needs to know where the parent lies.
  if (!slots[pieces_[a.childNext].slot].light) return;
  const Frame& world = flat_ ? worlds_.ofLeaves() : kOwnFrame;
  Leaf worldLeaf;
  worldLeaf.frame = world;
  worldLeaf.materials = output_.materialNumber(s.material, 0);
  worldLeaf.attributes = s.attributes;
  std::optional<Leaf> turnedLeaf;
  if (s.scope.turned) turnedLeaf.emplace(worldLeaf).frame = world * s.scope;
  LightPlanes planes;
  const bool trimmed = s.extra && !s.extra->trim.empty();
  if (trimmed) findLightPlanes(s, planes);
  const LightTrim trim{{planes.begin(), planes.size()}, &s.scope, {}};
  const LightSource source{world,
                           world.origin,
                           s.scope,
                           s.scope.origin,
                           turnedLeaf ? &*turnedLeaf : &worldLeaf,
                           &worldLeaf,
                           directionOf(s.scope, a.plan.axis),
                           s.size,
                           s.geometry.kind,
                           trimmed ? &trim : nullptr,
                           &activations_[a.owner].childCount};
  while (a.childNext < a.childEnd) {
    const SplitPiece& piece = pieces_[a.childNext];
    const LightSlot& slot = slots[piece.slot];
    if (!slot.light) return;
    const LightMark mark{output_.openLeaves.size(), tally_.mark(), *source.childCount};
    if (!makeLightPart(source, a.plan, piece, slot, a.depth, 0)) {
      output_.openLeaves.resize(mark.leaves);
      tally_.goBack(mark.tally);
      *source.childCount = mark.childCount;
      return;
    }
    ++a.childNext;
    if (!tick(0)) return;
  }
}

// The steps of a part in the frame that they work in, and then its leaf, or its parts. False when
// it has to be done the long way; what was written until then is the caller's to drop.
bool Machine::makeLightPart(const LightSource& from, const PartPlan& plan, const SplitPiece& piece,
                            const LightSlot& slot, uint32_t depth, uint32_t nested) {
  depth += slot.calls;
  if (depth > options().limits.depth) return false;
  LightPart part{&from.axes, from.origin + from.along * piece.start, from.size, from.kind, false,
                 from.trim};
  part.size[static_cast<size_t>(plan.axis)] = plan.flat ? 0 : piece.size;
  if (from.childCount && (slot.calls > 0 || slot.named)) ++*from.childCount;
  LightPlace place{from.place, from.leaf};
  // The rule's frame has the world's axes when the scope has the local ones.
  if (slot.boundary && from.axes.turned) return false;
  std::optional<LightTrim> trim;
  if (slot.boundary) {
    place.origin += from.world.direction(part.origin);
    place.leaf = from.worldLeaf;
    if (part.trim && isFarFromTrim(part)) part.trim = nullptr;
    if (part.trim) {
      trim = LightTrim{part.trim->planes, nullptr, part.trim->there(part.origin)};
      part.trim = &*trim;
    }
    part.parent = &kOwnFrame;
    part.origin = {};
  }
  for (const LightSlot::Step& step : slot.steps) {
    if (!step.apply(part, step.arguments)) return false;
  }
  tally_.countShapes(slot.shapes);
  tally_.countSteps(slot.work);
  if (slot.drop) return true;
  if (slot.block > 0) return splitLightPart(from, place, part, slot, depth, nested);
  // Completed where it stays: a copy of what was just written would wait for its stores.
  output_.openLeaves.push_back(*place.leaf);
  Leaf& leaf = output_.openLeaves.back();
  leaf.frame.origin = flat_ ? place.origin + from.world.direction(part.origin) : part.origin;
  leaf.scale = part.size;
  leaf.mesh = unitMesh(part.kind, part.uv);
  leaf.name = slot.name;
  leaf.source = slot.source;
  return true;
}

bool Machine::splitLightPart(const LightSource& from, const LightPlace& place,
                             const LightPart& part, const LightSlot& slot, uint32_t depth,
                             uint32_t nested) {
  const uint32_t block = slot.block - 1u;
  const SplitMemo& memo = splits_[block].memo;
  const bool known = nested < kMostNested && memo.known && memo.givenOutOf == part.kind &&
                     !part.uv && part.size[static_cast<size_t>(memo.plan.axis)] == memo.whole &&
                     memo.pieces.size() <= options().limits.width;
  if (!known) return false;
  const LightSource inner{from.world,
                          place.origin,
                          *part.parent,
                          part.origin,
                          place.leaf,
                          from.worldLeaf,
                          directionOf(*part.parent, memo.plan.axis),
                          part.size,
                          part.kind,
                          part.trim,
                          slot.calls > 0 ? nullptr : from.childCount};
  const std::vector<LightSlot>& slots = lightSlots(block, slot.rule);
  for (const SplitPiece& piece : memo.pieces) {
    const LightSlot& next = slots[piece.slot];
    if (!next.light || !makeLightPart(inner, memo.plan, piece, next, depth, nested + 1)) {
      return false;
    }
  }
  return true;
}

}  // namespace gable
