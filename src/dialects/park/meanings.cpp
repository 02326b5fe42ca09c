// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "dialects/park/meanings.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "base/number.h"
#include "base/text.h"

namespace gable::park {

namespace {

// Rules that name each other in a ring are followed so far.
constexpr int kDeepest = 20;

Lines linesOf(const Grammar& g, const Op& op, int depth);

Lines linesOf(const Grammar& g, const std::string& argument, int depth) {
  Lines l;
  l.ranges = argument;
  std::string name = argument.substr(0, argument.find('('));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  const Rule* r = g.rule(name);
  const Op* op = r ? onlyOp(*r) : nullptr;
  if (depth > kDeepest) return l;
  if (!r && lowerCase(name) == "parametrise") {
    Op here;
    here.name = name;
    for (const std::string& a : argumentTexts(argument)) here.arguments.push_back({a, {}});
    return linesOf(g, here, depth + 1);
  }
  if (!op) return l;
  // The function's arguments in the place of its parameters.
  std::map<std::string, std::string> words;
  const std::vector<std::string> given = argumentTexts(argument);
  for (size_t i = 0; i < r->parameters.size() && i < given.size(); ++i) {
    words[r->parameters[i]] = given[i];
  }
  Lines inner = linesOf(g, withArguments({*op}, words)[0], depth + 1);
  const bool called = name.size() < argument.size() && argument.find('(') != std::string::npos;
  if (called && given.size() != r->parameters.size()) {
    inner.mistake = countMistake(*r, given.size());
  }
  return inner;
}

// Ranges at the head of an argument, "[0.1, 0.9] _ 0", are an entry for each logical edge; what
// follows them is a selection.
void addLines(const std::string& argument, std::string& ranges, std::string& selections) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  size_t at = 0;
  const std::string before = ranges;
  while (at < argument.size()) {
    while (at < argument.size() && blank(argument[at])) ++at;
    size_t end = at;
    const char c = at < argument.size() ? argument[at] : '\0';
    if (c == '[' || c == '{') {
      for (int depth = 0; end < argument.size(); ++end) {
        const char d = argument[end];
        depth += d == '[' || d == '{' ? 1 : d == ']' || d == '}' ? -1 : 0;
        if (depth == 0) break;
      }
      end = std::min(end + 1, argument.size());
    } else if (c == '_' || c == '0') {
      end = at + 1;
    }
    const bool whole = end >= argument.size() || blank(argument[end]) || argument[end] == '[' ||
                       argument[end] == '{';
    if (end == at || !whole) break;
    ranges += (ranges.empty() ? "" : " ") + argument.substr(at, end - at);
    at = end;
  }
  if (at < argument.size() && at > 0 &&
      std::string_view("|&-").find(argument[at]) != std::string_view::npos) {
    // A range that a selection begins with.
    ranges = before;
    at = 0;
  }
  if (at < argument.size()) selections += (selections.empty() ? "" : "; ") + argument.substr(at);
}

Lines linesOf(const Grammar& g, const Op& op, int depth) {
  Lines l;
  std::string selections;
  // One function may stand for another.
  if (g.rule(op.name) && op.called && depth <= kDeepest) {
    std::string call = op.name + '(';
    for (const Argument& a : op.arguments) call += (call.back() == '(' ? "" : ", ") + a.text;
    return linesOf(g, call + ')', depth + 1);
  }
  for (const Argument& a : op.arguments) {
    const std::string word = lowerCase(a.text.substr(0, a.text.find('(')));
    if (isFigure(word) && a.text.back() == ')') {
      l.figure = a.text;
    } else if (lowerCase(a.text) != "perimeter") {
      addLines(a.text, l.ranges, selections);
    }
  }
  l.ranges += (l.ranges.empty() || selections.empty() ? "" : "; ") + selections;
  for (const Part& p : partsOf(op)) {
    for (const Op& inner : p.body) {
      if (lowerCase(inner.name) == "contract" && !inner.arguments.empty()) {
        l.inset = inner.arguments[0].text;
      }
    }
  }
  return l;
}

}  // namespace

bool isFigure(std::string_view op) {
  return op == "romb" || op == "rombcenter" || op == "circle" || op == "square" || op == "rect" ||
         op == "polygon";
}

