// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Setting up a derivation, what operations ask of the outside, limits and messages.

#include "runtime/machine.h"

#include <algorithm>
#include <cmath>

#include "base/interned.h"
#include "runtime/array_ops.h"
#include "shape/edge_attributes.h"

namespace gable {

namespace {

Status unusedApply(OpCall&) { return {}; }
// What the setters of shape attributes are called as.
constexpr OpSpec kSetSpec{"", "", "", {}, unusedApply};

// Whether people see the attribute, or choose another one's value among its own.
std::vector<bool> shownAttributes(const Program& program) {
  std::vector<bool> shown;
  for (const AttributeCode& a : program.attributes) shown.push_back(!a.hidden);
  for (const AttributeCode& a : program.attributes) {
    for (const AnnotationInfo& note : a.annotations) {
      for (const auto& [key, value] : note.arguments) {
        if (key != "valuesAttr") continue;
        const int32_t named = program.findAttribute(program.pool->str(value));
        if (named >= 0) shown[static_cast<size_t>(named)] = true;
      }
    }
  }
  return shown;
}

// The mesh of a shape with what its file tells of each face.
Mesh taggedMesh(const InitialShape& input, TagTable& tags) {
  Mesh mesh = input.mesh;
  const size_t faces = mesh.faceCount();
  for (size_t f = 0; f < faces && input.faceTags.size() == faces; ++f) {
    if (!input.faceTags[f].empty()) mesh.faces[f].tags = tags.of(input.faceTags[f]);
  }
  for (size_t f = 0; f < faces && input.streetWidths.size() == faces; ++f) {
    const double width = input.streetWidths[f];
    if (width > 0) mesh.faces[f].tags = tags.withStreetWidth(mesh.faces[f].tags, width);
  }
  return mesh;
}

}  // namespace

Machine::Machine(DeriveShared& shared, uint32_t worker)
    : shared_(shared),
      program_(shared.program),
      worker_(worker),
      tally_(shared.usage),
      tracer_(shared.program, shared.options),
      attributeValues_(shared.program.attributes.size()),
      context_(shared.collectOccluders, shared.occluders),
      claimsOnly_(shared.collectClaims && !shared.collectOccluders),
      splits_(shared.program),
      bound_(shared.program.constantCalls),
      flat_(!shared.options.sharing || shared.options.trace),
      lightParts_({shared.program, shared.options.limits, splits_, flat_}, output_, tally_) {
  pool_ = shared.environment.pool.get();
  materials_ = &shared.environment.materials;
  attributes_ = &shared.environment.attributes;
  tags_ = &shared.environment.tags;
  assets_ = &shared.environment.assets;
  builtinSetSpec_ = &kSetSpec;
  lightPartsAllowed_ = !context_.collects() && !claimsOnly_ && !shared.options.trace;
  if (shared.options.remember) {
    incremental_ = std::make_unique<IncrementalCache>(
        IncrementalCache::Tables{program_, shared.reach, shared.before, isFirstPass()}, output_,
        prototypes_, tally_);
  }
}

Machine::~Machine() = default;

void Machine::forget() { prototypes_.forget(); }

OutputUnit Machine::run(const InitialShape& input, uint32_t index) {
  const uint64_t shapesBefore = tally_.expanded();
  derive(input, index);
  OutputUnit unit;
  unit.frame = flat_ ? Frame{} : input.origin;
  unit.name = input.name;
  closeUnit(unit, nameId_, shapesBefore);
  return unit;
}

void Machine::closeUnit(OutputUnit& unit, StringId name, uint64_t shapesBefore) {
  // Nobody sees what a derivation that was stopped has made: it is not put into order first.
  if (shared_.usage.cancelled()) {
    const Output::Mark& begin = prototypes_.unitMark();
    output_.openLeaves.resize(begin.leaves);
    output_.openInstances.resize(begin.instances);
    output_.openEvents.resize(begin.events);
  }
  unit.worker = worker_;
  const bool whole = !aborted_ && !holes_.any();
  unit.prototype = equalRoot_ ? *equalRoot_
                              : prototypes_.endUnit(name, tally_.expanded() - shapesBefore,
                                                    aborted_ ? ShareKey{} : rootKey_, whole);
  if (incremental_) incremental_->endUnit(worker_, unit.prototype);
  unit.holes = holes_.take();
  unit.messages = log_.take();
}

void Machine::derive(const InitialShape& input, uint32_t index) {
  const WorkScope scope(*this);
  beginUnit();
  endUnit(guarded([&] {
    begin(input, index);
    return Status();
  }));
}

void Machine::beginUnit() {
  aborted_ = false;
  instruction_ = nullptr;
  portion_ = nullptr;
  portionBase_ = nullptr;
  log_.beginUnit();
  openAttributes_.drop();
  holes_.begin();
  prototypes_.beginUnit();
  rootKey_ = {};
  equalRoot_.reset();
}

void Machine::endUnit(const Status& status) {
  if (!status.ok()) endByFailure(status);
  dropGathers();
  // What was open when a limit struck stays: it belongs to the initial shape.
  while (prototypes_.anyOpen()) prototypes_.end(tally_.expanded(), !aborted_);
}

void Machine::clearStacks() {
  salt_ = 0;
  parameters_ = activationCount_ = 0;
  stack_.cut(0);
  children_.clear();
  pieces_.clear();
  shapeStack_.clear();
  inPlace_.begin(portion_ ? portion_->inPlace : 0);
  locals_.cut(0);
  functions_.clear();
}

void Machine::setInitialMaterials(const InitialShape& input) {
  if (input.materials.empty()) return;
  std::vector<MaterialId> list;
  for (int times = 0; times < 2; ++times) {
    for (const Material& m : input.materials) list.push_back(materials().intern(m));
  }
  std::vector<StringId> groups;
  for (const std::string& name : input.groups) groups.push_back(pool().intern(name));
  info_.shape.assetMaterials = attributes().internMaterials(std::move(list), std::move(groups));
}

void Machine::begin(const InitialShape& input, uint32_t index) {
  attributeValues_.begin();
  nameId_ = 0;
  nameId_ = pool().intern(input.name);
  const uint64_t place = input.index < 0 ? index : static_cast<uint64_t>(input.index);
  const uint64_t identity =
      input.identity.empty() ? hashCombine(0, place) : hashBytes(input.identity, 1);
  info_.name = input.name;
  info_.index = index;
  info_.origin = input.origin;
  const double seed = input.seed.value_or(options().seed);
  info_.seed = seed;
  info_.shape = Shape{};
  setInitialGeometry(info_.shape, taggedMesh(input, tags()));
  if (input.upright) {
    alignScope(info_.shape, Frame{});
    info_.shape.pivot = info_.shape.scope;
  }
  setInitialMaterials(input);
  info_.shape.path = hashCombine(hashDouble(seed), identity);
  info_.edges = edgesOf(input);
  info_.geo = options().geo;
  worlds_.begin(input.origin);
  clearStacks();
  bindAttributes(input);

  const int32_t rule = startRuleOf(input);
  if (rule >= 0) {
    info_.startRule = program_.rules[static_cast<size_t>(rule)].qualifiedName;
    // Nothing has been evaluated yet.
    if (incremental_) {
      incremental_->begin(IncrementalCache::inputsOf(info_, attributeValues_.hashes()));
    }
    beginRoot(static_cast<uint32_t>(rule));
    execute();
  } else {
    // Without a rule the initial shape itself is the result.
    activationCount_ = 0;
    Activation& a = pushActivation();
    a.shape = info_.shape;
    makeLeaf(a, nameId_, 0);
  }
}

namespace {

bool isList(ValueType type) {
  return type == ValueType::FloatArray || type == ValueType::BoolArray ||
         type == ValueType::StringArray;
}

}  // namespace

// A list that is too long or too short is told: it is likely to be of another outline. So is one
// whose name is a single value in the rules, which would seem to be that of the list.
std::shared_ptr<const EdgeAttributes> Machine::edgesOf(const InitialShape& input) {
  EdgeAttributes::Given given = options().edgeAttributes;
  for (const auto& attribute : input.edgeAttributes) {
    const bool isNew = std::ranges::none_of(
        given, [&](const auto& other) { return other.first == attribute.first; });
    if (isNew) given.push_back(attribute);
  }
  if (given.empty()) return nullptr;
  auto edges = std::make_shared<const EdgeAttributes>(input.mesh, std::move(given), pool());
  for (const auto& [name, list] : edges->attributes()) {
    const int32_t known = name == EdgeAttributes::kStreetWidth ? program_.findAttribute(name) : -1;
    if (known >= 0 && !isList(program_.attributes[static_cast<size_t>(known)].type)) {
      const AttributeCode& a = program_.attributes[static_cast<size_t>(known)];
      log_.input().warning("attribute-type", a.span,
                           "'" + name + "' has a list of values for the edges of the shapes, and " +
                               "is a single " + typeName(a.type) + " in the rules",
                           "the rules see the value that stands there; edgeAttr.getFloat(\"" +
                               name + "\") gives that of an edge");
    }
    const Array& a = pool().array(list);
    const size_t count = std::max(a.numbers.size(), a.strings.size());
    if (count == edges->edgeCount()) continue;
    log_.input().warning("edge-count", Span{},
                         "the attribute '" + name + "' has " + std::to_string(count) +
                             (count == 1 ? " value" : " values") + " for the " +
                             std::to_string(edges->edgeCount()) + " edges of shape '" + input.name +
                             "'",
                         "give a value for each edge, in the order of the outline and its holes");
  }
  return edges;
}

int32_t Machine::startRuleOf(const InitialShape& input) {
  if (input.startRule.empty()) return options().startRule;
  const int32_t rule = program_.findRule(input.startRule);
  if (rule < 0) {
    log_.input().error("unknown-start-rule", Span{},
                       "shape '" + input.name + "' names the start rule '" + input.startRule +
                           "', which the rules do not have",
                       "use one of the rules without parameters, or leave the shape's rule empty");
  }
  return rule;
}

void Machine::beginRoot(uint32_t rule) {
  const RuleCode& code = program_.rules[rule];
  activationCount_ = 0;
  Activation& a = pushActivation();
  a = Activation{};
  a.shape = info_.shape;
  a.rule = rule;
  countShape();
  if (options().trace) traceShape(a, TraceNode::kNone, nullptr);
  if (code.needsPrevious) a.keepScope();
  seen_ = &a.shape;
  divided_ = nullptr;
  parameters_ = 0;
  pc_ = program_.code.data() + code.entry;
  if (incremental_ && beginPart(a)) activationCount_ = 0;
  const bool isShared = code.shared && !flat_ && !incremental_ && !isFirstPass();
  if (isShared && takeEqualRoot(a)) activationCount_ = 0;
}

// Attributes are bound by name: options over the shape's own, both over the initialiser.
void Machine::bindAttributes(const InitialShape& shape) {
  attributeValues_.give(shape.attributes, program_, pool());
  attributeValues_.give(options().attributes, program_, pool());
}

std::vector<EvaluatedAttribute> Machine::attributeValues() {
  const WorkScope scope(*this);
  if (shownAttributes_.empty()) shownAttributes_ = shownAttributes(program_);
  std::vector<EvaluatedAttribute> out;
  for (uint32_t a = 0; a < program_.attributes.size(); ++a) {
    const AttributeCode& code = program_.attributes[a];
    if (code.constant || !(shownAttributes_[a] || options().importedAttributes)) continue;
    if (code.name.find('.') != std::string::npos) {
      // Those of a call that gives an import values of its own have the names of the import's.
      const bool own =
          code.propagatesFrom < 0 && program_.findAttribute(code.name) == static_cast<int32_t>(a);
      if (!options().importedAttributes || !own) continue;
    }
    aborted_ = false;
    openAttributes_.drop();
    stack_.cut(0);
    seen_ = &info_.shape;
    divided_ = nullptr;
    functions_.clear();
    attributeValues_.giveUpEvaluation(a);
    Value value;
    const Status status = guarded([&] {
      value = evaluateAttribute(a);
      return Status();
    });
    if (!status.ok()) functions_.clear();
    out.push_back({a, value});
  }
  return out;
}

// An attribute that reports or prints does it once an initial shape.
void Machine::speak(const OutputEvent& event) {
  noteEffect();
  if (isDivided() && evaluatesAttribute()) shared_.indivisible = true;
  output_.openEvents.push_back(event);
}

void Machine::takeReport(StringId key, const Value& value) {
  speak({prototypes_.instancesAround(), false, key, value});
}

void Machine::takePrint(std::string text) {
  speak({prototypes_.instancesAround(), true, pool().intern(text), {}});
}

void Machine::takeMessage(Severity severity, const char* code, std::string message,
                          std::string hint) {
  noteEffect();
  log_.add(severity, code, here(), std::move(message), std::move(hint), info_.index,
           [&] { return shapePath(); });
}

Span Machine::here() const { return instruction_ ? program_.spans[pcOf(instruction_)] : Span{}; }

std::string Machine::shapePath() const {
  uint32_t length = 0;
  return shapePath(activationCount_, length);
}

// The path to the activation before `end`, and how many rules it has. Endless recursion has a long
// path: its beginning says enough.
std::string Machine::shapePath(uint32_t end, uint32_t& length) const {
  constexpr uint32_t kMost = 8;
  std::string out = portion_             ? portion_->path
                    : info_.name.empty() ? "shape " + std::to_string(info_.index + 1)
                                         : info_.name;
  length = portion_ ? portion_->pathLength : 0;
  for (uint32_t i = portion_ ? 1 : 0; i < end && length <= kMost; ++i) {
    const Activation& a = activations_[i];
    if (a.slot) continue;
    out += ++length > kMost ? " > ..." : " > " + program_.rules[a.rule].qualifiedName;
  }
  return out;
}

std::string Machine::treeKeyAtWork() const {
  std::string out = "0;";
  for (uint32_t i = 1; i < activationCount_; ++i) {
    if (!activations_[i].slot) out += std::to_string(activations_[i].ordinal) + ";";
  }
  return out;
}

bool Machine::overLimit(const char* code, std::string message, std::string hint) {
  // An initial shape may be over a limit before its first instruction.
  instruction_ = pc_ && pc_ != program_.code.data() ? pc_ - 1 : nullptr;
  if (isFirstPass() && !firstPassLimit_) {
    firstPassLimit_ = {info_.index,
                       {Severity::Warning, code, here(), message, hint, shapePath(), {}}};
  }
  warn(code, std::move(message), std::move(hint));
  aborted_ = true;
  // What comes after in path order goes, and may be with another worker.
  if (portion_ || holes_.anyPending()) shared_.indivisible = true;
  shared_.limitReached.store(true, std::memory_order_relaxed);
  return false;
}

bool Machine::endsByFullTable(const Status& status) {
  if (status.code() != kTableFull) return false;
  shared_.environment.full = true;
  over(shared_.usage.tablesAreFull());
  return true;
}

void Machine::tellFailure(const char* name, const Status& status) {
  if (status.code() == kWorkStopped || endsByFullTable(status)) return;
  warn(status.code(), name ? "'" + std::string(name) + "': " + status.message() : status.message(),
       status.hint());
}

// Something outside of operations and functions unwound: the initial shape ends.
void Machine::endByFailure(const Status& status) {
  if (status.code() == kWorkStopped || endsByFullTable(status)) return;
  shared_.usage.exhaust();
  overLimit(status.code(), "the derivation cannot go on: " + status.message(), status.hint());
}

bool Machine::stackFull() {
  return overLimit("recursion-too-deep", "rules and functions call each other too deeply",
                   "end the recursion with a case");
}

// A limit on all initial shapes together: false when one has been reached.
bool Machine::over(std::optional<Usage::Excess> excess) {
  if (!excess) return true;
  return overLimit(excess->code, std::move(excess->message), std::move(excess->hint));
}

uint64_t Machine::lengthOf(const Value& v) const {
  return v.isArray() ? pool_->array(v).size() * sizeof(double) : pool_->text(v.id).size();
}

// Within an operation or a function.
bool Machine::look(uint64_t units, uint64_t bytes) {
  if (aborted_) return false;
  tally_.countWork(units);
  return lookAtLimits(bytes);
}

// Within what is done once and kept, as reading a file: whether this derivation is the first to ask
// must not move the places at which counts are held against their limits.
bool Machine::lookAside(uint64_t bytes) {
  return !aborted_ && !endsByWish() && over(tally_.lookAside(bytes));
}

bool Machine::endsByWish() {
  if (!shared_.usage.cancelled()) return false;
  aborted_ = true;
  return true;
}

// The clock, memory, the user's wish to stop, and what all workers have made and done together.
// `bytes`: so many are about to be taken.
bool Machine::lookAtLimits(uint64_t bytes) {
  if (endsByWish() || !over(tally_.look(bytes))) return false;
  if (shared_.portions && shared_.portions->isHungry()) offerPortion();
  return true;
}

bool Machine::tellUse() { return over(tally_.tell()); }

std::string_view Machine::fileOf(const Instruction& i) const {
  const Span& at = program_.spans[pcOf(&i)];
  return at.valid() && at.file < program_.files.size() ? std::string_view(program_.files[at.file])
                                                       : std::string_view();
}

}  // namespace gable
