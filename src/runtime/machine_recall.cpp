// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recall in the machine: which calls are remembered, under which keys, and what they count.
//
// A call is a part when it works in the world, not in the frame of a shared rule (those are found
// as prototypes), and where no operation waits for its leaves; and when calls of its rule cost
// enough that a key is little beside them. A part that warned is not remembered: the warning would
// be lost.

#include <algorithm>

#include "base/work_count.h"
#include "runtime/key_hash.h"
#include "runtime/machine.h"

namespace gable {

namespace {

/// Steps of a call that is worth a key.
constexpr uint64_t kWorthwhile = 256;
/// Every so often a rule, or an operation, whose calls were small is looked at again.
constexpr uint64_t kBetweenSamples = 16;
/// The work() of an operation that is worth keeping with all that it made: some tenths of a
/// millisecond, where a key takes microseconds.
constexpr uint64_t kMuchWork = 4096;

}  // namespace

void Machine::beginRemembering() {
  inputs_.assign(program_.rules.size(), 0);
  // Nothing has been evaluated yet.
  given_ = attributeValues_.hashes();
  shapeHash_ = hashOfInitialShape();
}

// What rules can ask of the initial shape.
uint64_t Machine::hashOfInitialShape() const {
  KeyHash h;
  h.add(hashBytes(info_.name));
  h.add(hashBytes(info_.startRule));
  h.add(info_.origin);
  h.add(info_.seed);
  h.add(uint64_t{info_.index});
  h.add(info_.shape.path);
  h.add(info_.shape.scope);
  h.add(info_.shape.size);
  h.add(contentHash(info_.shape.geometry));
  return h.key().a;
}

uint64_t Machine::inputsOf(uint32_t rule) {
  uint64_t& known = inputs_[rule];
  if (known != 0) return known;
  const Reach& reach = shared_.reach[rule];
  uint64_t h = hashCombine(reach.code, shapeHash_);
  for (const uint32_t a : reach.attributes) h = hashCombine(h, given_[a]);
  return known = h | 1;
}

void Machine::addShape(KeyHash& h, const Shape& s) const {
  h.add(s.path);
  h.add(uint64_t{s.trimVertical} << 1 | uint64_t{s.trimHorizontal});
  h.add(s.scope);
  h.add(s.size);
  h.add(s.pivot);
  h.add(contentHash(s.geometry));
  h.add(uint64_t{s.material} << 32 | s.assetMaterials);
  h.add(uint64_t{s.attributes} << 32 | s.compSelector);
  h.add(uint64_t{s.split.index} << 32 | s.split.total);
  h.add(uint64_t{s.comp.index} << 32 | s.comp.total);
  locals_.forEach(s.locals, [&](uint32_t attribute, const Value& v) {
    h.add(uint64_t{attribute});
    h.add(v.hash());
  });
  if (s.extra) h.add(*s.extra);
}

ShareKey Machine::partKey(const Activation& call) {
  KeyHash h;
  h.add(inputsOf(call.rule));
  h.add(uint64_t{call.depth});
  addShape(h, call.shape);
  for (uint32_t p = call.parameters; p < stackTop_; ++p) h.add(stack_[p].hash());
  if ((program_.rules[call.rule].reads.effects & kReadsPath) != 0) h.add(hashBytes(treeKey()));
  return h.key();
}

bool Machine::worthKeeping(uint32_t rule) {
  RuleCost& cost = costs_[rule];
  return cost.calls++ % kBetweenSamples == 0 || cost.steps >= kWorthwhile * cost.measured;
}

Output::Mark Machine::placeInRoot() const {
  Output::Mark m = output_.mark();
  m.leaves -= rootMark_.leaves;
  m.instances -= rootMark_.instances;
  m.events -= rootMark_.events;
  return m;
}

bool Machine::beginPart(Activation& call) {
  if (!worksInTheOpen() || aborted_ || !worthKeeping(call.rule)) return false;
  OpenPart open;
  open.part.key = partKey(call);
  if (recaller_) {
    if (const RecallPart* known = recaller_->part(open.part.key)) {
      costs_[call.rule].measured += 1;
      costs_[call.rule].steps += known->steps;
      takePart(*known);
      return true;
    }
  }
  open.part.begin = placeInRoot();
  open.part.holes = static_cast<uint32_t>(holes_.size());
  open.part.firstInside = static_cast<uint32_t>(parts_.size());
  open.part.firstOperation = static_cast<uint32_t>(keptOperations_.size());
  open.part.shapes = tally_.made();
  open.part.shapesExpanded = tally_.expanded();
  open.part.steps = tally_.steps();
  open.rule = call.rule;
  open.warnings = log_.warnings();
  openParts_.push_back(open);
  call.kept = true;
  return false;
}

void Machine::endPart() {
  OpenPart& open = openParts_.back();
  RecallPart& part = open.part;
  part.end = placeInRoot();
  part.endOperation = static_cast<uint32_t>(keptOperations_.size());
  part.shapes = tally_.made() - part.shapes;
  part.shapesExpanded = tally_.expanded() - part.shapesExpanded;
  part.steps = tally_.steps() - part.steps;
  costs_[open.rule].measured += 1;
  costs_[open.rule].steps += part.steps;
  // What a portion made lies elsewhere.
  const bool whole = part.holes == holes_.size();
  if (part.steps >= kWorthwhile && log_.warnings() == open.warnings && whole)
    parts_.push_back(part);
  openParts_.pop_back();
}

// The parts inside come along: the next derivation may know them where it does not know this one.
void Machine::takePart(const RecallPart& known) {
  const Output::Mark now = placeInRoot();
  recaller_->take(known, rootMark_);
  const std::vector<RecallPart>& all = recaller_->recall().parts;
  const auto self = static_cast<uint32_t>(&known - all.data());
  const uint32_t partShift = static_cast<uint32_t>(parts_.size()) - known.firstInside;
  const uint32_t operationShift =
      static_cast<uint32_t>(keptOperations_.size()) - known.firstOperation;
  const auto moved = [&](const Output::Mark& m) {
    return Output::Mark{m.leaves - known.begin.leaves + now.leaves,
                        m.instances - known.begin.instances + now.instances,
                        m.events - known.begin.events + now.events};
  };
  for (uint32_t p = known.firstInside; p <= self; ++p) {
    RecallPart copy = all[p];
    copy.firstInside += partShift;
    copy.firstOperation += operationShift;
    copy.endOperation += operationShift;
    copy.begin = moved(copy.begin);
    copy.end = moved(copy.end);
    copy.holes = static_cast<uint32_t>(holes_.size());
    parts_.push_back(copy);
  }
  tally_.countTaken(known.shapes, known.shapesExpanded);
  recalled_ += known.shapesExpanded;
  for (uint32_t o = known.firstOperation; o < known.endOperation; ++o) {
    keptOperations_.push_back(recaller_->recall().operations[o]);
  }
  countTaken();
  tick(known.steps);
}

bool Machine::addArgument(KeyHash& h, const Value& v) const {
  if (v.type != ValueType::Code) {
    h.add(v.hash());
    return true;
  }
  const ArgumentCode& argument = program_.arguments[v.id];
  h.add(argument.terms.size() << 1 | uint64_t{argument.list});
  for (const ArgumentTerm& t : argument.terms) {
    h.add(static_cast<uint64_t>(t.kind) << 40 | static_cast<uint64_t>(t.unit) << 32 | t.operands);
    h.add(hashBytes(t.spec ? t.spec->name : ""));
    for (const ValueCode& c : t.values) {
      if (!c.isConstant()) return false;
      h.add(c.constant.hash());
    }
  }
  return true;
}

ShareKey Machine::operationKey(OpCall& call, std::span<const Value> arguments,
                               const BlockInput* block) {
  KeyHash h;
  h.add(hashBytes(call.spec().name));
  h.add(hashBytes(call.file()));
  h.add(call.randomAddress(0));
  h.add(shapeHash_);
  h.add(call.previousScope());
  h.add(call.previousSize());
  addShape(h, call.shape());
  for (const Value& v : arguments) {
    if (!addArgument(h, v)) return {};
  }
  if (!block) return h.key();
  for (const uint32_t f : block->figures) {
    if (f == 0) continue;
    const FigureCode& figure = program_.figures[f - 1];
    if (figure.kind != FigureCode::Kind::Figure) return {};
    h.add(hashBytes(figure.spec->name));
    for (const ValueCode& v : figure.values) {
      if (!v.isConstant()) return {};
      h.add(v.constant.hash());
    }
  }
  h.add(uint64_t{block->slotCount});
  for (const SelectorItem& item : block->selectors) {
    h.add(item.terms.size() << 8 | static_cast<uint64_t>(item.op));
    h.add(uint64_t{item.slot});
    for (const SelectorTerm& t : item.terms) {
      h.add(static_cast<uint64_t>(t.kind) << 32 | t.word);
      h.add(t.number);
    }
  }
  for (const auto& size : block->preferredSizes) {
    for (const double v : size) h.add(v);
  }
  return h.key();
}

Status Machine::applyRemembering(OpCall& call, const Instruction& i,
                                 std::span<const Value> arguments, const BlockInput* block) {
  constexpr uint32_t kTold = kReadsContext | kReadsPath | kReports;
  OperationCost& cost = operationCosts_[pcOf(&i)];
  const bool split = block && !block->split.items.empty();
  const bool looked =
      cost.calls++ % kBetweenSamples == 0 || cost.units >= kMuchWork * cost.measured;
  const bool told = (call.spec().effects & kTold) != 0 || call.spec().gathered;
  if (split || !looked || told) return call.run();
  const ShareKey key = operationKey(call, arguments, block);
  // What its arguments say is known only when it asks for it.
  if (key == ShareKey{}) return call.spec().apply(call);
  if (takeOperation(key, call.shape())) {
    // It was much work, or it would not be known.
    cost.units += kMuchWork;
    ++cost.measured;
    return {};
  }
  const size_t firstChild = children_.size(), firstPiece = pieces_.size();
  const uint64_t warnings = log_.warnings();
  const size_t leaves = output_.openLeaves.size();
  const WorkCount count;
  const Status status = call.run();
  const uint64_t units = count.units();
  cost.units += units;
  ++cost.measured;
  const bool repeatable = status.ok() && !call.dropped() && log_.warnings() == warnings &&
                          !aborted_ && pieces_.size() == firstPiece &&
                          output_.openLeaves.size() == leaves;
  if (repeatable && units >= kMuchWork) keepOperation(key, call.shape(), firstChild);
  return status;
}

void Machine::keepOperation(const ShareKey& key, const Shape& shape, size_t firstChild) {
  auto kept = std::make_shared<RecallOperation>();
  kept->key = key;
  kept->shape = keptShape(shape, 0);
  for (size_t c = firstChild; c < children_.size(); ++c) {
    kept->children.push_back(keptShape(children_[c].shape, children_[c].slot));
  }
  keptOperations_.push_back(std::move(kept));
}

bool Machine::takeOperation(const ShareKey& key, Shape& shape) {
  if (!recaller_) return false;
  std::shared_ptr<const RecallOperation> known = recaller_->operation(key);
  if (!known) return false;
  const uint32_t locals = shape.locals;
  for (const KeptShape& child : known->children) {
    children_.push_back({takenShape(child, locals), child.slot});
  }
  shape = takenShape(known->shape, locals);
  keptOperations_.push_back(std::move(known));
  return true;
}

bool Machine::recallPrototype(const ShareKey& key, uint32_t& number) {
  if (!recaller_ || !recaller_->takePrototype(key, number)) return false;
  recalled_ += output_.prototypes[number].range.shapes;
  countTaken();
  return true;
}

void Machine::countTaken() {
  const Recaller::Counts taken = recaller_->counts();
  cacheHits_ += taken.shared;
  tally_.countVertices(taken.vertices);
}

bool Machine::evaluatesAttribute() const {
  return std::any_of(functions_.begin(), functions_.end(),
                     [](const FunctionFrame& f) { return f.attribute >= 0; });
}

void Machine::noteEffect() {
  if (remembers_ && evaluatesAttribute()) {
    shared_.unrepeatable.store(true, std::memory_order_relaxed);
  }
}

}  // namespace gable
