// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What changes the present shape in passing, in the machine: do, repeat, local.

#include <algorithm>

#include "runtime/machine.h"

namespace gable {

// Rules in place and turns make no shapes, so that they need a limit of their own.
bool Machine::countStep() {
  tally_.countTurn();
  return tick();
}

void Machine::runRule(const Instruction& i) {
  if (!countStep()) return;
  Activation& a = current();
  if (a.depth + inPlace_.rules() + 1 > options().limits.depth) {
    overLimit("recursion-too-deep",
              "rules call each other more than " + std::to_string(options().limits.depth) +
                  " levels deep",
              "end the recursion with a case, or raise the limit on depth (--max-depth)");
    return;
  }
  const RuleCode& code = program_.rules[i.a];
  inPlace_.beginRule(a, code, i.a, program_.sites[pcOf(&i)], {pc_, stack_.size() - i.x});
  parameters_ = a.parameters;
  pc_ = program_.code.data() + code.entry;
}

void Machine::endRunRule() {
  Activation& a = current();
  const InPlace::Return back = inPlace_.endRule(a);
  parameters_ = a.parameters;
  stack_.cut(back.stackBase);
  pc_ = back.pc;
}

void Machine::beginTurns(const Instruction& i) {
  const double count = pop().number;
  if (!(count >= 1)) {
    pc_ = program_.code.data() + i.a;
    return;
  }
  const auto turns = static_cast<uint32_t>(std::min(count, 4e9));
  inPlace_.beginLoop(current().shape, turns, program_.sites[pcOf(&i)]);
}

void Machine::endTurn(const Instruction& i) {
  if (!countStep() || !inPlace_.nextTurn(current().shape)) return;
  if (inPlace_.turn() >= options().limits.width) {
    overLimit("too-many-turns",
              "a loop takes more than " + std::to_string(options().limits.width) + " turns",
              "repeat less often, or raise the limit on width (--max-width)");
    return;
  }
  pc_ = program_.code.data() + i.a;
}

// Ends what is at work in place before its end. After a rule the code goes on behind its call.
void Machine::endInPlace() {
  Shape& s = current().shape;
  switch (inPlace_.innermost()) {
    case InPlace::Kind::Rule: endRunRule(); break;
    case InPlace::Kind::Loop: inPlace_.endLoop(s); break;
    case InPlace::Kind::Locals: inPlace_.endLocals(s); break;
  }
}

void Machine::bind(uint32_t attribute, const Value& v) {
  Shape& s = current().shape;
  s.locals = locals_.bind(s.locals, attribute, v);
}

}  // namespace gable
