// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Constant folding of numbers, truth values and texts. Children are older than their parents in the
// tree, so one pass by node id folds whole expressions; further passes carry the values of `const`
// declarations to their uses. What may fail or round differently at run time (division by zero,
// numbers as text, arrays) is left to the machine.

#include <cmath>
#include <string>

#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

Value foldUnary(UnaryOp op, const Value& v) {
  if (op == UnaryOp::Not) return v.type == ValueType::Bool ? Value::of(!v.truth()) : Value();
  if (v.type != ValueType::Float) return {};
  return Value::of(op == UnaryOp::Minus ? -v.number : v.number);
}

Value foldNumbers(BinaryOp op, double a, double b) {
  switch (op) {
    case BinaryOp::Add: return Value::of(a + b);
    case BinaryOp::Subtract: return Value::of(a - b);
    case BinaryOp::Multiply: return Value::of(a * b);
    case BinaryOp::Divide: return b == 0 ? Value() : Value::of(a / b);
    case BinaryOp::Modulo: return b == 0 ? Value() : Value::of(std::fmod(a, b));
    case BinaryOp::Equal: return Value::of(a == b);
    case BinaryOp::NotEqual: return Value::of(a != b);
    case BinaryOp::Less: return Value::of(a < b);
    case BinaryOp::LessEqual: return Value::of(a <= b);
    case BinaryOp::Greater: return Value::of(a > b);
    case BinaryOp::GreaterEqual: return Value::of(a >= b);
    default: return {};
  }
}

}  // namespace

Value Analysis::foldNode(const Module& m, const Tree& t, NodeId node) {
  const auto valueOf = [&](size_t child) { return m.constantAt(t.child(node, child)); };
  switch (t.kind(node)) {
    case NodeKind::Number: return Value::of(t.number(node));
    case NodeKind::Bool: return Value::of(t.number(node) != 0);
    case NodeKind::String: return values_.string(t.text(node));
    case NodeKind::Name: {
      const Resolution& r = m.resolutions[node];
      if (r.kind != RefKind::Attribute) return {};
      const AttributeInfo& a = program_.attributes[r.index];
      if (!a.constant || a.source != ValueSource::Own || a.slotCount > 0) return {};
      return program_.modules[a.valueModule].constantAt(a.valueNode);
    }
    case NodeKind::Unary:
      if (t.has(node, kFlagElementwise)) return {};
      return foldUnary(t.unaryOp(node), valueOf(0));
    case NodeKind::Binary: {
      if (t.has(node, kFlagElementwise)) return {};
      const Value a = valueOf(0);
      const Value b = valueOf(1);
      const BinaryOp op = t.binaryOp(node);
      if (a.type != b.type || a.type == ValueType::Null) return {};
      if (a.type == ValueType::Float) return foldNumbers(op, a.number, b.number);
      if (op == BinaryOp::Equal) return Value::of(a == b);
      if (op == BinaryOp::NotEqual) return Value::of(!(a == b));
      if (a.type == ValueType::Bool && op == BinaryOp::And)
        return Value::of(a.truth() && b.truth());
      if (a.type == ValueType::Bool && op == BinaryOp::Or) return Value::of(a.truth() || b.truth());
      if (a.type == ValueType::String && op == BinaryOp::Add) {
        return values_.string(std::string(values_.text(a.id)) + std::string(values_.text(b.id)));
      }
      return {};
    }
    default: return {};
  }
}

void Analysis::foldModule(ModuleId id, bool& changed) {
  const Tree& t = program_.tree(id);
  for (NodeId node = 1; node < t.size(); ++node) {
    Module& m = program_.modules[id];
    if (m.constantAt(node).type != ValueType::Null) continue;
    const Value v = foldNode(m, t, node);
    if (v.type == ValueType::Null) continue;
    (*m.constants)[node] = v;
    changed = true;
  }
}

void Analysis::foldConstants() {
  // Chains of constants longer than this stay unfolded, which costs only speed.
  constexpr int kPasses = 8;
  for (Module& m : program_.modules) {
    if (m.original == m.id && !m.constants) {
      m.constants = std::make_shared<std::vector<Value>>(m.types.size());
    }
  }
  for (Module& m : program_.modules) m.constants = program_.modules[m.original].constants;
  bool changed = true;
  for (int pass = 0; pass < kPasses && changed; ++pass) {
    changed = false;
    for (const Module& m : program_.modules) {
      if (m.original == m.id) foldModule(m.id, changed);
    }
  }
}

}  // namespace gable::lang
