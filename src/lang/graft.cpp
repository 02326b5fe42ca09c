// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/graft.h"

#include <algorithm>
#include <string>
#include <vector>

#include "lang/lexer.h"
#include "lang/parser.h"

namespace gable::lang {

namespace {

struct Graft {
  Tree& to;
  const Tree& from;
  std::string_view text;
  Span span;
  const std::function<Span(std::string_view)>& place;

  bool isWhole(Span s) const { return s.begin == span.begin && s.end == span.end; }

  // No deeper than the parser lets expressions nest. A node covers what is known of its parts.
  NodeId copied(NodeId node) {
    if (node == kNoNode) return kNoNode;
    Node n = from[node];
    const NodeKind kind = from.kind(node);
    const bool word = kind == NodeKind::Name || kind == NodeKind::Call;
    const bool number = kind == NodeKind::Number;
    Span at = span;
    if (word) at = place(from.text(node));
    if (number) at = place(text.substr(n.begin, n.end - n.begin));
    std::vector<NodeId> children;
    for (const NodeId c : from.children(node)) {
      children.push_back(copied(c));
      if (children.back() == kNoNode || word) continue;
      const Span part = to.span(children.back());
      if (isWhole(part)) continue;
      at = isWhole(at) ? part
                       : Span{at.file, std::min(at.begin, part.begin), std::max(at.end, part.end)};
    }
    n.begin = at.begin;
    n.end = at.end;
    n.text = to.intern(from.text(node));
    return to.add(n, children);
  }
};

}  // namespace

NodeId graft(Tree& to, std::string_view expression, Span span,
             const std::function<Span(std::string_view)>& place) {
  // The one argument of a call in a rule.
  const std::string text = "R --> o(" + std::string(expression) + ")";
  Diagnostics diagnostics;
  const Tokens tokens = tokenize(text, 0, diagnostics);
  const Tree tree = parse(text, 0, tokens, diagnostics);
  if (!diagnostics.all().empty() || tree.root() == kNoNode) return kNoNode;
  const auto declarations = tree.children(tree.root());
  if (declarations.size() != 1 || tree.kind(declarations[0]) != NodeKind::Rule) return kNoNode;
  const auto successors = tree.children(tree.child(declarations[0], 3));
  if (successors.size() != 1 || tree.kind(successors[0]) != NodeKind::Apply) return kNoNode;
  const auto arguments = tree.children(tree.child(successors[0], 0));
  if (arguments.size() != 1) return kNoNode;
  return Graft{to, tree, text, span, place}.copied(arguments[0]);
}

}  // namespace gable::lang
