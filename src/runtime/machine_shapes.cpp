// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The loop over instructions, and what changes shapes: rule calls, blocks, leaves.
//
// A rule call or a block slot is an activation on a stack; the program counter and the parameters
// of the innermost one are in registers (pc_, parameters_) and are put back when it ends. A block
// operation leaves its children on children_; they run one after the other before the rule goes on.

#include <cmath>
#include <utility>

#include "base/check.h"
#include "runtime/door.h"
#include "runtime/finite.h"
#include "runtime/leaf_shape.h"
#include "runtime/machine.h"
#include "shape/deformation.h"

namespace gable {

namespace {

constexpr size_t kManyLeaves = 1u << 14;

uint64_t verticesOf(const Shape& s) {
  return s.geometry.kind == GeometryKind::Mesh ? s.geometry.mesh->positions.size() : 0;
}

uint64_t stepsOf(const OpSpec& spec, const Shape& s) {
  // A primitive is turned into a mesh by the operations that take long.
  const uint64_t vertices = verticesOf(s);
  return spec.stepsPerVertex > 1 ? (8 + vertices) * spec.stepsPerVertex : 1 + vertices;
}

}  // namespace

void Machine::execute() {
  while (activationCount_ > 0 && !aborted_) {
    const Instruction& i = *pc_++;
    switch (i.code) {
      case Code::Operation: operation(i, nullptr); break;
      case Code::OperationConstant: operation(i, program_.constants.data() + (pc_++)->a); break;
      case Code::CallRule: callRule(i); break;
      case Code::CallComputed: callComputed(i); break;
      case Code::Leaf: leafInstruction(i); break;
      case Code::SetAttribute: setAttribute(i); break;
      case Code::SetBuiltin: {
        const Value v = pop();
        setBuiltin(i, v);
        break;
      }
      case Code::PushShape: pushShape(); break;
      case Code::PopShape: popShape(); break;
      case Code::Drop: dropShape(); break;
      case Code::RunRule: runRule(i); break;
      case Code::BeginTurns: beginTurns(i); break;
      case Code::EndTurn: endTurn(i); break;
      case Code::BeginLocals: inPlace_.beginLocals(current().shape); break;
      case Code::Bind: bind(i.a, pop()); break;
      case Code::EndLocals: inPlace_.endLocals(current().shape); break;
      case Code::End:
        if (inPlace_.size() > current().inPlaceBase)
          endRunRule();
        else
          endActivation();
        break;
      default: evaluate(i); break;
    }
  }
}

Activation& Machine::pushActivation() {
  if (activationCount_ == activations_.size()) activations_.resize(activations_.size() * 2 + 64);
  return activations_[activationCount_++];
}

void Machine::beginRule(uint32_t rule, uint32_t argumentCount, const Instruction* at, bool last) {
  if (!countShape()) return;
  const uint32_t callerIndex = activationCount_ - 1;
  Activation& a = pushActivation();
  Activation& caller = activations_[callerIndex];
  // Turns and rules run in place have limits of their own.
  if (++caller.made > options().limits.width && inPlace_.size() == caller.inPlaceBase) {
    --activationCount_;
    overLimit("too-many-children",
              "a shape of rule '" + program_.rules[caller.rule].qualifiedName + "' has more than " +
                  std::to_string(options().limits.width) + " children",
              "split into fewer parts, or raise the limit on width (--max-width)");
    return;
  }
  caller.pc = pc_;
  // The last call of a rule may take the shape itself.
  if (last)
    a.shape = std::move(caller.shape);
  else
    a.shape = caller.shape;
  a.rule = rule;
  a.stackBase = stack_.size() - argumentCount;
  a.parameters = a.stackBase;
  a.shapeStackBase = static_cast<uint32_t>(shapeStack_.size());
  a.inPlaceBase = inPlace_.size();
  a.localBase = static_cast<uint32_t>(locals_.size());
  a.childBase = a.childNext = a.childEnd = 0;
  a.ordinal = activations_[caller.owner].childCount++;
  if (enterRule(a, caller.depth, caller.traceNode, at)) return;
  stack_.cut(a.stackBase);
  --activationCount_;
}

// A slot that ends with a rule call has nothing left to do when the rule ends: its activation
// becomes the rule's, with the shape where it is.
void Machine::becomeRule(const Instruction& i) {
  if (!countShape()) return;
  Activation& a = current();
  a.rule = i.a;
  a.parameters = stack_.size() - i.x;
  a.ordinal = activations_[a.owner].childCount++;
  if (enterRule(a, a.depth, a.traceNode, &i)) return;
  stack_.cut(a.stackBase);
  --activationCount_;
  resume();
}

// Sets an activation that has its shape, its rule and its place on the stacks to the rule's
// beginning. False when the cache had the result: the call is over before it began.
bool Machine::enterRule(Activation& a, uint32_t callerDepth, uint32_t callerTrace,
                        const Instruction* at) {
  const RuleCode& code = program_.rules[a.rule];
  a.shape.path = hashCombine(a.shape.path, program_.sites[pcOf(at)]);
  a.made = 0;
  a.childCount = 0;
  a.owner = activationCount_ - 1;
  a.depth = callerDepth + 1;
  a.slot = false;
  a.boundary = false;
  a.traceNode = TraceNode::kNone;
  if (a.depth > options().limits.depth) {
    overLimit("recursion-too-deep",
              "rules call each other more than " + std::to_string(options().limits.depth) +
                  " levels deep, at last '" + code.qualifiedName + "'",
              "end the recursion with a case, or raise the limit on depth (--max-depth)");
    return true;
  }
  if (options().trace) traceShape(a, callerTrace, at);
  a.kept = false;
  if (code.shared && beginShared(code, a)) return false;
  if (incremental_ && beginPart(a)) return false;
  if (code.needsPrevious) a.keepScope();
  seen_ = &a.shape;
  parameters_ = a.parameters;
  pc_ = program_.code.data() + code.entry;
  return true;
}

void Machine::callRule(const Instruction& i) {
  const Activation& a = current();
  const bool last = pc_->code == Code::End && shapeStack_.size() == a.shapeStackBase &&
                    inPlace_.size() == a.inPlaceBase;
  if (last && a.slot)
    becomeRule(i);
  else
    beginRule(i.a, i.x, &i, last);
}

void Machine::callComputed(const Instruction& i) {
  const Value name = pop();
  const std::string_view text = pool().text(name.id);
  const int32_t rule = program_.findRule(text);
  if (rule >= 0) {
    beginRule(static_cast<uint32_t>(rule), 0, &i, false);
    return;
  }
  warn("unknown-rule", "there is no rule '" + std::string(text) + "' without parameters", "");
  ++current().made;
  makeLeaf(current(), name.id, pcOf(&i));
}

void Machine::leafInstruction(const Instruction& i) {
  if (!countShape()) return;
  Activation& a = current();
  ++a.made;
  makeLeaf(a, program_.constants[i.a].id, pcOf(&i));
  ++activations_[a.owner].childCount;
}

// A child that made nothing is a leaf under the name of its rule.
void Machine::endActivation() {
  Activation& a = current();
  if (a.made == 0) {
    if (a.slot) countShape();
    makeLeaf(a, program_.rules[a.rule].name, program_.rules[a.rule].entry);
  }
  if (a.kept) incremental_->endPart(moment());
  if (a.boundary) endShared();
  stack_.cut(a.stackBase);
  if (shapeStack_.size() > a.shapeStackBase) shapeStack_.resize(a.shapeStackBase);
  inPlace_.cut(a.inPlaceBase);
  locals_.cut(a.localBase);
  --activationCount_;
  if (activationCount_ > 0) resume();
}

void Machine::resume() {
  Activation& a = current();
  seen_ = &a.shape;
  parameters_ = a.parameters;
  pc_ = a.pc;
  if (a.childEnd > a.childBase) nextChild();
}

// Goes on with the children of a block, or with the rule when there are none left.
void Machine::nextChild() {
  Activation& a = current();
  if (a.inPieces) {
    placeEqualParts(a);
    makeLightParts(a);
  }
  if (a.childNext < a.childEnd) return makeChild();
  if (a.inPieces)
    pieces_.resize(a.childBase);
  else
    children_.erase(children_.begin() + a.childBase, children_.end());
  a.childBase = a.childNext = a.childEnd = 0;
  if (holes_.isPendingAt(activationCount_ - 1)) {
    holes_.place(activationCount_ - 1, prototypes_.placeInUnit(), log_.count());
  }
  if (portion_ && activationCount_ == 1) {
    activationCount_ = 0;
    return;
  }
  if (gathers_.isDue(activationCount_)) endGather();
}

void Machine::makeChild() {
  const uint32_t parentIndex = activationCount_ - 1;
  Activation& a = pushActivation();
  Activation& parent = activations_[parentIndex];
  const uint32_t number = parent.childNext++;
  uint32_t slot;
  if (parent.inPieces) {
    const SplitPiece& piece = pieces_[number];
    slot = piece.slot;
    makePart(parent.shape, parent.plan, piece, parent.plan.first + number - parent.childBase,
             a.shape);
  } else {
    slot = children_[number].slot;
    a.shape = std::move(children_[number].shape);
  }
  a.rule = parent.rule;
  a.stackBase = stack_.size();
  a.parameters = parent.parameters;
  a.shapeStackBase = static_cast<uint32_t>(shapeStack_.size());
  a.inPlaceBase = inPlace_.size();
  a.localBase = static_cast<uint32_t>(locals_.size());
  a.childBase = a.childNext = a.childEnd = 0;
  a.made = 0;
  a.owner = parent.owner;
  a.depth = parent.depth;
  a.traceNode = parent.traceNode;
  a.slot = true;
  a.boundary = false;
  a.kept = false;
  if (program_.rules[a.rule].needsPrevious) a.keepScope();
  seen_ = &a.shape;
  parameters_ = a.parameters;
  pc_ = program_.code.data() + program_.blocks[parent.block].slots[slot];
}

// NIL: the shape goes, and nothing after it runs. What it had made before stays.
void Machine::dropShape() {
  Activation& a = current();
  if (a.slot && a.made == 0) countShape();
  if (a.made == 0 && a.traceNode < TraceNode::kCut && !a.slot) tracer_.drop(a.traceNode);
  ++a.made;
  if (shapeStack_.size() > a.shapeStackBase) {
    leaveBracket();
  } else {
    endActivation();
  }
}

// Goes on behind the ']' of the innermost open bracket: brackets are nested in the code as they are
// in the text. What began in place within the bracket ends with it.
void Machine::leaveBracket() {
  while (inPlace_.size() > shapeStack_.back().inPlace) endInPlace();
  for (size_t open = 1; open > 0; ++pc_) {
    if (pc_->code == Code::PushShape) ++open;
    if (pc_->code == Code::PopShape) --open;
  }
  popShape();
}

void Machine::fillBlock(uint32_t number, const Value* values, PartPlan& plan, BlockInput& input) {
  const BlockCode& block = program_.blocks[number];
  input.children = &children_;
  input.pieces = &pieces_;
  input.plan = &plan;
  input.slotCount = static_cast<uint32_t>(block.slots.size());
  input.preferredSizes = block.preferredSizes;
  input.figures = block.figures;
  if (block.kind == BlockKind::Split) {
    input.split = splits_.at(number, values);
  } else if (block.kind == BlockKind::Selectors || block.kind == BlockKind::Operations) {
    input.selectors = selectors_.of(block, values);
  }
}

// A box or a rectangle that is divided like the one before needs no call: the parts are known.
bool Machine::splitAsBefore(const Instruction& i, Activation& a, const Value* values) {
  const SplitMemo& memo = *splits_.at(i.y - 1u, values).memo;
  const Geometry& g = a.shape.geometry;
  if (!memo.known || memo.givenOutOf != g.kind || g.kind == GeometryKind::None || g.uv ||
      isDeformed(a.shape) ||
      std::fabs(a.shape.size[static_cast<size_t>(memo.plan.axis)]) != memo.whole) {
    return false;
  }
  a.plan = memo.plan;
  a.plan.path = hashCombine(a.shape.path, program_.sites[pcOf(&i)]);
  pieces_.insert(pieces_.end(), memo.pieces.begin(), memo.pieces.end());
  return true;
}

namespace {

template <class Run>
Status guardedKeeping(Shape& shape, const Run& run) {
  Shape before = shape;
  Status status = guarded(run);
  if (!status.ok()) shape = std::move(before);
  return status;
}

}  // namespace

// The door of operations. What unwinds out of one ends here, and the shape is as it was before; so
// does what comes out with numbers that are not finite. A copy is kept where the operation may get
// so far as to take the shape apart, and where numbers are so large that they may overflow.
Status Machine::apply(OpCall& call, const Instruction& i, std::span<const Value> arguments,
                      const BlockInput* block) {
  const OpSpec& spec = call.spec();
  if (!allHold(arguments, pool())) {
    Status refused = refusedNumber(spec, program_.operations[i.a].form, arguments, pool());
    if (!refused.ok()) return refused;
  }
  const size_t firstChild = children_.size(), firstPiece = pieces_.size();
  const auto run = [&] {
    Status status =
        incremental_ && worksInTheOpen() ? applyRemembering(call, i, arguments, block) : call.run();
    if (!status.ok() || madeFinite(call.shape(), firstChild, firstPiece)) return status;
    return call.fail("not-finite", "the result has sizes or places that are no finite numbers",
                     "look for a division by zero, or for sizes that grow with each turn");
  };
  const bool whole = spec.stepsPerVertex == 1 && isModerate(call.shape()) &&
                     call.shape().geometry.kind != GeometryKind::Mesh;
  if (!whole) return guardedKeeping(call.shape(), run);
  Status status = guarded(run);
  // Without a copy there is nothing to go back to.
  if (!status.ok() && !hasFiniteScope(call.shape())) {
    call.shape().scope = Frame{};
    call.shape().size = {};
    call.shape().geometry = Geometry{};
  }
  return status;
}

bool Machine::madeFinite(const Shape& s, size_t firstChild, size_t firstPiece) const {
  bool finite = hasFiniteScope(s);
  for (size_t c = firstChild; c < children_.size(); ++c) {
    finite = finite && hasFiniteScope(children_[c].shape);
  }
  for (size_t p = firstPiece; p < pieces_.size(); ++p) {
    finite = finite && isFinite(Vec3{pieces_[p].start, pieces_[p].size, 0});
  }
  return finite;
}

void Machine::operation(const Instruction& i, const Value* constants) {
  Activation& a = current();
  const OpSpec& spec = *program_.operations[i.a];
  if (!tick(stepsOf(spec, a.shape))) return;
  const BlockCode* block = i.y > 0 ? &program_.blocks[i.y - 1] : nullptr;
  const uint32_t blockValues = block ? block->valueCount : 0;
  const uint32_t argumentsOnStack = constants ? 0 : i.x;
  const Value* stack = stack_.take(blockValues + argumentsOnStack);
  const Value* arguments = constants ? constants : stack;
  const Value* blockStart = stack + argumentsOnStack;
  const auto childBase = static_cast<uint32_t>(block ? children_.size() : 0);
  const auto pieceBase = static_cast<uint32_t>(block ? pieces_.size() : 0);
  if (block && block->kind == BlockKind::Split && argumentsOnStack == 0 &&
      splitAsBefore(i, a, blockStart)) {
    return beginChildren(i, childBase, pieceBase);
  }

  if (isDeformed(a.shape) && (spec.effects & kTakesDeformed) == 0) bakeDeformation(a.shape);
  const CallPlace place{a.previous.frame, a.previous.size,
                        program_.files[program_.rules[a.rule].file], program_.sites[pcOf(&i)],
                        program_.operations[i.a].form};
  BlockInput input;
  if (block) fillBlock(i.y - 1u, blockStart, a.plan, input);
  OpCall call(spec, a.shape, {arguments, i.x}, *this, place, block ? &input : nullptr);
  if (context_.collects() && (spec.effects & kLeavesOccluder) != 0) {
    context_.add(0, a.shape, placeAtWork());
  }
  instruction_ = &i;
  stack_.hold(blockValues + argumentsOnStack);
  const Status status = apply(call, i, {arguments, i.x}, block ? &input : nullptr);
  stack_.hold(0);
  if (!status.ok()) {
    if (block) {
      children_.erase(children_.begin() + childBase, children_.end());
      pieces_.erase(pieces_.begin() + pieceBase, pieces_.end());
    }
    tellFailure(spec.name, status);
    // Without its parts the shape itself stays as a leaf, so that nothing is lost.
    return;
  }
  if (call.dropped()) {
    dropShape();
    return;
  }
  if (!block) {
    const uint64_t vertices = verticesOf(a.shape);
    tally_.countSteps(vertices);
    if (vertices > options().limits.shapeVertices) shapeTooLarge(spec);
    return;
  }
  if (call.gathers() && children_.size() > childBase) beginGather(i, {arguments, i.x});
  beginChildren(i, childBase, pieceBase);
}

// Starts on the children that an operation has left beyond the marks.
void Machine::beginChildren(const Instruction& i, uint32_t childBase, uint32_t pieceBase) {
  Activation& a = current();
  ++a.made;
  a.inPieces = pieces_.size() > pieceBase;
  a.childBase = a.childNext = a.inPieces ? pieceBase : childBase;
  a.childEnd = static_cast<uint32_t>(a.inPieces ? pieces_.size() : children_.size());
  const uint32_t count = a.childEnd - a.childBase;
  if (count > options().limits.width) {
    overLimit("too-many-children",
              "'" + std::string(program_.operations[i.a]->name) + "' makes " +
                  std::to_string(count) + " shapes of one",
              "use larger sizes, or raise the limit on width (--max-width)");
    return;
  }
  if (count == 0) return;
  a.block = static_cast<uint32_t>(i.y - 1);
  a.pc = pc_;
  nextChild();
}

// The shape itself goes: a leaf of that size would be too much for what comes after.
void Machine::shapeTooLarge(const OpSpec& spec) {
  current().shape.geometry = Geometry{};
  overLimit("too-much-geometry",
            "'" + std::string(spec.name) + "' gives the shape more than " +
                std::to_string(options().limits.shapeVertices) + " vertices",
            "end the recursion earlier, or divide the shape first");
}

void Machine::makeLeaf(Activation& a, StringId name, uint32_t source) {
  if (isDeformed(a.shape) && a.shape.geometry.kind != GeometryKind::None) bakeDeformation(a.shape);
  if (options().trace) traceLeaf(a, name, source);
  if (!putLeaf(a.shape, name, source)) return;
  if (context_.collects()) context_.add(0, a.shape, placeAtWork());
}

// For operations that leave their shape where it is, and go on.
void Machine::leaveLeaf() {
  if (!countShape()) return;
  Activation& a = current();
  if (a.made == 0) a.made = 1;
  // Growing fourfold touches less memory than doubling does; what is never touched costs nothing.
  std::vector<Leaf>& open = output_.openLeaves;
  if (open.size() == open.capacity() && open.size() >= kManyLeaves) open.reserve(open.size() * 4);
  makeLeaf(a, program_.rules[a.rule].name, pcOf(instruction_));
  ++activations_[a.owner].childCount;
}

// False for a shape without geometry.
bool Machine::putLeaf(const Shape& s, StringId name, uint32_t source) {
  if (s.geometry.kind == GeometryKind::None) return false;
  if (s.geometry.kind == GeometryKind::Mesh && s.geometry.mesh->empty()) return false;
  // Leaves that are boxes or rectangles have no tags, so what is gathered with them is a mesh.
  if (s.geometry.kind != GeometryKind::Mesh && gathers_.anyTagged() &&
      s.geometry.tags != decltype(s.geometry.tags){}) {
    Shape tagged = s;
    tagged.geometry = {GeometryKind::Mesh, false, {1, 1, 1}, meshInScope(s)};
    tagged.geometry.refSize = s.size;
    return putLeaf(tagged, name, source);
  }
  Leaf& leaf = output_.openLeaves.emplace_back();
  setShape(leaf, s, output_);
  if (flat_) leaf.frame = worlds_.ofLeaves() * s.scope;
  if (s.geometry.kind == GeometryKind::Mesh) {
    tally_.countVertices(s.geometry.mesh->positions.size());
  }
  leaf.materials = output_.materialNumber(s.material, s.assetMaterials);
  leaf.name = name;
  leaf.source = source;
  leaf.attributes = s.attributes;
  return true;
}

void Machine::pushShape() {
  Activation& a = current();
  SavedShape& saved = shapeStack_.emplace_back(a.shape);
  saved.inPlace = inPlace_.size();
  if (!program_.rules[a.rule].needsPrevious) return;
  saved.previous = a.previous;
  a.keepScope();
}

void Machine::popShape() {
  Activation& a = current();
  if (shapeStack_.size() == a.shapeStackBase) return;
  SavedShape& saved = shapeStack_.back();
  a.shape = std::move(saved.shape);
  if (program_.rules[a.rule].needsPrevious) a.previous = saved.previous;
  shapeStack_.pop_back();
}

// A value that a block around binds hides the shape's own, so it is bound anew.
void Machine::setAttribute(const Instruction& i) {
  const Value v = pop();
  Shape& s = current().shape;
  if (locals_.find(s.locals, i.a))
    bind(i.a, v);
  else
    s.attributes = attributes().with(s.attributes, i.a, v);
}

void Machine::setBuiltin(const Instruction& i, const Value& v) {
  Activation& a = current();
  instruction_ = &i;
  const AttributeSpec& spec = *program_.builtinAttributes[i.a];
  if (isDeformed(a.shape) && (spec.effects & kTakesDeformed) == 0) bakeDeformation(a.shape);
  const CallPlace place{a.previous.frame, a.previous.size,
                        program_.files[program_.rules[a.rule].file]};
  OpCall call(*builtinSetSpec_, a.shape, {&v, 1}, *this, place);
  Status status = refusedNumber(spec.name, v, pool());
  if (status.ok()) status = guarded([&] { return spec.set(call, v); });
  if (!status.ok()) tellFailure(nullptr, status);
}

}  // namespace gable
