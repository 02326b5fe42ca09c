// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sharing: what makes two calls of a rule equal.
//
// A call of a shared rule works in a frame of its own, the scope of the shape it was called on; so
// its result depends on nothing but the inputs that sharedKey() hashes, and equal keys have equal
// results. With sharing on a result becomes a prototype (runtime/prototypes.h) and each call an
// instance; with sharing off the frames are composed in the same order while deriving, which gives
// the same numbers.
#pragma once

#include <cstdint>
#include <span>

#include "program/program.h"
#include "runtime/output.h"
#include "shape/part.h"
#include "shape/shape.h"

namespace gable {

struct SharedCall {
  /// Stands for the rule's code.
  uint64_t code = 0;
  /// What the rule depends on; see Effect.
  uint32_t effects = 0;
  /// In its own frame.
  const Shape& shape;
  std::span<const Value> arguments;
  /// The values of the attributes that the rule reads, in their order.
  std::span<const Value> attributes;
};

ShareKey sharedKey(const SharedCall& call);

/// The key of an initial shape of that name, from that of its start rule. It works in its own
/// frame, in which `scope` lies.
ShareKey rootKey(const ShareKey& call, const Frame& scope, StringId name);

/// Whether calls of a rule with these effects, which draws, are shared where a rule has chosen the
/// address of the shape (shape/seeded_path.h): then the address is part of the key.
bool isSharedWhenSeeded(uint32_t effects);

/// Puts a shape into `outer`, the frame of its own scope, and drops what a rule with these effects
/// cannot see.
void putIntoOwnFrame(Shape& shape, uint32_t effects, const Frame& outer);

/// Whether two parts of a shape have the same key, for a rule with these effects that sees neither
/// their number nor their place: they are equally large, and have the same trim planes and, where
/// the rule reads them, tags.
bool areAlike(const Shape& parent, uint32_t effects, const PartPlan& plan, const SplitPiece& a,
              const SplitPiece& b);

}  // namespace gable
