// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Types of expressions, bottom up, with what the place expects handed down to parameters of unknown
// type: `extrude(h)` makes h a number. A type that use leaves open is Null and is checked when the
// rules run; only contradictions between known types are reported.

#include <algorithm>

#include "base/number.h"
#include "base/work.h"
#include "lang/other_languages.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

bool isArrayType(ValueType t) { return t >= ValueType::FloatArray; }

// How a value that stands there in letters is written as one of another type; empty where that
// cannot be.
std::string otherwiseWritten(const Tree& t, NodeId node, ValueType wanted) {
  double number = 0;
  const NodeKind kind = t.kind(node);
  if (kind == NodeKind::String) {
    const std::string_view word = t.text(node);
    const bool fits = (wanted == ValueType::Bool && (word == "true" || word == "false")) ||
                      (wanted == ValueType::Float && parseNumber(word, number));
    return fits ? "remove the quotes: " + std::string(word) : std::string();
  }
  if (wanted != ValueType::String) return {};
  if (kind == NodeKind::Number)
    return "write it in quotes: \"" + shortestText(t.number(node)) + '"';
  if (kind != NodeKind::Bool) return {};
  return std::string("write it in quotes: ") + (t.number(node) != 0 ? "\"true\"" : "\"false\"");
}

}  // namespace

void Analysis::expectType(NodeId node, ValueType got, ValueType wanted, const char* what) {
  if (got == ValueType::Null || wanted == ValueType::Null || got == wanted) return;
  const AttributeInfo* named = attributeAt(node);
  const std::string who = named ? std::string(what) + ' ' + quote(named->name) : what;
  errorAt("type-mismatch", node,
          who + " must be a " + typeName(wanted) + ", not a " + typeName(got),
          named ? typeRemedy(*named, wanted) : otherwiseWritten(tree(), node, wanted));
}

// The attribute that a name stands for; null for all else.
const AttributeInfo* Analysis::attributeAt(NodeId node) const {
  const Resolution& r = program_.modules[body_.module].at(node);
  const bool named = tree().kind(node) == NodeKind::Name && r.kind == RefKind::Attribute;
  return named ? &program_.attributes[r.index] : nullptr;
}

// Where the attribute gets its type, and how the value can be had in another.
std::string Analysis::typeRemedy(const AttributeInfo& a, ValueType wanted) const {
  const bool own = a.source == ValueSource::Own;
  const uint32_t unit = program_.modules[own ? a.valueModule : a.module].unit;
  const Tree& t = *program_.units[unit].tree;
  const Span place = t.span(own && a.valueNode != kNoNode ? a.valueNode : a.node);
  const LineColumn at = sources_.locate(place.file, place.begin);
  const std::string line = sources_.path(place.file) + ':' + std::to_string(at.line);
  std::string out =
      quote(a.name) + " gets its type at " + line + ": give it a " + typeName(wanted) + " there";
  if (wanted == ValueType::Float) out += ", or write float(" + a.name + ") here";
  if (wanted == ValueType::String) out += ", or write str(" + a.name + ") here";
  if (wanted == ValueType::Bool) out += ", or write bool(" + a.name + ") here";
  return out;
}

ValueType Analysis::slotType(uint32_t slot, ValueType expected) {
  ValueType& type = body_.types[slot];
  if (slot >= body_.paramCount) return type;
  if (expected == ValueType::Null || expected == type || body_.open[slot]) return type;
  // Used as two types: it is decided at each call.
  if (type != ValueType::Null) {
    type = ValueType::Null;
    body_.open[slot] = true;
  } else {
    type = expected;
  }
  settle();
  return type;
}

