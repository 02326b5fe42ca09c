// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Blocks whose parts have names, `peel(..) { strip : A | rest : B }`, and the figures that such
// parts begin with.

#include <algorithm>

#include "base/number.h"
#include "lang/other_languages.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// The choice of an item "50% : ..." that has nothing else to choose; kNoNode for others.
NodeId loneWeight(const Tree& t, NodeId item) {
  const std::span<const NodeId> body = t.children(t.child(item, 2));
  if (body.size() != 1 || t.kind(body[0]) != NodeKind::Choice ||
      t[body[0]].op != static_cast<uint8_t>(ChoiceKind::Percent) ||
      t.children(body[0]).size() != 1) {
    return kNoNode;
  }
  const NodeId weight = t.child(t.child(body[0], 0), 0);
  return t.kind(weight) == NodeKind::Number && t.number(weight) < 100 ? body[0] : kNoNode;
}

}  // namespace

bool Analysis::isSelectorWord(std::string_view word, const OpSpec* op) const {
  return selectors_.count(word) != 0 || (op && op->part(word));
}

// "its parts are: strip, rest, otherwise".
std::string Analysis::partsText(const OpSpec& op) const {
  std::string out;
  for (const PartSpec& p : op.parts)
    out += (out.empty() ? "its parts are: " : ", ") + std::string(p.name);
  return out;
}

// "'strip' is a part of peel"; empty for what is a part of no operation.
std::string Analysis::partOwners(std::string_view word) const {
  constexpr int kMost = 6;
  std::string owners;
  int count = 0;
  for (const OpSpec* op : catalogue_.operations) {
    if (!op->part(word) || ++count > kMost) continue;
    owners += (owners.empty() ? "" : ", ") + std::string(op->name);
  }
  if (count > kMost) owners += " and others";
  return owners.empty() ? owners : quote(word) + " is a part of " + owners;
}

// What to write for `else :` in a block.
std::string Analysis::elseHint(const OpSpec* op) {
  if (op && op->block == BlockKind::Split) return "a part that takes the rest is '~1 : ...'";
  const bool otherwise = op && op->part("otherwise");
  meant_ = {"else", otherwise ? "otherwise" : "all"};
  if (!otherwise) return "write 'all' for every part that is not selected before";
  return "write 'otherwise' for a shape that " + quote(op->name) + " cannot do; " + partsText(*op);
}

// The size that a part of a split begins with, or a word of the split's own.
void Analysis::visitSizeHead(NodeId head, const OpSpec& op) {
  const bool isName = tree().kind(head) == NodeKind::Name;
  const std::string_view word = isName ? text(head) : std::string_view();
  if (isName && op.part(word)) {
    errorAt("unexpected-head", head, quote(word) + " stands in a block of its own",
            "write '{ length : depth : ... } { " + std::string(word) + " : ... }'");
    return;
  }
  std::string owners = isName && !isKnownValue(word) ? partOwners(word) : std::string();
  if (!isName ||
      (owners.empty() && word != "else" && (isKnownValue(word) || !selectors_.count(word)))) {
    expectType(head, visit(head, ValueType::Float), ValueType::Float, "a size");
    return;
  }
  resolve(head, RefKind::Selector);
  typed(head, ValueType::Selector);
  if (word == "else") {
    errorAt("unknown-selector", head, "'else' is no part of " + quote(op.name), elseHint(&op));
    return;
  }
  errorAt("unknown-selector", head, quote(word) + " is no size",
          "a part of " + quote(op.name) + " begins with its size, such as '~1 : ...'" +
              (owners.empty() ? "" : "; " + owners));
}

// A word in the head of an item that neither names a part nor selects anything.
void Analysis::reportSelector(NodeId node, const OpSpec* op) {
  const std::string_view word = text(node);
  const bool hasParts = op && !op->parts.empty();
  const bool onlyParts = hasParts && (op->isOnlyParts() || op->block == BlockKind::Operations);
  const ForeignWord* const foreign = onlyParts ? nullptr : foreignWord(ForeignUse::Selector, word);
  const auto names = [&] {
    std::vector<std::string_view> out;
    for (const PartSpec& p : hasParts ? op->parts : std::span<const PartSpec>()) {
      out.push_back(p.name);
    }
    for (const SelectorSpec& s : catalogue_.selectors) {
      if (!onlyParts) out.push_back(s.name);
    }
    return out;
  };
  std::string hint = word == "else" ? elseHint(op)
                     : foreign      ? remedyOf(*foreign)
                                    : near(word, names);
  if (hint.empty()) hint = hasParts ? partsText(*op) : partOwners(word);
  if (hint.empty()) hint = "selectors are words such as 'front', 'side', 'top' and 'all'";
  if (hasParts && !onlyParts && hint.starts_with("its parts")) hint += ", and all selectors";
  errorAt("unknown-selector", node,
          onlyParts ? quote(word) + " is no part of " + quote(op->name)
                    : quote(word) + " is no selector",
          std::move(hint));
}

