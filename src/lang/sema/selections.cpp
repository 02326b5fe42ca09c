// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Arguments that an operation works out itself: selections, made of the terms that the parameter
// knows, and lists of numbers that are drawn. Everything in them is checked here.

#include <algorithm>

#include "lang/old_regions.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

const TermSpec* Analysis::termNamed(const ParamSpec& param, std::string_view name) const {
  for (const TermSpec& t : param.terms) {
    if (t.name == name) return &t;
  }
  return nullptr;
}

// Whether the expression is made of terms: a - b is a difference of selections or of numbers.
bool Analysis::isSelection(NodeId node, const ParamSpec& param) const {
  const Tree& t = tree();
  while (t.kind(node) == NodeKind::Binary || t.kind(node) == NodeKind::Unary) {
    if (t.kind(node) == NodeKind::Binary && isSelection(t.child(node, 1), param)) return true;
    node = t.child(node, 0);
  }
  const bool named = t.kind(node) == NodeKind::Name || t.kind(node) == NodeKind::Call;
  return named && termNamed(param, t.text(node)) != nullptr;
}

void Analysis::visitSelection(NodeId node, const ParamSpec& param) {
  const Tree& t = tree();
  typed(node, ValueType::Code);
  const NodeKind kind = t.kind(node);
  if (kind == NodeKind::Name || kind == NodeKind::Call) {
    if (const TermSpec* term = termNamed(param, t.text(node))) {
      return visitTerm(node, *term, param);
    }
  }
  const bool inverse = kind == NodeKind::Unary && t.unaryOp(node) == UnaryOp::Not;
  const bool joined = kind == NodeKind::Binary &&
                      (t.binaryOp(node) == BinaryOp::And || t.binaryOp(node) == BinaryOp::Or ||
                       (t.binaryOp(node) == BinaryOp::Subtract && isSelection(node, param)));
  if ((inverse || joined) && param.single) {
    errorAt("bad-selection", node, "there is nothing to combine here",
            "write one of: " + std::string(param.doc));
    return;
  }
  if (inverse) return visitSelection(t.child(node, 0), param);
  if (joined) {
    visitSelection(t.child(node, 0), param);
    visitSelection(t.child(node, 1), param);
    return;
  }
  visitSelectionValue(node, param);
}

// Selections, figures and options as texts: how they were written once.
bool Analysis::reportOldCall(NodeId node, std::span<const NodeId> args) {
  if (!isOldRegionCall(tree(), node)) return false;
  visitLoosely(args);
  if (isMute()) return true;
  const Span span = tree().span(node);
  const std::string_view source = sources_.text(tree().file());
  const std::vector<TextEdit> edits = modernRegionCall(tree(), node, source);
  std::string hint =
      "write selections, figures and options as expressions; see the operation's page";
  if (!edits.empty() && span.begin < edits[0].begin && edits.back().begin <= span.end) {
    std::string now;
    uint32_t at = span.begin;
    for (const TextEdit& e : edits) {
      now += std::string(source.substr(at, e.begin - at)) + e.text;
      at = e.end;
    }
    // An edit in the block ends there; that of all arguments, with their bracket.
    const bool whole = now.ends_with('}');
    hint = "write '" + now +
           (edits.size() > 1 ? "..."
            : whole          ? ""
                             : ")") +
           "', or let 'gable format' rewrite the file";
  }
  errorAt("text-selection", node, quote(text(node)) + " takes no texts", std::move(hint));
  return true;
}

// What is no term: a number, or a list of them.
void Analysis::visitSelectionValue(NodeId node, const ParamSpec& param) {
  const NodeKind kind = tree().kind(node);
  if (kind == NodeKind::String) {
    typed(node, ValueType::String);
    errorAt("text-selection", node, "this is written without quotes, as an expression",
            "write words and calls with && || ! - and brackets between them");
    return;
  }
  const bool unknownName = kind == NodeKind::Name && !isKnownValue(text(node)) &&
                           !inMissingImport(body_.module, text(node));
  const bool unknownCall = kind == NodeKind::Call && !catalogue_.function(text(node)) &&
                           functionsNamed(body_.module, text(node)).empty();
  if (unknownName || unknownCall) return reportTerm(node, param);
  const ValueType type = visit(node);
  const bool fit =
      type == ValueType::Null || type == ValueType::Float || type == ValueType::FloatArray;
  if (type == ValueType::Selector) return reportTerm(node, param);
  if (!fit) {
    errorAt("type-mismatch", node,
            std::string("this must be a selection or a number, not a ") + typeName(type),
            "the parameter is " + std::string(param.name) + ": " + param.doc);
  }
  typed(node, ValueType::Code);
}

