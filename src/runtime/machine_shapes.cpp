// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The loop over instructions, and what changes shapes: rule calls, brackets, leaves.
//
// A rule call or a block slot is an activation on a stack; the program counter and the parameters
// of the innermost one are in registers (pc_, parameters_) and are put back when it ends. A block
// operation leaves its children on children_; they run one after the other before the rule goes on.

#include <utility>

#include "runtime/door.h"
#include "runtime/leaf_shape.h"
#include "runtime/machine.h"
#include "runtime/sharing.h"
#include "shape/deformation.h"
#include "shape/seeded_path.h"

namespace gable {

namespace {

constexpr size_t kManyLeaves = 1u << 14;

}  // namespace

void Machine::execute() {
  while (activationCount_ > 0 && !aborted_) {
    const Instruction& i = *pc_++;
    switch (i.code) {
      case Code::Operation: operation(i, nullptr); break;
      case Code::OperationConstant: operation(i, program_.constants.data() + (pc_++)->a); break;
      case Code::CallRule: callRule(i); break;
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
  if (isLeftOut(rule)) return leaveOut(argumentCount);
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
  a.rule = rule;
  if (last) {
    a.shape = std::move(caller.shape);
  } else {
    a.shape = caller.shape;
    if (const auto from = endOrigins(caller.shape, false)) beginOrigins(*from, a.shape);
  }
  a.stackBase = stack_.size() - argumentCount;
  a.parameters = a.stackBase;
  a.shapeStackBase = static_cast<uint32_t>(shapeStack_.size());
  a.inPlaceBase = inPlace_.size();
  a.localBase = static_cast<uint32_t>(locals_.size());
  a.childBase = a.childNext = a.childEnd = 0;
  a.ordinal = activations_[caller.owner].childCount++;
  a.step = caller.steps++;
  a.steps = 0;
  a.question = Activation::kNoQuestion;
  a.condition = caller.condition;
  if (enterRule(a, caller.depth, caller.traceNode, at)) return;
  stack_.cut(a.stackBase);
  --activationCount_;
}

// A slot that ends with a rule call has nothing left to do when the rule ends: its activation
// becomes the rule's, with the shape where it is.
void Machine::becomeRule(const Instruction& i) {
  if (!countShape()) return;
  if (isLeftOut(i.a)) return leaveOut(i.x);
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
  // What comes of a chosen address does not depend on where the call stands.
  const bool seeded = (code.reads.effects & kRandom) != 0 && seedOf(a.shape.path);
  const uint64_t site = seeded ? hashBytes(code.qualifiedName) : program_.sites[pcOf(at)];
  a.shape.path = hashCombine(a.shape.path, site);
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
  const bool shared = code.shared || (seeded && isSharedWhenSeeded(code.reads.effects));
  if (shared && beginShared(code, a)) return false;
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
  placeChild(parent, number, slot, a);
  if (gathers_.isDue(parentIndex + 1)) gathers_.beginChild(slot);
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
  keepDeleted(a.shape);
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

void Machine::makeLeaf(Activation& a, StringId name, uint32_t source) {
  if (leavesAreLeftOut()) return;
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
  const bool othersFollow = i.x != 0;
  if (locals_.find(s.locals, i.a)) {
    bind(i.a, v);
  } else if (othersFollow || openAttributes_.isOpen()) {
    if (!openAttributes_.isOpen()) openAttributes_.open(s);
    openAttributes_.set(i.a, v);
  } else {
    s.attributes = attributes().with(s.attributes, i.a, v);
  }
  if (!othersFollow) openAttributes_.close(attributes());
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
