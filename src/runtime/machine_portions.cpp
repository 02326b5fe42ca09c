// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Portions in the machine: handing over children of a block, and deriving those of another one.

#include "runtime/machine.h"

namespace gable {

// The outermost block with children left that works in the open: its shapes belong to no prototype
// and no operation waits for them. What is outermost is largest, as a rule.
void Machine::offerPortion() {
  const Gathers::Call* const gather = gathers_.anyOpen() ? &gathers_.outermost() : nullptr;
  const bool flat = gather ? gather->flat : flat_;
  const uint32_t end = gather ? gather->activation : activationCount_;
  size_t world = 0;
  for (uint32_t k = 0; k < end; ++k) {
    const Activation& a = activations_[k];
    if (a.boundary && !flat) return;
    if (a.boundary) ++world;
    if (a.childNext < a.childEnd) return offerChildren(k, worlds_.after(world));
  }
}

void Machine::offerChildren(uint32_t index, const Frame& world) {
  Activation& a = activations_[index];
  const bool innermost = index + 1 == activationCount_;
  const Activation* inner = innermost ? nullptr : &activations_[index + 1];
  const uint32_t locals = inner ? inner->localBase : static_cast<uint32_t>(locals_.size());
  const uint32_t frames = inner ? inner->inPlaceBase : inPlace_.size();
  const std::span<const Value> parameters =
      stack_.range(a.parameters, inner ? inner->stackBase : stack_.size());
  if (!portionBase_) {
    auto inputs = incremental_ ? incremental_->inputs() : IncrementalCache::Inputs{};
    portionBase_ =
        portion_
            ? portion_->base
            : std::make_shared<const PortionBase>(PortionBase{info_, nameId_, std::move(inputs)});
  }
  auto p = std::make_unique<Portion>();
  p->base = portionBase_;
  p->attributeValues = attributeValues_.known();
  p->parent = keptShape(a.shape, 0);
  p->rule = a.rule;
  p->block = a.block;
  p->depth = a.depth;
  p->parameters.assign(parameters.begin(), parameters.end());
  p->locals = locals_.first(locals);
  p->inPlace = inPlace_.rulesIn(frames);
  p->world = world;
  p->path = shapePath(index + 1, p->pathLength);
  const uint32_t first = a.childEnd - (a.childEnd - a.childNext + 1) / 2;
  if (a.inPieces) {
    p->plan = a.plan;
    p->plan.first += first - a.childBase;
    p->pieces.assign(pieces_.begin() + first, pieces_.begin() + a.childEnd);
  } else {
    for (uint32_t c = first; c < a.childEnd; ++c) {
      p->children.push_back(keptShape(children_[c].shape, children_[c].slot));
      children_[c].shape = Shape{};
    }
  }
  p->place = placePath(index + 1);
  p->asked = a.asked;
  p->firstStep = a.asked ? a.stepBase : a.stepBase + first - a.childBase;
  a.childEnd = first;
  holes_.leave(index, shared_.portions->push(std::move(p)));
}

void Machine::run(const Portion& portion) {
  const WorkScope scope(*this);
  const uint64_t shapesBefore = tally_.expanded();
  beginUnit();
  portion_ = &portion;
  endUnit(guarded([&] {
    beginPortion(portion);
    return Status();
  }));
  closeUnit(*portion.unit, portion.base->name, shapesBefore);
  portion_ = nullptr;
}

void Machine::beginPortion(const Portion& p) {
  info_ = p.base->info;
  clearStacks();
  worlds_.begin(p.world);
  attributeValues_ = p.attributeValues;
  if (incremental_) incremental_->begin(p.base->inputs);
  locals_ = p.locals;
  for (const Value& v : p.parameters) push(v);
  pieces_ = p.pieces;
  for (const KeptShape& c : p.children) {
    children_.push_back({takenShape(c, c.shape.locals), c.slot});
  }
  // It stands for the one that was divided: nothing of it but its children is done here.
  Activation& a = pushActivation();
  a = Activation{};
  a.shape = takenShape(p.parent, p.parent.shape.locals);
  a.rule = p.rule;
  a.block = p.block;
  a.depth = p.depth;
  a.plan = p.plan;
  a.stepBase = p.firstStep;
  a.asked = p.asked;
  a.slot = true;
  a.stackBase = stack_.size();
  a.inPieces = !pieces_.empty();
  a.childEnd = static_cast<uint32_t>(a.inPieces ? pieces_.size() : children_.size());
  resume();
  execute();
}

}  // namespace gable
