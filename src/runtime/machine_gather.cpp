// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations that wait for the leaves of their children, in the machine.

#include "program/tag_effects.h"
#include "runtime/machine.h"

namespace gable {

// An operation that declares kReadsTags gets the tags of its leaves.
void Machine::beginGather(const Instruction& i, std::span<const Value> arguments) {
  gathers_.begin({&i,
                  activationCount_ - 1,
                  current().made,
                  flat_,
                  lightPartsAllowed_,
                  {arguments.begin(), arguments.end()},
                  (program_.operations[i.a]->effects & kReadsTags) != 0,
                  program_.operations[i.a]->block == BlockKind::Selectors});
  flat_ = true;
  lightPartsAllowed_ = false;
}

void Machine::leaveGather(const Gathers::Call& call) {
  flat_ = call.flat;
  lightPartsAllowed_ = call.light;
}

void Machine::endGather() {
  Gathers::Ended ended = gathers_.end();
  leaveGather(ended.call);
  const Instruction& i = *ended.call.at;
  Activation& a = current();
  const OpSpec& spec = *program_.operations[i.a];
  const CallPlace place{a.previous.frame, a.previous.size,
                        program_.files[program_.rules[a.rule].file], program_.sites[pcOf(&i)]};
  // Its selectors are those that the leaves came of, leaf by leaf.
  std::vector<SelectorItem> cameOf(ended.leaves.size());
  for (size_t k = 0; k < cameOf.size(); ++k) cameOf[k].slot = ended.slots[k];
  BlockInput block;
  block.slotCount = static_cast<uint32_t>(program_.blocks[i.y - 1].slots.size());
  block.selectors = cameOf;
  OpCall call(spec, a.shape, ended.call.arguments, *this, place, &block);
  instruction_ = &i;
  const Shape before = a.shape;
  const Status status = guarded([&] { return call.runGathered(ended.leaves); });
  if (status.ok()) {
    a.made = ended.call.made;
  } else {
    a.shape = before;
    tellFailure(spec.name, status);
  }
  gathers_.putBack(ended, status.ok());
}

// A limit struck within.
void Machine::dropGathers() {
  while (gathers_.anyOpen()) leaveGather(gathers_.drop());
}

}  // namespace gable
