// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Successors: operations, rule calls and choices. The slots of blocks are compiled behind the
// rule's own code (see blocks.cpp).

#include "lang/compile/unit_compiler.h"

namespace gable::lang {

void UnitCompiler::body(NodeId node, Span end) {
  sequence(node);
  e_.emit(Code::End, end);
  // Compiling a slot may add slots of inner blocks to the list.
  for (size_t i = 0; i < pending_.size(); ++i) {
    const PendingSlot slot = pending_[i];
    e_.program().blocks[slot.block].slots[slot.slot] = e_.here();
    uint32_t ordinals = 0;
    if (slot.figureChoice)
      behindFigure(slot.sequence, *slot.figureChoice, ordinals);
    else
      sequence(slot.sequence);
    e_.emit(Code::End, t_.span(slot.sequence));
  }
  pending_.clear();
}

void UnitCompiler::sequence(NodeId node) {
  for (NodeId part : t_.children(node)) {
    const size_t depth = e_.depth();
    successor(part);
    e_.settle(depth);
  }
}

void UnitCompiler::successor(NodeId node) {
  switch (t_.kind(node)) {
    case NodeKind::Apply: apply(node); break;
    case NodeKind::ImportApply: importApply(node); break;
    case NodeKind::Choice: choice(node, false); break;
    case NodeKind::Push:
      e_.emit(Code::PushShape, t_.span(node));
      sequence(t_.child(node, 0));
      e_.emit(Code::PopShape, t_.span(node));
      break;
    case NodeKind::Sequence: sequence(node); break;
    default: break;
  }
}

void UnitCompiler::apply(NodeId node) {
  const Resolution& ref = m_.at(node);
  const NodeId arguments = t_.child(node, 0);
  switch (ref.kind) {
    case RefKind::Operation: operation(node, *ref.spec.operation, arguments); break;
    case RefKind::Rule: callRule(node, ref.index, arguments); break;
    default: {
      const Value name = e_.program().pool->string(t_.text(node));
      e_.emit(Code::Leaf, t_.span(node), e_.constant(name));
      break;
    }
  }
}

void UnitCompiler::importApply(NodeId node) {
  const Resolution& ref = m_.at(node);
  if (ref.kind != RefKind::Rule) {
    apply(node);
    return;
  }
  enterDynamicImport(node);
  callRule(node, ref.index, t_.child(node, 2));
}

// The attributes of a dynamic import become attributes of the shape: first those that are given, in
// the caller's view, then the others, each seeing those before it.
void UnitCompiler::enterDynamicImport(NodeId node) {
  const DynamicImport* import = r_.dynamicImport(m_.id, node);
  if (!import) return;
  size_t left = import->given.size() + import->initOrder.size();
  const auto set = [&](Span span, AttributeId a) {
    e_.emit(Code::SetAttribute, span, a, --left > 0);
  };
  for (const DynamicImport::Given& g : import->given) {
    expression(g.value);
    set(t_.span(g.value), g.attribute);
  }
  for (AttributeId a : import->initOrder) {
    uses_.initialisers.insert(a);
    e_.emit(Code::Initialise, t_.span(node), a);
    set(t_.span(node), a);
  }
}

void UnitCompiler::callRule(NodeId node, uint32_t rule, NodeId arguments) {
  const size_t count = pushArguments(arguments);
  uses_.rules.insert(rule);
  uses_.branches = true;
  e_.emit(Code::CallRule, nameSpan(t_, node), rule, count, 0,
          e_.site(r_.rules[rule].qualifiedName));
}

// set(attribute, value): the first argument is a place, no value.
bool UnitCompiler::setStatement(NodeId node, NodeId arguments) {
  const auto named = m_.namedArguments.find(node);
  const std::span<const NodeId> list =
      named == m_.namedArguments.end() ? t_.children(arguments) : named->second;
  if (list.size() != 2) return false;
  const Resolution& place = m_.at(list[0]);
  if (place.kind != RefKind::Attribute && place.kind != RefKind::ShapeAttribute) return false;
  expression(list[1]);
  if (place.kind == RefKind::Attribute) {
    e_.emit(Code::SetAttribute, t_.span(arguments), place.index);
  } else {
    uses_.effects |= place.spec.attribute->effects;
    e_.emit(Code::SetBuiltin, t_.span(arguments), e_.attribute(place.spec.attribute));
  }
  return true;
}

void UnitCompiler::blockInPlace(NodeId node) {
  for (NodeId block : t_.children(node).subspan(1)) {
    for (NodeId item : t_.children(block)) {
      if (t_.kind(item) == NodeKind::Item) successor(t_.child(item, 2));
    }
  }
}

// What these three do they do to the present shape, so their blocks are part of the code around.
bool UnitCompiler::inPlace(NodeId node, const OpSpec& spec, NodeId arguments) {
  const std::string_view name = spec.name;
  const Span span = t_.span(node);
  if (name == "do") {
    const NodeId call = t_.child(arguments, 0);
    const Resolution& rule = m_.at(call);
    if (rule.kind != RefKind::Rule) {
      e_.emit(Code::Leaf, span, e_.constant(e_.program().pool->string(t_.text(call))));
      return true;
    }
    const size_t count =
        pushArguments(t_.kind(call) == NodeKind::Call ? t_.child(call, 0) : kNoNode);
    uses_.rules.insert(rule.index);
    uses_.branches = true;
    e_.emit(Code::RunRule, span, rule.index, count, 0, e_.site(r_.rules[rule.index].qualifiedName));
    return true;
  }
  if (name == "repeat") {
    expression(t_.child(arguments, 0));
    uses_.branches = true;
    const uint32_t begin = e_.emit(Code::BeginTurns, span, 0, 0, 0, e_.site(name));
    blockInPlace(node);
    e_.emit(Code::EndTurn, span, begin + 1, 0, 0, e_.program().sites[begin]);
    e_.land(begin);
    return true;
  }
  if (name == "local") {
    // All values are those of the block around; a value bound last is found first.
    for (NodeId a : t_.children(arguments)) expression(t_.child(a, 0));
    e_.emit(Code::BeginLocals, span);
    const auto values = t_.children(arguments);
    for (size_t i = values.size(); i-- > 0;) {
      e_.emit(Code::Bind, t_.span(values[i]), m_.at(values[i]).index);
    }
    blockInPlace(node);
    e_.emit(Code::EndLocals, span);
    return true;
  }
  return false;
}

void UnitCompiler::operation(NodeId node, const OpSpec& spec, NodeId arguments) {
  if (std::string_view(spec.name) == "set" && setStatement(node, arguments)) return;
  if (inPlace(node, spec, arguments)) return;
  operationEffects(spec, arguments);
  const Span span = t_.span(node);
  const BuiltinArguments given = builtinArguments(node, spec.signatures, arguments);
  const bool hasBlock = t_.children(node).size() > 1;

  // When nothing has to be evaluated the arguments are read where they are.
  std::vector<Value> fixed;
  // A distance of setbackPerEdge is worked out for each edge, a constant one as well.
  const bool perEdge = std::string_view(spec.name) == "setbackPerEdge" &&
                       !(given.form && given.form->params[0].type == ParamType::FloatArray);
  const bool allFixed = !perEdge && constantsOf(given, fixed);
  const uint32_t blockNumber = hasBlock ? newBlock(node, spec) : 0;
  for (size_t i = 0; !allFixed && i < given.list.size(); ++i) {
    if (perEdge && i == 0) {
      valuePerEdge(given.list[i].node);
    } else {
      push(given.list[i], span);
    }
  }
  if (hasBlock) pushBlockValues(blockNumber, given);
  const uint64_t site = e_.site(spec.name);
  const Code code = allFixed ? Code::OperationConstant : Code::Operation;
  e_.emit(code, span, e_.operation(&spec, given.form), given.list.size(),
          hasBlock ? blockNumber + size_t{1} : 0, site);
  if (allFixed) e_.emit(Code::Operand, span, e_.constantRun(fixed), 0, e_.constantCall());
}

void UnitCompiler::choice(NodeId node, bool inExpression) {
  if (t_.choiceKind(node) == ChoiceKind::Percent)
    percentChoice(node, inExpression);
  else
    caseChoice(node, inExpression);
}

// Of all branches one runs.
void UnitCompiler::branchBody(NodeId branch, bool inExpression) {
  const NodeId inner = t_.child(branch, 1);
  const size_t depth = e_.depth();
  if (inExpression)
    expression(inner);
  else
    successor(inner);
  e_.settle(depth);
}

void UnitCompiler::caseChoice(NodeId node, bool inExpression) {
  std::vector<uint32_t> ends;
  bool complete = false;
  const size_t depth = e_.depth();
  for (NodeId branch : t_.children(node)) {
    const NodeId condition = t_.child(branch, 0);
    const Span span = t_.span(branch);
    e_.settle(depth);
    if (condition == kNoNode) {
      branchBody(branch, inExpression);
      complete = true;
      break;
    }
    expression(condition);
    const uint32_t next = e_.jump(Code::JumpIfFalse, t_.span(condition));
    branchBody(branch, inExpression);
    ends.push_back(e_.jump(Code::Jump, span));
    e_.land(next);
  }
  if (!complete && inExpression) {
    e_.emit(Code::Constant, t_.span(node), e_.constant(Value{}));
  }
  for (uint32_t jump : ends) e_.land(jump);
}

void UnitCompiler::percentChoice(NodeId node, bool inExpression) {
  const Span span = t_.span(node);
  size_t weighted = 0;
  const size_t depth = e_.depth();
  for (NodeId branch : t_.children(node)) {
    const NodeId weight = t_.child(branch, 0);
    if (weight == kNoNode) continue;
    e_.settle(depth + weighted);
    expression(weight);
    e_.emit(Code::Constant, t_.span(weight), e_.constant(Value::of(100.0)));
    e_.emit(Code::Binary, t_.span(weight), 0, static_cast<size_t>(BinaryOperator::Divide));
    ++weighted;
  }
  uses_.effects |= kRandom;
  e_.emit(Code::Choose, span, 0, 0, weighted, e_.site("%"));
  const uint32_t table = e_.table(std::vector<uint32_t>(weighted + 1));
  e_.emit(Code::JumpTable, span, table);
  std::vector<uint32_t> ends;
  size_t way = 0;
  bool complete = false;
  for (NodeId branch : t_.children(node)) {
    e_.settle(depth);
    const bool last = t_.child(branch, 0) == kNoNode;
    e_.program().jumpTables[table][last ? weighted : way++] = e_.here();
    complete = complete || last;
    branchBody(branch, inExpression);
    ends.push_back(e_.jump(Code::Jump, t_.span(branch)));
  }
  if (!complete) {
    e_.program().jumpTables[table][weighted] = e_.here();
    if (inExpression) e_.emit(Code::Constant, span, e_.constant(Value{}));
  }
  for (uint32_t jump : ends) e_.land(jump);
}

}  // namespace gable::lang
