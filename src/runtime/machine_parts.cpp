// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/machine.h"
#include "runtime/sharing.h"
#include "shape/part_place.h"

namespace gable {

// A part that is like the one before, for a shared rule that sees no more of it, is another
// instance of what became of that one.
void Machine::placeEqualParts(Activation& a) {
  if (flat_ || !lightPartsAllowed_ || a.childNext == a.childBase) return;
  const SplitPiece& before = pieces_[a.childNext - 1];
  const RuleCode* taker = lightParts_.slot(a.block, a.rule, before.slot).taker;
  if (!taker) return;
  while (a.childNext < a.childEnd) {
    const SplitPiece& piece = pieces_[a.childNext];
    if (piece.slot != before.slot) return;
    if (!areAlike(a.shape, taker->reads.effects, a.plan, before, piece)) return;
    ++a.childNext;
    if (!countShape()) return;
    ++activations_[a.owner].childCount;
    ++cacheHits_;
    const uint32_t prototype = prototypes_.placeAgain(originOfPart(a.shape, a.plan, piece));
    tally_.countExpanded(prototypes_.finished(prototype).range.shapes - 1);
  }
}

// Makes parts of the current block as long as they are light.
void Machine::makeLightParts(Activation& a) {
  while (lightPartsAllowed_ && a.childNext < a.childEnd) {
    const LightParts::Parent parent{a.shape,
                                    a.plan,
                                    worlds_.ofLeaves(),
                                    a.rule,
                                    a.block,
                                    a.depth,
                                    &activations_[a.owner].childCount};
    a.childNext += static_cast<uint32_t>(
        lightParts_.make(parent, {pieces_.data() + a.childNext, a.childEnd - a.childNext}));
    if (!tally_.isLookDue() || !tick(0)) return;
  }
}

}  // namespace gable
