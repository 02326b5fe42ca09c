// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules of GBBG as values. They are read by the notation's own parser, and written by its own
// printer; what differs between the two texts, word by word, is what is edited.

#include <algorithm>
#include <iterator>
#include <set>

#include "dialects/gbbg/lexer.h"
#include "dialects/gbbg/parser.h"
#include "dialects/gbbg/print.h"
#include "language/rule_form.h"
#include "language/words.h"

namespace gable::language {

namespace {

using gbbg::TokenKind;

constexpr const char* kOperators[] = {"Scope", "Split", "Repeat", "Grid", "Margin", "Component"};
constexpr const char* kAxes[] = {"X", "Y", "Z"};
constexpr const char* kOrientations[] = {"Default", "FacingOut", "FacingIn"};

template <class Enum, size_t N>
Enum among(const char* const (&names)[N], const std::string& name) {
  const auto* at = std::find(std::begin(names), std::end(names), name);
  return static_cast<Enum>(at == std::end(names) ? 0 : at - std::begin(names));
}

gbbg::Faces facesNamed(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(gbbg::Faces::TopPlusBottom); ++i) {
    const auto f = static_cast<gbbg::Faces>(i);
    if (name == gbbg::facesName(f)) return f;
  }
  return gbbg::Faces::Sides;
}

std::optional<BoxRule::Change> changeOf(const gbbg::Change& c, bool scale) {
  if (!c.written) return std::nullopt;
  return BoxRule::Change{c.value, c.set, scale ? c.relative : c.world, c.on};
}

gbbg::Change changeTo(const std::optional<BoxRule::Change>& c, bool scale) {
  gbbg::Change out;
  if (!c) return out;
  out = {true, c->on, c->value, c->set, false, false};
  (scale ? out.relative : out.world) = c->other;
  return out;
}

std::vector<std::string> namesOfSlots(const gbbg::Rule& r) {
  std::vector<std::string> out;
  switch (r.op) {
    case gbbg::Operator::Split:
      for (const double p : r.points) out.push_back(numberText(p) + " m");
      out.push_back("the rest");
      break;
    case gbbg::Operator::Margin:
      out = {"corner", "edge"};
      if (r.center) out.push_back("centre");
      break;
    case gbbg::Operator::Component:
      if (gbbg::hasSides(r.faces)) out.push_back("sides");
      if (gbbg::hasTop(r.faces)) out.push_back("top");
      if (gbbg::hasBottom(r.faces)) out.push_back("bottom");
      break;
    default: out = {"successor"};
  }
  return out;
}

BoxRule boxOf(const gbbg::Rule& r) {
  BoxRule out;
  out.title = r.title;
  out.predecessor = r.predecessor.text;
  out.op = gbbg::operatorName(r.op);
  out.axis = kAxes[static_cast<size_t>(r.axis)];
  out.translate = changeOf(r.translate, false);
  out.rotate = changeOf(r.rotate, false);
  out.scale = changeOf(r.scale, true);
  // What the operation does not have keeps what a new rule has.
  if (r.op == gbbg::Operator::Split) out.points = r.points;
  if (r.op == gbbg::Operator::Margin) out.margin = r.margin;
  if (r.op == gbbg::Operator::Component) out.faces = gbbg::facesName(r.faces);
  out.toRoot = r.toRoot;
  out.relative = r.relativeMargin;
  out.orientation = kOrientations[static_cast<size_t>(r.orientation)];
  out.center = r.center;
  for (const gbbg::Slot& slot : r.slots) {
    std::vector<BoxRule::Possibility>& list = out.slots.emplace_back();
    for (const gbbg::Possibility& p : slot.possibilities) {
      list.push_back({p.symbol.text, p.chanceWritten ? std::optional(p.chance) : std::nullopt});
    }
  }
  out.slotNames = namesOfSlots(r);
  out.weight = r.weight;
  return out;
}

gbbg::Rule ruleOf(const BoxRule& box) {
  gbbg::Rule out;
  out.title = box.title;
  out.predecessor.text = box.predecessor;
  out.op = among<gbbg::Operator>(kOperators, box.op);
  out.axis = among<gbbg::Axis>(kAxes, box.axis);
  out.translate = changeTo(box.translate, false);
  out.rotate = changeTo(box.rotate, false);
  out.scale = changeTo(box.scale, true);
  out.points = box.points;
  out.toRoot = box.toRoot;
  out.margin = box.margin;
  out.relativeMargin = box.relative;
  out.orientation = among<gbbg::Orientation>(kOrientations, box.orientation);
  out.center = box.center;
  out.faces = facesNamed(box.faces);
  for (const auto& list : box.slots) {
    gbbg::Slot& slot = out.slots.emplace_back();
    for (const BoxRule::Possibility& p : list) {
      slot.possibilities.push_back({{p.symbol, {}}, p.chance.value_or(1), p.chance.has_value()});
    }
  }
  // As many successors as there have to be; those that are there stay.
  gbbg::Slot nothing;
  nothing.possibilities.push_back({{"EMPTY", {}}, 1, false});
  out.slots.resize(namesOfSlots(out).size(), nothing);
  out.weight = box.weight;
  return out;
}

bool namesSymbol(const gbbg::Token& t) {
  return t.kind == TokenKind::Word || (t.kind == TokenKind::Text && !t.text.empty());
}

struct Read {
  gbbg::Grammar grammar;
  Diagnostics diagnostics;
};

Read read(std::string_view text) {
  Read out;
  out.grammar = gbbg::parse(text, 0, out.diagnostics);
  return out;
}

// The line of something in a table, with its end.
Range lineOf(const Text& text, uint32_t begin, uint32_t end) {
  const std::string& s = text.content();
  const uint32_t from = text.lineStart(text.lineOf(begin));
  const size_t stop = s.find('\n', end);
  return text.range(from, static_cast<uint32_t>(stop == std::string::npos ? s.size() : stop + 1));
}

void addAssets(const Text& text, const gbbg::Statement& table, TextForm& out) {
  const std::string& s = text.content();
  for (const gbbg::AssetLine& a : table.assets) {
    AssetRow row{a.symbol.text, a.path, {}, {}};
    for (const Word& w : wordsOf(std::string_view(s).substr(a.symbol.span.end))) {
      if (w.kind != WordKind::String) continue;
      const uint32_t begin = a.symbol.span.end + w.begin, end = a.symbol.span.end + w.end;
      row.pathRange = text.range(begin + 1, end - 1);
      row.removal = lineOf(text, a.symbol.span.begin, end);
      break;
    }
    out.assets.push_back(std::move(row));
  }
  const uint32_t close = table.span.end - 1;
  const uint32_t line = text.lineStart(text.lineOf(close));
  const bool alone = s.find_first_not_of(" \t", line) == close;
  out.newAsset = Insertion{text.position(alone ? line : close), alone ? "  " : "\n  ", "\n"};
}

}  // namespace