ValueType Analysis::visit(NodeId node, ValueType expected) {
  work();
  const Tree& t = tree();
  switch (t.kind(node)) {
    case NodeKind::Number: return typed(node, ValueType::Float);
    case NodeKind::Bool: return typed(node, ValueType::Bool);
    case NodeKind::String: return typed(node, ValueType::String);
    case NodeKind::Name: return typed(node, visitName(node, expected));
    case NodeKind::Call: return typed(node, visitCall(node));
    case NodeKind::ImportCall: visitImportCall(node, false); return ValueType::Null;
    case NodeKind::Unary: return typed(node, visitUnary(node));
    case NodeKind::Binary: return typed(node, visitBinary(node));
    case NodeKind::Index: return typed(node, visitIndex(node));
    case NodeKind::Array: return typed(node, visitArray(node));
    case NodeKind::Range:
      for (const NodeId c : t.children(node)) {
        if (c != kNoNode) expectType(c, visit(c, ValueType::Float), ValueType::Float, "a bound");
      }
      return typed(node, ValueType::FloatArray);
    case NodeKind::Relative:
    case NodeKind::Floating: {
      const NodeId inner = t.child(node, 0);
      expectType(inner, visit(inner, ValueType::Float), ValueType::Float, "a size");
      return typed(node, ValueType::Float);
    }
    case NodeKind::Choice: return typed(node, visitChoice(node, expected));
    case NodeKind::NamedArg: visit(t.child(node, 0)); return ValueType::Null;
    default: return ValueType::Null;
  }
}

// --- Names ---

ValueType Analysis::visitName(NodeId node, ValueType expected) {
  const std::string_view name = text(node);
  const auto slot = std::find(body_.slots.rbegin(), body_.slots.rend(), name);
  if (slot != body_.slots.rend()) {
    const auto index = static_cast<uint32_t>(body_.slots.rend() - slot - 1);
    resolve(node, RefKind::Slot, index);
    return slotType(index, expected);
  }
  if (AttributeId a = attributeNamed(body_.module, name); a != kNone) {
    // A replacement that reads what it replaces means the value before.
    const AttributeInfo& info = program_.attributes[a];
    if (body_.attribute != kNone &&
        ((info.source == ValueSource::Propagated && info.from == body_.attribute) ||
         (info.source == ValueSource::Override && a == body_.attribute))) {
      a = ownValueOf(a);
    }
    resolve(node, RefKind::Attribute, a);
    return program_.attributes[a].type;
  }
  for (const FunctionId f : functionsNamed(body_.module, name)) {
    if (program_.functions[f].paramCount != 0) continue;
    resolve(node, RefKind::Function, f);
    return program_.functions[f].result;
  }
  if (const AttributeSpec* a = catalogue_.attribute(name)) {
    resolve(node, RefKind::ShapeAttribute);
    module().resolutions[node].spec.attribute = a;
    return a->type;
  }
  const FunctionSpec* f = catalogue_.function(name);
  if (f && (f->bare || acceptsCount(f->signatures, 0))) return visitBuiltinCall(node, *f, {});
  if (isSelectorWord(name, nullptr)) {
    resolve(node, RefKind::Selector);
    return ValueType::Selector;
  }
  reportUnknownName(node);
  return ValueType::Null;
}

void Analysis::reportUnknownName(NodeId node) {
  if (isMute()) return;
  const std::string_view name = text(node);
  if (inMissingImport(body_.module, name)) return;
  const std::vector<FunctionId> overloads = functionsNamed(body_.module, name);
  const bool isFunction = !overloads.empty() || catalogue_.function(name) != nullptr;
  if (isFunction) {
    errorAt("wrong-argument-count", node, quote(name) + " is a function and needs arguments",
            "write " + quote(std::string(name) + "(...)"));
    return;
  }
  const std::string_view bare = withoutForeignModule(name);
  const ForeignWord* const foreign = foreignWord(ForeignUse::Value, bare.empty() ? name : bare);
  std::string hint = foreign ? remedyOf(*foreign) : wordHint_;
  if (!foreign && !bare.empty() && isKnownValue(bare)) hint = "write " + quote(bare);
  if (hint.empty() && !wordsHere_.empty()) hint = near(name, [&] { return wordsHere_; });
  if (hint.empty()) hint = near(name, [&] { return valueNames(body_.module); });
  if (hint.empty()) hint = "declare it with 'attr' or 'const', or put it in quotes if it is a text";
  errorAt("unknown-name", node, "nothing is named " + quote(name), std::move(hint));
  if (foreign && !foreign->instead.empty()) {
    fix(tree().span(node), std::string(foreign->instead));
  }
}

