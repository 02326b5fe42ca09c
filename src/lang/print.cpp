// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/print.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/number.h"
#include "base/work.h"
#include "lang/dump.h"

namespace gable::lang {

namespace {

/// How tightly a piece of an expression holds together; brackets go around looser ones.
enum Tightness { kLoose = 0, kUnary = 7, kPrimary = 8 };

int precedenceOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or: return 1;
    case BinaryOp::And: return 2;
    case BinaryOp::Equal:
    case BinaryOp::NotEqual: return 3;
    case BinaryOp::Less:
    case BinaryOp::LessEqual:
    case BinaryOp::Greater:
    case BinaryOp::GreaterEqual: return 4;
    case BinaryOp::Add:
    case BinaryOp::Subtract: return 5;
    default: return 6;
  }
}

class Printer {
 public:
  Printer(const Tree& tree, std::span<const Remark> remarks) : t_(tree), remarks_(remarks) {}

  std::string run() {
    const auto declarations = t_.children(t_.root());
    std::map<NodeId, std::string> remarks = remarksByOwner(declarations);
    NodeKind last = NodeKind::None;
    for (const NodeId d : declarations) {
      const NodeKind kind = t_.kind(d);
      if (!out_.empty() && (kind != last || kind == NodeKind::Rule)) out_ += "\n";
      last = kind;
      out_ += remarks[d];
      declaration(d);
      out_ += "\n";
    }
    if (!remarks[kNoNode].empty()) out_ += "\n" + remarks[kNoNode];
    return std::move(out_);
  }

 private:
  std::string_view text(NodeId id) const { return t_.text(id); }

  // --- Remarks ---

