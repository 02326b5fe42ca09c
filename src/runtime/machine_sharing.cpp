// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Calls of shared rules in the machine: they work in a frame of their own, and become prototypes
// where sharing is on.

#include "base/small_buffer.h"
#include "program/tag_effects.h"
#include "runtime/machine.h"
#include "runtime/sharing.h"

namespace gable {

ShareKey Machine::keyOf(const Activation& call) {
  const Dependence& reads = program_.rules[call.rule].reads;
  const Shape& s = call.shape;
  SmallBuffer<Value, 8> read;
  for (const uint32_t a : reads.attributes) {
    const Value* set = locals_.find(s.locals, a);
    if (!set && s.attributes) set = attributes().find(s.attributes, a);
    read.push_back(set ? *set : evaluateAttribute(a));
  }
  const uint64_t code = incremental_ ? shared_.reach[call.rule].code : uint64_t{call.rule};
  return sharedKey(
      {code, reads.effects, s, stack_.from(call.parameters), {read.begin(), read.size()}});
}

// True when the result is known already and its instance has been made.
bool Machine::beginShared(const RuleCode& rule, Activation& call) {
  const Frame outer = call.shape.scope;
  // The operation that gathers what comes of the call may read the tags that the rule does not.
  const uint32_t gathered = gathers_.anyOpen() ? kReadsTags : 0u;
  putIntoOwnFrame(call.shape, rule.reads.effects | gathered, outer);
  if (flat_) {
    call.boundary = true;
    worlds_.open(outer);
    return false;
  }
  const ShareKey key = keyOf(call);
  if (aborted_) return false;
  std::optional<uint32_t> known = prototypes_.find(key);
  if (known)
    ++cacheHits_;
  else if (incremental_ && !isFirstPass())
    known = incremental_->takePrototype(key, call.rule, call.shape.attributes);
  if (known) {
    // The call itself has been counted already.
    tally_.countExpanded(prototypes_.finished(*known).range.shapes - 1);
    prototypes_.place(*known, outer);
    return true;
  }
  call.boundary = true;
  worlds_.open(outer);
  prototypes_.begin(key, rule.name, outer, tally_.expanded() - 1, call.shape.attributes);
  return false;
}

// An initial shape is as one before it: same rule, geometry, scope and attributes, and the rule
// sees nothing else. Its result is that of the other.
bool Machine::takeEqualRoot(const Activation& root) {
  const ShareKey key = keyOf(root);
  const bool spoke = output_.openEvents.size() > prototypes_.unitMark().events;
  if (aborted_ || spoke) return false;
  rootKey_ = rootKey(key, root.shape.scope, nameId_);
  equalRoot_ = prototypes_.find(rootKey_);
  if (!equalRoot_) return false;
  ++cacheHits_;
  // The initial shape itself has been counted already.
  tally_.countExpanded(prototypes_.finished(*equalRoot_).range.shapes - 1);
  return true;
}

void Machine::endShared() {
  worlds_.close();
  if (!flat_) prototypes_.end(tally_.expanded(), !aborted_);
}

}  // namespace gable
