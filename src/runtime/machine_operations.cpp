// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations in the machine: what each is given, what it may not do, and the children of its block.

#include <cmath>

#include "runtime/door.h"
#include "runtime/finite.h"
#include "runtime/machine.h"
#include "shape/deformation.h"

namespace gable {

namespace {

uint64_t verticesOf(const Shape& s) {
  return s.geometry.kind == GeometryKind::Mesh ? s.geometry.mesh->positions.size() : 0;
}

uint64_t stepsOf(const OpSpec& spec, const Shape& s) {
  // A primitive is turned into a mesh by the operations that take long.
  const uint64_t vertices = verticesOf(s);
  return spec.stepsPerVertex > 1 ? (8 + vertices) * spec.stepsPerVertex : 1 + vertices;
}

}  // namespace

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
  const bool known = call.bound() && call.bound()->known;
  if (!known && !allHold(arguments, pool())) {
    Status refused = refusedNumber(spec, program_.operations[i.a].form, arguments, pool());
    if (!refused.ok()) return refused;
  }
  const size_t firstChild = children_.size(), firstPiece = pieces_.size();
  const auto run = [&] {
    Status status = incremental_ && !gathers_.anyOpen()
                        ? applyRemembering(call, i, arguments, block)
                        : call.run();
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
  // The instruction behind one with constant arguments carries the number of the call.
  const uint32_t numbered = constants ? (&i)[1].y : 0;
  const CallPlace place{a.previous.frame,
                        a.previous.size,
                        program_.files[program_.rules[a.rule].file],
                        program_.sites[pcOf(&i)],
                        program_.operations[i.a].form,
                        numbered > 0 ? &bound_[numbered - 1] : nullptr};
  BlockInput input;
  if (block) fillBlock(i.y - 1u, blockStart, a.plan, input);
  OpCall call(spec, a.shape, {arguments, i.x}, *this, place, block ? &input : nullptr);
  if (context_.collects() && (spec.effects & kLeavesOccluder) != 0) {
    context_.add(0, a.shape, placeAtWork());
  }
  if ((spec.effects & kAsksForRoom) != 0) a.claim = Activation::kNoClaim;
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
  if (options().trace) traceTags(a);
  if (!block) {
    const uint64_t vertices = verticesOf(a.shape);
    tally_.countSteps(vertices);
    if (vertices > options().limits.shapeVertices) shapeTooLarge(spec);
    return;
  }
  if (!call.gathers()) {
    handOver(spec, childBase);
  } else if (children_.size() > childBase) {
    beginGather(i, call, {arguments, i.x});
  }
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
  a.asked = (program_.operations[i.a]->effects & kAsksForRoom) != 0;
  a.stepBase = a.steps;
  a.steps += a.asked ? 1 : count;
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

}  // namespace gable
