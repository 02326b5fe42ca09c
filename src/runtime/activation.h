// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Activation: one rule call or block slot in progress, on the machine's stack.
#pragma once

#include <cstdint>

#include "program/program.h"
#include "runtime/derive.h"
#include "runtime/room.h"
#include "shape/part.h"
#include "shape/shape.h"

namespace gable {

/// Of the shape below on the shape stack: what a rule can still ask of it.
struct PreviousScope {
  Frame frame;
  Vec3 size;
};

struct Activation {
  Shape shape;
  const Instruction* pc = nullptr;
  uint32_t rule = 0;
  /// Parameters begin here on the value stack; slots use those of their rule.
  uint32_t parameters = 0;
  /// The value stack is cut to this when the activation ends.
  uint32_t stackBase = 0;
  uint32_t shapeStackBase = 0;
  /// What the activation does in place, and the local values that it binds, begin here.
  uint32_t inPlaceBase = 0, localBase = 0;
  /// Children of a block that wait for their turn: pieces that the plan makes shapes of, or shapes.
  uint32_t childBase = 0, childNext = 0, childEnd = 0;
  uint32_t block = 0;
  bool inPieces = false;
  PartPlan plan;
  /// The activation of the rule call that a slot belongs to (itself for a rule call), and the
  /// number of the call among its parent's children.
  uint32_t owner = 0, ordinal = 0;
  /// In a rule call: children made by it and its slots.
  uint32_t childCount = 0;
  /// Its number among the children of the activation below, and how many it has begun itself: where
  /// it stands in the tree (Machine::placePath). Alike in both passes of a derivation.
  uint32_t step = 0, steps = 0;
  /// The number of the first child of the block at work. Where the block is that of a shape which
  /// asked for room, the number of that question instead: its children are numbered by their slots.
  uint32_t stepBase = 0;
  bool asked = false;
  /// Of a child of such a block.
  static constexpr uint32_t kNoQuestion = 0xffffffff;
  uint32_t question = kNoQuestion;
  /// In the first pass: the claim that the block at work belongs to (none where the call was
  /// refused), the slot for shapes that have room, and on what it depends that there is this
  /// activation.
  static constexpr uint32_t kNoClaim = 0xffffffff;
  uint32_t claim = kNoClaim, roomSlot = 0;
  RoomCondition condition = kAlways;
  /// Children made so far; none at the end makes the shape a leaf.
  uint32_t made = 0;
  uint32_t depth = 0;
  uint32_t traceNode = TraceNode::kNone;
  bool slot = false;
  /// The call opened a frame of its own (a shared rule), and with sharing a prototype.
  bool boundary = false;
  /// The result is to be remembered.
  bool kept = false;
  /// Kept up only where the rule reads it (RuleCode::needsPrevious).
  PreviousScope previous;

  /// The shape as it is now is the one below for what comes.
  void keepScope() { previous = {shape.scope, shape.size}; }
};

}  // namespace gable
