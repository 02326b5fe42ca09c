// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/light_parts.h"

#include <optional>

namespace gable {

namespace {

// Splits within splits deeper than this are not worth following.
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

size_t LightParts::make(const Parent& parent, std::span<const SplitPiece> pieces) {
  const Shape& s = parent.shape;
  const bool plain = s.geometry.kind != GeometryKind::None && s.size.x >= 0 && s.size.y >= 0 &&
                     s.size.z >= 0 && s.assetMaterials == 0;
  if (!plain || pieces.empty()) return 0;
  const std::vector<LightSlot>& slots = slots_.of(parent.block, parent.rule);
  // Only a part that is light needs to know where the parent lies.
  if (!slots[pieces[0].slot].light) return 0;
  const Frame& world = flat_ ? parent.world : kOwnFrame;
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
  const Source source{world,
                      world.origin,
                      s.scope,
                      s.scope.origin,
                      turnedLeaf ? &*turnedLeaf : &worldLeaf,
                      &worldLeaf,
                      directionOf(s.scope, parent.plan.axis),
                      s.size,
                      s.geometry.kind,
                      trimmed ? &trim : nullptr,
                      parent.childCount};
  for (size_t made = 0; made < pieces.size(); ++made) {
    const LightSlot& slot = slots[pieces[made].slot];
    if (!slot.light || tally_.isLookDue()) return made;
    const size_t leaves = output_.openLeaves.size();
    const Tally::Mark mark = tally_.mark();
    const uint32_t childCount = *parent.childCount;
    if (makePart(source, parent.plan, pieces[made], slot, parent.depth, 0)) continue;
    output_.openLeaves.resize(leaves);
    tally_.goBack(mark);
    *parent.childCount = childCount;
    return made;
  }
  return pieces.size();
}

// The steps of a part in the frame that they work in, and then its leaf, or its parts. False when
// it has to be done the long way; what was written until then is the caller's to drop.
bool LightParts::makePart(const Source& from, const PartPlan& plan, const SplitPiece& piece,
                          const LightSlot& slot, uint32_t depth, uint32_t nested) {
  depth += slot.calls;
  if (depth > limits_.depth) return false;
  LightPart part{&from.axes, from.origin + from.along * piece.start, from.size, from.kind, false,
                 from.trim};
  part.size[static_cast<size_t>(plan.axis)] = plan.flat ? 0 : piece.size;
  if (from.childCount && (slot.calls > 0 || slot.named)) ++*from.childCount;
  Place place{from.place, from.leaf};
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
  if (slot.block > 0) return splitPart(from, place, part, slot, depth, nested);
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

bool LightParts::splitPart(const Source& from, const Place& place, const LightPart& part,
                           const LightSlot& slot, uint32_t depth, uint32_t nested) {
  const uint32_t block = slot.block - 1u;
  const SplitMemo& memo = splits_.memo(block);
  const bool known = nested < kMostNested && memo.known && memo.givenOutOf == part.kind &&
                     !part.uv && part.size[static_cast<size_t>(memo.plan.axis)] == memo.whole &&
                     memo.pieces.size() <= limits_.width;
  if (!known) return false;
  const Source inner{from.world,
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
  const std::vector<LightSlot>& slots = slots_.of(block, slot.rule);
  for (const SplitPiece& piece : memo.pieces) {
    const LightSlot& next = slots[piece.slot];
    if (!next.light || !makePart(inner, memo.plan, piece, next, depth, nested + 1)) {
      return false;
    }
  }
  return true;
}

}  // namespace gable
