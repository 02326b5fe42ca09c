// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names mean three things: a rule of the grammar; a set of points or lines that an argument names
// (a rule of one ScatterCircles, Corners or Parametrise); else a leaf, drawn in a colour that its
// name suggests. Operations that put things into a region leave the region itself to the end of
// the rule, where it becomes the leaf.
#include "dialects/park/lower.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "base/number.h"
#include "base/text.h"
#include "dialects/park/expression.h"
#include "dialects/park/lowering.h"
#include "dialects/park/operations.h"
#include "dialects/park/places.h"
#include "dialects/proposal.h"
#include "lang/graft.h"

namespace gable::park {

lang::Tree Lowering::run() {
  Nodes rules;
  static const Rule kNone;
  rule_ = &kNone;
  for (const Grammar::Constant& c : g_.written) {
    b_.at(c.span);
    const NodeId value = expressionOf(c.text, c.span);
    b_.at(c.span);
    rules.push_back(b_.attribute(c.name, value));
  }
  bool first = true;
  for (const Rule& r : g_.rules) {
    if (r.function || isPointSet(r)) continue;
    if (first) checkStart(r);
    rules.push_back(rule(r, first));
    first = false;
  }
  warnOfUnused();
  if (models_) rules.insert(rules.begin(), modelFile());
  return b_.finish(rules, static_cast<uint32_t>(source_.size()));
}

namespace {

// The words of a text that may be names.
void addWords(std::string_view text, std::set<std::string>& out) {
  for (size_t i = 0; i < text.size();) {
    const auto part = [&](size_t k) {
      return std::isalnum(static_cast<unsigned char>(text[k])) != 0 || text[k] == '_';
    };
    size_t end = i;
    while (end < text.size() && part(end)) ++end;
    if (end > i) out.emplace(text.substr(i, end - i));
    i = std::max(end, i + 1);
  }
}

void addWords(const Sequence& s, std::set<std::string>& out) {
  for (const Op& op : s) {
    out.insert(op.name);
    addWords(op.size, out);
    for (const Argument& a : op.arguments) addWords(a.text, out);
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) {
        addWords(p.label, out);
        addWords(p.body, out);
      }
    }
    addWords(op.otherwise, out);
  }
}

}  // namespace

void Lowering::warnOfUnused() {
  std::set<std::string> named;
  for (const Rule& r : g_.rules) {
    for (const Branch& b : r.branches) {
      addWords(b.condition, named);
      addWords(b.body, named);
    }
  }
  for (const Grammar::Constant& c : g_.written) addWords(c.text, named);
  bool started = false;
  for (const Rule& r : g_.rules) {
    // Derivation begins with the first rule that is no function.
    const bool start = !started && !r.function;
    started = started || start;
    if (start || named.count(r.name) != 0) continue;
    diagnostics_.warning("unused-rule", r.nameSpan, "nothing names the rule '" + r.name + "'",
                         "name it where it is meant, or take it out");
  }
  for (const Grammar::Constant& c : g_.written) {
    if (c.name == "PathWidth" || named.count(c.name) != 0) continue;
    const std::string nearest = nearestName(c.name, {"PathWidth"});
    diagnostics_.warning(
        "unused-rule", c.span, "nothing names the constant '" + c.name + "'",
        nearest.empty() ? "name it where it is meant, or take it out" : meaning(nearest));
    propose(diagnostics_, placeOf(source_, c.span, c.name), c.name, nearest);
  }
}

NodeId Lowering::rule(const Rule& r, bool start) {
  rule_ = &r;
  b_.at(r.nameSpan);
  Nodes notes;
  if (start) notes.push_back(b_.annotation("StartRule", {}));
  std::vector<std::pair<NodeId, NodeId>> branches;
  NodeId body = kNoNode;
  for (const Branch& br : r.branches) {
    const NodeId steps = sequence(br.body, r.name);
    if (br.condition.empty() && branches.empty()) {
      body = steps;
      break;
    }
    b_.at(br.span);
    const NodeId condition = br.condition.empty() ? kNoNode : conditionOf(br.condition, br.span);
    branches.emplace_back(condition, steps);
  }
  b_.at(r.nameSpan);
  if (!branches.empty()) {
    if (branches.back().first != kNoNode) {
      diagnostics_.warning("missing-else", r.branches.back().span,
                           "'" + r.name + "' has no 'else': what fits none of its cases is a leaf",
                           "add 'else: operations'");
      branches.emplace_back(kNoNode, b_.sequence({colour(r.name), b_.leaf(r.name)}));
    }
    body = b_.sequence({b_.choice(lang::ChoiceKind::Case, branches)});
  }
  return b_.rule(r.name, notes, body, r.parameters);
}

