// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations of the notation that put things into a region: at places, along edges, scattered,
// swept. Flat things are cut out of their ground.
#include "base/number.h"
#include "base/text.h"
#include "dialects/park/lowering.h"
#include "dialects/park/places.h"

namespace gable::park {

namespace {

using lang::RegionTexts;

// Of what is swept without saying how wide: a box hedge.
constexpr double kHedgeWidth = 0.6, kHedgeHeight = 1;

}  // namespace

void Lowering::insert(const Op& op, Nodes& out) {
  const std::vector<Part> parts = partsOf(op);
  const bool nothing = parts.empty() || parts[0].body.empty();
  Op disc;
  disc.name = "circle";
  disc.span = op.span;
  disc.arguments.assign(1, {op.arguments.empty() ? "1" : text(op, 0), spanOf(op, 0)});
  Nodes steps{figureNode(disc)};
  steps.push_back(nothing ? b_.apply("NIL") : sequence(parts[0].body, "Thing"));
  b_.at(op.span);
  Nodes items{b_.item(kNoNode, b_.sequence(flattened(steps)))};
  addElse(op, items);
  b_.at(op.span);
  const NodeId where = b_.call("corner", {b_.word("outer")});
  out.push_back(b_.apply("place", {where}, b_.block(items)));
}

void Lowering::figure(const Op& op, Nodes& out) {
  const NodeId plain = figureNode(op);
  if (!op.hasElse) {
    out.push_back(plain);
    return;
  }
  // The same with a block.
  const auto list = b_.tree().child(plain, 0);
  const Nodes arguments(b_.tree().children(list).begin(), b_.tree().children(list).end());
  const std::string name(b_.tree().text(plain));
  const NodeId block = elseBlock(op);
  out.push_back(b_.apply(name, arguments, block));
}

NodeId Lowering::things(const Op& op) {
  NodeId body = kNoNode;
  for (const Block& b : op.blocks) {
    for (const Part& p : b.parts) body = figureBody(p.body, "Thing", false);
  }
  b_.at(op.span);
  Nodes items{b_.item(kNoNode, body != kNoNode ? body : b_.sequence({}))};
  addElse(op, items);
  b_.at(op.span);
  return b_.block(items);
}

bool Lowering::endsFlat(const Op& op) const {
  for (const Part& p : partsOf(op)) {
    if (p.body.empty() || endingOf(g_, p.body) != Ending::Flat) return false;
  }
  return !op.blocks.empty();
}

void Lowering::place(const Op& op, Nodes& out) {
  std::string where = op.arguments.empty() ? "centre" : text(op, 0);
  if (where.find(':') != std::string::npos && where.find('(') != 0) return distribute(op, out);
  // Several places, with commas between or in brackets.
  size_t first = 1;
  for (; first < op.arguments.size() && op.arguments[first].text[0] == '('; ++first) {
    where += ' ' + text(op, first);
  }
  if (where.size() > 2 && where.front() == '[' && where.back() == ']') {
    where = where.substr(1, where.size() - 2);
  }
  Nodes arguments{formed(&RegionTexts::places, where, spanOf(op, 0))};
  flags(op, first, {"cut", "over", "split", "align"}, arguments);
  const NodeId block = things(op);
  out.push_back(b_.apply("place", arguments, block));
}

// A spacing; [0.2, 0.8]; [3]; [start : 2.5 : end].
void Lowering::positions(const std::string& written, Span span, Nodes& arguments) {
  if (written.empty() || written.front() != '[') {
    arguments.push_back(written.empty() ? b_.number(1) : numberOf(written, span));
    return;
  }
  const std::string inside = written.substr(1, written.rfind(']') - 1);
  if (inside.find(',') != std::string::npos) {
    arguments.push_back(b_.argument("at", node("[" + number(inside, span) + "]", written, span)));
    return;
  }
  std::vector<std::string> parts(1);
  for (const char c : inside) {
    if (c == ':') {
      parts.emplace_back();
    } else if (c != ' ') {
      parts.back() += c;
    }
  }
  // [start : item], [start : item : end], [: item : end], [item].
  const bool bare = parts.size() == 1, start = !bare && lowerCase(parts[0]) == "start";
  const std::string item = bare ? parts[0] : parts[1];
  const auto isOnly = [&](size_t i, std::string_view word) {
    return bare || i >= parts.size() || parts[i].empty() || lowerCase(parts[i]) == word;
  };
  if (!isOnly(0, "start") || !isOnly(2, "end") || parts.size() > 3) {
    diagnostics_.error("bad-argument", span, "'" + written + "' is no way to stand along an edge",
                       "write [start : 3 : end], [start : 3], [: 3 : end] or [3]");
    return;
  }
  double v = 0;
  const bool fixed = known(item, v);
  if (bare && fixed && v < 1 && v > 0) {
    arguments.push_back(b_.argument("at", node("[" + number(item, span) + "]", written, span)));
    return;
  }
  const bool real = item.find('.') != std::string::npos || (fixed && v != static_cast<int>(v));
  arguments.push_back(b_.argument(real ? "interval" : "intervals", numberOf(item, span)));
  if (start) arguments.push_back(b_.argument("start", b_.boolean(true)));
  if (parts.size() > 2 && lowerCase(parts[2]) == "end") {
    arguments.push_back(b_.argument("end", b_.boolean(true)));
  }
}

void Lowering::distribute(const Op& op, Nodes& out) {
  std::string selection = op.arguments.empty() ? "all" : text(op, 0);
  std::string inset;
  if (const size_t colon = selection.find(':'); colon != std::string::npos) {
    inset = selection.substr(colon + 1);
    selection.resize(colon);
  }
  while (!selection.empty() && selection.back() == ' ') selection.pop_back();
  Nodes arguments{formed(&RegionTexts::selection, selection, spanOf(op, 0))};
  positions(text(op, 1), spanOf(op, 1), arguments);
  if (!inset.empty()) arguments.push_back(b_.argument("inset", numberOf(inset, spanOf(op, 0))));
  flags(op, 2, {"cut", "over", "split", "align", "chain"}, arguments);
  const NodeId block = things(op);
  out.push_back(b_.apply("distribute", arguments, block));
}

void Lowering::scatter(const Op& op, Nodes& out) {
  const std::string what = op.arguments.empty() ? "1 {1}" : text(op, 0);
  const Span span = spanOf(op, 0);
  std::string count = what, radius = "1";
  if (const size_t brace = what.find('{'); brace != std::string::npos) {
    count = what.substr(0, brace);
    const size_t close = what.find('}');
    radius = what.substr(brace + 1, close - brace - 1);
    if (close == what.npos || what.find_first_not_of(' ', close + 1) != what.npos) {
      unreadable(what, span);
    }
  }
  // Without a count as many as fit.
  const bool fill = count.find_first_not_of(' ') == std::string::npos;
  Nodes arguments{fill ? b_.number(0) : numberOf(count, span),
                  formed(&RegionTexts::drawn, radius, span)};
  Op spelt = op;
  for (Argument& a : spelt.arguments) {
    if (lowerCase(a.text).starts_with("min")) a.text = "gap" + a.text.substr(3);
  }
  bool over = false;
  std::erase_if(spelt.arguments, [&](const Argument& a) {
    const bool word = lowerCase(a.text) == "over" || lowerCase(a.text) == "cut";
    over = over || lowerCase(a.text) == "over";
    return word;
  });
  using Takes = Option::Takes;
  options(spelt, 1, {{"gap", "gap", Takes::Number}, {"edge", "edge", Takes::Number}}, arguments);
  if (!over && endsFlat(op)) arguments.push_back(b_.argument("cut", b_.boolean(true)));
  const NodeId block = things(op);
  out.push_back(b_.apply("scatterCircles", arguments, block));
}

std::string Lowering::valueOf(const std::string& text) {
  const size_t equals = text.find('=');
  const size_t begin = equals == text.npos ? text.npos : text.find_first_not_of(' ', equals + 1);
  return begin == text.npos ? std::string() : text.substr(begin);
}

// Lines around a figure leave the region as it is.
NodeId Lowering::onFigure(const std::string& figure, Span span, NodeId operation) {
  if (figure.empty()) return operation;
  Op shape;
  shape.name = figure.substr(0, figure.find('('));
  shape.span = span;
  for (const std::string& a : argumentTexts(figure)) shape.arguments.push_back({a, span});
  b_.at(span);
  const NodeId first = figureNode(shape);
  return b_.push(b_.sequence({first, operation, b_.apply("NIL")}));
}

void Lowering::sweep(const Op& op, Nodes& out) {
  const Lines l = linesOf(g_, op.arguments.empty() ? std::string("all") : op.arguments[0].text);
  if (!l.mistake.empty()) return wrongCount(l.mistake, spanOf(op, 0));
  checkWords(op, 1, {"width=", "height=", "profile=", "joins=", "ends=", "round", "over", "cut"});
  NodeId width = kNoNode, height = kNoNode, section = kNoNode;
  Nodes options;
  bool over = false, wide = true;
  for (size_t i = 1; i < op.arguments.size(); ++i) {
    const std::string a = lowerCase(op.arguments[i].text);
    const Span span = spanOf(op, i);
    over = over || a == "over";
    if (a.starts_with("width")) {
      width = number(op, i, 0);
      double v = 0;
      wide = !known(valueOf(a), v) || v > 0;
    }
    if (a.starts_with("height")) height = number(op, i, 0);
    if (a == "round") {
      options.push_back(b_.argument("joins", b_.word("round")));
      options.push_back(b_.argument("ends", b_.word("round")));
    }
    const std::string value = valueOf(a) == "miter" ? "mitre" : valueOf(a);
    b_.at(placeOf(source_, span, value));
    if (a.starts_with("joins")) options.push_back(b_.argument("joins", b_.word(value)));
    if (a.starts_with("ends")) options.push_back(b_.argument("ends", b_.word(value)));
    b_.at(op.span);
    if (a.starts_with("profile")) section = formed(&RegionTexts::profile, value, span);
  }
  // The volume of a cross-section is made at once, any other by drawing the ribbon up.
  const bool profiled = section != kNoNode;
  if (profiled) {
    const NodeId tall = height == kNoNode ? b_.number(kHedgeHeight) : height;
    options.push_back(b_.argument("height", tall));
    options.push_back(b_.argument("profile", section));
    height = kNoNode;
  }
  b_.at(op.span);
  if (width == kNoNode) width = b_.number(kHedgeWidth);
  // What has no rule is a hedge.
  Nodes body;
  bool raised = profiled;
  for (const Block& b : op.blocks) {
    for (const Part& p : b.parts) {
      const bool bare = p.body.size() == 1 && !p.body[0].called && !g_.rule(p.body[0].name);
      if (!profiled && (bare || height != kNoNode)) {
        raised = true;
        b_.at(p.span);
        body.push_back(b_.apply("extrude", {height != kNoNode ? height : b_.number(kHedgeHeight)}));
      }
      body.push_back(b_.push(sequence(p.body, "Hedge")));
    }
  }
  if (!raised && !over && wide && endsFlat(op)) {
    options.push_back(b_.argument("cut", b_.boolean(true)));
  }
  b_.at(op.span);
  Nodes items{b_.item(kNoNode, b_.sequence(body))};
  addElse(op, items);
  b_.at(op.span);
  Nodes arguments{formed(&RegionTexts::lines, l.ranges, spanOf(op, 0)), width};
  if (!l.inset.empty()) {
    arguments.push_back(b_.argument("inset", numberOf(l.inset, spanOf(op, 0))));
  }
  arguments.insert(arguments.end(), options.begin(), options.end());
  out.push_back(onFigure(l.figure, op.span, b_.apply("sweep", arguments, b_.block(items))));
}

void Lowering::lines(const Op& op, Nodes& out) {
  const Lines l = linesOf(g_, op);
  if (!l.mistake.empty()) return wrongCount(l.mistake, op.span);
  // A Contract alone in the braces says where the lines run.
  const std::vector<Part> parts = partsOf(op);
  const bool moved = !l.inset.empty() && parts.size() == 1 && parts[0].body.size() == 1;
  NodeId block = kNoNode;
  if (op.blocks.empty() || moved) {
    Nodes items{b_.item(kNoNode, b_.sequence({b_.leaf("Line")}))};
    addElse(op, items);
    b_.at(op.span);
    block = b_.block(items);
  } else {
    block = things(op);
  }
  Nodes arguments{formed(&RegionTexts::lines, l.ranges, op.span)};
  if (moved) arguments.push_back(b_.argument("inset", numberOf(l.inset, op.span)));
  out.push_back(onFigure(l.figure, op.span, b_.apply("parametrise", arguments, block)));
}

}  // namespace gable::park
