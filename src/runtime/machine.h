// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Machine: one worker's virtual machine. It derives one initial shape after the other, depth first,
// on stacks of its own: rule calls, block slots and function calls never recurse in C++.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/work.h"
#include "geom/mesh/origins.h"
#include "program/program.h"
#include "program/reach.h"
#include "runtime/activation.h"
#include "runtime/array_ops.h"
#include "runtime/attribute_values.h"
#include "runtime/block_selectors.h"
#include "runtime/context_queries.h"
#include "runtime/derive.h"
#include "runtime/gathers.h"
#include "runtime/holes.h"
#include "runtime/in_place.h"
#include "runtime/incremental_cache.h"
#include "runtime/light_parts.h"
#include "runtime/local_values.h"
#include "runtime/message_log.h"
#include "runtime/open_attributes.h"
#include "runtime/output.h"
#include "runtime/portion.h"
#include "runtime/prototypes.h"
#include "runtime/recall.h"
#include "runtime/room.h"
#include "runtime/split_cache.h"
#include "runtime/tally.h"
#include "runtime/tracer.h"
#include "runtime/value_stack.h"
#include "runtime/worlds.h"
#include "shape/op_call.h"

namespace gable {

/// What all workers of one derivation share.
struct DeriveShared {
  DeriveShared(const Program& p, const DeriveOptions& o, Environment& e, Usage& b)
      : program(p), options(o), environment(e), usage(b) {
    if (options.remember) spare = environment.spare.take();
  }
  /// What of the spare memory was not used is left for others.
  ~DeriveShared() {
    spare.bare = std::move(before.bare);
    environment.spare.keep(std::move(spare));
  }
  DeriveShared(const DeriveShared&) = delete;
  DeriveShared& operator=(const DeriveShared&) = delete;
  const Program& program;
  const DeriveOptions& options;
  Environment& environment;
  Usage& usage;
  /// The occluders of the first pass; null while it runs and when no rule asks.
  const OccluderIndex* occluders = nullptr;
  /// The first pass of a derivation whose rules ask about other shapes.
  bool collectOccluders = false;
  /// The next derivation may have the answers of this one, under that key.
  std::optional<ShareKey> roomKey;
  /// The answers to shapes that ask for room; null in the first pass and where none asks.
  const RoomPlan* rooms = nullptr;
  /// The first pass of a derivation whose shapes ask for room.
  bool collectClaims = false;
  /// By rule, and what came before; with DeriveOptions::remember.
  std::vector<Reach> reach;
  RecallInput before;
  SpareBlocks spare;
  /// Something happened while an attribute was evaluated: where that is told depends on which part
  /// comes first, so no part can stand for itself.
  std::atomic<bool> unrepeatable{false};
  std::atomic<bool> limitReached{false};
  /// Null where no initial shape is divided among workers.
  PortionQueue* portions = nullptr;
  /// Something came of portions that does not come of a whole: all has to be done without them.
  std::atomic<bool> indivisible{false};
};

class Machine final : public Services, private WorkMeter {
 public:
  Machine(DeriveShared& shared, uint32_t worker);
  ~Machine() override;

  /// Derives one initial shape.
  OutputUnit run(const InitialShape& shape, uint32_t index);
  /// Derives what another worker offered, into the portion's unit.
  void run(const Portion& portion);
  /// The same, but leaves everything open in the output.
  void derive(const InitialShape& shape, uint32_t index);
  /// Drops the output and what is known of it.
  void forget();
  Output& output() { return output_; }
  /// Finished prototypes of the output by their keys.
  KeyNumbers& prototypeNumbers() { return prototypes_.numbers(); }
  /// What was told since the last time it was asked for. What this worker told before is not told
  /// again.
  Diagnostics takeMessages() { return log_.take(); }
  Tracer& tracer() { return tracer_; }
  ContextQueries& context() { return context_; }
  RoomClaims& claims() { return claims_; }
  /// Of two: what it makes is thrown away.
  bool isFirstPass() const { return shared_.collectOccluders || shared_.collectClaims; }
  /// The first initial shape of this worker that a limit of the first pass ended, and how.
  struct LimitOfShape {
    uint32_t initialShape;
    Diagnostics::Entry message;
  };
  const std::optional<LimitOfShape>& firstPassLimit() const { return firstPassLimit_; }
  /// How many shapes asked for room in the second pass that did not ask in the first.
  uint64_t strangers() const { return strangers_; }
  uint64_t cacheHits() const { return cacheHits_ + (incremental_ ? incremental_->shared() : 0); }
  /// Null without DeriveOptions::remember.
  const IncrementalCache* incremental() const { return incremental_.get(); }
  /// Tells the usage what it has not been told yet; false when a limit is reached.
  bool tellUse();
  /// The rule attributes of the shape derived last that people see, as evaluated, and those that
  /// the choices of others are.
  std::vector<EvaluatedAttribute> attributeValues();