NodeId Lowering::colour(std::string_view name) {
  return b_.apply("color", {b_.text(colourOf(name))});
}

NodeId Lowering::sequence(const Sequence& ops, std::string_view owner) {
  Nodes steps;
  addSteps(ops, owner, steps);
  return b_.sequence(steps);
}

void Lowering::addSteps(const Sequence& ops, std::string_view owner, Nodes& out) {
  const bool outer = std::exchange(coloured_, false);
  bool open = true;
  for (const Op& op : ops) open = step(op, out);
  if (open && !owner.empty()) addLeaf(owner, out);
  coloured_ = outer;
}

void Lowering::addLeaf(std::string_view name, Nodes& out) {
  if (!coloured_) out.push_back(colour(name));
  out.push_back(b_.leaf(name));
}

bool Lowering::step(const Op& op, Nodes& out) {
  b_.at(op.span);
  if (!op.called && op.blocks.empty()) return symbol(op, out);
  checkUsage(op);
  switch (operationNamed(op.name)) {
    case Operation::Grid: return grid(op, out), false;
    case Operation::Voronoi: return voronoi(op, out), false;
    case Operation::Rays: return rays(op, out), false;
    case Operation::Peel: return peel(op, out), false;
    case Operation::Choose: return choose(op, out), false;
    case Operation::Joined: return joined(op, out), false;
    case Operation::Model: return model(op, out), false;
    case Operation::InnerRect: return innerRect(op, out), false;
    case Operation::Select: return select(op, out), false;
    case Operation::QuadMap: return quadMap(op, out), false;
    case Operation::Contract: return contract(op, out), true;
    case Operation::Insert: return insert(op, out), true;
    case Operation::NoHoles: return out.push_back(b_.applyBare("cutHoles")), true;
    case Operation::Colour: return look(op, out), true;
    case Operation::Extrude: return out.push_back(b_.apply("extrude", {number(op, 0, 1)})), true;
    case Operation::Figure: return figure(op, out), true;
    case Operation::Place: return place(op, out), true;
    case Operation::Distribute: return distribute(op, out), true;
    case Operation::Scatter: return scatter(op, out), true;
    case Operation::Sweep: return sweep(op, out), true;
    case Operation::Parametrise: return lines(op, out), true;
    case Operation::None: break;
  }
  if (const Rule* r = g_.rule(op.name)) {
    if (r->function) return inlined(*r, op, out);
    call(*r, op, out);
    return false;
  }
  if (isPointSetName(op.name)) {
    diagnostics_.error("unknown-operation", placeOf(source_, op.span, op.name),
                       "'" + op.name + "' stands for points and makes nothing by itself",
                       "give it to another operation, as in CastRays(CENTRE, Corners(Region))");
    return true;
  }
  if (const char* own = wordForCga(op.name)) {
    diagnostics_.error("unknown-operation", placeOf(source_, op.span, op.name),
                       "'" + op.name + "' is a word of CGA, which park grammars do not have",
                       std::string("write it as park grammars do: ") + own);
    return true;
  }
  const std::string nearest = nearestOperation(op.name);
  if (op.blocks.empty() && nearest.empty()) {
    warnOfArguments(op);
    addLeaf(op.name, out);
    return false;
  }
  const Span word = placeOf(source_, op.span, op.name);
  diagnostics_.error(
      "unknown-operation", word, "there is no operation '" + op.name + "'",
      nearest.empty() ? "docs/guide/park.md lists the operations" : meaning(nearest));
  propose(diagnostics_, word, op.name, nearest);
  return true;
}

// Color("#ff0000") and Texture("gravel.jpg").
void Lowering::look(const Op& op, Nodes& out) {
  std::string value = text(op, 0);
  std::erase(value, '"');
  const char* const made = lowerCase(op.name) == "texture" ? "texture" : "color";
  out.push_back(b_.apply(made, {b_.text(value)}));
  coloured_ = true;
}