bool isMaterialWord(std::string_view name) {
  return name.size() > 1 &&
         std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

namespace {

struct ColourHint {
  const char* part;
  const char* colour;
};

constexpr ColourHint kHints[] = {
    {"gravel", "#cfc0a0"}, {"kerb", "#a9a296"},   {"lawn", "#79a052"},   {"rose", "#c8476a"},
    {"gold", "#d8b13c"},   {"soil", "#6a5a45"},   {"sand", "#d8c7a4"},   {"wood", "#7c5a3a"},
    {"blue", "#5f8f8f"},   {"tree", "#3f7a34"},   {"bush", "#4a7f3a"},   {"hedge", "#3f7034"},
    {"plant1", "#c86a8a"}, {"plant2", "#c9a24a"}, {"plant", "#8f7ab8"},  {"flower", "#c86a8a"},
    {"cement", "#b5b5b0"}, {"stone", "#a89f92"},  {"path", "#cbbfa6"},   {"fountain", "#8fa8b8"},
    {"water", "#6f9fc0"},  {"centre", "#b8b0a4"}, {"center", "#b8b0a4"}, {"grass", "#6fa854"},
    {"green", "#5f9f4a"},  {"region", "#7fb25f"}, {"park", "#7fb25f"},   {"smooth", "#7fb25f"}};

// Colours stand as words of their own: RED, not Scattered.
constexpr ColourHint kColours[] = {
    {"red", "#b8433f"},    {"yellow", "#e0c045"}, {"white", "#f2f0ea"}, {"pink", "#e08fa8"},
    {"orange", "#d98a3c"}, {"black", "#2f2f2f"},  {"brown", "#7a5a3c"}, {"purple", "#8a5a9a"},
    {"grey", "#8f8f8a"},   {"gray", "#8f8f8a"}};

}  // namespace

const char* knownColourOf(std::string_view name) {
  const std::string low = lowerCase(name);
  for (const ColourHint& h : kHints) {
    if (low.find(h.part) != std::string::npos) return h.colour;
  }
  for (const ColourHint& h : kColours) {
    const std::string_view word = h.part;
    const size_t at = low.find(word);
    if (at == std::string::npos) continue;
    const size_t end = at + word.size();
    const bool begins = at == 0 || low[at - 1] == '_';
    if (begins && (end == low.size() || low[end] == '_')) return h.colour;
  }
  return nullptr;
}

const char* colourOf(std::string_view name) {
  const char* const known = knownColourOf(name);
  return known ? known : "#9a9a92";
}

std::vector<std::string_view> colourWords() {
  std::vector<std::string_view> words;
  for (const ColourHint& h : kHints) words.push_back(h.part);
  for (const ColourHint& h : kColours) words.push_back(h.part);
  return words;
}

std::string nearestColour(std::string_view name) {
  std::string nearest = nearestName(lowerCase(name), colourWords());
  for (char& c : nearest) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return nearest;
}

const Op* onlyOp(const Rule& r) {
  if (r.branches.size() != 1 || r.branches[0].body.size() != 1) return nullptr;
  return &r.branches[0].body[0];
}

const Op* onlyOp(const Grammar& g, std::string_view rule) {
  const Rule* r = g.rule(rule);
  return r ? onlyOp(*r) : nullptr;
}

bool isPointSetName(std::string_view name) {
  const std::string low = lowerCase(name);
  return low == "corner" || low == "corners" || low == "entrances" || low == "directions" ||
         low == "points";
}

bool isPointSet(const Rule& r) {
  const Op* op = onlyOp(r);
  if (!op || !op->blocks.empty() || !op->called) return false;
  const std::string name = lowerCase(op->name);
  return name == "scattercircles" || name == "scatter" ||
         (name != "corner" && isPointSetName(name));
}

FigureHead figureHead(const Grammar& g, const Sequence& s) {
  FigureHead out;
  const Sequence* at = &s;
  for (int depth = 0; depth < kDeepest && !at->empty(); ++depth) {
    const Op& first = at->front();
    if (isFigure(lowerCase(first.name)) && first.called) {
      out.figure = &first;
      out.body = at;
      return out;
    }
    const Rule* r = first.called || !first.blocks.empty() ? nullptr : g.rule(first.name);
    if (at->size() != 1 || !r || r->function || r->branches.size() != 1) break;
    out.rule = r;
    at = &r->branches[0].body;
  }
  return {};
}

namespace {

// Rules are looked at once: one that leads to itself says nothing more the second time.
Ending endingOf(const Grammar& g, const Sequence& s, std::set<const Rule*>& seen) {
  static constexpr std::string_view kGiveAway[] = {"grid",      "voronoiregions", "voronoismoothed",
                                                   "ffregions", "cells",          "castrays",
                                                   "raycast",   "beam",           "rays",
                                                   "peel",      "innerrect",      "quadmap"};
  const auto any = [&](const std::vector<Part>& parts, const Sequence* otherwise) {
    Ending best = Ending::Nothing;
    for (const Part& p : parts) best = std::max(best, endingOf(g, p.body, seen));
    if (otherwise) best = std::max(best, endingOf(g, *otherwise, seen));
    return best;
  };
  for (const Op& op : s) {
    const std::string name = lowerCase(op.name);
    if (name == "loadmodel") return Ending::Nothing;
    if (name == "extrude") return Ending::Raised;
    if (name == "choose" || name == "select") {
      return any(partsOf(op), op.hasElse ? &op.otherwise : nullptr);
    }
    if (std::find(std::begin(kGiveAway), std::end(kGiveAway), name) != std::end(kGiveAway)) {
      return Ending::Flat;
    }
    const Rule* r = g.rule(op.name);
    if (!r) {
      if (op.called || !op.blocks.empty() || isMaterialWord(op.name)) continue;
      return Ending::Flat;
    }
    if (!seen.insert(r).second) return Ending::Nothing;
    Ending best = Ending::Nothing;
    for (const Branch& b : r->branches) best = std::max(best, endingOf(g, b.body, seen));
    if (!r->function) return best;
  }
  return Ending::Flat;
}

}  // namespace

Ending endingOf(const Grammar& g, const Sequence& s) {
  std::set<const Rule*> seen;
  return endingOf(g, s, seen);
}

const Op* joinedOp(const Grammar& g, const Part* part) {
  if (!part || part->body.size() != 1) return nullptr;
  const Op* op = &part->body[0];
  if (!op->called && op->blocks.empty()) op = onlyOp(g, op->name);
  return op && lowerCase(op->name) == "joined" ? op : nullptr;
}

Joined joinedParts(const Grammar& g, const Op& op) {
  Joined out;
  for (const Part& p : partsOf(op)) {
    for (const Op& inner : p.body) {
      const Sequence alone{inner};
      const FigureHead head = figureHead(g, alone);
      if (head.figure) {
        out.figures.push_back(*head.figure);
      } else {
        out.rest.push_back(inner);
      }
    }
  }
  return out;
}

std::string countMistake(const Rule& function, size_t given) {
  const size_t wanted = function.parameters.size();
  return (function.function ? "the function '" : "'") + function.name + "' takes " +
         std::to_string(wanted) + (wanted == 1 ? " argument, not " : " arguments, not ") +
         std::to_string(given);
}

std::string discs(const Grammar& g, const std::string& argument) {
  if (const Op* op = onlyOp(g, argument)) {
    if (op->arguments.empty()) return "1";
    std::string all = op->arguments[0].text;
    const bool places = lowerCase(op->name) == "points";
    for (size_t i = 1; places && i < op->arguments.size(); ++i) {
      all += ' ' + op->arguments[i].text;
    }
    return all;
  }
  const size_t bracket = argument.find('(');
  if (bracket != std::string::npos && argument.back() == ')') {
    return argument.substr(bracket + 1, argument.size() - bracket - 2);
  }
  return argument;
}

Lines linesOf(const Grammar& g, const std::string& argument) { return linesOf(g, argument, 0); }
Lines linesOf(const Grammar& g, const Op& op) { return linesOf(g, op, 0); }

std::vector<Part> partsOf(const Op& op) {
  std::vector<Part> out;
  for (const Block& b : op.blocks) out.insert(out.end(), b.parts.begin(), b.parts.end());
  return out;
}

std::vector<double> sharesOf(const Grammar& g, const std::vector<Part>& parts) {
  std::vector<double> out;
  double given = 0, open = 0;
  for (const Part& p : parts) {
    std::string label = p.label;
    if (!label.empty() && label.back() == '%') label.pop_back();
    double w = -1;
    if (!constantValue(g, label, w)) w = -1;
    out.push_back(w);
    given += std::max(0.0, w);
    open += w < 0;
  }
  const double each = open > 0 ? std::max(0.0, 100 - given) / open : 0;
  for (double& w : out) w = w < 0 ? each : w * (given > 100 ? 100 / given : 1);
  return out;
}

JunctionChoices junctionChoices(const Grammar& g, const Part& part) {
  JunctionChoices out;
  const Op* op = part.body.size() == 1 ? &part.body[0] : nullptr;
  const Rule* r = op && !op->called && op->blocks.empty() ? g.rule(op->name) : nullptr;
  out.rule = r;
  if (r && r->branches.size() == 1 && r->branches[0].body.size() == 1) op = onlyOp(*r);
  if (op && lowerCase(op->name) == "choose") {
    out.parts = partsOf(*op);
    out.shares = sharesOf(g, out.parts);
  } else if (r && r->branches.size() > 1) {
    for (const Branch& b : r->branches) {
      out.conditions.push_back(b.condition);
      out.parts.push_back({"", b.body, b.span});
    }
  }
  return out;
}

}  // namespace gable::park