  // Services.
  const Program* program() const override { return &program_; }
  Value evaluateAtWork(uint32_t entry, uint64_t address, const Shape* as) override;
  const InitialShapeInfo& initialShapeAtWork() const override { return info_; }
  const Frame& worldAtWork() const override { return worlds_.present(); }
  void takeReport(StringId key, const Value& value) override;
  void takePrint(std::string text) override;
  void takeMessage(Severity severity, const char* code, std::string message,
                   std::string hint) override;
  bool answerQuery(ContextTest test, ContextScope scope, StringId label,
                   const Shape& shape) override;
  double answerDistance(ContextScope scope, StringId label, const Shape& shape) override;
  double answerCount(ContextScope scope, StringId label) override;
  double answerRank(ContextScope scope, StringId label, ContextOrder order,
                    const Shape& shape) override;
  Room answerRoom(const RoomRequest& request, const Shape& shape) override;
  void takeLabel(StringId name, const Shape& shape) override;
  std::string treeKeyAtWork() const override;
  void leaveLeaf() override;

 private:
  struct FunctionFrame {
    const Instruction* returnTo;
    uint32_t parameters;
    uint32_t stackBase;
    /// The attribute that the value is for; -1 for a function.
    int32_t attribute;
    const Shape* shape;
    uint64_t salt;
    const Shape* divided;
  };
  struct SavedShape {
    SavedShape() = default;
    explicit SavedShape(const Shape& s) : shape(s) {}
    Shape shape;
    /// What was at work in place when the bracket opened.
    uint32_t inPlace = 0;
    /// Kept where the rule needs it.
    PreviousScope previous;
  };
  const DeriveOptions& options() const { return shared_.options; }

  // The loop, and its parts.
  void begin(const InitialShape& shape, uint32_t index);
  void beginUnit();
  void clearStacks();
  void endUnit(const Status& status);
  void closeUnit(OutputUnit& unit, StringId name, uint64_t shapesBefore);
  void execute();
  void beginRoot(uint32_t rule);
  void beginRule(uint32_t rule, uint32_t argumentCount, const Instruction* at, bool last);
  void becomeRule(const Instruction& i);
  bool enterRule(Activation& a, uint32_t callerDepth, uint32_t callerTrace, const Instruction* at);
  void callRule(const Instruction& i);
  void leafInstruction(const Instruction& i);
  void endActivation();
  void resume();
  void nextChild();
  void makeChild();
  void placeEqualParts(Activation& a);
  void makeLightParts(Activation& a);
  void operation(const Instruction& i, const Value* constants);
  Status apply(OpCall& call, const Instruction& i, std::span<const Value> arguments,
               const BlockInput* block);
  void fillBlock(uint32_t number, const Value* values, PartPlan& plan, BlockInput& input);
  bool splitAsBefore(const Instruction& i, Activation& a, const Value* values);
  void beginChildren(const Instruction& i, uint32_t childBase, uint32_t pieceBase);
  void setBuiltin(const Instruction& i, const Value& v);
  void setAttribute(const Instruction& i);
  void pushShape();
  void popShape();
  void dropShape();
  void leaveBracket();
  void shapeTooLarge(const OpSpec& spec);
  bool madeFinite(const Shape& s, size_t firstChild, size_t firstPiece) const;
  void makeLeaf(Activation& a, StringId name, uint32_t source);
  bool putLeaf(const Shape& s, StringId name, uint32_t source);

  // Gathering: operations that wait for the leaves of their children.
  void keepDeleted(const Shape& s);
  Frame homeOf(const Shape& s) const;
  std::optional<Handover> endOrigins(const Shape& s, bool divided);
  void beginOrigins(const Handover& from, Shape& s);
  void handOver(const OpSpec& spec, size_t firstChild);
  void beginGather(const Instruction& i, const OpCall& call, std::span<const Value> arguments);
  void endGather();
  void dropGathers();
  void leaveGather(const Gathers::Call& call);