std::string Analysis::hintOfForeignFunction(std::string_view name) {
  const std::string_view bare = withoutForeignModule(name);
  const std::string_view word = bare.empty() ? name : bare;
  if (const ForeignWord* const known = foreignWord(ForeignUse::Function, word)) {
    return remedyOf(*known);
  }
  return catalogue_.function(bare) ? "write " + quote(bare) : std::string();
}

// --- Calls ---

ValueType Analysis::visitBuiltinCall(NodeId node, const FunctionSpec& spec,
                                     std::span<const NodeId> args) {
  if (!args.empty() && reportOldCall(node, args)) return ValueType::Null;
  // Written without brackets, a function takes what it takes by default.
  const bool bare = args.empty() && tree().kind(node) == NodeKind::Name;
  Chosen chosen;
  if (bare && !acceptsCount(spec.signatures, 0)) {
    chosen = {static_cast<uint16_t>(spec.signatures.empty() ? 0xffff : 0), true};
  } else if (spec.signatures.empty()) {
    visitArguments(args);
  } else {
    chosen = checkBuiltinCall({spec.name, node, spec.signatures}, args);
  }
  resolve(node, RefKind::BuiltinFunction);
  Resolution& r = module().resolutions[node];
  r.spec.function = &spec;
  r.signature = chosen.signature;
  r.open = chosen.open;
  if (chosen.signature >= spec.signatures.size()) return ValueType::Null;
  // A result that the signature leaves open follows the first argument.
  const ValueType result = spec.signatures[chosen.signature].result;
  return result == ValueType::Null && !args.empty() ? module().types[args[0]] : result;
}

ValueType Analysis::visitCall(NodeId node) {
  const Tree& t = tree();
  const std::string_view name = t.text(node);
  const std::span<const NodeId> args = arguments(t.child(node, 0));
  if (t.child(node, 1) != kNoNode) return visitComp(node);

  const std::vector<FunctionId> overloads = functionsNamed(body_.module, name);
  const bool fits = std::any_of(overloads.begin(), overloads.end(), [&](FunctionId f) {
    return program_.functions[f].paramCount == args.size();
  });
  const FunctionSpec* builtin = catalogue_.function(name);
  if (!fits && builtin) return visitBuiltinCall(node, *builtin, args);

  if (fits) {
    checkNamedArguments(args);
    std::vector<ValueType> types;
    for (size_t i = 0; i < args.size(); ++i) {
      // With a single overload its parameter tells what the argument is.
      const FunctionInfo& only = program_.functions[overloads[0]];
      checkPrefix(args[i], {});
      types.push_back(visit(args[i], overloads.size() == 1 ? only.paramTypes[i] : ValueType::Null));
    }
    const FunctionId f = chooseOverload(overloads, program_.functions, args, types);
    resolve(node, RefKind::Function, f);
    for (size_t i = 0; i < args.size(); ++i) {
      expectType(args[i], types[i], program_.functions[f].paramTypes[i], "this argument");
    }
    return program_.functions[f].result;
  }

  visitLoosely(args);
  const AttributeId attribute = attributeNamed(body_.module, name);
  if (attribute != kNone && (args.empty() || program_.attributes[attribute].edgeMap)) {
    resolve(node, RefKind::Attribute, attribute);
    return program_.attributes[attribute].type;
  }
  if (!overloads.empty()) {
    const auto wanted = program_.functions[overloads[0]].paramCount;
    errorAt("wrong-argument-count", node,
            quote(name) + " takes " + std::to_string(wanted) +
                (wanted == 1 ? " argument, not " : " arguments, not ") +
                std::to_string(args.size()),
            "");
    return ValueType::Null;
  }
  if (inMissingImport(body_.module, name)) return ValueType::Null;
  std::string hint = near(name, [&] { return valueNames(body_.module); });
  if (std::string foreign = hintOfForeignFunction(name); !foreign.empty()) {
    meant_ = {};
    hint = std::move(foreign);
  } else if (!rulesNamed(body_.module, name).rules.empty()) {
    meant_ = {};
    hint = "it is a rule; rules have no value";
  } else if (catalogue_.operation(name)) {
    meant_ = {};
    hint =
        "it is an operation, and those stand in rules: 'Name --> " + std::string(name) + "(...)'";
  }
  errorAt("unknown-function", node, "there is no function " + quote(name), std::move(hint));
  return ValueType::Null;
}