bool Lowering::symbol(const Op& op, Nodes& out) {
  const Rule* r = g_.rule(op.name);
  if (r && r->function) return inlined(*r, op, out);
  if (r) {
    call(*r, op, out);
    return false;
  }
  if (lowerCase(op.name) == "grid") return grid(op, out), false;
  if (lowerCase(op.name) == "noholes") return out.push_back(b_.applyBare("cutHoles")), true;
  if (isMaterialWord(op.name)) {
    warnOfColour(op);
    out.push_back(colour(op.name));
    coloured_ = true;
    return true;
  }
  if (operationNamed(op.name) != Operation::None) {
    diagnostics_.error("wrong-argument-count", op.span,
                       "the operation '" + op.name + "' needs arguments or a block",
                       "write " + op.name + "(..), or give the leaf another name");
    return true;
  }
  warnOfSlip(op);
  addLeaf(op.name, out);
  return false;
}

// MARBLE is grey, which may be meant, but YELOW is a slip.
void Lowering::warnOfColour(const Op& op) {
  if (knownColourOf(op.name)) return;
  const std::string nearest = nearestColour(op.name);
  if (nearest.empty()) return;
  diagnostics_.error("unknown-colour", op.span, "'" + op.name + "' is no colour or material",
                     meaning(nearest));
  propose(diagnostics_, placeOf(source_, op.span, op.name), op.name, nearest);
}

