// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/graft.h"

#include <string>
#include <vector>

#include "lang/lexer.h"
#include "lang/parser.h"

namespace gable::lang {

namespace {

// No deeper than the parser lets expressions nest.
NodeId copied(Tree& to, const Tree& from, NodeId node, Span span) {
  if (node == kNoNode) return kNoNode;
  std::vector<NodeId> children;
  for (const NodeId c : from.children(node)) children.push_back(copied(to, from, c, span));
  Node n = from[node];
  n.begin = span.begin;
  n.end = span.end;
  n.text = to.intern(from.text(node));
  return to.add(n, children);
}

}  // namespace

NodeId graft(Tree& to, std::string_view expression, Span span) {
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
  return copied(to, tree, arguments[0], span);
}

}  // namespace gable::lang
