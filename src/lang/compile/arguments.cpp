// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Arguments that the operation works out itself: numbers that are drawn, and selections. What in
// them is no constant becomes code of its own, which stands before the call, jumped over.

#include "lang/compile/unit_compiler.h"

namespace gable::lang {

using Kind = ArgumentTerm::Kind;

bool UnitCompiler::isCode(const ParamSpec& param) const {
  return param.type == ParamType::Drawn || param.type == ParamType::DrawnList ||
         param.type == ParamType::Selection;
}

ValueCode UnitCompiler::valueCode(NodeId node) {
  ValueCode code;
  if (constantOf(node, code.constant)) return code;
  const uint32_t over = e_.jump(Code::Jump, t_.span(node));
  code.entry = e_.here();
  expression(node);
  e_.emit(Code::Return, t_.span(node));
  e_.land(over);
  return code;
}

// One number; rand(a, b) alone is a range, so that the operation knows its bounds.
void UnitCompiler::drawn(NodeId node, std::vector<ArgumentTerm>& out) {
  ArgumentTerm term;
  if (t_.kind(node) == NodeKind::Floating || t_.kind(node) == NodeKind::Relative) {
    term.unit =
        t_.kind(node) == NodeKind::Floating ? ::gable::Unit::Floating : ::gable::Unit::Relative;
    node = t_.child(node, 0);
  }
  const Resolution& ref = m_.at(node);
  const bool evenly = t_.kind(node) == NodeKind::Call && ref.kind == RefKind::BuiltinFunction &&
                      std::string_view(ref.spec.function->name) == "rand" &&
                      t_.children(t_.child(node, 0)).size() == 2 &&
                      m_.namedArguments.count(node) == 0;
  if (evenly) {
    term.kind = Kind::Range;
    uses_.effects |= kRandom;
    for (const NodeId bound : t_.children(t_.child(node, 0))) {
      term.values.push_back(valueCode(bound));
    }
  } else {
    term.values.push_back(valueCode(node));
  }
  out.push_back(std::move(term));
}

Value UnitCompiler::codeOf(NodeId node, const ParamSpec& param) {
  Value plain;
  const bool word = param.type == ParamType::Selection && t_.kind(node) == NodeKind::Name &&
                    m_.at(node).kind == RefKind::Selector &&
                    (!m_.at(node).spec.term || m_.at(node).spec.term->paramCount == 0);
  if (word) return e_.program().pool->selector(t_.text(node));
  // A number is what it is. A word without brackets may stand for a call with its defaults.
  if (m_.at(node).kind != RefKind::Selector && constantOf(node, plain)) return plain;
  ArgumentCode code;
  if (param.type == ParamType::Selection) {
    selection(node, param, code.terms);
  } else if (param.type == ParamType::DrawnList && t_.kind(node) == NodeKind::Array) {
    code.list = true;
    for (const NodeId row : t_.children(node)) {
      for (const NodeId item : t_.children(row)) drawn(item, code.terms);
    }
  } else {
    drawn(node, code.terms);
  }
  std::vector<ArgumentCode>& all = e_.program().arguments;
  all.push_back(std::move(code));
  return Value::code(static_cast<uint32_t>(all.size() - 1));
}

void UnitCompiler::selection(NodeId node, const ParamSpec& param, std::vector<ArgumentTerm>& out) {
  const Resolution& ref = m_.at(node);
  const NodeKind kind = t_.kind(node);
  const bool named = kind == NodeKind::Name || kind == NodeKind::Call;
  if (named && ref.kind == RefKind::Selector && ref.spec.term) {
    return term(node, *ref.spec.term, param, out);
  }
  ArgumentTerm here;
  if (kind == NodeKind::Unary && t_.unaryOp(node) == UnaryOp::Not) {
    selection(t_.child(node, 0), param, out);
    here.kind = Kind::Not;
    out.push_back(std::move(here));
    return;
  }
  // What the analysis took for a selection is marked so; a difference of numbers is a number.
  const bool joined =
      kind == NodeKind::Binary &&
      (t_.binaryOp(node) == BinaryOp::And || t_.binaryOp(node) == BinaryOp::Or ||
       (t_.binaryOp(node) == BinaryOp::Subtract && m_.types[t_.child(node, 0)] == ValueType::Code &&
        m_.types[t_.child(node, 1)] == ValueType::Code));
  if (!joined) {
    here.values.push_back(valueCode(node));
    out.push_back(std::move(here));
    return;
  }
  selection(t_.child(node, 0), param, out);
  selection(t_.child(node, 1), param, out);
  here.kind = t_.binaryOp(node) == BinaryOp::And  ? Kind::And
              : t_.binaryOp(node) == BinaryOp::Or ? Kind::Or
                                                  : Kind::Minus;
  out.push_back(std::move(here));
}

void UnitCompiler::term(NodeId node, const TermSpec& spec, const ParamSpec& param,
                        std::vector<ArgumentTerm>& out) {
  ArgumentTerm here;
  here.kind = Kind::Term;
  here.spec = &spec;
  const auto order = m_.namedArguments.find(node);
  for (size_t p = 0; p < spec.paramCount; ++p) {
    const ParamSpec& wanted = spec.params[p];
    const NodeId given =
        order != m_.namedArguments.end() && p < order->second.size() ? order->second[p] : kNoNode;
    if (wanted.type == ParamType::Selection) {
      if (given == kNoNode) continue;
      selection(given, param, out);
      ++here.operands;
    } else if (given != kNoNode) {
      here.values.push_back(valueCode(given));
    } else {
      ValueCode code;
      code.constant = defaultValue(wanted, *e_.program().pool);
      here.values.push_back(code);
    }
  }
  out.push_back(std::move(here));
}

// Whether a selection looks at the world: facing(world.west).
bool UnitCompiler::namesWorldIn(NodeId node) const {
  std::vector<NodeId> open{node};
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    if (n == kNoNode) continue;
    if (t_.kind(n) == NodeKind::Name && m_.at(n).kind == RefKind::Selector &&
        namesWorld(t_.text(n))) {
      return true;
    }
    for (const NodeId c : t_.children(n)) open.push_back(c);
  }
  return false;
}

}  // namespace gable::lang
