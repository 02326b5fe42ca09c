// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Nodes of the neutral tree in few words. All nodes that are made between two calls of at() have
// one span: what of the dialect's text they stand for.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "lang/tree.h"

namespace gable::gbbg {

class TreeBuilder {
 public:
  using NodeId = lang::NodeId;
  using Nodes = std::vector<NodeId>;

  explicit TreeBuilder(uint32_t file) : tree_(file) {}

  void at(Span span) { span_ = span; }
  Span span() const { return span_; }
  lang::Tree& tree() { return tree_; }

  NodeId number(double v) {
    if (v < 0) {
      const NodeId inner = number(-v);
      lang::Node n = node(lang::NodeKind::Unary);
      n.op = static_cast<uint8_t>(lang::UnaryOp::Minus);
      return tree_.add(n, {inner});
    }
    lang::Node n = node(lang::NodeKind::Number);
    // Text has no zero with a sign.
    n.number = v == 0 ? 0 : v;
    return tree_.add(n);
  }
  NodeId relative(double v) { return tree_.add(node(lang::NodeKind::Relative), {number(v)}); }
  NodeId floating(double v) { return tree_.add(node(lang::NodeKind::Floating), {number(v)}); }
  NodeId boolean(bool v) {
    lang::Node n = node(lang::NodeKind::Bool);
    n.number = v;
    return tree_.add(n);
  }
  NodeId word(std::string_view text) { return named(lang::NodeKind::Name, text, {}); }
  NodeId text(std::string_view text) { return named(lang::NodeKind::String, text, {}); }
  NodeId list(const Nodes& items) { return tree_.add(node(lang::NodeKind::List), items); }

  NodeId unary(lang::UnaryOp op, NodeId operand) {
    lang::Node n = node(lang::NodeKind::Unary);
    n.op = static_cast<uint8_t>(op);
    return tree_.add(n, {operand});
  }
  NodeId binary(lang::BinaryOp op, NodeId left, NodeId right) {
    lang::Node n = node(lang::NodeKind::Binary);
    n.op = static_cast<uint8_t>(op);
    return tree_.add(n, {left, right});
  }
  NodeId call(std::string_view function, const Nodes& arguments) {
    return named(lang::NodeKind::Call, function, {list(arguments), lang::kNoNode});
  }

  /// name = value
  NodeId argument(std::string_view name, NodeId value) {
    return named(lang::NodeKind::NamedArg, name, {value});
  }

  NodeId annotation(std::string_view name, const Nodes& arguments) {
    return named(lang::NodeKind::Annotation, name, arguments);
  }
  NodeId attribute(std::string_view name, NodeId value) {
    return named(lang::NodeKind::Attr, name, {0, 0, 0, value});
  }
  NodeId rule(std::string_view name, const Nodes& annotations, NodeId body,
              const std::vector<std::string>& parameters = {}) {
    const NodeId notes = annotations.empty() ? lang::kNoNode : list(annotations);
    Nodes made;
    for (const std::string& p : parameters) made.push_back(named(lang::NodeKind::Param, p, {}));
    const NodeId params = made.empty() ? lang::kNoNode : list(made);
    return named(lang::NodeKind::Rule, name, {notes, params, 0, body});
  }

  NodeId function(std::string_view name, const std::vector<std::string>& parameters, NodeId value) {
    Nodes made;
    for (const std::string& p : parameters) made.push_back(named(lang::NodeKind::Param, p, {}));
    return named(lang::NodeKind::Function, name, {0, list(made), 0, value});
  }
  /// `case a : x case b : y else : z` of expressions; kNoNode stands for `else`.
  NodeId valueChoice(const std::vector<std::pair<NodeId, NodeId>>& branches) {
    Nodes made;
    for (const auto& [head, value] : branches) {
      made.push_back(tree_.add(node(lang::NodeKind::Branch), {head, value}));
    }
    return tree_.add(node(lang::NodeKind::Choice), made);
  }

