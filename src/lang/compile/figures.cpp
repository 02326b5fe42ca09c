// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Figures: where the operations of a block begin with one, `junction : circle(3) Plaza`, the
// operation around makes it, and what stands behind it works on what came out. A choice among
// figures is made by the operation as well; the shape then says which one it is, and the choice in
// the block follows that.

#include "lang/compile/unit_compiler.h"

namespace gable::lang {

bool UnitCompiler::isFigure(NodeId successor) const {
  return t_.kind(successor) == NodeKind::Apply && t_.children(successor).size() == 1 &&
         m_.at(successor).kind == RefKind::Operation && m_.at(successor).spec.operation->figure;
}

bool UnitCompiler::hasFigure(NodeId successor) const {
  if (t_.kind(successor) != NodeKind::Choice) return isFigure(successor);
  for (const NodeId branch : t_.children(successor)) {
    if (figureHead(t_.child(branch, 1)) != kNoNode) return true;
  }
  return false;
}

NodeId UnitCompiler::figureHead(NodeId sequence) const {
  const auto parts = t_.children(sequence);
  if (t_.kind(sequence) != NodeKind::Sequence || parts.empty()) return kNoNode;
  return hasFigure(parts[0]) ? parts[0] : kNoNode;
}

uint32_t UnitCompiler::figureOfBranch(NodeId sequence, uint32_t& ordinals) {
  const NodeId head = figureHead(sequence);
  if (head != kNoNode) return figure(head, ordinals);
  FigureCode none;
  none.ordinal = ++ordinals;
  e_.program().figures.push_back(none);
  return static_cast<uint32_t>(e_.program().figures.size() - 1);
}

uint32_t UnitCompiler::figure(NodeId successor, uint32_t& ordinals) {
  FigureCode code;
  if (t_.kind(successor) == NodeKind::Choice) {
    code.kind = t_.choiceKind(successor) == ChoiceKind::Case ? FigureCode::Kind::Case
                                                             : FigureCode::Kind::Percent;
    if (code.kind == FigureCode::Kind::Percent) uses_.effects |= kRandom;
    for (const NodeId branch : t_.children(successor)) {
      const NodeId condition = t_.child(branch, 0);
      if (condition != kNoNode) code.values.push_back(valueCode(condition));
      code.children.push_back(figureOfBranch(t_.child(branch, 1), ordinals));
    }
  } else {
    const OpSpec& spec = *m_.at(successor).spec.operation;
    const BuiltinArguments given =
        builtinArguments(successor, spec.signatures, t_.child(successor, 0));
    code.kind = FigureCode::Kind::Figure;
    code.spec = &spec;
    code.form = given.form;
    for (const BuiltinArguments::Argument& a : given.list) {
      ValueCode value;
      value.constant = a.fixed;
      code.values.push_back(a.node != kNoNode ? valueCode(a.node) : value);
    }
    code.ordinal = ++ordinals;
  }
  e_.program().figures.push_back(std::move(code));
  return static_cast<uint32_t>(e_.program().figures.size() - 1);
}

// The operations behind the figure. `ordinals` counts the figures as figure() did.
void UnitCompiler::behindFigure(NodeId sequence, const AttributeSpec& choice, uint32_t& ordinals) {
  const NodeId head = figureHead(sequence);
  const auto parts = t_.children(sequence);
  if (head == kNoNode) {
    ++ordinals;
    this->sequence(sequence);
    return;
  }
  if (isFigure(head)) {
    ++ordinals;
  } else {
    figureChoice(head, choice, ordinals);
  }
  for (size_t i = 1; i < parts.size(); ++i) successor(parts[i]);
}

uint32_t UnitCompiler::figuresIn(NodeId sequence) const {
  const NodeId head = figureHead(sequence);
  if (head == kNoNode || isFigure(head)) return 1;
  uint32_t sum = 0;
  for (const NodeId branch : t_.children(head)) sum += figuresIn(t_.child(branch, 1));
  return sum;
}

// The branch whose figure the shape is.
void UnitCompiler::figureChoice(NodeId node, const AttributeSpec& choice, uint32_t& ordinals) {
  const Span span = t_.span(node);
  const auto compare = [&](BinaryOperator op, uint32_t with) {
    e_.emit(Code::BuiltinAttribute, span, e_.attribute(&choice));
    e_.emit(Code::Constant, span, e_.constant(Value::of(static_cast<double>(with))));
    e_.emit(Code::Binary, span, 0, static_cast<uint8_t>(op));
    return e_.jump(Code::JumpIfFalse, span);
  };
  uses_.effects |= choice.effects;
  std::vector<uint32_t> ends;
  for (const NodeId branch : t_.children(node)) {
    const NodeId body = t_.child(branch, 1);
    const uint32_t first = ordinals + 1, last = ordinals + figuresIn(body);
    const uint32_t before = compare(BinaryOperator::GreaterEqual, first);
    const uint32_t after = compare(BinaryOperator::LessEqual, last);
    behindFigure(body, choice, ordinals);
    ends.push_back(e_.jump(Code::Jump, span));
    e_.land(before);
    e_.land(after);
  }
  for (const uint32_t jump : ends) e_.land(jump);
}

}  // namespace gable::lang