void Analysis::reportTerm(NodeId node, const ParamSpec& param) {
  const Tree& t = tree();
  const std::string_view word = t.text(node);
  if (t.kind(node) == NodeKind::Call) visitLoosely(arguments(t.child(node, 0)));
  resolve(node, RefKind::Selector);
  std::string hint = near(word, [&] {
    std::vector<std::string_view> names;
    for (const TermSpec& term : param.terms) names.push_back(term.name);
    return names;
  });
  if (hint.empty()) {
    hint = "there are: ";
    for (const TermSpec& term : param.terms) {
      hint += (&term == param.terms.data() ? "" : ", ") + std::string(term.name);
    }
  }
  errorAt("unknown-selector", node,
          quote(word) + " is nothing that " + quote(param.name) + " knows", std::move(hint));
}

// side(west), edge(2, 0, 0.5), corner(outer): arguments in order or by name.
void Analysis::visitTerm(NodeId node, const TermSpec& term, const ParamSpec& param) {
  const Tree& t = tree();
  resolve(node, RefKind::Selector);
  module().resolutions[node].spec.term = &term;
  const std::span<const ParamSpec> wanted{term.params, term.paramCount};
  const std::span<const NodeId> args =
      t.kind(node) == NodeKind::Call ? arguments(t.child(node, 0)) : std::span<const NodeId>();
  std::vector<NodeId> order(wanted.size(), kNoNode);
  std::string form = std::string(term.name) + "(";
  for (const ParamSpec& p : wanted) form += (&p == wanted.data() ? "" : ", ") + std::string(p.name);
  form += ")";
  bool right = areNamesLast(args);
  for (size_t i = 0; i < args.size(); ++i) {
    const bool named = t.kind(args[i]) == NodeKind::NamedArg;
    size_t place = named ? 0 : i;
    while (named && place < wanted.size() && t.text(args[i]) != wanted[place].name) ++place;
    right = right && place < wanted.size() && order[place] == kNoNode;
    if (right) order[place] = argumentValue(t, args[i]);
  }
  for (size_t p = 0; p < wanted.size(); ++p) {
    right = right && (order[p] != kNoNode || wanted[p].defaultText != nullptr);
  }
  if (!right) {
    visitLoosely(args);
    errorAt("wrong-argument-count", node,
            "these arguments of " + quote(term.name) + " do not go together, or one is missing",
            "write " + (wanted.empty() ? std::string(term.name) : form));
    return;
  }
  for (size_t p = 0; p < wanted.size(); ++p) {
    if (order[p] != kNoNode) visitTermArgument(order[p], term, wanted[p], param);
  }
  module().namedArguments[node] = std::move(order);
}

void Analysis::visitTermArgument(NodeId node, const TermSpec& term, const ParamSpec& wanted,
                                 const ParamSpec& param) {
  if (wanted.type == ParamType::Selection) {
    // A selection within a selection knows the same terms unless it has its own.
    if (!wanted.terms.empty()) return visitSelection(node, wanted);
    ParamSpec inner = wanted;
    inner.terms = param.terms;
    return visitSelection(node, inner);
  }
  const ParamSpec* one[] = {&wanted};
  const ValueType type = visitArgument(node, {one[0]});
  if (fits(type, wanted.type)) return;
  errorAt("type-mismatch", node,
          std::string("this must be a ") + typeName(valueType(wanted.type)) + ", not a " +
              typeName(type),
          "the parameter of " + quote(term.name) + " is " + wanted.name + ": " + wanted.doc);
}

// [2, ~1, rand(3, 4)], or a single one.
void Analysis::visitDrawnList(NodeId node) {
  const Tree& t = tree();
  if (t.kind(node) != NodeKind::Array) {
    checkPrefix(node, {});
    const ValueType type = visit(node);
    if (type != ValueType::FloatArray) {
      expectType(node, type, ValueType::Float, "this argument");
    }
    if (type != ValueType::FloatArray) typed(node, ValueType::Code);
    return;
  }
  static constexpr ParamSpec kItem{"item", ParamType::FloatingSize, ""};
  if (t.children(node).size() > 1) {
    errorAt("type-mismatch", node, "a list is wanted here, not a table", "write [a, b, c]");
  }
  for (const NodeId row : t.children(node)) {
    for (const NodeId item : t.children(row)) {
      checkPrefix(item, {&kItem});
      expectType(item, visit(item, ValueType::Float), ValueType::Float, "each of the list");
    }
  }
  typed(node, ValueType::Code);
}

}  // namespace gable::lang