// comp(..) { selector op value | ... }: an array of the values.
ValueType Analysis::visitComp(NodeId node) {
  const Tree& t = tree();
  const std::string_view name = t.text(node);
  const FunctionSpec* spec = catalogue_.function(name);
  const OpSpec* op = catalogue_.operation(name);
  const std::span<const NodeId> args = arguments(t.child(node, 0));
  ValueType element = ValueType::Null;
  if (spec) {
    visitBuiltinCall(node, *spec, args);
  } else if (op && op->block == BlockKind::Selectors) {
    const Chosen chosen = checkBuiltinCall({name, node, op->signatures}, args);
    resolve(node, RefKind::BuiltinFunction);
    module().resolutions[node].signature = chosen.signature;
    module().resolutions[node].open = chosen.open;
  } else {
    visitLoosely(args);
    errorAt("unknown-function", node, quote(name) + " takes no block as a function",
            near(name, [&] { return std::vector<std::string_view>{"comp"}; }));
  }
  for (const NodeId item : t.children(t.child(node, 1))) {
    if (t.kind(item) != NodeKind::Item) {
      errorAt("unexpected-group", item, "groups have no meaning in the function form",
              "remove the inner braces");
      continue;
    }
    if (t.child(item, 0) == kNoNode) {
      errorAt("missing-selector", item, "this part has no selector",
              "write 'selector : value', for example 'all : 1'");
    } else {
      visitHead(t.child(item, 0), nullptr);
    }
    const NodeId value = t.child(item, 2);
    const ValueType type = visit(value, element);
    if (element == ValueType::Null) element = type;
    expectType(value, type, element, "each value");
  }
  return element == ValueType::Null || isArrayType(element) ? ValueType::Null : arrayType(element);
}

// The head of an item: words are selectors here, alone and below logical operators.
ValueType Analysis::visitHead(NodeId node, const OpSpec* op) {
  const Tree& t = tree();
  if (t.kind(node) == NodeKind::Name && isSelectorWord(t.text(node), op)) {
    const bool foreign = op && op->isOnlyParts() && !op->part(t.text(node));
    if (foreign && t.text(node) != "all") reportSelector(node, op);
    resolve(node, RefKind::Selector);
    return typed(node, ValueType::Selector);
  }
  if (t.kind(node) == NodeKind::Unary && t.unaryOp(node) == UnaryOp::Not) {
    visitHead(t.child(node, 0), op);
    return typed(node, ValueType::Bool);
  }
  if (t.kind(node) == NodeKind::Binary) {
    const BinaryOp sign = t.binaryOp(node);
    if (sign == BinaryOp::And || sign == BinaryOp::Or) {
      visitHead(t.child(node, 0), op);
      visitHead(t.child(node, 1), op);
      return typed(node, ValueType::Bool);
    }
    // A selection without another: `border - front`.
    if (sign == BinaryOp::Subtract) {
      const auto startsWithWord = [&](NodeId n) {
        while (t.kind(n) == NodeKind::Binary) n = t.child(n, 0);
        return t.kind(n) == NodeKind::Name && isSelectorWord(t.text(n), op);
      };
      if (startsWithWord(t.child(node, 0)) || startsWithWord(t.child(node, 1))) {
        visitHead(t.child(node, 0), op);
        visitHead(t.child(node, 1), op);
        return typed(node, ValueType::Bool);
      }
    }
  }
  // What is nothing else was meant to be a selector.
  if (t.kind(node) == NodeKind::Name && !isKnownValue(t.text(node)) &&
      !inMissingImport(body_.module, t.text(node))) {
    resolve(node, RefKind::Selector);
    reportSelector(node, op);
    return typed(node, ValueType::Selector);
  }
  return visit(node);
}

// --- Operators ---

ValueType Analysis::visitUnary(NodeId node) {
  const NodeId operand = tree().child(node, 0);
  const bool isNot = tree().unaryOp(node) == UnaryOp::Not;
  const ValueType scalar = isNot ? ValueType::Bool : ValueType::Float;
  if (tree().has(node, kFlagElementwise)) {
    const ValueType type = visit(operand);
    if (!isArrayType(type)) expectType(operand, type, scalar, "the operand");
    return type;
  }
  expectType(operand, visit(operand, scalar), scalar, "the operand");
  return scalar;
}