// A name without a rule is a leaf, but one close to a rule's was probably meant to be that.
void Lowering::warnOfSlip(const Op& op) {
  std::vector<std::string_view> names;
  for (const Rule& r : g_.rules) names.push_back(r.name);
  const std::string nearest = nearestName(op.name, names);
  // Plant1 beside Plant2, Hedge beside Hedges.
  const bool counted = std::any_of(op.name.begin(), op.name.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
  if (nearest.empty() || counted || nearest == op.name + "s" || op.name == nearest + "s") return;
  diagnostics_.warning("undefined-rule", op.span,
                       "no rule is named '" + op.name + "'; it becomes a leaf", meaning(nearest));
  propose(diagnostics_, placeOf(source_, op.span, op.name), op.name, nearest);
}

void Lowering::call(const Rule& r, const Op& op, Nodes& out) {
  if (r.parameters.size() != op.arguments.size()) {
    diagnostics_.error("wrong-argument-count", op.span, countMistake(r, op.arguments.size()),
                       "give a value for each of its parameters");
    return;
  }
  Nodes arguments;
  for (size_t i = 0; i < op.arguments.size(); ++i) arguments.push_back(number(op, i, 0));
  out.push_back(b_.apply(op.name, arguments));
}

void Lowering::wrongCount(const std::string& mistake, Span span) {
  diagnostics_.error("wrong-argument-count", span, mistake,
                     "give a value for each of its parameters");
}

bool Lowering::canInline(const Rule& r, const Op& op) {
  constexpr size_t kMostCalls = 50000, kLongestArgument = 4096;
  const auto refuse = [&](const char* code, const std::string& what, const char* hint) {
    diagnostics_.error(code, op.span, "the function '" + op.name + "' " + what, hint);
    return false;
  };
  if (r.branches.size() != 1) {
    return refuse("nesting-too-deep", "has cases", "make it a rule: leave out 'fun'");
  }
  if (std::find(functions_.begin(), functions_.end(), &r) != functions_.end()) {
    return refuse("nesting-too-deep", "calls itself", "make it a rule: leave out 'fun'");
  }
  if (functionCalls_ == kMostCalls) {
    return refuse("nesting-too-deep", "stands for more than can be written out",
                  "call functions within functions less often");
  }
  if (op.called && r.parameters.size() != op.arguments.size()) {
    wrongCount(countMistake(r, op.arguments.size()), op.span);
    return false;
  }
  for (const auto& argument : op.arguments) {
    if (argument.text.size() <= kLongestArgument) continue;
    return refuse("nesting-too-deep", "has an argument that is too long",
                  "name a part of it as a constant");
  }
  ++functionCalls_;
  return true;
}

bool Lowering::inlined(const Rule& r, const Op& op, Nodes& out) {
  if (!canInline(r, op)) return true;
  std::map<std::string, std::string> words;
  for (size_t i = 0; i < r.parameters.size() && i < op.arguments.size(); ++i) {
    words[r.parameters[i]] = op.arguments[i].text;
  }
  functions_.push_back(&r);
  bool open = true;
  for (const Op& inner : withArguments(r.branches[0].body, words)) open = step(inner, out);
  functions_.pop_back();
  b_.at(op.span);
  return open;
}

namespace {

// No size, share or constant.
bool isName(const std::string& label) {
  return std::all_of(label.begin(), label.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

}  // namespace

Lowering::Slots Lowering::slotsOf(const Op& op,
                                  const std::vector<std::vector<std::string>>& names) {
  Slots s;
  s.part.assign(names.size(), nullptr);
  s.empty.assign(names.size(), false);
  size_t at = 0;
  for (const Block& block : op.blocks) {
    if (block.parts.empty()) {
      if (at < names.size()) s.empty[at] = true;
      ++at;
    }
    for (const Part& p : block.parts) {
      const std::string label = lowerCase(p.label);
      size_t place = names.size();
      for (size_t i = 0; i < names.size(); ++i) {
        if (std::find(names[i].begin(), names[i].end(), label) != names[i].end()) place = i;
      }
      const bool value = g_.constants.count(p.label) != 0 || isParameter(p.label);
      if (place == names.size() && !label.empty() && isName(label) && !value) {
        std::vector<std::string_view> words;
        for (const auto& same : names) words.insert(words.end(), same.begin(), same.end());
        const std::string nearest = nearestName(label, words);
        std::string hint = meaning(nearest);
        if (hint.empty()) {
          for (const std::string_view w : words) {
            hint += (hint.empty() ? "it knows " : ", ") + std::string(w);
          }
        }
        diagnostics_.error("unknown-selector", p.span,
                           "'" + op.name + "' has no part called '" + p.label + "'", hint);
        propose(diagnostics_, placeOf(source_, p.span, p.label), p.label, nearest);
      }
      if (place == names.size()) place = at++;
      if (place < names.size()) {
        s.part[place] = &p;
        s.empty[place] = p.body.empty();
      } else {
        diagnostics_.error("too-many-blocks", p.span, "'" + op.name + "' has no use for this",
                           "leave it out");
      }
    }
  }
  return s;
}

NodeId Lowering::item(const char* word, const Part* p, const char* otherwise) {
  if (p && !p->body.empty()) {
    const NodeId body = sequence(p->body, "Region");
    b_.at(p->span);
    return b_.item(b_.word(word), body);
  }
  return b_.item(b_.word(word), b_.sequence({colour(otherwise), b_.leaf(otherwise)}));
}

NodeId Lowering::item(const char* word, const Slots& s, size_t i, const char* otherwise) {
  if (!s.empty[i]) return item(word, s.part[i], otherwise);
  return b_.item(b_.word(word), b_.sequence({b_.apply("NIL")}));
}

void Lowering::addElse(const Op& op, Nodes& items) {
  if (!op.hasElse) return;
  const NodeId body = sequence(op.otherwise, "Region");
  b_.at(op.span);
  items.push_back(b_.item(b_.word("otherwise"), body));
}

NodeId Lowering::elseBlock(const Op& op) {
  Nodes items;
  addElse(op, items);
  b_.at(op.span);
  return items.empty() ? kNoNode : b_.block(items);
}

std::string Lowering::text(const Op& op, size_t i) const {
  return i < op.arguments.size() ? op.arguments[i].text : std::string();
}

Span Lowering::spanOf(const Op& op, size_t i) const {
  return i < op.arguments.size() && op.arguments[i].span.valid() ? op.arguments[i].span : op.span;
}

NodeId Lowering::expressionOf(std::string_view text, Span span) {
  return expression(g_, rule_->parameters, text, placeOf(source_, span, text), b_, diagnostics_);
}

NodeId Lowering::conditionOf(std::string_view text, Span span) {
  const size_t before = diagnostics_.errorCount();
  const NodeId read = expressionOf(text, span);
  return diagnostics_.errorCount() == before ? read : b_.boolean(true);
}

bool Lowering::known(std::string_view text, double& value) const {
  for (const std::string& p : rule_->parameters) {
    if (withWords(text, {{p, ""}}) != text) return false;
  }
  return constantValue(g_, text, value);
}

bool Lowering::isParameter(const std::string& word) const {
  const auto& all = rule_->parameters;
  return std::find(all.begin(), all.end(), word) != all.end();
}

std::string Lowering::number(std::string_view written, Span span) {
  const auto isPartOfName = [](char c) {
    return c == '_' || c == '.' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  std::string out;
  for (size_t at = 0; at < written.size();) {
    size_t end = at;
    while (end < written.size() && isPartOfName(written[end])) ++end;
    if (end == at) {
      out += written[at++];
      continue;
    }
    const std::string word(written.substr(at, end - at));
    at = end;
    const size_t next = written.find_first_not_of(" \t", end);
    const bool called = next != written.npos && written[next] == '(';
    const char* attribute = attributeOf(word);
    const bool own = isParameter(word) || g_.constants.count(word) != 0;
    const bool digit = word[0] == '.' || (word[0] >= '0' && word[0] <= '9');
    // A word of sector; dotted names and functions are those of the language.
    const bool known =
        own || attribute || called || digit || word == "whole" || word.find('.') != word.npos;
    if (!known) {
      diagnostics_.error("bad-expression", placeOf(source_, span, word),
                         "'" + word + "' is no constant and nothing that a region knows",
                         kExpressionHint);
    }
    out += attribute && !own ? std::string(attribute) : word;
  }
  return out;
}

NodeId Lowering::node(const std::string& expression, std::string_view written, Span span) {
  const Span before = b_.span();
  const NodeId made = lang::graft(b_.tree(), expression, span, [&](std::string_view word) {
    return placeOf(source_, span, word);
  });
  b_.at(before);
  if (made != kNoNode) return made;
  unreadable(written, span);
  return b_.number(0);
}

void Lowering::unreadable(std::string_view written, Span span) {
  diagnostics_.error("bad-argument", span, "'" + std::string(written) + "' cannot be read",
                     "docs/guide/park.md has a table of the notation");
}

NodeId Lowering::formed(Form form, std::string_view written, Span span) {
  lang::RegionTexts texts([&](std::string_view n) { return number(n, span); });
  const std::string made = (texts.*form)(written);
  if (!made.empty()) return node(made, written, span);
  const std::string nearest = nearestName(texts.word(), lang::RegionTexts::words());
  std::string hint = meaning(nearest);
  if (hint.empty() && form == &lang::RegionTexts::places) {
    hint =
        "write CENTRE, CENTROID, Corners, CORNER(0), CORNER(OUTER), (0.8, 0.1) or Points((3, 4))";
  } else if (hint.empty() && form == &lang::RegionTexts::smoothing) {
    hint = "write none, average(2), chaikin(2), bezier or round(1)";
  } else if (hint.empty()) {
    hint = "docs/guide/park.md lists the selections";
  }
  const Span word = placeOf(source_, span, texts.word());
  diagnostics_.error("bad-selection", word,
                     "'" + std::string(written) + "' cannot be read: " + texts.problem(), hint);
  propose(diagnostics_, word, texts.word(), nearest);
  return b_.number(0);
}

NodeId Lowering::numberOf(std::string t, Span span) {
  if (const size_t name = t.find('='); name != std::string::npos && t.find("==") == t.npos) {
    t = t.substr(name + 1);
  }
  while (!t.empty() && t.front() == ' ') t.erase(0, 1);
  while (!t.empty() && t.back() == ' ') t.pop_back();
  double v = 0;
  if (isParameter(t)) return b_.word(t);
  if (!t.empty() && (t.front() == '\'' || t.back() == '%')) {
    const bool percent = t.back() == '%';
    const std::string bare = percent ? t.substr(0, t.size() - 1) : t.substr(1);
    if (known(bare, v)) return b_.relative(percent ? v / 100 : v);
  }
  if (parseNumber(t, v)) return b_.number(v);
  return expressionOf(t, span);
}

NodeId Lowering::number(const Op& op, size_t i, double otherwise) {
  if (i >= op.arguments.size()) return b_.number(otherwise);
  return numberOf(op.arguments[i].text, spanOf(op, i));
}

NodeId Lowering::pathWidth() {
  const auto found = g_.constants.find("PathWidth");
  if (found == g_.constants.end()) return b_.number(kPathWidth);
  return isParameter("PathWidth") ? b_.number(found->second) : b_.word("PathWidth");
}

lang::Tree lower(const Grammar& grammar, const LowerInput& input, Diagnostics& diagnostics) {
  return Lowering(grammar, input, diagnostics).run();
}

}  // namespace gable::park
