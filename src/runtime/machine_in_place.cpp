// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What changes the present shape in passing, without a child: rules run in place (do), turns
// (repeat) and attribute values for a while (local). Each is a frame on a stack of its own; an
// activation that ends early (NIL) drops the frames that it opened.
//
// A rule run in place and every turn have an address of their own for chance.

#include <algorithm>

#include "runtime/machine.h"

namespace gable {

namespace {

constexpr size_t kManyLeaves = 1u << 14;

}  // namespace

InPlaceFrame& Machine::openFrame(InPlaceFrame::Kind kind) {
  const uint32_t before = portion_ ? portion_->inPlace : 0;
  const uint32_t calls = frames_.empty() ? before : frames_.back().calls;
  InPlaceFrame& f = frames_.emplace_back();
  f.kind = kind;
  f.calls = calls;
  return f;
}

// Rules in place and turns make no shapes, so that they need a limit of their own.
bool Machine::countStep() {
  tally_.countTurn();
  return tick();
}

void Machine::runRule(const Instruction& i) {
  if (!countStep()) return;
  Activation& a = current();
  const RuleCode& code = program_.rules[i.a];
  InPlaceFrame& f = openFrame(InPlaceFrame::Kind::Rule);
  if (a.depth + ++f.calls > options().limits.depth) {
    overLimit("recursion-too-deep",
              "rules call each other more than " + std::to_string(options().limits.depth) +
                  " levels deep",
              "end the recursion with a case, or raise the limit on depth (--max-depth)");
    return;
  }
  f.back = pc_;
  f.parameters = a.parameters;
  f.stackBase = stackTop_ - i.x;
  f.rule = a.rule;
  f.path = a.shape.path;
  if (code.needsPrevious) {
    f.keepsPrevious = true;
    f.previous = static_cast<uint32_t>(previous_.size());
    previous_.emplace_back(a.previousScope, a.previousSize);
    a.previousScope = a.shape.scope;
    a.previousSize = a.shape.size;
  }
  a.shape.path = hashCombine(a.shape.path, program_.sites[pcOf(&i)]);
  a.rule = i.a;
  a.parameters = parameters_ = f.stackBase;
  pc_ = program_.code.data() + code.entry;
}

void Machine::endInPlace() {
  const InPlaceFrame& f = frames_.back();
  Activation& a = current();
  a.shape.path = f.path;
  a.rule = f.rule;
  a.parameters = parameters_ = f.parameters;
  stackTop_ = f.stackBase;
  pc_ = f.back;
  if (f.keepsPrevious) {
    // Activations that ended early may have left theirs above.
    a.previousScope = previous_[f.previous].first;
    a.previousSize = previous_[f.previous].second;
    previous_.resize(f.previous);
  }
  frames_.pop_back();
}

void Machine::beginTurns(const Instruction& i) {
  const double count = pop().number;
  if (!(count >= 1)) {
    pc_ = program_.code.data() + i.a;
    return;
  }
  Shape& s = current().shape;
  InPlaceFrame& f = openFrame(InPlaceFrame::Kind::Turns);
  f.turns = static_cast<uint32_t>(std::min(count, 4e9));
  f.split = s.split;
  f.path = s.path;
  s.split = {0, f.turns};
  f.loopPath = hashCombine(f.path, program_.sites[pcOf(&i)]);
  s.path = hashCombine(f.loopPath, 0);
}

void Machine::endTurn(const Instruction& i) {
  if (!countStep()) return;
  InPlaceFrame& f = frames_.back();
  Shape& s = current().shape;
  if (++f.turn == f.turns) {
    endTurns();
    return;
  }
  if (f.turn >= options().limits.width) {
    overLimit("too-many-turns",
              "a loop takes more than " + std::to_string(options().limits.width) + " turns",
              "repeat less often, or raise the limit on width (--max-width)");
    return;
  }
  s.split = {f.turn, f.turns};
  s.path = hashCombine(f.loopPath, f.turn);
  pc_ = program_.code.data() + i.a;
}

void Machine::endTurns() {
  const InPlaceFrame& f = frames_.back();
  Shape& s = current().shape;
  s.split = f.split;
  s.path = f.path;
  frames_.pop_back();
}

// Ends what is at work in place before its end. After a rule the code goes on behind its call.
void Machine::closeFrame() {
  switch (frames_.back().kind) {
    case InPlaceFrame::Kind::Rule: endInPlace(); break;
    case InPlaceFrame::Kind::Turns: endTurns(); break;
    case InPlaceFrame::Kind::Locals: endLocals(); break;
  }
}

void Machine::beginLocals() {
  InPlaceFrame& f = openFrame(InPlaceFrame::Kind::Locals);
  f.locals = current().shape.locals;
  f.localCount = static_cast<uint32_t>(locals_.size());
}

void Machine::bind(uint32_t attribute, const Value& v) {
  Shape& s = current().shape;
  s.locals = locals_.bind(s.locals, attribute, v);
}

void Machine::endLocals() {
  const InPlaceFrame& f = frames_.back();
  current().shape.locals = f.locals;
  locals_.cut(f.localCount);
  frames_.pop_back();
}

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

}  // namespace gable
