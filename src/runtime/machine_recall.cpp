// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The incremental cache in the machine: which calls it is asked about. A call is a part when it
// works in the world, not in the frame of a shared rule (those are found as prototypes), and where
// no operation waits for its leaves. Operations are kept in prototypes as well, but for those that
// ask where in the world they are: a prototype stands in many places.

#include <algorithm>

#include "base/work_count.h"
#include "runtime/key_hash.h"
#include "runtime/machine.h"

namespace gable {

IncrementalCache::Moment Machine::moment() const {
  return {log_.warnings() + strangers_, holes_.portions(), holes_.placed()};
}

// Of the place of a call, where what comes of it depends on that; 0 where it does not. Who has room
// is known by the place, and is the same where what asks for room is.
std::optional<uint64_t> Machine::placeInKey(const Activation& call) const {
  const uint32_t effects = program_.rules[call.rule].reads.effects;
  KeyHash h;
  if ((effects & kReadsPath) != 0) h.add(hashBytes(treeKey()));
  if ((effects & kAsksForRoom) != 0) {
    if (!shared_.roomKey) return {};
    h.add(shared_.roomKey->a);
    h.add(shared_.roomKey->b);
    h.add(uint64_t{info_.index});
    for (const uint32_t step : placePath(activationCount_)) h.add(uint64_t{step});
    h.add(uint64_t{call.steps});
  }
  return (effects & (kReadsPath | kAsksForRoom)) != 0 ? h.key().a | 1 : 0;
}

bool Machine::beginPart(Activation& call) {
  const bool due = !isFirstPass() && worksInTheOpen() && !aborted_;
  if (!due || !incremental_->isRuleDue(call.rule)) return false;
  const std::optional<uint64_t> place = placeInKey(call);
  if (!place) return false;
  const ShareKey key = incremental_->keyOf(
      {call.rule, call.depth, call.shape, stack_.from(call.parameters), locals_, *place});
  if (const RecallPart* const taken = incremental_->beginPart(key, call.rule, moment())) {
    holes_.fill(*taken, prototypes_.placeInUnit(), log_.count());
    tick(0);
    return true;
  }
  call.kept = true;
  return false;
}

// Runs the operation at `i`, or takes what it did the time before.
Status Machine::applyRemembering(OpCall& call, const Instruction& i,
                                 std::span<const Value> arguments, const BlockInput* block) {
  constexpr uint32_t kTold = kReadsContext | kReadsPath | kLabels | kReports | kAsksForRoom;
  const uint32_t at = pcOf(&i);
  const bool split = block && !block->split.items.empty();
  const bool told = (call.spec().effects & kTold) != 0 || call.spec().gathered;
  const bool placed = prototypes_.anyOpen() && (call.spec().effects & kReadsWorld) != 0;
  if (split || told || placed || !incremental_->isOperationDue(at)) return call.run();
  const std::optional<ShareKey> key = incremental_->keyOf(call, arguments, block, locals_);
  if (!key) return call.run();
  if (incremental_->takeOperation(*key, at, call.shape(), children_)) return {};
  const size_t firstChild = children_.size(), firstPiece = pieces_.size();
  const size_t leaves = output_.openLeaves.size();
  const uint64_t warnings = log_.warnings();
  const uint32_t attributes = call.shape().attributes;
  const WorkCount count;
  const Status status = call.run();
  const bool repeatable = status.ok() && !call.dropped() && log_.warnings() == warnings &&
                          !aborted_ && pieces_.size() == firstPiece &&
                          output_.openLeaves.size() == leaves;
  const IncrementalCache::OperationResult result{
      call.shape(), std::span(children_).subspan(firstChild), attributes};
  incremental_->endOperation(*key, at, count.units(), repeatable ? &result : nullptr);
  return status;
}

bool Machine::evaluatesAttribute() const {
  return std::any_of(functions_.begin(), functions_.end(),
                     [](const FunctionFrame& f) { return f.attribute >= 0; });
}

void Machine::noteEffect() {
  if (incremental_ && evaluatesAttribute()) {
    shared_.unrepeatable.store(true, std::memory_order_relaxed);
  }
}

}  // namespace gable