// An item without the size or the selector that it begins with. The selector may be there, and only
// its colon missing.
void Analysis::reportMissingHead(NodeId item, const OpSpec& op) {
  const Tree& t = tree();
  const uint32_t begin = t[item].begin;
  if (op.block == BlockKind::Split) {
    if (const NodeId choice = loneWeight(t, item); choice != kNoNode) {
      // One mistake: that the weights are not whole is not told.
      headless_ = choice;
      const double weight = t.number(t.child(t.child(choice, 0), 0));
      errorAt("missing-size", item, "'" + shortestText(weight) + "%' is no size, but a probability",
              "write a share of the scope's size with a quote before it: '" +
                  shortestText(weight / 100));
      return;
    }
    warning("missing-size", t.span(item), "this part has no size, and takes '~1'",
            "write 'size : operations'");
    fix({t.file(), begin, begin}, "~1 : ");
    return;
  }
  const std::span<const NodeId> operations = t.children(t.child(item, 2));
  const NodeId first = operations.size() < 2 ? kNoNode : operations[0];
  const bool plain = t.kind(first) == NodeKind::Apply && t.children(first).size() == 1 &&
                     t.child(first, 0) == kNoNode && !t.has(first, kFlagTerminal);
  if (plain && isSelectorWord(t.text(first), &op) &&
      rulesNamed(body_.module, t.text(first)).rules.empty()) {
    headless_ = first;
    const Span word = nameSpan(t, first);
    errorAt("missing-selector", first, "the ':' is missing behind " + quote(t.text(first)),
            "write '" + std::string(t.text(first)) + " : operations'");
    fix({t.file(), word.end, word.end}, " :");
    return;
  }
  errorAt("missing-selector", item, "this part has no selector", "write 'selector : operations'");
  fix({t.file(), begin, begin}, "all : ");
}

// The figure that operations begin with, where a rule of that name has it in its own body.
const OpSpec* Analysis::figureOf(ModuleId module, NodeId sequence, int depth) const {
  const Tree& t = program_.tree(module);
  if (depth == 0 || t.kind(sequence) != NodeKind::Sequence || t.children(sequence).empty()) {
    return nullptr;
  }
  const NodeId first = t.children(sequence)[0];
  if (t.kind(first) == NodeKind::Choice) {
    for (const NodeId branch : t.children(first)) {
      if (const OpSpec* f = figureOf(module, t.child(branch, 1), depth - 1)) return f;
    }
    return nullptr;
  }
  const Resolution& r = program_.modules[module].at(first);
  if (r.kind == RefKind::Operation && r.spec.operation->figure) return r.spec.operation;
  if (r.kind != RefKind::Rule) return nullptr;
  const RuleInfo& rule = program_.rules[r.index];
  return figureOf(rule.module, bodyOf(program_.tree(rule.module), rule.node), depth - 1);
}

// junction : Plaza, with Plaza --> circle(3) ..: the operation sees no figure here, and makes none.
void Analysis::checkFigure(NodeId item, const OpSpec& op) {
  if (!op.figureWords || isMute()) return;
  const Tree& t = tree();
  const NodeId head = t.child(item, 0), body = t.child(item, 2);
  const std::string_view word = head == kNoNode ? "" : t.text(head);
  const bool plain = std::string_view(op.figureWords).empty();
  if (plain ? head != kNoNode : wordIndex(op.figureWords, word) < 0) return;
  if (t.kind(body) != NodeKind::Sequence || t.children(body).empty()) return;
  const NodeId first = t.children(body)[0];
  const Resolution& r = module().at(first);
  constexpr int kDeepest = 8;
  if (t.kind(first) != NodeKind::Apply || r.kind != RefKind::Rule) return;
  const OpSpec* figure = figureOf(body_.module, body, kDeepest);
  if (!figure) return;
  const std::string name(t.text(first));
  warning("figure-in-rule", nameSpan(t, first),
          quote(op.name) + " makes no figure here: the " + quote(figure->name) +
              " stands in the rule " + quote(name),
          "begin the block with it, '" + (plain ? std::string() : std::string(word) + " : ") +
              figure->name + "(..) " + name + "', and take it out of the rule");
}

// { remainder : operations }
void Analysis::visitRemainder(NodeId block, const OpSpec& op) {
  const Tree& t = tree();
  if (t.has(block, kFlagRepeat)) {
    errorAt("unexpected-repeat", block, "what remains is one part, and cannot be repeated",
            "remove the '*'");
  }
  for (const NodeId item : t.children(block)) {
    if (t.kind(item) != NodeKind::Item) {
      errorAt("unexpected-group", item, "this block has one part, without groups",
              "remove the inner braces");
      continue;
    }
    const NodeId head = t.child(item, 0);
    if (head == kNoNode) {
      errorAt("missing-selector", item, "this part has no selector",
              "write 'remainder : operations'");
    } else if (t.kind(head) == NodeKind::Name && op.part(t.text(head))) {
      resolve(head, RefKind::Selector);
      typed(head, ValueType::Selector);
    } else if (t.kind(head) == NodeKind::Name) {
      reportSelector(head, &op);
    } else if (t.kind(head) != NodeKind::Missing) {
      visit(head);
      errorAt("unexpected-head", head, "the second block of " + quote(op.name) + " has one part",
              "write 'remainder : operations'");
    }
    if (t.child(item, 1) != kNoNode && t.kind(t.child(item, 1)) != NodeKind::Missing) {
      errorAt("unexpected-head", t.child(item, 1), "what remains has no depth",
              "write 'remainder : operations'");
    }
    visitSequence(t.child(item, 2));
  }
  if (t.children(block).size() > 1) {
    errorAt("unexpected-separator", block, "what remains is one part", "remove the others");
  }
}

}  // namespace gable::lang