  // To each declaration the remarks that stand in it, before it, or behind it on its last line;
  // kNoNode has those at the end.
  std::map<NodeId, std::string> remarksByOwner(std::span<const NodeId> declarations) const {
    // Of declarations in one place the last is the author's: a rule, not what it needs.
    std::vector<NodeId> sorted(declarations.rbegin(), declarations.rend());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](NodeId a, NodeId b) { return t_.span(a).begin < t_.span(b).begin; });
    std::map<NodeId, std::string> out;
    size_t next = 0;
    NodeId before = kNoNode;
    for (const Remark& r : remarks_) {
      for (; next < sorted.size() && t_.span(sorted[next]).end <= r.begin; ++next) {
        const bool later = before == kNoNode || t_.span(sorted[next]).end > t_.span(before).end;
        if (later) before = sorted[next];
      }
      NodeId owner = next < sorted.size() ? sorted[next] : kNoNode;
      const bool inside = owner != kNoNode && t_.span(owner).begin < r.begin;
      if (r.behind && !inside && before != kNoNode) owner = before;
      out[owner] += r.text + "\n";
    }
    return out;
  }

  // --- Declarations ---

  void declaration(NodeId id) {
    switch (t_.kind(id)) {
      case NodeKind::Version: out_ += "version " + quoted(text(id)); return;
      case NodeKind::Attr: return definition(id, "attr ");
      case NodeKind::Const: return definition(id, "const ");
      case NodeKind::Function: return definition(id, "");
      case NodeKind::Rule: return rule(id);
      case NodeKind::Annotation: return annotation(id);
      default: return;
    }
  }

  void annotation(NodeId id) {
    out_ += "@";
    out_ += text(id);
    if (t_.children(id).empty()) return;
    out_ += "(";
    joined(t_.children(id), ", ");
    out_ += ")";
  }

  void head(NodeId id) {
    out_ += text(id);
    if (paramsOf(t_, id) != kNoNode) {
      out_ += "(";
      joined(t_.children(paramsOf(t_, id)), ", ");
      out_ += ")";
    }
    if (localsOf(t_, id) == kNoNode) return;
    out_ += " with (";
    for (const NodeId l : t_.children(localsOf(t_, id))) {
      out_ += " ";
      out_ += text(l);
      out_ += " := ";
      expression(t_.child(l, 0));
    }
    out_ += " )";
  }

  void annotations(NodeId id, const char* separator) {
    for (const NodeId a : t_.children(annotationsOf(t_, id))) {
      annotation(a);
      out_ += separator;
    }
  }

  void definition(NodeId id, const char* word) {
    annotations(id, " ");
    out_ += word;
    head(id);
    out_ += " = ";
    expression(bodyOf(t_, id));
  }

  void rule(NodeId id) {
    annotations(id, "\n");
    if (t_.has(id, kFlagStart)) out_ += "start ";
    if (t_.has(id, kFlagExtension)) out_ += "extension ";
    head(id);
    out_ += " -->";
    sequence(bodyOf(t_, id));
  }

  // --- Successors; each begins with a blank ---

  void sequence(NodeId id) {
    if (id == kNoNode) return;
    for (const NodeId s : t_.children(id)) successor(s);
  }

  void successor(NodeId id) {
    work();
    switch (t_.kind(id)) {
      case NodeKind::Apply: return apply(id);
      case NodeKind::Push:
        out_ += " [";
        sequence(t_.child(id, 0));
        out_ += " ]";
        return;
      case NodeKind::Choice: return choice(id, false);
      case NodeKind::ImportApply:
        out_ += " ";
        imported(id);
        return;
      default: return;
    }
  }

  void apply(NodeId id) {
    out_ += " ";
    out_ += text(id);
    if (t_.child(id, 0) != kNoNode) arguments(t_.child(id, 0));
    if (t_.has(id, kFlagTerminal)) out_ += ".";
    const auto parts = t_.children(id);
    if (t_.has(id, kFlagOperand)) {
      sequence(t_.child(t_.child(parts[1], 0), 2));
      return;
    }
    for (size_t i = 1; i < parts.size(); ++i) block(parts[i], false);
  }

  void imported(NodeId id) {
    out_ += text(t_.child(id, 0));
    arguments(t_.child(id, 1));
    out_ += ".";
    out_ += text(id);
    if (t_.child(id, 2) != kNoNode) arguments(t_.child(id, 2));
  }

  void arguments(NodeId list) {
    out_ += "(";
    joined(t_.children(list), ", ");
    out_ += ")";
  }

  void block(NodeId id, bool expressions) {
    out_ += " {";
    bool first = true;
    for (const NodeId item : t_.children(id)) {
      if (!first) out_ += " |";
      first = false;
      if (t_.kind(item) == NodeKind::Block)
        block(item, expressions);
      else
        blockItem(item, expressions);
    }
    out_ += t_.has(id, kFlagRepeat) ? " }*" : " }";
  }

  void blockItem(NodeId id, bool expressions) {
    static constexpr const char* kSigns[] = {"", " :", " =", " =:"};
    const NodeId head = t_.child(id, 0), second = t_.child(id, 1);
    if (head != kNoNode) {
      out_ += " ";
      expression(head);
      out_ += kSigns[static_cast<size_t>(t_.itemKind(id))];
    }
    if (second != kNoNode) {
      out_ += " ";
      expression(second);
      out_ += " :";
    }
    if (!expressions) return sequence(t_.child(id, 2));
    out_ += " ";
    expression(t_.child(id, 2));
  }

  void choice(NodeId id, bool expressions) {
    const bool percent = t_.choiceKind(id) == ChoiceKind::Percent;
    for (const NodeId branch : t_.children(id)) {
      const NodeId condition = t_.child(branch, 0);
      out_ += expressions && branch == t_.child(id, 0) ? "" : " ";
      if (condition == kNoNode) {
        out_ += "else :";
      } else {
        if (!percent) out_ += "case ";
        expression(condition, percent ? kUnary : kLoose);
        out_ += percent ? "% :" : " :";
      }
      if (expressions) {
        out_ += " ";
        expression(t_.child(branch, 1));
      } else {
        sequence(t_.child(branch, 1));
      }
    }
  }

  // --- Expressions ---

  void joined(std::span<const NodeId> nodes, const char* separator) {
    bool first = true;
    for (const NodeId n : nodes) {
      if (!first) out_ += separator;
      first = false;
      expression(n);
    }
  }

  int tightnessOf(NodeId id) const {
    switch (t_.kind(id)) {
      case NodeKind::Binary: return precedenceOf(t_.binaryOp(id));
      case NodeKind::Unary: return kUnary;
      case NodeKind::Relative:
      case NodeKind::Floating:
      case NodeKind::Choice:
      case NodeKind::Range: return kLoose;
      default: return kPrimary;
    }
  }

  void expression(NodeId id, int least = kLoose) {
    work();
    const bool brackets = tightnessOf(id) < least;
    if (brackets) out_ += "(";
    bare(id);
    if (brackets) out_ += ")";
  }

  void bare(NodeId id) {
    const auto list = t_.children(id);
    switch (t_.kind(id)) {
      case NodeKind::Number: return number(t_.number(id));
      case NodeKind::String: out_ += quoted(text(id)); return;
      case NodeKind::Bool: out_ += t_.number(id) != 0 ? "true" : "false"; return;
      case NodeKind::Name:
      case NodeKind::Param: out_ += text(id); return;
      case NodeKind::Call:
        out_ += text(id);
        if (list[0] != kNoNode) arguments(list[0]);
        if (t_.child(id, 1) != kNoNode) block(t_.child(id, 1), true);
        return;
      case NodeKind::ImportCall: return imported(id);
      case NodeKind::Unary:
        out_ += dot(id);
        out_ += operatorText(t_.unaryOp(id));
        return expression(list[0], kUnary);
      case NodeKind::Binary: {
        const int precedence = precedenceOf(t_.binaryOp(id));
        expression(list[0], precedence);
        out_ += " " + dot(id) + operatorText(t_.binaryOp(id)) + " ";
        return expression(list[1], precedence + 1);
      }
      case NodeKind::Index:
        expression(list[0], kPrimary);
        out_ += "[";
        joined(list.subspan(1, t_.child(id, 2) == kNoNode ? 1 : 2), ", ");
        out_ += "]";
        return;
      case NodeKind::Array: return array(id);
      case NodeKind::Range: return range(id);
      case NodeKind::Relative: out_ += "'"; return expression(list[0], kUnary);
      case NodeKind::Floating: out_ += "~"; return expression(list[0], kUnary);
      case NodeKind::NamedArg:
        out_ += text(id);
        out_ += " = ";
        return expression(list[0]);
      case NodeKind::BraceList:
        out_ += "{";
        joined(list, ", ");
        out_ += "}";
        return;
      case NodeKind::Choice: return choice(id, true);
      default: return;
    }
  }

  // The language has no words for what is no number, or beyond all numbers.
  void number(double v) {
    if (std::isfinite(v))
      out_ += shortestText(v);
    else
      out_ += std::isnan(v) ? "(0 / 0)" : v > 0 ? "(1 / 0)" : "(-1 / 0)";
  }

  std::string dot(NodeId id) const { return t_.has(id, kFlagElementwise) ? "." : ""; }

  void array(NodeId id) {
    out_ += "[";
    bool first = true;
    for (const NodeId row : t_.children(id)) {
      if (!first) out_ += "; ";
      first = false;
      joined(t_.children(row), ", ");
    }
    out_ += "]";
  }

  void range(NodeId id) {
    expression(t_.child(id, 0), kUnary);
    for (const size_t part : {1, 2}) {
      if (t_.child(id, part) == kNoNode) continue;
      out_ += ":";
      expression(t_.child(id, part), kUnary);
    }
  }

  const Tree& t_;
  std::span<const Remark> remarks_;
  std::string out_;
};

}  // namespace

std::string print(const Tree& tree, std::span<const Remark> remarks) {
  return Printer(tree, remarks).run();
}

}  // namespace gable::lang
