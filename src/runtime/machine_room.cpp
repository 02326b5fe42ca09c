// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Room in the machine: where a shape stands in the tree, claims in the first pass, answers in the
// second.

#include "runtime/machine.h"

namespace gable {

// A shape that asked for room counts as one level, and its slot as the next: what comes of either
// way has the numbers that it would have without the other.
PlacePath Machine::placePath(uint32_t end) const {
  PlacePath out;
  if (portion_) out = portion_->place;
  for (uint32_t i = 1; i < end; ++i) {
    const Activation& a = activations_[i];
    if (a.question != Activation::kNoQuestion) out.push_back(a.question);
    out.push_back(a.step);
  }
  return out;
}

void Machine::placeChild(const Activation& parent, uint32_t number, uint32_t slot,
                         Activation& child) {
  child.steps = 0;
  child.step = parent.asked ? slot : parent.stepBase + number - parent.childBase;
  child.question = parent.asked ? parent.stepBase : Activation::kNoQuestion;
  child.condition = parent.condition;
  if (parent.asked && shared_.collectClaims && parent.claim != Activation::kNoClaim) {
    child.condition = conditionOf(parent.claim, slot == parent.roomSlot);
    if (slot != parent.roomSlot) claims_.goesOnOtherwise(parent.claim);
  }
}

Room Machine::answerRoom(const RoomRequest& request, const Shape& shape) {
  Activation& a = current();
  PlacePath path = placePath(activationCount_);
  path.push_back(a.steps);
  if (shared_.collectClaims) {
    RoomClaims::Claim claim{.initialShape = info_.index, .condition = a.condition, .asks = true};
    claim.byHeight = request.byHeight;
    claim.group = request.group;
    claim.clearance = request.clearance;
    claim.rank = request.rank;
    claim.span = here();
    a.claim = claims_.add(claim, path, shape, worlds_.present());
    a.roomSlot = request.slot;
    return Room::Unknown;
  }
  Room answer = Room::Unknown;
  if (shared_.rooms) {
    answer = shared_.rooms->answer(info_.index, path, worlds_.present().point(shape.scope.origin),
                                   shape.size);
  }
  if (answer != Room::Unknown) return answer;
  ++strangers_;
  return Room::Taken;
}

bool Machine::isLeftOut(uint32_t rule) const {
  constexpr uint32_t kTaken = kAsksForRoom | kLabels;
  return claimsOnly_ && (program_.rules[rule].reads.effects & kTaken) == 0 && !gathers_.anyOpen();
}

// The shape at work has made something, and nothing comes of it.
void Machine::leaveOut(uint32_t argumentCount) {
  Activation& a = current();
  ++a.made;
  ++a.steps;
  ++activations_[a.owner].childCount;
  stack_.cut(stack_.size() - argumentCount);
}

}  // namespace gable
