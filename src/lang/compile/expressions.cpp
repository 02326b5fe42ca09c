// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions: each leaves one value on the stack. Parts that the analysis folded are constants.

#include <algorithm>
#include <optional>

#include "lang/compile/unit_compiler.h"
#include "program/tag_effects.h"

namespace gable::lang {

namespace {

BinaryOperator plainOperator(BinaryOp op) {
  switch (op) {
    case BinaryOp::Equal: return BinaryOperator::Equal;
    case BinaryOp::NotEqual: return BinaryOperator::NotEqual;
    case BinaryOp::Less: return BinaryOperator::Less;
    case BinaryOp::LessEqual: return BinaryOperator::LessEqual;
    case BinaryOp::Greater: return BinaryOperator::Greater;
    case BinaryOp::GreaterEqual: return BinaryOperator::GreaterEqual;
    case BinaryOp::Add: return BinaryOperator::Add;
    case BinaryOp::Subtract: return BinaryOperator::Subtract;
    case BinaryOp::Multiply: return BinaryOperator::Multiply;
    case BinaryOp::Divide: return BinaryOperator::Divide;
    default: return BinaryOperator::Modulo;
  }
}

BinaryOperator eachOperator(BinaryOp op) {
  if (op == BinaryOp::And) return BinaryOperator::EachAnd;
  if (op == BinaryOp::Or) return BinaryOperator::EachOr;
  return static_cast<BinaryOperator>(static_cast<int>(plainOperator(op)) +
                                     static_cast<int>(BinaryOperator::EachAdd));
}

}  // namespace

void UnitCompiler::locals(NodeId list) {
  for (NodeId local : t_.children(list)) expression(t_.child(local, 0));
}

bool UnitCompiler::constantOf(NodeId node, Value& out) const {
  const NodeKind kind = t_.kind(node);
  if (kind == NodeKind::Relative || kind == NodeKind::Floating) {
    if (!constantOf(t_.child(node, 0), out)) return false;
    out.unit = kind == NodeKind::Relative ? ::gable::Unit::Relative : ::gable::Unit::Floating;
    return true;
  }
  if (m_.at(node).kind == RefKind::Selector) {
    out = e_.program().pool->selector(t_.text(node));
    return true;
  }
  out = m_.constantAt(node);
  return out.type != ValueType::Null;
}

void UnitCompiler::expression(NodeId node) {
  const size_t depth = e_.depth();
  value(node);
  e_.settle(depth + 1);
}

void UnitCompiler::value(NodeId node) {
  const Span span = t_.span(node);
  Value fixed;
  if (constantOf(node, fixed)) {
    e_.emit(Code::Constant, span, e_.constant(fixed));
    return;
  }
  switch (t_.kind(node)) {
    case NodeKind::Name: name(node); break;
    case NodeKind::Call: call(node, t_.child(node, 0)); break;
    case NodeKind::ImportCall:
      enterDynamicImport(node);
      call(node, t_.child(node, 2));
      break;
    case NodeKind::Unary: unary(node); break;
    case NodeKind::Binary: binary(node); break;
    case NodeKind::Index: index(node); break;
    case NodeKind::Array: array(node); break;
    case NodeKind::Range: range(node); break;
    case NodeKind::Choice: choice(node, true); break;
    case NodeKind::NamedArg: expression(t_.child(node, 0)); break;
    case NodeKind::Relative:
    case NodeKind::Floating: {
      expression(t_.child(node, 0));
      const ::gable::Unit unit =
          t_.kind(node) == NodeKind::Relative ? ::gable::Unit::Relative : ::gable::Unit::Floating;
      e_.emit(Code::WithUnit, span, 0, static_cast<size_t>(unit));
      break;
    }
    default: e_.emit(Code::Constant, span, e_.constant(Value{})); break;
  }
}

void UnitCompiler::name(NodeId node) { call(node, kNoNode); }

size_t UnitCompiler::pushArguments(NodeId arguments) {
  const auto list = t_.children(arguments);
  for (NodeId argument : list) expression(argument);
  return list.size();
}

UnitCompiler::BuiltinArguments UnitCompiler::builtinArguments(NodeId call,
                                                              std::span<const Signature> signatures,
                                                              NodeId list) {
  BuiltinArguments out;
  const Resolution& ref = m_.at(call);
  const auto named = m_.namedArguments.find(call);
  if (named != m_.namedArguments.end()) {
    for (const NodeId n : named->second) out.list.push_back({n, {}});
  } else {
    for (const NodeId n : t_.children(list)) out.list.push_back({n, {}});
  }
  if (ref.signature >= signatures.size() || ref.open) return out;
  const Signature& form = signatures[ref.signature];
  out.form = &form;
  out.list.resize(form.params.size());
  for (size_t i = 0; i < out.list.size(); ++i) {
    BuiltinArguments::Argument& argument = out.list[i];
    if (argument.node == kNoNode) {
      argument.fixed = defaultValue(form.params[i], *e_.program().pool);
    } else if (isCode(form.params[i])) {
      argument.fixed = codeOf(argument.node, form.params[i]);
      argument.node = kNoNode;
    }
  }
  return out;
}

bool UnitCompiler::constantsOf(const BuiltinArguments& arguments, std::vector<Value>& out) const {
  for (const BuiltinArguments::Argument& a : arguments.list) {
    Value v = a.fixed;
    if (a.node != kNoNode && !constantOf(a.node, v)) return false;
    out.push_back(v);
  }
  return true;
}

void UnitCompiler::push(const BuiltinArguments::Argument& argument, Span span) {
  if (argument.node != kNoNode)
    expression(argument.node);
  else
    e_.emit(Code::Constant, span, e_.constant(argument.fixed));
}

void UnitCompiler::pushArguments(const BuiltinArguments& arguments, Span span) {
  for (const BuiltinArguments::Argument& a : arguments.list) push(a, span);
}

void UnitCompiler::call(NodeId node, NodeId arguments) {
  const Resolution& ref = m_.at(node);
  const Span span = t_.span(node);
  switch (ref.kind) {
    case RefKind::Slot: e_.emit(Code::Parameter, span, ref.index); break;
    case RefKind::Attribute:
      uses_.attributes.insert(ref.index);
      e_.emit(Code::RuleAttribute, span, ref.index);
      break;
    case RefKind::ShapeAttribute:
      uses_.effects |= ref.spec.attribute->effects;
      e_.emit(Code::BuiltinAttribute, span, e_.attribute(ref.spec.attribute));
      break;
    case RefKind::Function: {
      const size_t count = pushArguments(arguments);
      uses_.functions.insert(ref.index);
      e_.emit(Code::Function, span, ref.index, count, 0,
              e_.site(r_.functions[ref.index].qualifiedName));
      break;
    }
    case RefKind::BuiltinFunction: {
      if (t_.kind(node) == NodeKind::Call && t_.child(node, 1) != kNoNode) {
        componentValues(node);
        break;
      }
      functionEffects(*ref.spec.function, arguments);
      const BuiltinArguments given =
          builtinArguments(node, ref.spec.function->signatures, arguments);
      pushArguments(given, span);
      e_.emit(Code::BuiltinFunction, span, e_.function(ref.spec.function, given.form),
              given.list.size(), 0, e_.site(ref.spec.function->name));
      break;
    }
    default: e_.emit(Code::Constant, span, e_.constant(Value{})); break;
  }
}

void UnitCompiler::operationEffects(const OpSpec& spec, NodeId arguments) {
  uses_.effects |= effectsOf(effectsOfOperation(spec.effects), spec.signatures, arguments);
}

void UnitCompiler::functionEffects(const FunctionSpec& spec, NodeId arguments) {
  uses_.effects |= effectsOf(spec.effects, spec.signatures, arguments);
}

namespace {

bool takesSelectors(std::span<const Signature> signatures) {
  return std::ranges::any_of(signatures, [](const Signature& s) {
    return std::ranges::any_of(s.params, [](const ParamSpec& p) {
      return p.type == ParamType::Selector || p.type == ParamType::Selection;
    });
  });
}

bool takesWords(ParamType type) {
  switch (type) {
    case ParamType::Float:
    case ParamType::Size:
    case ParamType::FloatingSize:
    case ParamType::Drawn:
    case ParamType::Bool:
    case ParamType::FloatArray:
    case ParamType::BoolArray: return false;
    default: return true;
  }
}

// Whether the argument `index` of so many, or the one with that name, may be a word.
bool mayBeWord(std::span<const Signature> signatures, size_t count, size_t index,
               std::optional<std::string_view> name) {
  return std::ranges::any_of(signatures, [&](const Signature& s) {
    if (name) {
      return std::ranges::any_of(
          s.params, [&](const ParamSpec& p) { return *name == p.name && takesWords(p.type); });
    }
    const ParamSpec* const param = s.paramAt(index);
    return param && (s.variadic || count <= s.params.size()) && takesWords(param->type);
  });
}

}  // namespace

// The effects of a call with these arguments: words narrow or widen what the spec says.
uint32_t UnitCompiler::effectsOf(uint32_t effects, std::span<const Signature> signatures,
                                 NodeId arguments) const {
  bool worldNamed = false;
  // An argument whose type is not known here (a parameter, an item of a list) may be any word.
  const bool byWord = (effects & kReadsWorldByWord) != 0;
  const bool byAny = byWord || takesSelectors(signatures);
  const std::span<const NodeId> list = t_.children(arguments);
  for (size_t i = 0; i < list.size(); ++i) {
    NodeId argument = list[i];
    std::optional<std::string_view> name;
    if (t_.kind(argument) == NodeKind::NamedArg) {
      name = t_.text(argument);
      argument = t_.child(argument, 0);
    }
    Value v;
    if (m_.types[argument] == ValueType::Code) {
      worldNamed |= namesWorldIn(argument);
    } else if (constantOf(argument, v)) {
      const std::string_view text = v.type == ValueType::Selector || v.type == ValueType::String
                                        ? e_.program().pool->text(v.id)
                                        : std::string_view();
      // A selection written as text may name the world anywhere in it.
      worldNamed |= v.type == ValueType::Selector ? namesWorld(text)
                                                  : text.find("world.") != std::string_view::npos;
    } else {
      const ValueType type = m_.types[argument];
      worldNamed |=
          type == ValueType::Selector ||
          (type == ValueType::Null && byAny && mayBeWord(signatures, list.size(), i, name)) ||
          (type == ValueType::String && byWord);
    }
  }
  // Words for streets are among those for the world.
  return effectsOfCall(effects, worldNamed) | (worldNamed ? kReadsWorld | kReadsTags : 0u);
}

void UnitCompiler::unary(NodeId node) {
  const Span span = t_.span(node);
  expression(t_.child(node, 0));
  if (t_.unaryOp(node) == UnaryOp::Minus) e_.emit(Code::Negate, span);
  if (t_.unaryOp(node) == UnaryOp::Not) e_.emit(Code::Not, span);
}

void UnitCompiler::binary(NodeId node) {
  const Span span = t_.span(node);
  const BinaryOp op = t_.binaryOp(node);
  const bool each = t_.has(node, kFlagElementwise);
  expression(t_.child(node, 0));
  if (!each && (op == BinaryOp::And || op == BinaryOp::Or)) {
    const uint32_t skip =
        e_.jump(op == BinaryOp::And ? Code::JumpIfFalseKeep : Code::JumpIfTrueKeep, span);
    expression(t_.child(node, 1));
    e_.land(skip);
    e_.emit(Code::ToBool, span);
    return;
  }
  expression(t_.child(node, 1));
  const BinaryOperator code = each ? eachOperator(op) : plainOperator(op);
  e_.emit(Code::Binary, span, 0, static_cast<size_t>(code));
}

void UnitCompiler::array(NodeId node) {
  std::vector<uint32_t> counts;
  for (NodeId row : t_.children(node)) {
    for (NodeId item : t_.children(row)) expression(item);
    counts.push_back(static_cast<uint32_t>(t_.children(row).size()));
  }
  e_.emit(Code::MakeArray, t_.span(node), e_.table(std::move(counts)));
}

void UnitCompiler::index(NodeId node) {
  size_t count = 0;
  for (NodeId part : t_.children(node)) {
    if (part == kNoNode) continue;
    expression(part);
    ++count;
  }
  e_.emit(Code::Index, t_.span(node), 0, count - 1);
}

void UnitCompiler::range(NodeId node) {
  const NodeId step = t_.child(node, 1);
  expression(t_.child(node, 0));
  if (step != kNoNode) expression(step);
  expression(t_.child(node, 2));
  e_.emit(Code::MakeRange, t_.span(node), 0, step != kNoNode ? 1 : 0);
}

}  // namespace gable::lang
