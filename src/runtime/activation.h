// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Activation: one rule call or block slot in progress, on the machine's stack.
#pragma once

#include <cstdint>

#include "program/program.h"
#include "runtime/derive.h"
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