std::vector<BoxHead> boxHeads(std::string_view text) {
  Diagnostics ignored;
  const std::vector<gbbg::Token> tokens = gbbg::tokenize(text, 0, ignored);
  std::vector<BoxHead> out;
  bool open = false;
  for (size_t i = 0; i + 1 < tokens.size(); ++i) {
    const bool titled = i > 0 && tokens[i - 1].kind == TokenKind::Text &&
                        tokens[i].kind == TokenKind::Word && tokens[i - 1].firstOfLine;
    const bool begins = namesSymbol(tokens[i]) && tokens[i + 1].kind == TokenKind::Arrow;
    if (begins) {
      BoxHead h;
      h.name = tokens[i].text;
      h.nameBegin = tokens[i].begin + (tokens[i].kind == TokenKind::Text ? 1 : 0);
      h.nameEnd = h.nameBegin + static_cast<uint32_t>(h.name.size());
      h.begin = titled ? tokens[i - 1].begin : tokens[i].begin;
      h.end = tokens[i + 1].end;
      if (titled) h.title = tokens[i - 1].text;
      out.push_back(std::move(h));
      open = true;
    } else if (tokens[i].firstOfLine && namesSymbol(tokens[i])) {
      // Something else begins, unless a title does.
      open = false;
    }
    if (open && tokens[i].end > out.back().end) out.back().end = tokens[i].end;
  }
  return out;
}

void addGrammar(const Text& text, TextForm& out) {
  const Read r = read(text.content());
  std::set<std::string> names{"START", "EMPTY"};
  uint32_t declared = 0;
  const auto add = [&](const gbbg::Symbol& s) { names.insert(s.text); };
  const auto size = static_cast<uint32_t>(text.content().size());
  const bool ends = text.content().empty() || text.content().back() == '\n';
  out.newAsset = Insertion{text.position(size),
                           ends ? "\npostprocess {\n  " : "\n\npostprocess {\n  ", "\n}\n"};
  for (const gbbg::Statement& s : r.grammar.statements) {
    for (const gbbg::Start& start : s.starts) add(start.symbol);
    for (const gbbg::ShapeLine& shape : s.shapes) add(shape.symbol);
    if (s.kind == gbbg::StatementKind::Rule) {
      add(s.rule.predecessor);
      for (const gbbg::Slot& slot : s.rule.slots) {
        for (const gbbg::Possibility& p : slot.possibilities) add(p.symbol);
      }
    }
    if (s.kind == gbbg::StatementKind::Axiom || s.kind == gbbg::StatementKind::Shapes) {
      declared = std::max(declared, s.span.end);
    }
    if (s.kind == gbbg::StatementKind::PostProcess) addAssets(text, s, out);
  }
  // Behind the last declaration, on the next line.
  const std::string& content = text.content();
  const size_t line = declared == 0 ? 0 : content.find('\n', declared);
  const uint32_t at = line == std::string::npos ? size : static_cast<uint32_t>(line);
  out.newSymbol = declared == 0 ? Insertion{text.position(0), "", "\n"}
                                : Insertion{text.position(at), "\n", ""};
  out.symbols.assign(names.begin(), names.end());
}

void addBoxRule(const Text& text, const BoxHead& head, RuleForm& out) {
  const Read r = read(text.content());
  for (const gbbg::Statement& s : r.grammar.statements) {
    if (s.kind == gbbg::StatementKind::Rule && s.span.begin == head.begin) out.box = boxOf(s.rule);
  }
  if (out.box) return;
  out.trouble = "The form needs a rule that can be read.";
  for (const Diagnostics::Entry& d : r.diagnostics.all()) {
    if (d.severity != Severity::Error || d.span.begin < head.begin) continue;
    out.trouble = "The form needs a rule that can be read: " + d.message + ".";
    return;
  }
}

std::string boxRuleText(const BoxRule& box) { return gbbg::printRule(ruleOf(box)); }

std::optional<std::vector<Edit>> boxEdits(const Text& text, const std::string& rule,
                                          const BoxRule& box) {
  for (const BoxHead& h : boxHeads(text.content())) {
    if (h.name != rule) continue;
    RuleForm now;
    addBoxRule(text, h, now);
    if (!now.box) return std::nullopt;
    return wordEdits(text, h.begin, h.end, boxRuleText(box));
  }
  return std::nullopt;
}

}  // namespace gable::language