  // In place: do, repeat, local.
  void runRule(const Instruction& i);
  void endRunRule();
  void beginTurns(const Instruction& i);
  void endTurn(const Instruction& i);
  void endInPlace();
  void bind(uint32_t attribute, const Value& v);
  bool countStep();

  // Sharing.
  bool beginShared(const RuleCode& rule, Activation& call);
  void endShared();
  ShareKey keyOf(const Activation& call);
  bool takeEqualRoot(const Activation& root);
  void speak(const OutputEvent& event);

  // Recall.
  /// What is made now stays as it is, in the world.
  bool worksInTheOpen() const { return !prototypes_.anyOpen() && !gathers_.anyOpen(); }
  IncrementalCache::Moment moment() const;
  std::optional<uint64_t> placeInKey(const Activation& call) const;
  /// True when the call's result was known and lies in the output.
  bool beginPart(Activation& call);
  Status applyRemembering(OpCall& call, const Instruction& i, std::span<const Value> arguments,
                          const BlockInput* block);
  bool evaluatesAttribute() const;
  /// Reports, prints and warnings in an attribute's initialiser come with its first use.
  void noteEffect();

  // Room.
  /// A pass that is there for those who ask for room alone: what they do not depend on is left out.
  bool isLeftOut(uint32_t rule) const;
  bool leavesAreLeftOut() const { return claimsOnly_ && !gathers_.anyOpen(); }
  void leaveOut(uint32_t argumentCount);
  void placeChild(const Activation& parent, uint32_t number, uint32_t slot, Activation& child);
  PlacePath placePath(uint32_t end) const;

  // Portions.
  void offerPortion();
  void offerChildren(uint32_t activation, const Frame& world);
  void beginPortion(const Portion& portion);
  /// Whether a part of the initial shape is, or was, with another worker.
  bool isDivided() const { return portion_ || holes_.any(); }

  // Expressions.
  /// Runs an instruction of an expression; false when the instruction is none.
  bool evaluate(const Instruction& i);
  void put(const ValueOrError& r, const Instruction& i);
  void binary(const Instruction& i);
  void not_(const Instruction& i);
  void index(const Instruction& i);
  void makeArray(const Instruction& i);
  void makeRange(const Instruction& i);
  void choose(const Instruction& i);
  void ruleAttribute(const Instruction& i);
  void pushAttribute(uint32_t a, const Value& v);
  void enterAttribute(uint32_t attribute, const Instruction* returnTo);
  void builtinAttribute(const Instruction& i);
  void callFunction(const Instruction& i);
  void callBuiltin(const Instruction& i);
  Value callGuarded(FunctionCall& call, Value (*function)(FunctionCall&), uint32_t effects,
                    const char* name, ValueType result);
  void returnValue();
  void initialise(const Instruction& i);
  void componentValues(const Instruction& i);
  void runUntil(size_t depth);
  /// An attribute's value now, for a key or a list; nests one level of the loop.
  Value evaluateAttribute(uint32_t attribute);

  // Initial shapes.
  void bindAttributes(const InitialShape& shape);
  void setInitialMaterials(const InitialShape& input);
  int32_t startRuleOf(const InitialShape& shape);
  std::shared_ptr<const EdgeAttributes> edgesOf(const InitialShape& shape);

  // Tracing and occluders.
  /// Whether a filter shows what is made below the node. `rule`: the one that makes it; null for a
  /// leaf, which is never a topmost one.
  bool isTraced(uint32_t parentNode, const Activation* rule) const;
  void traceShape(Activation& a, uint32_t parentNode, const Instruction* at);
  Tracer::Made traced(const Shape& s, uint32_t parent, StringId name, const Span& span) const;
  /// The node of the rule at work; kNone where there is none.
  uint32_t traceNode() const {
    return activationCount_ > 0 ? current().traceNode : TraceNode::kNone;
  }
  void traceLeaf(const Activation& a, StringId name, uint32_t source);
  void traceTags(const Activation& a);
  ContextQueries::Place placeAtWork() const;

