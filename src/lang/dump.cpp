// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Two mutually recursive walks, one for lines and one for expressions; the depth of the tree is
// bounded by its contract.

#include "lang/dump.h"

#include <utility>

#include "base/number.h"

namespace gable::lang {

namespace {

class Dumper {
 public:
  explicit Dumper(const Tree& tree) : tree_(tree) {}

  std::string take() { return std::move(out_); }

  void line(NodeId id, int indent) {
    if (id == kNoNode) return;
    out_.append(static_cast<size_t>(indent) * 2, ' ');
    switch (tree_.kind(id)) {
      case NodeKind::File: return lines(id, "file", indent);
      case NodeKind::Import: return import(id, indent);
      case NodeKind::Style: return style(id, indent);
      case NodeKind::Attr:
      case NodeKind::Const:
      case NodeKind::Function: return definition(id);
      case NodeKind::Rule: return rule(id, indent);
      case NodeKind::Sequence: return lines(id, "sequence", indent);
      case NodeKind::Apply: return apply(id, indent);
      case NodeKind::Push: return lines(tree_.child(id, 0), "push", indent);
      case NodeKind::Choice:
        return lines(id, tree_.choiceKind(id) == ChoiceKind::Case ? "case" : "percent", indent);
      case NodeKind::Branch: return branch(id, indent);
      case NodeKind::Block:
        return lines(id, tree_.has(id, kFlagRepeat) ? "block *" : "block", indent);
      case NodeKind::Item: return item(id, indent);
      case NodeKind::Version: out_ += "version " + quoted(tree_.text(id)) + "\n"; return;
      default: expression(id); out_ += "\n";
    }
  }

  void expression(NodeId id) {
    if (id == kNoNode) return;
    const std::string text(tree_.text(id));
    switch (tree_.kind(id)) {
      case NodeKind::Number: out_ += shortestText(tree_.number(id)); return;
      case NodeKind::Bool: out_ += tree_.number(id) != 0 ? "true" : "false"; return;
      case NodeKind::String: out_ += lang::quoted(text); return;
      case NodeKind::Name:
      case NodeKind::Param: out_ += text; return;
      case NodeKind::Call:
        out_ += text;
        arguments(tree_.child(id, 0));
        functionBlock(tree_.child(id, 1));
        return;
      case NodeKind::ImportApply:
      case NodeKind::ImportCall:
        expression(tree_.child(id, 0));
        arguments(tree_.child(id, 1));
        out_ += "." + text;
        arguments(tree_.child(id, 2));
        return;
      case NodeKind::Unary:
        out_ += dot(id) + operatorText(tree_.unaryOp(id));
        return wrapped(tree_.child(id, 0));
      case NodeKind::Binary:
        out_ += "(";
        expression(tree_.child(id, 0));
        out_ += " " + dot(id) + operatorText(tree_.binaryOp(id)) + " ";
        expression(tree_.child(id, 1));
        out_ += ")";
        return;
      case NodeKind::Index:
        expression(tree_.child(id, 0));
        out_ += "[";
        expression(tree_.child(id, 1));
        if (tree_.child(id, 2) != kNoNode) out_ += ", ";
        expression(tree_.child(id, 2));
        out_ += "]";
        return;
      case NodeKind::Array:
        out_ += "[";
        joined(id, "; ");
        out_ += "]";
        return;
      case NodeKind::List: joined(id, ", "); return;
      case NodeKind::Range:
        expression(tree_.child(id, 0));
        out_ += ":";
        expression(tree_.child(id, 1));
        if (tree_.child(id, 1) != kNoNode) out_ += ":";
        expression(tree_.child(id, 2));
        return;
      case NodeKind::Relative: out_ += "'"; return wrapped(tree_.child(id, 0));
      case NodeKind::Floating: out_ += "~"; return wrapped(tree_.child(id, 0));
      case NodeKind::NamedArg:
      case NodeKind::Local:
        out_ += text + (tree_.kind(id) == NodeKind::Local ? " := " : " = ");
        expression(tree_.child(id, 0));
        return;
      case NodeKind::BraceList:
        out_ += "{";
        joined(id, ", ");
        out_ += "}";
        return;
      case NodeKind::Choice: return choice(id);
      case NodeKind::Annotation:
        out_ += "@" + text + "(";
        joined(id, ", ");
        out_ += ")";
        return;
      case NodeKind::Rule: out_ += text + " --> ..."; return;
      default: out_ += "<missing>";
    }
  }

 private:
  std::string dot(NodeId id) const { return tree_.has(id, kFlagElementwise) ? "." : ""; }

  void wrapped(NodeId id) {
    out_ += "(";
    expression(id);
    out_ += ")";
  }

  void joined(NodeId id, const char* separator) {
    bool first = true;
    for (const NodeId c : tree_.children(id)) {
      if (!first) out_ += separator;
      first = false;
      expression(c);
    }
  }

  void arguments(NodeId list) {
    if (list != kNoNode) wrapped(list);
  }