ValueType Analysis::visitElementwise(NodeId node) {
  const NodeId left = tree().child(node, 0);
  const NodeId right = tree().child(node, 1);
  const ValueType a = visit(left);
  const ValueType b = visit(right);
  const BinaryOp op = tree().binaryOp(node);
  const auto element = [](ValueType t) { return isArrayType(t) ? elementType(t) : t; };
  ValueType result = ValueType::Bool;
  if (op >= BinaryOp::Add) {
    if (a == ValueType::Null || b == ValueType::Null) return ValueType::Null;
    const bool isText = element(a) == ValueType::String || element(b) == ValueType::String;
    if (isText && op != BinaryOp::Add) {
      errorAt("type-mismatch", node, "texts can only be put together, with '.+'", "");
    }
    result = isText ? ValueType::String : ValueType::Float;
  }
  const bool isArray = isArrayType(a) || isArrayType(b);
  if (!isArray && (a == ValueType::Null || b == ValueType::Null)) return ValueType::Null;
  return isArray ? arrayType(result) : result;
}

ValueType Analysis::visitBinary(NodeId node) {
  if (tree().has(node, kFlagElementwise)) return visitElementwise(node);
  const NodeId left = tree().child(node, 0);
  const NodeId right = tree().child(node, 1);
  const BinaryOp op = tree().binaryOp(node);
  if (op == BinaryOp::And || op == BinaryOp::Or) {
    expectType(left, visit(left, ValueType::Bool), ValueType::Bool, "the operand");
    expectType(right, visit(right, ValueType::Bool), ValueType::Bool, "the operand");
    return ValueType::Bool;
  }
  if (op == BinaryOp::Subtract || op == BinaryOp::Multiply || op == BinaryOp::Divide ||
      op == BinaryOp::Modulo) {
    expectType(left, visit(left, ValueType::Float), ValueType::Float, "the operand");
    expectType(right, visit(right, ValueType::Float), ValueType::Float, "the operand");
    return ValueType::Float;
  }
  // + and comparisons: one side tells what a parameter on the other side is.
  ValueType a = visit(left);
  const bool hintsRight = op != BinaryOp::Add && a != ValueType::Null;
  const ValueType b = visit(right, hintsRight ? a : ValueType::Null);
  if (op != BinaryOp::Add && a == ValueType::Null && b != ValueType::Null &&
      tree().kind(left) == NodeKind::Name) {
    a = visit(left, b);
  }
  if (op == BinaryOp::Add) {
    if (a == ValueType::String || b == ValueType::String) return ValueType::String;
    if (a == ValueType::Null || b == ValueType::Null) return ValueType::Null;
    expectType(left, a, ValueType::Float, "the operand");
    expectType(right, b, ValueType::Float, "the operand");
    return ValueType::Float;
  }
  const auto comparable = [](ValueType t) {
    return t == ValueType::Selector ? ValueType::String : t;
  };
  if (a != ValueType::Null && b != ValueType::Null && comparable(a) != comparable(b)) {
    // Texts are seldom ordered: there a number is meant.
    const bool ordered = op != BinaryOp::Equal && op != BinaryOp::NotEqual;
    std::string remedy = otherwiseWritten(tree(), right, ordered ? ValueType::Float : a);
    if (remedy.empty()) remedy = otherwiseWritten(tree(), left, ordered ? ValueType::Float : b);
    const AttributeInfo* named = attributeAt(left);
    const ValueType wanted = named ? b : a;
    if (!named) named = attributeAt(right);
    if (remedy.empty() && named) remedy = typeRemedy(*named, wanted);
    if (remedy.empty()) remedy = "convert one of them with str(), float() or bool()";
    errorAt("type-mismatch", node,
            std::string("a ") + typeName(a) + " cannot be compared with a " + typeName(b),
            std::move(remedy));
  }
  return ValueType::Bool;
}

