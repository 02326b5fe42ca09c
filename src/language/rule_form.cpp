// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/rule_form.h"

#include <algorithm>
#include <set>

#include "language/service.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;

namespace {

/// A rule in the text, whatever its notation.
struct Head {
  std::string name;
  std::vector<std::string> parameters;
  uint32_t begin = 0, nameBegin = 0, nameEnd = 0, end = 0;
  NodeId node = kNoNode;
};

std::vector<Head> headsOf(const Parsed& parsed) {
  std::vector<Head> out;
  const std::string& text = parsed.text.content();
  if (parsed.dialect && std::string_view(parsed.dialect->name) == "gbbg") {
    for (BoxHead& b : boxHeads(text)) {
      out.push_back({std::move(b.name), {}, b.begin, b.nameBegin, b.nameEnd, b.end, kNoNode});
    }
    return out;
  }
  const lang::Tree& t = parsed.tree;
  for (const Declared& d : declaredIn(t)) {
    if (d.kind != NameKind::Rule) continue;
    Head h;
    h.name = d.word;
    h.nameBegin = t[d.node].begin;
    // What a parser has made up is not written.
    if (text.compare(std::min<size_t>(h.nameBegin, text.size()), d.word.size(), d.word) != 0) {
      continue;
    }
    h.begin = h.nameBegin;
    h.nameEnd = h.nameBegin + static_cast<uint32_t>(d.word.size());
    h.end = std::min<uint32_t>(t[d.node].end, static_cast<uint32_t>(text.size()));
    h.node = d.node;
    for (const NodeId p : t.children(paramsOf(t, d.node))) h.parameters.emplace_back(t.text(p));
    out.push_back(std::move(h));
  }
  return out;
}

// What stands first behind the arrow.
std::string typeOf(std::string_view rule) {
  const std::vector<Word> words = wordsOf(rule);
  bool body = false;
  for (size_t i = 0; i < words.size(); ++i) {
    const Word& w = words[i];
    const std::string_view word = rule.substr(w.begin, w.end - w.begin);
    if (w.kind == WordKind::Comment) continue;
    if (!body) {
      body = word == ">" && i > 0 && rule[words[i - 1].begin] == '-';
      continue;
    }
    const bool share = i + 1 < words.size() && rule[words[i + 1].begin] == '%';
    if (w.kind == WordKind::Number && share) return "chance";
    if (w.kind == WordKind::Name) return std::string(word);
    return {};
  }
  return {};
}

// The annotations and the comments right above a rule.
uint32_t leadOf(const Parsed& parsed, const Head& h, const std::vector<Word>& comments) {
  const std::string& text = parsed.text.content();
  uint32_t lead = h.begin;
  if (h.node != kNoNode) {
    const NodeId notes = lang::annotationsOf(parsed.tree, h.node);
    if (notes != kNoNode) lead = std::min(lead, parsed.tree[notes].begin);
    // Words before the name: inline, recursive, and what else a notation has.
    const uint32_t line = parsed.text.lineStart(parsed.text.lineOf(lead));
    if (text.find_first_of("{}|", line) >= lead) lead = line;
  }
  for (auto c = comments.rbegin(); c != comments.rend(); ++c) {
    if (c->end > lead) continue;
    const std::string_view gap = std::string_view(text).substr(c->end, lead - c->end);
    const uint32_t line = parsed.text.lineStart(parsed.text.lineOf(c->begin));
    const bool alone = text.find_first_not_of(" \t", line) == c->begin;
    const bool near = gap.find_first_not_of(" \t\r\n") == std::string_view::npos &&
                      std::count(gap.begin(), gap.end(), '\n') <= 1;
    if (!alone || !near) break;
    lead = line;
  }
  return lead;
}

// The rule with what is above it, a comment behind it and the lines that it leaves empty.
Range ruleRemoval(const Parsed& parsed, const Head& h) {
  const std::string& text = parsed.text.content();
  std::vector<Word> comments;
  for (const Word& w : wordsOf(text)) {
    if (w.kind == WordKind::Comment) comments.push_back(w);
  }
  const uint32_t lead = leadOf(parsed, h, comments);
  size_t end = std::min(text.find_first_not_of(" \t", h.end), text.size());
  for (const Word& c : comments) {
    if (c.begin == end) end = c.end;
  }
  if (end < text.size() && text[end] != '\n' && text[end] != '\r') {
    return parsed.text.range(lead, h.end);
  }
  while (end < text.size() && (text[end] == '\n' || text[end] == '\r')) ++end;
  return parsed.text.range(lead, static_cast<uint32_t>(end));
}

Range parametersOf(const Parsed& parsed, const Head& h) {
  const std::string& text = parsed.text.content();
  size_t at = text.find_first_not_of(" \t", h.nameEnd);
  if (at == std::string::npos || text[at] != '(') return parsed.text.range(h.nameEnd, h.nameEnd);
  const size_t close = text.find(')', at);
  if (close == std::string::npos || close > h.end) return parsed.text.range(h.nameEnd, h.nameEnd);
  return parsed.text.range(h.nameEnd, static_cast<uint32_t>(close + 1));
}

RuleForm ruleForm(const Parsed& parsed, const Head& h) {
  RuleForm out;
  out.name = h.name;
  out.range = parsed.text.range(h.begin, h.end);
  out.nameRange = parsed.text.range(h.nameBegin, h.nameEnd);
  out.parametersRange = parametersOf(parsed, h);
  out.removal = ruleRemoval(parsed, h);
  if (!parsed.dialect && lang::bodyOf(parsed.tree, h.node) != kNoNode) {
    out.body = piecesOf(parsed, h.node);
  }
  return out;
}

// A rule more stands behind an empty line.
Insertion behind(const Parsed& parsed, uint32_t at) {
  const std::string& text = parsed.text.content();
  size_t breaks = 0;
  while (breaks < at && breaks < 2 && text[at - 1 - breaks] == '\n') ++breaks;
  const bool last = at == text.size();
  const std::string gap = at == 0 ? "" : std::string(2 - breaks, '\n');
  return {parsed.text.position(at), gap, last ? "\n" : ""};
}

}  // namespace

TextForm formOf(const Parsed& parsed, const std::string& rule) {
  TextForm out;
  const std::string& text = parsed.text.content();
  const std::vector<Head> heads = headsOf(parsed);
  const Head* shown = heads.empty() ? nullptr : &heads[0];
  std::set<std::string> taken, symbols{"NIL"};
  for (const Head& h : heads) {
    const std::string_view source = std::string_view(text).substr(h.begin, h.end - h.begin);
    out.rules.push_back({h.name, h.parameters, typeOf(source), parsed.text.range(h.begin, h.end)});
    symbols.insert(h.name);
    if (h.name == rule && shown->name != rule) shown = &h;
  }
  for (const Declared& d : declaredIn(parsed.tree)) taken.insert(std::string(d.word));
  taken.insert(symbols.begin(), symbols.end());
  out.symbols.assign(symbols.begin(), symbols.end());
  out.newRule = behind(parsed, shown ? shown->end : static_cast<uint32_t>(text.size()));
  if (shown) out.rule = ruleForm(parsed, *shown);
  if (parsed.dialect && std::string_view(parsed.dialect->name) == "gbbg") {
    addGrammar(parsed.text, out);
    taken.insert(out.symbols.begin(), out.symbols.end());
    for (const BoxHead& b : boxHeads(text)) {
      if (shown && b.begin == shown->begin) addBoxRule(parsed.text, b, *out.rule);
    }
  }
  out.taken.assign(taken.begin(), taken.end());
  return out;
}

}  // namespace gable::language
