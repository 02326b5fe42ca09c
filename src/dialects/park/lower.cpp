// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names mean three things: a rule of the grammar; a set of points or lines that an argument names
// (a rule of one ScatterCircles, Corners or Parametrise); else a leaf, drawn in a colour that its
// name suggests. Operations that put things into a region leave the region itself to the end of
// the rule, where it becomes the leaf.
#include "dialects/park/lower.h"

#include <algorithm>

#include "base/number.h"
#include "dialects/park/expression.h"
#include "dialects/park/lowering.h"

namespace gable::park {

lang::Tree Lowering::run(uint32_t size) {
  Nodes rules;
  bool first = true;
  for (const Rule& r : g_.rules) {
    if (r.function || isPointSet(r)) continue;
    rules.push_back(rule(r, first));
    first = false;
  }
  if (models_) rules.insert(rules.begin(), modelFile());
  return b_.finish(rules, size);
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
    const NodeId condition = br.condition.empty() ? kNoNode : expressionOf(br.condition, br.span);
    branches.emplace_back(condition, steps);
  }
  b_.at(r.nameSpan);
  if (!branches.empty()) {
    if (branches.back().first != kNoNode) {
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
  bool open = true;
  for (const Op& op : ops) open = step(op, steps);
  if (open && !owner.empty()) {
    if (!coloured(ops)) steps.push_back(colour(owner));
    steps.push_back(b_.leaf(owner));
  }
  return b_.sequence(steps);
}

bool Lowering::coloured(const Sequence& ops) {
  return std::any_of(ops.begin(), ops.end(), [](const Op& op) {
    return !op.called && op.blocks.empty() && isMaterialWord(op.name);
  });
}

bool Lowering::step(const Op& op, Nodes& out) {
  b_.at(op.span);
  const std::string name = lowered(op.name);
  if (!op.called && op.blocks.empty()) return symbol(op, out);
  if (name == "grid") return grid(op, out), false;
  if (name == "voronoiregions" || name == "voronoismoothed" || name == "ffregions" ||
      name == "cells") {
    return voronoi(op, out), false;
  }
  if (name == "castrays" || name == "raycast" || name == "beam" || name == "rays") {
    return rays(op, out), false;
  }
  if (name == "peel") return peel(op, out), false;
  if (name == "choose") return choose(op, out), false;
  if (name == "joined") return joined(op, out), false;
  if (name == "loadmodel") return model(op, out), false;
  if (name == "innerrect") return innerRect(op, out), false;
  if (name == "select") return select(op, out), false;
  if (name == "quadmap") return quadMap(op, out), false;
  if (name == "contract") return contract(op, out), true;
  if (name == "insert") return insert(op, out), true;
  if (name == "noholes") return out.push_back(b_.applyBare("cutHoles")), true;
  if (name == "extrude") return out.push_back(b_.apply("extrude", {number(op, 0, 1)})), true;
  if (isFigure(name)) return figure(op, out), true;
  if (name == "place") return place(op, out), true;
  if (name == "distribute") return distribute(op, out), true;
  if (name == "scatter" || name == "scattercircles") return scatter(op, out), true;
  if (name == "sweep" || name == "distributesmooth" || name == "smoothdistribute") {
    return sweep(op, out), true;
  }
  if (name == "parametrise") return lines(op, out), true;
  if (const Rule* r = g_.rule(op.name)) {
    if (r->function) return inlined(*r, op, out);
    call(*r, op, out);
    return false;
  }
  if (op.blocks.empty()) {
    // ParkPath(..): a name with arguments that nothing is made of.
    out.push_back(colour(op.name));
    out.push_back(b_.leaf(op.name));
    return false;
  }
  diagnostics_.error("unknown-operation", op.span, "there is no operation '" + op.name + "'",
                     "see the notation's table of operations");
  return true;
}

bool Lowering::symbol(const Op& op, Nodes& out) {
  const Rule* r = g_.rule(op.name);
  if (r && r->function) return inlined(*r, op, out);
  if (r) {
    call(*r, op, out);
    return false;
  }
  if (lowered(op.name) == "grid") return grid(op, out), false;
  if (lowered(op.name) == "noholes") return out.push_back(b_.applyBare("cutHoles")), true;
  if (isMaterialWord(op.name)) {
    out.push_back(colour(op.name));
    return true;
  }
  out.push_back(colour(op.name));
  out.push_back(b_.leaf(op.name));
  return false;
}

void Lowering::call(const Rule& r, const Op& op, Nodes& out) {
  if (r.parameters.size() != op.arguments.size()) {
    diagnostics_.error("wrong-argument-count", op.span,
                       "'" + op.name + "' takes " + std::to_string(r.parameters.size()) +
                           " arguments, not " + std::to_string(op.arguments.size()),
                       "give a value for each of its parameters");
    return;
  }
  Nodes arguments;
  for (size_t i = 0; i < op.arguments.size(); ++i) arguments.push_back(number(op, i, 0));
  out.push_back(b_.apply(op.name, arguments));
}

bool Lowering::inlined(const Rule& r, const Op& op, Nodes& out) {
  constexpr int kDeepest = 20;
  if (functions_ >= kDeepest || r.branches.size() != 1) {
    diagnostics_.error("nesting-too-deep", op.span,
                       "the function '" + op.name + "' calls itself, or has cases",
                       "make it a rule: leave out 'fun'");
    return true;
  }
  std::map<std::string, std::string> words;
  for (size_t i = 0; i < r.parameters.size() && i < op.arguments.size(); ++i) {
    words[r.parameters[i]] = op.arguments[i].text;
  }
  ++functions_;
  bool open = true;
  for (const Op& inner : withArguments(r.branches[0].body, words)) open = step(inner, out);
  --functions_;
  b_.at(op.span);
  return open;
}

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
      const std::string label = lowered(p.label);
      size_t place = names.size();
      for (size_t i = 0; i < names.size(); ++i) {
        if (std::find(names[i].begin(), names[i].end(), label) != names[i].end()) place = i;
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

void Lowering::noElse(const Op& op) {
  if (!op.hasElse) return;
  diagnostics_.error("unexpected-text", op.span, "'" + op.name + "' has no use for else",
                     "leave it out: the operation cannot fail");
}

void Lowering::checkWords(const Op& op, size_t first,
                          std::initializer_list<std::string_view> words) {
  for (size_t i = first; i < op.arguments.size(); ++i) {
    std::string a = lowered(op.arguments[i].text);
    const size_t equals = a.find('=');
    if (equals != std::string::npos) a = a.substr(0, a.find_last_not_of(' ', equals - 1) + 1) + '=';
    if (std::find(words.begin(), words.end(), a) != words.end()) continue;
    std::string hint;
    for (const std::string_view w : words) hint += (hint.empty() ? "" : ", ") + std::string(w);
    diagnostics_.error("bad-argument", op.arguments[i].span,
                       "'" + op.arguments[i].text + "' is nothing that '" + op.name + "' knows",
                       "it knows " + hint);
  }
}

std::string Lowering::text(const Op& op, size_t i) const {
  return i < op.arguments.size() ? constants(op.arguments[i].text) : std::string();
}

std::string Lowering::constants(const std::string& text) const {
  if (rule_->parameters.empty()) return withConstants(g_, text);
  Grammar rest;
  rest.constants = g_.constants;
  for (const std::string& p : rule_->parameters) rest.constants.erase(p);
  return withConstants(rest, text);
}

NodeId Lowering::expressionOf(std::string_view text, Span span) {
  return expression(g_, rule_->parameters, text, span, b_, diagnostics_);
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

NodeId Lowering::textNode(const std::string& text) {
  NodeId sum = kNoNode;
  std::string plain;
  const auto add = [&](NodeId next) {
    sum = sum == kNoNode ? next : b_.binary(lang::BinaryOp::Add, sum, next);
  };
  for (size_t i = 0; i < text.size();) {
    const auto letter = [&](size_t k) {
      return std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_';
    };
    size_t end = i;
    while (end < text.size() && letter(end)) ++end;
    const std::string word = text.substr(i, end - i);
    if (end > i && isParameter(word)) {
      if (sum == kNoNode || !plain.empty()) add(b_.text(plain));
      plain.clear();
      add(b_.word(word));
    } else {
      plain += end > i ? word : text.substr(i, 1);
    }
    i = std::max(end, i + 1);
  }
  if (sum == kNoNode) return b_.text(plain);
  if (!plain.empty()) add(b_.text(plain));
  return sum;
}

NodeId Lowering::number(const Op& op, size_t i, double otherwise) {
  if (i >= op.arguments.size()) return b_.number(otherwise);
  std::string t = op.arguments[i].text;
  if (const size_t name = t.find('='); name != std::string::npos && t.find("==") == t.npos) {
    t = t.substr(name + 1);
  }
  double v = 0;
  if (isParameter(t)) return b_.word(t);
  if (!t.empty() && (t.front() == '\'' || t.back() == '%')) {
    const bool percent = t.back() == '%';
    const std::string bare = percent ? t.substr(0, t.size() - 1) : t.substr(1);
    if (known(bare, v)) return b_.relative(percent ? v / 100 : v);
  }
  if (known(t, v)) return b_.number(v);
  return expressionOf(t, op.arguments[i].span);
}

lang::Tree lower(const Grammar& grammar, uint32_t file, uint32_t size, Diagnostics& diagnostics) {
  return Lowering(grammar, file, diagnostics).run(size);
}

}  // namespace gable::park
