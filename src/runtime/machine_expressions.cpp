// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions. A function or an attribute's initialiser runs in the same loop as the rule that
// asks: a frame remembers where to go on. Attributes are evaluated once an initial shape, on that
// shape, at the first use; only a sharing key asks for one out of turn (evaluateAttribute).

#include <cmath>

#include "base/random.h"
#include "runtime/array_ops.h"
#include "runtime/machine.h"

namespace gable {

bool Machine::evaluate(const Instruction& i) {
  switch (i.code) {
    case Code::Constant: push(program_.constants[i.a]); return true;
    case Code::Parameter: push(*stack_.at(parameters_ + i.a)); return true;
    case Code::RuleAttribute: ruleAttribute(i); return true;
    case Code::BuiltinAttribute: builtinAttribute(i); return true;
    case Code::Function: callFunction(i); return true;
    case Code::BuiltinFunction: callBuiltin(i); return true;
    case Code::Negate: put(negateValue(pop(), pool()), i); return true;
    case Code::Not: not_(i); return true;
    case Code::Binary: binary(i); return true;
    case Code::MakeArray: makeArray(i); return true;
    case Code::MakeRange: makeRange(i); return true;
    case Code::Index: index(i); return true;
    case Code::WithUnit: stack_.top().unit = static_cast<Unit>(i.x); return true;
    case Code::ToBool: stack_.top() = Value::of(stack_.top().truth()); return true;
    case Code::Jump: pc_ = program_.code.data() + i.a; return true;
    case Code::JumpIfFalse:
      if (!pop().truth()) pc_ = program_.code.data() + i.a;
      return true;
    case Code::JumpIfFalseKeep:
      if (!stack_.top().truth())
        pc_ = program_.code.data() + i.a;
      else
        pop();
      return true;
    case Code::JumpIfTrueKeep:
      if (stack_.top().truth())
        pc_ = program_.code.data() + i.a;
      else
        pop();
      return true;
    case Code::Choose: choose(i); return true;
    case Code::JumpTable: {
      const auto& table = program_.jumpTables[i.a];
      pc_ = program_.code.data() + table[static_cast<size_t>(pop().number)];
      return true;
    }
    case Code::Return: returnValue(); return true;
    case Code::Initialise: initialise(i); return true;
    case Code::ComponentValues: componentValues(i); return true;
    default: return false;
  }
}

void Machine::put(const ValueOrError& r, const Instruction& i) {
  if (r.error) {
    instruction_ = &i;
    warn(r.code, r.error, "");
  }
  push(r.value);
  weigh(r.value);
}

void Machine::binary(const Instruction& i) {
  const auto op = static_cast<BinaryOperator>(i.x);
  const Value b = pop(), a = pop();
  // The common case first: plain arithmetic and comparison of numbers.
  if (a.type == ValueType::Float && b.type == ValueType::Float) {
    switch (op) {
      case BinaryOperator::Add: push(Value::of(a.number + b.number)); return;
      case BinaryOperator::Subtract: push(Value::of(a.number - b.number)); return;
      case BinaryOperator::Multiply: push(Value::of(a.number * b.number)); return;
      case BinaryOperator::Divide: push(Value::of(a.number / b.number)); return;
      case BinaryOperator::Less: push(Value::of(a.number < b.number)); return;
      case BinaryOperator::Greater: push(Value::of(a.number > b.number)); return;
      case BinaryOperator::Equal: push(Value::of(a.number == b.number)); return;
      default: break;
    }
  }
  put(applyBinary(op, a, b, pool()), i);
}

void Machine::not_(const Instruction& i) {
  const Value v = pop();
  if (!v.isArray()) {
    push(Value::of(!v.truth()));
    return;
  }
  Array a = pool().array(v);
  if (a.element != ValueType::Bool) {
    put({v, "'!' takes truth values"}, i);
    return;
  }
  for (double& x : a.numbers) x = x != 0 ? 0 : 1;
  push(pool().intern(std::move(a)));
}

void Machine::makeArray(const Instruction& i) {
  const auto& counts = program_.jumpTables[i.a];
  uint32_t total = 0;
  for (uint32_t c : counts) total += c;
  put(buildArray({stack_.take(total), total}, counts, pool()), i);
}

void Machine::makeRange(const Instruction& i) {
  const double end = pop().number;
  const double step = i.x ? pop().number : 1;
  const double start = pop().number;
  put(buildRange(start, step, end, options().limits.arraySize, pool()), i);
}

void Machine::index(const Instruction& i) {
  const Value* at = stack_.take(i.x + 1u);
  put(indexArray(at[0], {at + 1, i.x}, pool()), i);
}

// Shares are of 1; without an `else` (the last way) the rest does nothing.
void Machine::choose(const Instruction& i) {
  const Value* shares = stack_.take(i.y);
  const uint64_t site = hashCombine(salt_, program_.sites[pcOf(&i)]);
  const double draw = randomUnit(hashCombine(seen_->path, site));
  double sum = 0;
  uint32_t chosen = i.y;
  for (uint32_t k = 0; k < i.y; ++k) {
    sum += shares[k].number;
    if (draw < sum) {
      chosen = k;
      break;
    }
  }
  if (tracer_.tracesShapes()) {
    const double chance = chosen < i.y ? shares[chosen].number : 1 - sum;
    tracer_.noteChoice(traceNode(), program_.spans[pcOf(&i)], {draw, chance, chosen, i.y});
  }
  push(Value::of(static_cast<double>(chosen)));
}

void Machine::pushAttribute(uint32_t a, const Value& v) {
  push(v);
  if (tracer_.tracesShapes()) tracer_.noteAttribute(traceNode(), a, v);
}

void Machine::ruleAttribute(const Instruction& i) {
  const uint32_t a = i.a;
  if (seen_->locals != 0) {
    if (const Value* local = locals_.find(seen_->locals, a)) {
      pushAttribute(a, *local);
      return;
    }
  }
  if (const Value* given = openAttributes_.find(seen_, a)) {
    pushAttribute(a, *given);
    return;
  }
  if (seen_->attributes != 0) {
    if (const Value* set = attributes().find(seen_->attributes, a)) {
      pushAttribute(a, *set);
      return;
    }
  }
  if (attributeValues_.isKnown(a)) {
    pushAttribute(a, attributeValues_.value(a));
    return;
  }
  instruction_ = &i;
  enterAttribute(a, pc_);
}

// Begins the evaluation of an attribute; execution goes on at `returnTo` with its value on the
// stack.
void Machine::enterAttribute(uint32_t a, const Instruction* returnTo) {
  if (stack_.isNearlyFull()) {
    stackFull();
    push(Value::of(0.0));
    return;
  }
  if (attributeValues_.isBusy(a)) {
    // The way around, as the frames on the stack tell it.
    const auto from = std::find_if(functions_.begin(), functions_.end(), [&](const auto& f) {
      return f.attribute == static_cast<int32_t>(a);
    });
    std::string path;
    for (auto f = from; f != functions_.end(); ++f) {
      if (f->attribute < 0) continue;
      path += program_.attributes[static_cast<uint32_t>(f->attribute)].name + " -> ";
    }
    const std::string& name = program_.attributes[a].name;
    warn("cyclic-attribute", "the value of '" + name + "' needs itself: " + path + name,
         "break the circle with a constant");
    push(Value::of(0.0));
    return;
  }
  attributeValues_.beginEvaluation(a);
  functions_.push_back(
      {returnTo, parameters_, stack_.size(), static_cast<int32_t>(a), seen_, salt_, divided_});
  parameters_ = stack_.size();
  seen_ = &info_.shape;
  divided_ = nullptr;
  salt_ = 0;
  pc_ = program_.code.data() + program_.attributes[a].entry;
}

void Machine::callFunction(const Instruction& i) {
  if (functions_.size() >= options().limits.functionDepth || stack_.isNearlyFull()) {
    overLimit("function-too-deep",
              "functions call each other more than " +
                  std::to_string(options().limits.functionDepth) + " levels deep",
              "end the recursion with a case");
    return;
  }
  if (!tick()) return;
  functions_.push_back({pc_, parameters_, stack_.size() - i.x, -1, seen_, salt_, divided_});
  parameters_ = stack_.size() - i.x;
  salt_ = hashCombine(salt_, program_.sites[pcOf(&i)]);
  pc_ = program_.code.data() + program_.functions[i.a].entry;
}

void Machine::returnValue() {
  const Value v = pop();
  const FunctionFrame f = functions_.back();
  functions_.pop_back();
  if (f.attribute >= 0) attributeValues_.set(static_cast<uint32_t>(f.attribute), v);
  stack_.cut(f.stackBase);
  parameters_ = f.parameters;
  seen_ = f.shape;
  divided_ = f.divided;
  salt_ = f.salt;
  pc_ = f.returnTo;
  push(v);
  if (f.attribute >= 0 && tracer_.tracesShapes()) {
    tracer_.noteAttribute(traceNode(), static_cast<uint32_t>(f.attribute), v);
  }
}

// The attributes of a dynamic import are evaluated at the call, each time.
void Machine::initialise(const Instruction& i) {
  if (stack_.isNearlyFull()) {
    stackFull();
    return;
  }
  functions_.push_back({pc_, parameters_, stack_.size(), -1, seen_, salt_, divided_});
  parameters_ = stack_.size();
  salt_ = hashCombine(salt_, program_.sites[pcOf(&i)]);
  pc_ = program_.code.data() + program_.attributes[i.a].entry;
}

// comp(...) { selector expr } as an expression: the components of the shape are made and dropped
// again; each block body is evaluated on its component.
namespace {

// The values of parts in the order of components; those in no part have the type's default,
// which for arrays is one without columns.
std::vector<Value> valuesByComponent(const std::vector<Value>& values,
                                     const std::vector<uint32_t>& partOf, ValuePool& pool) {
  Value none = values.empty() ? Value::of(0.0) : values[0];
  none.id = 0;
  none.number = 0;
  if (none.isArray()) {
    const Array& first = pool.array(values[0]);
    none = pool.intern(Array{first.element, first.rows, 0, {}, {}});
  }
  std::vector<Value> out;
  for (const uint32_t part : partOf) out.push_back(part < values.size() ? values[part] : none);
  return out;
}

// What stands for a value that there is none of.
Value noneOf(ValueType type, ValuePool& pool) {
  if (type >= ValueType::FloatArray) {
    Array none;
    none.element = elementType(type);
    return pool.intern(std::move(none));
  }
  if (type == ValueType::String) return Value::string(0);
  return type == ValueType::Bool ? Value::of(false) : Value::of(0.0);
}

}  // namespace

void Machine::componentValues(const Instruction& i) {
  const BlockCode& block = program_.blocks[i.y - 1u];
  const Value* arguments = stack_.take(block.valueCount + i.x);
  // Components have the attributes of their shape.
  openAttributes_.close(attributes());
  Shape shape = *seen_;
  std::vector<BlockChild> parts;
  std::vector<uint32_t> partOf;
  BlockInput input;
  input.selectors = selectors_.of(block, arguments + i.x);
  input.slotCount = static_cast<uint32_t>(block.slots.size());
  input.children = &parts;
  input.componentChild = &partOf;
  const Frame scope = shape.scope;
  const Vec3 size = shape.size;
  const CallPlace place{scope, size, fileOf(i), program_.sites[pcOf(&i)],
                        program_.operations[i.a].form};
  OpCall call(*program_.operations[i.a], shape, {arguments, i.x}, *this, place, &input);
  instruction_ = &i;
  const Status status = guarded([&] { return call.run(); });
  if (!status.ok()) {
    tellFailure(program_.operations[i.a]->name, status);
    parts.clear();
    partOf.clear();
  }
  const Instruction* resumeAt = pc_;
  const Shape* outer = seen_;
  const Shape* divided = divided_;
  std::vector<Value> values;
  for (const BlockChild& part : parts) {
    if (aborted_ || functions_.size() >= options().limits.functionDepth) break;
    if (stack_.isNearlyFull() && !stackFull()) break;
    const size_t depth = functions_.size();
    functions_.push_back({resumeAt, parameters_, stack_.size(), -1, outer, salt_, divided_});
    seen_ = &part.shape;
    divided_ = block.condition ? outer : nullptr;
    pc_ = program_.code.data() + block.slots[part.slot];
    runUntil(depth);
    if (aborted_) break;
    values.push_back(pop());
  }
  pc_ = resumeAt;
  seen_ = outer;
  divided_ = divided;
  const auto count = static_cast<uint32_t>(partOf.size());
  put(buildArray(valuesByComponent(values, partOf, pool()), {&count, 1}, pool()), i);
}

// The loop for expressions that C++ asks for; ends when the functions begun since have returned.
void Machine::runUntil(size_t depth) {
  while (functions_.size() > depth && !aborted_) {
    const Instruction& next = *pc_++;
    evaluate(next);
  }
}

Value Machine::evaluateAttribute(uint32_t a) {
  if (attributeValues_.isKnown(a)) return attributeValues_.value(a);
  const Instruction* resumeAt = pc_;
  const size_t depth = functions_.size();
  enterAttribute(a, pc_);
  runUntil(depth);
  pc_ = resumeAt;
  return aborted_ ? Value{} : pop();
}

// The door of functions. One that unwinds has the value that stands for none.
Value Machine::callGuarded(FunctionCall& call, Value (*function)(FunctionCall&), uint32_t effects,
                           const char* name, ValueType result) {
  Value v;
  const Status status = guarded([&] {
    v = call.run(function, effects);
    return Status();
  });
  if (status.ok()) return v;
  tellFailure(name, status);
  return noneOf(result, pool());
}

// The values that the operation or function was given lie above the top and stay as they are.
Value Machine::evaluateAtWork(uint32_t entry, uint64_t address, const Shape* as) {
  if (aborted_ || functions_.size() >= options().limits.functionDepth || stack_.isNearlyFull()) {
    return {};
  }
  if (!tick()) return {};
  const Instruction* resumeAt = pc_;
  const Instruction* caller = instruction_;
  const Shape* outer = seen_;
  openAttributes_.close(attributes());
  Shape at = as ? *as : *seen_;
  at.path = address;
  const uint32_t covered = stack_.cover();
  const size_t depth = functions_.size();
  functions_.push_back({resumeAt, parameters_, stack_.size(), -1, outer, salt_, divided_});
  seen_ = &at;
  pc_ = program_.code.data() + entry;
  runUntil(depth);
  const Value v = aborted_ ? Value{} : pop();
  pc_ = resumeAt;
  instruction_ = caller;
  seen_ = outer;
  stack_.uncover(covered);
  return v;
}

void Machine::builtinAttribute(const Instruction& i) {
  FunctionCall call({}, *seen_, *this);
  call.place(fileOf(i), 0);
  instruction_ = &i;
  const AttributeSpec& spec = *program_.builtinAttributes[i.a];
  push(callGuarded(call, spec.get, spec.effects, spec.name, spec.type));
}

void Machine::callBuiltin(const Instruction& i) {
  const Value* arguments = stack_.take(i.x);
  const auto& [spec, form] = program_.builtinFunctions[i.a];
  FunctionCall call({arguments, i.x}, *seen_, *this, spec, form);
  call.place(fileOf(i), hashCombine(salt_, program_.sites[pcOf(&i)]));
  instruction_ = &i;
  const FunctionSpec& function = *spec;
  stack_.hold(i.x);
  const Signature* const first = function.signatures.empty() ? nullptr : &function.signatures[0];
  const Signature* const used = form ? form : first;
  const Value v = callGuarded(call, function.call, function.effects, function.name,
                              used ? used->result : ValueType::Float);
  stack_.hold(0);
  if (tracer_.tracesShapes() && function.effects & kRandom) {
    tracer_.noteDraw(traceNode(), program_.spans[pcOf(&i)], function.name, v);
  }
  push(v);
  weigh(v);
}

}  // namespace gable