  // Limits and messages.
  [[gnu::cold]] bool overLimit(const char* code, std::string message, std::string hint);
  /// Tells why an operation or a function did not do what it should. A limit has told it already.
  [[gnu::cold]] void tellFailure(const char* name, const Status& status);
  [[gnu::cold]] void endByFailure(const Status& status);
  [[gnu::cold]] bool endsByFullTable(const Status& status);
  bool countShape() {
    tally_.countShape();
    return tick();
  }
  /// Counts work. Every so often it looks at the limits; false when one ends the initial shape.
  bool tick(uint64_t steps = 1) {
    if (stack_.isNearlyFull()) return stackFull();
    tally_.countSteps(steps);
    return !tally_.isLookDue() || look();
  }
  bool look() { return lookAtLimits(0); }
  bool look(uint64_t units, uint64_t bytes) override;
  bool lookAside(uint64_t bytes) override;
  bool lookAtLimits(uint64_t bytes);
  /// Whether the user wants it to end; nothing goes on then.
  bool endsByWish();
  bool stackFull();
  bool over(std::optional<Usage::Excess> excess);
  /// Texts and arrays cost by their length; the next tick() looks at the limits.
  void weigh(const Value& v) {
    if (v.type >= ValueType::String) tally_.countSteps(lengthOf(v) / 16);
  }
  uint64_t lengthOf(const Value& v) const;
  Span here() const;
  std::string shapePath() const;
  std::string shapePath(uint32_t end, uint32_t& length) const;
  std::string_view fileOf(const Instruction& i) const;

  void push(const Value& v) { stack_.push(v); }
  Value pop() { return stack_.pop(); }
  Activation& current() { return activations_[activationCount_ - 1]; }
  const Activation& current() const { return activations_[activationCount_ - 1]; }
  Activation& pushActivation();
  uint32_t pcOf(const Instruction* i) const {
    return static_cast<uint32_t>(i - program_.code.data());
  }

  DeriveShared& shared_;
  const Program& program_;
  uint32_t worker_;
  Output output_;
  Prototypes prototypes_{output_};
  Tally tally_;
  MessageLog log_;
  Tracer tracer_;
  /// Of the initial shape at work.
  AttributeValues attributeValues_;
  /// By number; made at the first use.
  std::vector<bool> shownAttributes_;
  ContextQueries context_;
  RoomClaims claims_;
  const bool claimsOnly_;
  uint64_t strangers_ = 0;
  std::optional<LimitOfShape> firstPassLimit_;

  // The stacks.
  ValueStack stack_;
  /// Reused, so that their shapes keep no memory busy.
  std::vector<Activation> activations_;
  uint32_t activationCount_ = 0;
  std::vector<BlockChild> children_;
  std::vector<SplitPiece> pieces_;
  std::vector<SavedShape> shapeStack_;
  LocalValues locals_;
  InPlace inPlace_{locals_};
  std::vector<FunctionFrame> functions_;
  Worlds worlds_;
  Gathers gathers_{output_, tracer_, worlds_};
  SplitCache splits_;
  /// By the numbers of calls with constant arguments.
  std::vector<BoundArguments> bound_;
  BlockSelectors selectors_;
  OpenAttributes openAttributes_;

  // The initial shape at work.
  InitialShapeInfo info_;
  StringId nameId_ = 0;
  const Instruction* pc_ = nullptr;
  uint32_t parameters_ = 0;
  /// The shape that expressions see: the current one, or the initial one in an attribute.
  const Shape* seen_ = nullptr;
  /// The calling sites of the functions in progress, folded.
  uint64_t salt_ = 0;
  bool aborted_ = false;
  uint64_t cacheHits_ = 0;
  /// Of the initial shape at work: what makes others equal to it, none where nothing does, and the
  /// prototype of one before that is.
  ShareKey rootKey_;
  std::optional<uint32_t> equalRoot_;
  /// The instruction at work, for messages.
  const Instruction* instruction_ = nullptr;
  const OpSpec* builtinSetSpec_ = nullptr;
  /// Leaves are placed in the world at once: sharing is off.
  bool flat_ = false;
  LightParts lightParts_;
  /// Nobody wants to see every shape.
  bool lightPartsAllowed_ = false;

  /// The portion at work; null for a whole initial shape.
  const Portion* portion_ = nullptr;
  /// Of the initial shape at work, for its portions.
  std::shared_ptr<const PortionBase> portionBase_;
  Holes holes_;

  /// With DeriveOptions::remember; null without.
  std::unique_ptr<IncrementalCache> incremental_;
};

}  // namespace gable