ValueType Analysis::visitIndex(NodeId node) {
  const NodeId base = tree().child(node, 0);
  const ValueType array = visit(base);
  bool single = true;
  bool known = true;
  for (size_t i = 1; i <= 2; ++i) {
    const NodeId index = tree().child(node, i);
    if (index == kNoNode) continue;
    const ValueType type = visit(index);
    single = single && type == ValueType::Float;
    known = known && type != ValueType::Null;
    if (type == ValueType::String || type == ValueType::StringArray) {
      errorAt("type-mismatch", index, "an index must be a number, numbers or truth values", "");
    }
  }
  if (array == ValueType::Null) return ValueType::Null;
  if (!isArrayType(array)) {
    errorAt("type-mismatch", base,
            std::string("only arrays have an index; this is a ") + typeName(array), "");
    return ValueType::Null;
  }
  if (!known) return ValueType::Null;
  checkIndex(node);
  return single ? elementType(array) : array;
}

// An array that is written out, alone or as a constant, and a number as its index.
void Analysis::checkIndex(NodeId node) {
  const Tree& t = tree();
  NodeId array = t.child(node, 0);
  const Resolution& r = module().at(array);
  if (t.kind(array) == NodeKind::Name && r.kind == RefKind::Attribute) {
    const AttributeInfo& a = program_.attributes[r.index];
    if (!a.constant || a.source != ValueSource::Own || a.valueModule != body_.module) return;
    array = a.valueNode;
  }
  if (t.kind(array) != NodeKind::Array || isMute()) return;
  const std::span<const NodeId> rows = t.children(array);
  size_t values = 0;
  for (const NodeId row : rows) {
    for (const NodeId value : t.children(row)) {
      const NodeKind kind = t.kind(value);
      if (kind != NodeKind::Number && kind != NodeKind::String && kind != NodeKind::Bool) return;
      ++values;
    }
  }
  const bool inRows = t.child(node, 2) != kNoNode;
  for (size_t i = 1; i <= 2; ++i) {
    NodeId index = t.child(node, i);
    const bool negative =
        index != kNoNode && t.kind(index) == NodeKind::Unary && t.unaryOp(index) == UnaryOp::Minus;
    const NodeId number = negative ? t.child(index, 0) : index;
    if (number == kNoNode || t.kind(number) != NodeKind::Number) continue;
    const size_t count = !inRows ? values : i == 1 ? rows.size() : t.children(rows[0]).size();
    const double at = negative ? -t.number(number) : t.number(number);
    if (at >= 0 && at < static_cast<double>(count)) continue;
    warning("index-out-of-range", t.span(index),
            std::string("there is no ") +
                (!inRows  ? "element"
                 : i == 1 ? "row"
                          : "column") +
                " of this number: the array has " + std::to_string(count),
            count == 1 ? "the only one is 0"
                       : "they are counted from 0 to " + std::to_string(count - 1));
  }
}

ValueType Analysis::visitArray(NodeId node) {
  ValueType element = ValueType::Null;
  for (const NodeId row : tree().children(node)) {
    for (const NodeId value : tree().children(row)) {
      ValueType type = visit(value, element);
      if (isArrayType(type)) type = elementType(type);
      if (element == ValueType::Null) element = type;
      expectType(value, type, element, "each element");
    }
  }
  return element == ValueType::Null || element == ValueType::Selector ? ValueType::Null
                                                                      : arrayType(element);
}

ValueType Analysis::visitChoice(NodeId node, ValueType expected) {
  const bool isCase = tree().choiceKind(node) == ChoiceKind::Case;
  ValueType result = ValueType::Null;
  for (const NodeId branch : tree().children(node)) {
    const NodeId condition = tree().child(branch, 0);
    const ValueType wanted = isCase ? ValueType::Bool : ValueType::Float;
    if (condition != kNoNode) {
      expectType(condition, visit(condition, wanted), wanted, isCase ? "a condition" : "a weight");
    }
    const NodeId value = tree().child(branch, 1);
    const ValueType type = visit(value, expected);
    if (result == ValueType::Null) result = type;
    expectType(value, type, result, "each branch");
  }
  if (!isCase) checkWeights(node);
  return result;
}

}  // namespace gable::lang
