// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/machine.h"

namespace gable {

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
