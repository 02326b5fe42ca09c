// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/incremental_cache.h"

#include <algorithm>

#include "runtime/key_hash.h"
#include "shape/edge_attributes.h"
#include "shape/geo_frame.h"

namespace gable {

namespace {

/// Steps of a call that is worth a key.
constexpr uint64_t kManySteps = 256;
/// The work() of an operation that is worth keeping, for each shape that it makes: some hundredths
/// of a millisecond, where a key takes a microsecond or two, and a shape a kilobyte.
constexpr uint64_t kMuchWork = 512;
/// Of more shapes it is the work for all of them that counts.
constexpr uint64_t kFewShapes = 8;
/// Every so often what was small is looked at again.
constexpr uint64_t kBetweenSamples = 16;

void addShape(KeyHash& h, const Shape& s, const LocalValues& locals) {
  h.add(s.path);
  h.add(uint64_t{s.trimVertical} << 1 | uint64_t{s.trimHorizontal});
  h.add(s.scope);
  h.add(s.size);
  h.add(s.pivot);
  h.add(contentHash(s.geometry));
  h.add(uint64_t{s.material} << 32 | s.assetMaterials);
  h.add(uint64_t{s.compSelector});
  h.add(uint64_t{s.split.index} << 32 | s.split.total);
  h.add(uint64_t{s.comp.index} << 32 | s.comp.total);
  locals.forEach(s.locals, [&](uint32_t attribute, const Value& v) {
    h.add(uint64_t{attribute});
    h.add(v.hash());
  });
  if (s.extra) h.add(*s.extra);
}

// False when it takes code to know what the argument says.
bool addArgument(KeyHash& h, const Value& v, const Program& program) {
  if (v.type != ValueType::Code) {
    h.add(v.hash());
    return true;
  }
  const ArgumentCode& argument = program.arguments[v.id];
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

bool addFigure(KeyHash& h, const FigureCode& figure) {
  if (figure.kind != FigureCode::Kind::Figure) return false;
  h.add(hashBytes(figure.spec->name));
  for (const ValueCode& v : figure.values) {
    if (!v.isConstant()) return false;
    h.add(v.constant.hash());
  }
  return true;
}

bool addBlock(KeyHash& h, const BlockInput& block, const Program& program) {
  for (const uint32_t f : block.figures) {
    if (f != 0 && !addFigure(h, program.figures[f - 1])) return false;
  }
  h.add(uint64_t{block.slotCount});
  for (const SelectorItem& item : block.selectors) {
    h.add(item.terms.size() << 8 | static_cast<uint64_t>(item.op));
    h.add(uint64_t{item.slot});
    for (const SelectorTerm& t : item.terms) {
      h.add(static_cast<uint64_t>(t.kind) << 32 | t.word);
      h.add(t.number);
    }
  }
  for (const auto& size : block.preferredSizes) {
    for (const double v : size) h.add(v);
  }
  return true;
}

}  // namespace

bool IncrementalCache::Cost::isDue(uint64_t worthwhile) {
  return calls++ % kBetweenSamples == 0 || sum >= worthwhile * measured;
}

IncrementalCache::IncrementalCache(const Tables& tables, Output& output, Prototypes& prototypes,
                                   Tally& tally)
    : program_(tables.program),
      reach_(tables.reach),
      output_(output),
      prototypes_(prototypes),
      tally_(tally),
      thrownAway_(tables.thrownAway),
      recaller_(tables.before.recall
                    ? std::make_unique<Recaller>(tables.before, output, prototypes.numbers())
                    : nullptr),
      ruleInputs_(tables.program.rules.size()),
      ruleCosts_(tables.program.rules.size()),
      operationCosts_(tables.program.code.size()) {}

IncrementalCache::~IncrementalCache() = default;

// What rules can ask of the initial shape.
IncrementalCache::Inputs IncrementalCache::inputsOf(const InitialShapeInfo& info,
                                                    std::vector<uint64_t> given) {
  KeyHash h;
  h.add(hashBytes(info.name));
  h.add(hashBytes(info.startRule));
  h.add(info.origin);
  h.add(info.seed);
  h.add(uint64_t{info.index});
  h.add(info.shape.path);
  h.add(info.shape.scope);
  h.add(info.shape.size);
  h.add(contentHash(info.shape.geometry));
  h.add(info.edges ? info.edges->hash() : uint64_t{0});
  h.add(info.geo ? info.geo->hash() : uint64_t{0});
  return {h.key().a, std::move(given)};
}

void IncrementalCache::begin(Inputs inputs) {
  open_.clear();
  ruleInputs_.assign(ruleInputs_.size(), 0);
  inputs_ = std::move(inputs);
}

uint64_t IncrementalCache::inputsOf(uint32_t rule) {
  uint64_t& known = ruleInputs_[rule];
  if (known != 0) return known;
  const Reach& reach = reach_[rule];
  uint64_t h = hashCombine(reach.code, inputs_.shape);
  for (const uint32_t a : reach.attributes) h = hashCombine(h, inputs_.given[a]);
  return known = h | 1;
}

bool IncrementalCache::isRuleDue(uint32_t rule) { return ruleCosts_[rule].isDue(kManySteps); }

ShareKey IncrementalCache::keyOf(const Call& call) {
  KeyHash h;
  h.add(inputsOf(call.rule));
  h.add(uint64_t{call.depth});
  addShape(h, call.shape, call.locals);
  h.add(uint64_t{call.shape.attributes});
  for (const Value& v : call.arguments) h.add(v.hash());
  if (call.place != 0) h.add(call.place);
  return h.key();
}

const RecallPart* IncrementalCache::beginPart(const ShareKey& key, uint32_t rule,
                                              const Moment& now) {
  if (const RecallPart* known = recaller_ ? recaller_->part(key) : nullptr) {
    ruleCosts_[rule].add(known->steps);
    takePart(*known, now.holes);
    return known;
  }
  OpenPart& open = open_.emplace_back();
  open.rule = rule;
  open.warnings = now.warnings;
  open.portions = now.portions;
  RecallPart& part = open.part;
  part.key = key;
  part.begin = prototypes_.placeInUnit();
  part.holes = static_cast<uint32_t>(now.holes);
  part.firstInside = static_cast<uint32_t>(parts_.size());
  part.firstOperation = static_cast<uint32_t>(operations_.size());
  // What came before, until the part ends.
  part.shapes = tally_.made();
  part.shapesExpanded = tally_.expanded();
  part.steps = tally_.steps();
  return nullptr;
}

void IncrementalCache::endPart(const Moment& now) {
  const OpenPart open = open_.back();
  open_.pop_back();
  RecallPart part = open.part;
  part.end = prototypes_.placeInUnit();
  part.holesEnd = static_cast<uint32_t>(now.holes);
  part.endOperation = static_cast<uint32_t>(operations_.size());
  part.shapes = tally_.made() - part.shapes;
  part.shapesExpanded = tally_.expanded() - part.shapesExpanded;
  part.steps = tally_.steps() - part.steps;
  ruleCosts_[open.rule].add(part.steps);
  const bool whole = open.portions == now.portions;
  if (part.steps >= kManySteps && now.warnings == open.warnings && whole) parts_.push_back(part);
}

// The parts inside come along: the next derivation may know them where it does not know this one.
void IncrementalCache::takePart(const RecallPart& known, size_t holes) {
  recaller_->take(known);
  const std::vector<RecallPart>& all = recaller_->recall().parts;
  const auto self = static_cast<uint32_t>(&known - all.data());
  const uint32_t partShift = static_cast<uint32_t>(parts_.size()) - known.firstInside;
  const uint32_t operationShift = static_cast<uint32_t>(operations_.size()) - known.firstOperation;
  for (uint32_t p = known.firstInside; p <= self; ++p) {
    RecallPart copy = all[p];
    copy.firstInside += partShift;
    copy.firstOperation += operationShift;
    copy.endOperation += operationShift;
    copy.holes = copy.holesEnd = static_cast<uint32_t>(holes);
    copy.taken = true;
    parts_.push_back(copy);
  }
  for (uint32_t o = known.firstOperation; o < known.endOperation; ++o) {
    operations_.push_back(recaller_->recall().operations[o]);
  }
  tally_.countTaken(known.shapes, known.shapesExpanded);
  tally_.countSteps(known.steps);
  taken_ += known.shapesExpanded;
  countTaken();
}

void IncrementalCache::countTaken() {
  const Recaller::Counts counts = recaller_->counts();
  shared_ += counts.shared;
  tally_.countVertices(counts.vertices);
}

std::optional<uint32_t> IncrementalCache::takePrototype(const ShareKey& key, uint32_t rule,
                                                        uint32_t attributes) {
  uint32_t number = 0;
  if (!recaller_) return {};
  // What the rule reads of them is in the key by its value; what it sets, leaves have.
  const bool bare = attributes != 0 && !reach_[rule].setsAttributes;
  if (!recaller_->takePrototype(key, number) &&
      !(bare && recaller_->takePrototypeAs(key, attributes, number))) {
    return {};
  }
  taken_ += prototypes_.finished(number).range.shapes;
  countTaken();
  return number;
}

bool IncrementalCache::isOperationDue(uint32_t instruction) {
  return operationCosts_[instruction].isDue(kMuchWork);
}

std::optional<ShareKey> IncrementalCache::keyOf(OpCall& call, std::span<const Value> arguments,
                                                const BlockInput* block,
                                                const LocalValues& locals) const {
  KeyHash h;
  h.add(hashBytes(call.spec().name));
  h.add(hashBytes(call.file()));
  h.add(call.randomAddress(0));
  h.add(inputs_.shape);
  // That of another rule where the operation does not ask for it.
  if ((call.spec().effects & kReadsPrevious) != 0) {
    h.add(call.previousScope());
    h.add(call.previousSize());
  }
  addShape(h, call.shape(), locals);
  for (const Value& v : arguments) {
    if (!addArgument(h, v, program_)) return {};
  }
  if (block && !addBlock(h, *block, program_)) return {};
  return h.key();
}

bool IncrementalCache::takeOperation(const ShareKey& key, uint32_t instruction, Shape& shape,
                                     std::vector<BlockChild>& children) {
  if (!recaller_) return false;
  std::shared_ptr<const RecallOperation> known = recaller_->operation(key);
  if (!known) return false;
  const uint32_t locals = shape.locals, attributes = shape.attributes;
  const auto taken = [&](const KeptShape& kept) {
    Shape s = takenShape(kept, locals);
    s.attributes = attributes;
    return s;
  };
  for (const KeptShape& child : known->children) children.push_back({taken(child), child.slot});
  shape = taken(known->shape);
  operationCosts_[instruction].add(known->worth);
  if (!thrownAway_) operations_.push_back(std::move(known));
  return true;
}

void IncrementalCache::endOperation(const ShareKey& key, uint32_t instruction, uint64_t units,
                                    const OperationResult* result) {
  const uint64_t shapes = result ? 1 + result->children.size() : 1;
  const uint64_t worth = units / std::min(shapes, kFewShapes);
  operationCosts_[instruction].add(worth);
  if (!result || thrownAway_ || worth < kMuchWork) return;
  const auto hasOthers = [&](const Shape& s) { return s.attributes != result->attributes; };
  const auto childHas = [&](const BlockChild& child) { return hasOthers(child.shape); };
  if (hasOthers(result->shape) || std::ranges::any_of(result->children, childHas)) return;
  auto kept = std::make_shared<RecallOperation>();
  kept->key = key;
  kept->worth = worth;
  kept->shape = keptShape(result->shape, 0);
  for (const BlockChild& child : result->children) {
    kept->children.push_back(keptShape(child.shape, child.slot));
  }
  operations_.push_back(std::move(kept));
}

void IncrementalCache::endUnit(uint32_t worker, uint32_t prototype) {
  for (; unitBegin_ < parts_.size(); ++unitBegin_) {
    parts_[unitBegin_].worker = worker;
    parts_[unitBegin_].prototype = prototype;
  }
}

}  // namespace gable