  /// A choice before the last successor stands in brackets, since its last branch would go on to
  /// the end of the sequence.
  NodeId sequence(Nodes successors) {
    for (size_t i = 0; i + 1 < successors.size(); ++i) bracketChoice(successors[i]);
    return tree_.add(node(lang::NodeKind::Sequence), successors);
  }
  /// An operation, or a rule where there are no arguments.
  NodeId apply(std::string_view name, const Nodes& arguments = {}, NodeId block = lang::kNoNode) {
    Nodes children = {arguments.empty() ? lang::kNoNode : list(arguments)};
    if (block != lang::kNoNode) children.push_back(block);
    return named(lang::NodeKind::Apply, name, children);
  }
  /// An operation with empty brackets.
  NodeId applyBare(std::string_view name) { return named(lang::NodeKind::Apply, name, {list({})}); }
  NodeId leaf(std::string_view name) {
    const NodeId id = named(lang::NodeKind::Apply, name, {lang::kNoNode});
    tree_.addFlags(id, lang::kFlagTerminal);
    return id;
  }
  NodeId push(NodeId body) { return tree_.add(node(lang::NodeKind::Push), {body}); }

  NodeId block(const Nodes& items) { return tree_.add(node(lang::NodeKind::Block), items); }
  /// `a || b`, as a selector.
  NodeId choiceOfWords(std::string_view a, std::string_view b) {
    const NodeId left = word(a), right = word(b);
    return binary(lang::BinaryOp::Or, left, right);
  }
  /// `head = body`: all that the head selects in one.
  NodeId together(NodeId head, NodeId body) {
    lang::Node n = node(lang::NodeKind::Item);
    n.op = static_cast<uint8_t>(lang::ItemKind::Combine);
    return tree_.add(n, {head, lang::kNoNode, body});
  }
  /// `head : body`, or the body alone.
  NodeId item(NodeId head, NodeId body) {
    lang::Node n = node(lang::NodeKind::Item);
    n.op = static_cast<uint8_t>(head ? lang::ItemKind::Each : lang::ItemKind::Plain);
    return tree_.add(n, {head, lang::kNoNode, body});
  }
  /// Conditions, or weights in percent, with bodies; kNoNode stands for `else`. In a body a choice
  /// behind other successors stands in brackets: its branches would be read as those around it.
  NodeId choice(lang::ChoiceKind kind, const std::vector<std::pair<NodeId, NodeId>>& branches) {
    Nodes made;
    for (const auto& [head, body] : branches) {
      const auto steps = tree_.children(body);
      Nodes list(steps.begin(), steps.end());
      for (size_t i = 1; i < list.size(); ++i) bracketChoice(list[i]);
      const NodeId safe = tree_.add(node(lang::NodeKind::Sequence), list);
      made.push_back(tree_.add(node(lang::NodeKind::Branch), {head, safe}));
    }
    lang::Node n = node(lang::NodeKind::Choice);
    n.op = static_cast<uint8_t>(kind);
    return tree_.add(n, made);
  }

  lang::Tree finish(const Nodes& declarations, uint32_t size) {
    lang::Node n = node(lang::NodeKind::File);
    n.begin = 0;
    n.end = size;
    tree_.setRoot(tree_.add(n, declarations));
    return std::move(tree_);
  }

 private:
  void bracketChoice(NodeId& successor) {
    if (tree_.kind(successor) == lang::NodeKind::Choice) successor = push(sequence({successor}));
  }
  lang::Node node(lang::NodeKind kind) const {
    lang::Node n;
    n.kind = kind;
    if (span_.valid()) {
      n.begin = span_.begin;
      n.end = span_.end;
    }
    return n;
  }
  NodeId named(lang::NodeKind kind, std::string_view name, const Nodes& children) {
    lang::Node n = node(kind);
    n.text = tree_.intern(name);
    return tree_.add(n, children);
  }

  lang::Tree tree_;
  Span span_;
};

}  // namespace gable::gbbg