  void functionBlock(NodeId block) {
    if (block == kNoNode) return;
    out_ += "{";
    bool first = true;
    for (const NodeId i : tree_.children(block)) {
      if (!first) out_ += " | ";
      first = false;
      expression(tree_.child(i, 0));
      out_ += itemSign(i);
      expression(tree_.child(i, 2));
    }
    out_ += "}";
  }

  void choice(NodeId id) {
    const bool percent = tree_.choiceKind(id) == ChoiceKind::Percent;
    out_ += percent ? "percent{" : "case{";
    bool first = true;
    for (const NodeId b : tree_.children(id)) {
      if (!first) out_ += " | ";
      first = false;
      if (tree_.child(b, 0) == kNoNode) out_ += "else";
      expression(tree_.child(b, 0));
      out_ += ": ";
      expression(tree_.child(b, 1));
    }
    out_ += "}";
  }

  const char* itemSign(NodeId id) const {
    static constexpr const char* kSigns[] = {"", " : ", " = ", " =: "};
    return kSigns[static_cast<size_t>(tree_.itemKind(id))];
  }

  void lines(NodeId id, const char* title, int indent) {
    out_ += title;
    out_ += "\n";
    below(id, indent);
  }

  void below(NodeId id, int indent) {
    for (const NodeId c : tree_.children(id)) line(c, indent + 1);
  }

  void annotations(NodeId declaration) {
    for (const NodeId a : tree_.children(annotationsOf(tree_, declaration))) {
      out_ += " ";
      expression(a);
    }
  }

  void head(NodeId id) {
    out_ += std::string(nodeKindName(tree_.kind(id))) + " " + std::string(tree_.text(id));
    arguments(paramsOf(tree_, id));
    if (localsOf(tree_, id) == kNoNode) return;
    out_ += " with ";
    wrapped(localsOf(tree_, id));
  }

  void definition(NodeId id) {
    head(id);
    out_ += " = ";
    expression(bodyOf(tree_, id));
    annotations(id);
    out_ += "\n";
  }

  void rule(NodeId id, int indent) {
    head(id);
    if (tree_.has(id, kFlagStart)) out_ += " start";
    if (tree_.has(id, kFlagExtension)) out_ += " extension";
    annotations(id);
    out_ += "\n";
    below(bodyOf(tree_, id), indent);
  }

  void style(NodeId id, int) {
    out_ += "style " + std::string(tree_.text(id));
    if (tree_.child(id, 1) != kNoNode) out_ += " extends ";
    expression(tree_.child(id, 1));
    annotations(id);
    out_ += "\n";
  }

  void import(NodeId id, int indent) {
    out_ += "import " + std::string(tree_.text(id));
    arguments(tree_.child(id, 2));
    out_ += " : ";
    expression(tree_.child(id, 1));
    annotations(id);
    out_ += tree_.child(id, 3) != kNoNode ? " overrides\n" : "\n";
    below(tree_.child(id, 3), indent);
  }

  void apply(NodeId id, int indent) {
    out_ += tree_.text(id);
    arguments(tree_.child(id, 0));
    if (tree_.has(id, kFlagTerminal)) out_ += ".";
    if (tree_.has(id, kFlagOperand)) out_ += " operand";
    out_ += "\n";
    const auto children = tree_.children(id);
    for (size_t i = 1; i < children.size(); ++i) line(children[i], indent + 1);
  }

  void branch(NodeId id, int indent) {
    if (tree_.child(id, 0) == kNoNode) out_ += "else";
    expression(tree_.child(id, 0));
    out_ += ":\n";
    below(tree_.child(id, 1), indent);
  }

  void item(NodeId id, int indent) {
    out_ += "item ";
    expression(tree_.child(id, 0));
    if (tree_.child(id, 1) != kNoNode) out_ += " : ";
    expression(tree_.child(id, 1));
    out_ += itemSign(id);
    while (out_.back() == ' ') out_.pop_back();
    out_ += "\n";
    below(tree_.child(id, 2), indent);
  }

  const Tree& tree_;
  std::string out_;
};

const char* const kTokenNames[] = {
    "end",      "name",      "number",  "string",       "lparen",     "rparen",   "lbracket",
    "rbracket", "lbrace",    "rbrace",  "comma",        "semicolon",  "colon",    "assign",
    "equal",    "connect",   "arrow",   "pipe",         "dot",        "at",       "tilde",
    "quote",    "plus",      "minus",   "star",         "slash",      "percent",  "not",
    "less",     "lessEqual", "greater", "greaterEqual", "equalEqual", "notEqual", "and",
    "or",       "caret"};

}  // namespace

std::string dump(const Tree& tree) {
  Dumper d(tree);
  d.line(tree.root(), 0);
  return d.take();
}

std::string dumpExpression(const Tree& tree, NodeId id) {
  Dumper d(tree);
  d.expression(id);
  return d.take();
}

std::string dumpTokens(const Tokens& tokens, std::string_view text) {
  std::string out;
  for (const Token& t : tokens.tokens) {
    out += kTokenNames[static_cast<size_t>(t.kind)];
    if (t.kind != TokenKind::End) {
      out += " ";
      out += text.substr(t.begin, t.end - t.begin);
    }
    out += "\n";
  }
  return out;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c == '\r') {
      out += "\\r";
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace gable::lang
