// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each operation of the notation as operations on regions: partitions, peels and choices. What puts
// things into a region is in lower_things.cpp.
#include <set>

#include "base/number.h"
#include "base/text.h"
#include "dialects/park/lowering.h"
#include "dialects/park/places.h"
#include "dialects/proposal.h"

namespace gable::park {

namespace {

// What a model without a type may be, the first that is there; else one that comes with Gable.
constexpr const char* kModelTypes[] = {".obj", ".glb", ".gltf"};
constexpr const char* kBundledModels = "/gable/park/";

using lang::RegionTexts;

std::string trimmed(std::string s) {
  while (!s.empty() && s.front() == ' ') s.erase(0, 1);
  while (!s.empty() && s.back() == ' ') s.pop_back();
  return s;
}

}  // namespace

// --- Options ---

void Lowering::options(const Op& op, size_t first, std::initializer_list<Option> known,
                       Nodes& arguments) {
  for (size_t i = first; i < op.arguments.size(); ++i) {
    const Span span = spanOf(op, i);
    for (const auto& given : RegionTexts::options(op.arguments[i].text)) {
      const auto& [name, value] = given;
      const auto* option = std::find_if(known.begin(), known.end(),
                                        [&](const Option& o) { return o.name == given.first; });
      if (option == known.end()) {
        std::vector<std::string_view> names;
        std::string list;
        for (const Option& o : known) {
          names.push_back(o.name);
          list += (list.empty() ? "it knows " : ", ") + std::string(o.name);
        }
        const std::string nearest = nearestName(name, names);
        diagnostics_.error("bad-argument", span,
                           "'" + name + "' is nothing that '" + op.name + "' knows",
                           nearest.empty() ? list : meaning(nearest));
        propose(diagnostics_, placeOf(source_, span, name), name, nearest);
        continue;
      }
      const std::string word = lowerCase(value);
      const Span before = b_.span();
      b_.at(span);
      NodeId made = kNoNode;
      switch (option->takes) {
        case Option::Takes::Number: made = numberOf(value, span); break;
        case Option::Takes::Word: made = b_.word(value); break;
        case Option::Takes::Lowered: made = b_.word(word == "miter" ? "mitre" : word); break;
        case Option::Takes::Flag: made = b_.boolean(word != "none" && word != "false"); break;
      }
      arguments.push_back(b_.argument(option->argument, made));
      b_.at(before);
    }
  }
}

void Lowering::flags(const Op& op, size_t first, std::initializer_list<std::string_view> known,
                     Nodes& arguments) {
  checkWords(op, first, known);
  for (size_t i = first; i < op.arguments.size(); ++i) {
    const std::string word = lowerCase(op.arguments[i].text);
    const bool isKnown = std::find(known.begin(), known.end(), word) != known.end();
    // What is cut out is cut out by default, and x of what stands along edges runs along them.
    const bool plain = word == "cut" || (word == "align" && known.size() == 5);
    if (isKnown && !plain) arguments.push_back(b_.argument(word, b_.boolean(true)));
  }
}

// --- Figures ---

NodeId Lowering::figureNode(const Op& op) {
  const Span before = b_.span();
  b_.at(op.span);
  const std::string name = lowerCase(op.name);
  Nodes arguments;
  for (size_t i = 0; i < op.arguments.size(); ++i) {
    const std::string& written = op.arguments[i].text;
    if (lowerCase(written) == "free") {
      arguments.push_back(b_.argument("reach", b_.word("free")));
    } else if (written.find_first_not_of(". ") == std::string::npos) {
      // RombCenter(..) of the sketches.
      arguments.push_back(b_.number(3));
    } else {
      arguments.push_back(number(op, i, 1));
    }
  }
  noBraces(op);
  if (op.arguments.empty()) {
    diagnostics_.error("wrong-argument-count", op.span, "'" + op.name + "' needs its size",
                       "write " + op.name + "(2)");
  }
  if (arguments.empty()) arguments.push_back(b_.number(1));
  const NodeId made = b_.apply(name == "romb" || name == "rombcenter" ? "rhombus"
                               : name == "polygon"                    ? "regularPolygon"
                                                                      : name,
                               arguments);
  b_.at(before);
  return made;
}

// A rule takes the place of its name, unless it stands in itself or this goes on and on.
bool Lowering::mayInline(const Rule& r) const {
  constexpr int kMostInlined = 2;
  return &r != rule_ && inlined_ < kMostInlined;
}

// A sequence that begins with a figure: the figure, then what is done with it.
NodeId Lowering::figureBody(const Sequence& body, std::string_view owner, bool ground) {
  const FigureHead head = figureHead(g_, body);
  if (!head.figure) return sequence(body, owner);
  const Rule* const outer = rule_;
  if (head.rule && !mayInline(*head.rule)) {
    return b_.sequence(flattened({figureNode(*head.figure), sequence(body, owner)}));
  }
  inlined_ += head.rule ? 1 : 0;
  if (head.rule) {
    rule_ = head.rule;
    owner = head.rule->name;
  } else if (ground) {
    owner = "Centre";
  }
  const Sequence rest(head.body->begin() + 1, head.body->end());
  Nodes steps{figureNode(*head.figure)};
  if (ground && !rest.empty() && endingOf(g_, rest) == Ending::Nothing) {
    b_.at(head.figure->span);
    steps.push_back(b_.push(b_.sequence({colour("Centre"), b_.leaf("Centre")})));
    steps.push_back(sequence(rest, ""));
  } else {
    addSteps(rest, owner, steps);
  }
  rule_ = outer;
  inlined_ -= head.rule ? 1 : 0;
  return b_.sequence(flattened(steps));
}

// A sequence within a sequence is its steps.
Nodes Lowering::flattened(const Nodes& steps) {
  Nodes out;
  for (const NodeId n : steps) {
    if (b_.tree().kind(n) != lang::NodeKind::Sequence) {
      out.push_back(n);
      continue;
    }
    const auto inner = b_.tree().children(n);
    out.insert(out.end(), inner.begin(), inner.end());
  }
  return out;
}

NodeId Lowering::choiceBody(const JunctionChoices& choices) {
  const Rule* const outer = rule_;
  std::vector<std::pair<NodeId, NodeId>> branches;
  const bool byCase = choices.shares.empty();
  inlined_ += choices.rule ? 1 : 0;
  bool complete = false;
  for (size_t i = 0; i < choices.parts.size() && !complete; ++i) {
    const Part& part = choices.parts[i];
    if (choices.rule) rule_ = choices.rule;
    const NodeId body = figureBody(part.body, "Region", true);
    b_.at(part.span);
    NodeId head = kNoNode;
    if (byCase && !choices.conditions[i].empty()) {
      head = conditionOf(choices.conditions[i], part.span);
    } else if (!byCase && i + 1 < choices.parts.size()) {
      head = b_.number(choices.shares[i]);
    }
    complete = head == kNoNode;
    branches.emplace_back(head, body);
  }
  rule_ = outer;
  inlined_ -= choices.rule ? 1 : 0;
  if (!complete) branches.emplace_back(kNoNode, b_.sequence({colour("Path"), b_.leaf("Path")}));
  if (branches.size() == 1) return branches[0].second;
  return b_.sequence(
      {b_.choice(byCase ? lang::ChoiceKind::Case : lang::ChoiceKind::Percent, branches)});
}

NodeId Lowering::figureItem(NodeId head, const Part& p, bool together) {
  const JunctionChoices choices = junctionChoices(g_, p);
  if (!choices.rule && !choices.shares.empty()) checkShares(choices.parts, p.span);
  const bool plain = choices.parts.empty() || (choices.rule && !mayInline(*choices.rule));
  const NodeId body = plain ? figureBody(p.body, "Region", true) : choiceBody(choices);
  return together ? b_.together(head, body) : b_.item(head, body);
}

// --- Partitions ---

void Lowering::dimension(const Op& op, size_t i, const char* count, const char* sizes,
                         const char* angles, Nodes& arguments) {
  const std::string written = text(op, i);
  const Span span = spanOf(op, i);
  if (written.empty()) {
    if (op.arguments.empty()) arguments.push_back(b_.argument(count, b_.number(2)));
    return;
  }
  RegionTexts texts([&](std::string_view n) { return number(n, span); });
  const RegionTexts::Dimension d = texts.dimension(written);
  if (!d.read) {
    diagnostics_.error("bad-argument", span,
                       "'" + written + "' is no size of a grid: " + texts.problem(),
                       "write a count, 3 {2, 6, 2} or {[1.5, 4]}");
    return;
  }
  if (!d.count.empty()) arguments.push_back(b_.argument(count, node(d.count, written, span)));
  if (!d.sizes.empty()) arguments.push_back(b_.argument(sizes, node(d.sizes, written, span)));
  if (!d.angles.empty()) arguments.push_back(b_.argument(angles, node(d.angles, written, span)));
}

void Lowering::gridOptions(const Op& op, Nodes& arguments) {
  using Takes = Option::Takes;
  Op spelt = op;
  for (Argument& a : spelt.arguments) {
    const std::string low = lowerCase(a.text);
    if (low == "fit=centre") a.text = "fit=center";
    if (low == "pattern=center") a.text = "pattern=centre";
    if (low == "pattern=extendl") a.text = "pattern=extendL";
    if (low == "pattern=extendr") a.text = "pattern=extendR";
  }
  options(spelt, 2,
          {{"fit", "fit", Takes::Lowered},
           {"template", "template", Takes::Lowered},
           {"pattern", "pattern", Takes::Word},
           {"dominance", "dominance", Takes::Lowered},
           {"symxy", "symmetric", Takes::Flag},
           {"lines", "lines", Takes::Flag},
           {"sliver", "sliver", Takes::Number},
           {"minarea", "minArea", Takes::Number}},
          arguments);
}

// Parts with blocks in them are written once for all that they are for: twice at every level would
// be more than anybody has room for.
bool Lowering::isDeep(const Slots& s, size_t i) {
  if (!s.part[i] || s.empty[i]) return false;
  return std::any_of(s.part[i]->body.begin(), s.part[i]->body.end(),
                     [](const Op& op) { return !op.blocks.empty(); });
}

void Lowering::grid(const Op& op, Nodes& out) {
  Slots s = slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center", "junction"}});
  Nodes arguments;
  dimension(op, 0, "columns", "widths", "columnAngles", arguments);
  dimension(op, 1, "rows", "heights", "rowAngles", arguments);
  arguments.push_back(b_.argument("path", s.empty[1] ? b_.number(0) : pathWidth()));
  gridOptions(op, arguments);
  // "Min area, otherwise fail".
  constexpr double kLeastArea = 0.25;
  if (op.hasElse) arguments.push_back(b_.argument("least", b_.number(kLeastArea)));
  const Op* together = joinedOp(g_, s.part[1]);
  const bool figures =
      s.part[2] && !s.empty[2] &&
      (figureHead(g_, s.part[2]->body).figure || !junctionChoices(g_, *s.part[2]).parts.empty());
  const bool shared = isDeep(s, 0);
  Nodes items{
      shared ? b_.item(b_.choiceOfWords("region", "remainder"), sequence(s.part[0]->body, "Region"))
             : item("region", s, 0, "Grass")};
  if (together) {
    const Joined joined = joinedParts(g_, *together);
    Part all;
    all.body = joined.rest;
    all.span = together->span;
    if (!joined.figures.empty()) all.body.insert(all.body.begin(), joined.figures[0]);
    const NodeId both = b_.choiceOfWords("path", "junction");
    if (all.body.empty()) {
      items.push_back(b_.together(both, b_.sequence({colour("Path"), b_.leaf("Path")})));
    } else if (joined.figures.empty()) {
      items.push_back(b_.together(both, sequence(all.body, "Path")));
    } else {
      Nodes steps{figureNode(joined.figures[0]), sequence(joined.rest, "Path")};
      items.push_back(b_.together(both, b_.sequence(flattened(steps))));
    }
  } else if (!s.empty[1] && !s.part[2] && !s.empty[2] && isDeep(s, 1)) {
    items.push_back(
        b_.item(b_.choiceOfWords("path", "junction"), sequence(s.part[1]->body, "Region")));
  } else if (!s.empty[1]) {
    items.push_back(item("path", s.part[1], "Path"));
    items.push_back(figures                   ? figureItem(b_.word("junction"), *s.part[2], false)
                    : s.part[2] || s.empty[2] ? item("junction", s, 2, "Path")
                                              : item("junction", s.part[1], "Path"));
  }
  if (!shared) items.push_back(item("remainder", s, 0, "Grass"));
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("grid", arguments, b_.block(items)));
}

void Lowering::joined(const Op& op, Nodes& out) {
  // Everything in the braces gets the region, and what comes of all is one.
  Sequence all;
  const Joined j = joinedParts(g_, op);
  bool byName = false;
  for (const Part& p : partsOf(op)) {
    for (const Op& inner : p.body) {
      byName = byName || (!inner.called && figureHead(g_, {inner}).figure);
      all.push_back(inner);
    }
  }
  if (j.figures.empty() || (byName && !j.rest.empty())) return joinedLater(op, all, out);
  Nodes items;
  for (const Op& f : j.figures) {
    b_.at(f.span);
    items.push_back(
        b_.item(kNoNode, b_.sequence({figureNode(f), colour(rule_->name), b_.leaf(rule_->name)})));
  }
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("joined", {}, b_.block(items)));
  bool open = true;
  for (const Op& inner : j.rest) open = step(inner, out);
  if (open) {
    out.push_back(colour(rule_->name));
    out.push_back(b_.leaf(rule_->name));
  }
}

// Each part gets the region, and what comes of all is one.
void Lowering::joinedLater(const Op& op, const Sequence& parts, Nodes& out) {
  noElse(op);
  Nodes items;
  for (const Op& part : parts) {
    const NodeId body = sequence({part}, "Region");
    b_.at(part.span);
    items.push_back(b_.item(kNoNode, body));
  }
  if (items.empty()) {
    diagnostics_.error("bad-argument", op.span, "there is nothing to join",
                       "write joined { A B }, or joined { Rect(8, 2) Circle(3) }");
    return;
  }
  b_.at(op.span);
  out.push_back(b_.apply("joined", {}, b_.block(items)));
  out.push_back(colour(rule_->name));
  out.push_back(b_.leaf(rule_->name));
}

void Lowering::select(const Op& op, Nodes& out) {
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (const Part& p : partsOf(op)) {
    if (p.label.empty()) {
      diagnostics_.error("bad-argument", p.span, "a part of Select has no selection",
                         "write 'outer : A | side(W) : B'");
      return;
    }
    const NodeId body = sequence(p.body, rule_->name);
    b_.at(p.span);
    const NodeId condition =
        b_.call("region.selects", {formed(&RegionTexts::selection, p.label, p.span)});
    branches.emplace_back(condition, body);
  }
  const NodeId rest = op.hasElse ? sequence(op.otherwise, rule_->name)
                                 : b_.sequence({colour(rule_->name), b_.leaf(rule_->name)});
  b_.at(op.span);
  if (branches.empty()) {
    out.push_back(b_.push(rest));
    return;
  }
  branches.emplace_back(kNoNode, rest);
  out.push_back(b_.choice(lang::ChoiceKind::Case, branches));
}

void Lowering::quadMap(const Op& op, Nodes& out) {
  const Slots s = slotsOf(op, {{"region"}, {"remainder", "rest"}});
  const size_t rest = s.part[1] || s.empty[1] ? 1 : 0;
  const bool shared = rest == 0 && isDeep(s, 0);
  Nodes items;
  if (shared) {
    items.push_back(
        b_.item(b_.choiceOfWords("region", "remainder"), sequence(s.part[0]->body, "Region")));
  } else {
    items = {item("region", s, 0, "Grass"), item("remainder", s, rest, "Grass")};
  }
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("quadMap", {number(op, 0, 2), number(op, 1, 2)}, b_.block(items)));
}

void Lowering::voronoi(const Op& op, Nodes& out) {
  const Slots s =
      slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}, {"junction"}});
  const std::string written = op.arguments.empty() ? "5 {3}" : discs(g_, op.arguments[0].text);
  const Span span = spanOf(op, 0);
  RegionTexts texts([&](std::string_view n) { return number(n, span); });
  const RegionTexts::Sites sites = texts.sites(written);
  if (sites.sites.empty()) unreadable(written, span);
  Nodes arguments{node(sites.sites.empty() ? "1" : sites.sites, written, span),
                  b_.argument("path", s.empty[1] ? b_.number(0) : pathWidth())};
  Op rest = op;
  rest.arguments.clear();
  for (size_t i = 1; i < op.arguments.size(); ++i) {
    Argument a = op.arguments[i];
    const std::string low = lowerCase(a.text);
    if (low.starts_with("jitter(") && a.text.back() == ')') {
      a.text = "jitter=" + a.text.substr(7, a.text.size() - 8);
    }
    if (low.starts_with("smooth=")) a.text = trimmed(a.text.substr(7));
    if (a.text.find('=') == std::string::npos) {
      arguments.push_back(
          b_.argument("smooth", formed(&RegionTexts::smoothing, a.text, spanOf(op, i))));
    } else {
      rest.arguments.push_back(a);
    }
  }
  if (!sites.radius.empty()) {
    arguments.push_back(b_.argument("radius", node(sites.radius, written, span)));
  }
  using Takes = Option::Takes;
  options(rest, 0,
          {{"borderpath", "borderPath", Takes::Flag},
           {"orphans", "orphans", Takes::Lowered},
           {"jitter", "jitter", Takes::Number}},
          arguments);
  Nodes items{item("region", s, 0, "Grass")};
  if (!s.empty[1]) items.push_back(item("path", s.part[1], "Path"));
  if (s.part[3] && !s.empty[3] && figureHead(g_, s.part[3]->body).figure) {
    items.push_back(figureItem(b_.word("junction"), *s.part[3], false));
  } else if (s.part[3] || s.empty[3]) {
    items.push_back(item("junction", s, 3, "Path"));
  }
  if (s.part[2] || s.empty[2]) items.push_back(item("centre", s, 2, "Centre"));
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("voronoi", arguments, b_.block(items)));
}

void Lowering::rayOptions(const Op& op, Nodes& arguments) {
  using Takes = Option::Takes;
  Op spelt = op;
  for (size_t i = 2; i < spelt.arguments.size(); ++i) {
    std::string& a = spelt.arguments[i].text;
    // connect=thin(0.5)
    const size_t thin = lowerCase(a).find("thin(");
    if (thin != std::string::npos && a.back() == ')') {
      const std::string share = a.substr(thin + 5, a.size() - thin - 6);
      a = a.substr(0, thin + 4) + " share=" + share;
    }
  }
  options(spelt, 2,
          {{"hidden", "hidden", Takes::Lowered},
           {"connect", "connect", Takes::Lowered},
           {"share", "share", Takes::Number}},
          arguments);
}

void Lowering::rays(const Op& op, Nodes& out) {
  // CentrePoint [CentreRegionSize]: brackets give the centre a size.
  std::string source = op.arguments.empty() ? "centre" : op.arguments[0].text, size = "0";
  const size_t bracket = source.find('[');
  if (bracket != std::string::npos && bracket > 0 && source.back() == ']') {
    size = source.substr(bracket + 1, source.size() - bracket - 2);
    source = source.substr(0, source.find_last_not_of(' ', bracket - 1) + 1);
  }
  double v = 0;
  const bool sized = !known(size, v) || v > 0;
  const bool middle = lowerCase(source) == "centre" || lowerCase(source) == "center";
  const Span first = spanOf(op, 0), second = spanOf(op, 1);
  Nodes arguments;
  std::string radius;
  const std::string written = discs(g_, source);
  if (middle) {
    arguments.push_back(b_.word("centre"));
  } else {
    RegionTexts texts([&](std::string_view n) { return number(n, first); });
    const RegionTexts::Sites sites = texts.sites(written);
    if (sites.sites.empty()) unreadable(written, first);
    arguments.push_back(node(sites.sites.empty() ? "1" : sites.sites, written, first));
    radius = sites.radius;
  }
  std::string targets = op.arguments.size() > 1 ? op.arguments[1].text : "corners";
  if (const Op* t = onlyOp(g_, targets)) {
    targets = lowerCase(t->name) + "(";
    for (const Argument& a : t->arguments) targets += a.text + ' ';
    targets += ')';
  }
  arguments.push_back(formed(&RegionTexts::targets, targets, second));
  // With a sized centre and two blocks these are { centre } { region }.
  const bool swapped = sized && op.blocks.size() == 2 && op.blocks[0].parts.size() == 1 &&
                       op.blocks[0].parts[0].label.empty();
  const Slots s = swapped ? slotsOf(op, {{"centre", "center"}, {"region"}, {"path", "section"}})
                          : slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}});
  const size_t region = swapped ? 1 : 0, path = swapped ? 2 : 1, centre = swapped ? 0 : 2;
  arguments.push_back(b_.argument("path", s.empty[path] ? b_.number(0) : pathWidth()));
  if (!radius.empty()) {
    arguments.push_back(b_.argument("radius", node(radius, written, first)));
  }
  rayOptions(op, arguments);
  Nodes items{item("region", s, region, "Grass")};
  if (!s.empty[path]) items.push_back(item("path", s.part[path], "Path"));
  items.push_back(centreItem(s, centre, sized ? size : std::string(), first));
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("castRays", arguments, b_.block(items)));
}

// A size in brackets is a radius, or a figure.
NodeId Lowering::centreItem(const Slots& s, size_t i, const std::string& size, Span span) {
  if (size.empty()) {
    const bool figure = s.part[i] && !s.empty[i] && figureHead(g_, s.part[i]->body).figure;
    return figure ? figureItem(b_.word("centre"), *s.part[i], false)
                  : item("centre", s, i, "Centre");
  }
  const Span before = b_.span();
  b_.at(span);
  Op figure;
  figure.span = span;
  figure.called = true;
  figure.name = trimmed(size.substr(0, size.find('(')));
  if (isFigure(lowerCase(figure.name)) && size.back() == ')') {
    for (const std::string& a : argumentTexts(size)) figure.arguments.push_back({a, span});
  } else {
    figure.name = "circle";
    figure.arguments.push_back({size, span});
  }
  Nodes steps{figureNode(figure)};
  b_.at(before);
  if (s.empty[i]) {
    steps.push_back(b_.apply("NIL"));
  } else if (s.part[i] && !s.part[i]->body.empty()) {
    steps.push_back(sequence(s.part[i]->body, "Region"));
  } else {
    steps.push_back(colour("Centre"));
    steps.push_back(b_.leaf("Centre"));
  }
  return b_.item(b_.word("centre"), b_.sequence(flattened(steps)));
}

// {W: 2, N & outer: 4}
NodeId Lowering::ownWidths(const std::string& written, Span span) {
  NodeId all = kNoNode;
  size_t begin = written.find('{') + 1, depth = 0;
  const size_t close = written.rfind('}');
  for (size_t i = begin; close != std::string::npos && i <= close; ++i) {
    const char c = i < close ? written[i] : ',';
    if (c == '(' || c == '[') ++depth;
    if ((c == ')' || c == ']') && depth > 0) --depth;
    if (c != ',' || (depth > 0 && i < close)) continue;
    const std::string item = written.substr(begin, i - begin);
    begin = i + 1;
    const size_t colon = item.rfind(':');
    if (colon == std::string::npos) {
      unreadable(written, span);
      return b_.number(0);
    }
    const NodeId edges = formed(&RegionTexts::selection, item.substr(0, colon), span);
    const NodeId one = b_.call("wide", {edges, numberOf(item.substr(colon + 1), span)});
    all = all == kNoNode ? one : b_.binary(lang::BinaryOp::Or, all, one);
  }
  if (all != kNoNode) return all;
  unreadable(written, span);
  return b_.number(0);
}

void Lowering::peel(const Op& op, Nodes& out) {
  const Slots s = slotsOf(op, {{"strip", "shape"}, {"rest", "remainder"}});
  const std::string written = op.arguments.empty() ? "outer" : text(op, 0);
  const bool own = written.find('{') != std::string::npos;
  Nodes arguments{own ? ownWidths(written, spanOf(op, 0))
                      : formed(&RegionTexts::selection, written, spanOf(op, 0))};
  // The size stands in the block, or behind the selection.
  const bool inBlock = s.part[0] && !s.part[0]->label.empty() &&
                       lowerCase(s.part[0]->label) != "strip" &&
                       lowerCase(s.part[0]->label) != "shape";
  const size_t flags = inBlock ? 1 : 2;
  if (inBlock) {
    arguments.push_back(numberOf(s.part[0]->label, s.part[0]->span));
  } else if (op.arguments.size() > 1) {
    if (!own) arguments.push_back(number(op, 1, 1));
  } else if (!own) {
    diagnostics_.error(
        "wrong-argument-count", op.span, "'" + op.name + "' does not say how wide",
        "write Peel(" + written + ", 1) { A | B }, or Peel(" + written + ") { 1 : A | B }");
    arguments.push_back(b_.number(1));
  }
  checkWords(op, flags, {"cornersorthogonal", "cornersfollow", "smooth="});
  for (size_t i = flags; i < op.arguments.size(); ++i) {
    const std::string a = lowerCase(op.arguments[i].text);
    if (a == "cornersorthogonal") {
      arguments.push_back(b_.argument("orthogonal", b_.boolean(true)));
    } else if (a.starts_with("smooth=")) {
      arguments.push_back(
          b_.argument("smooth", formed(&RegionTexts::smoothing, a.substr(7), spanOf(op, i))));
    }
  }
  Nodes items{item("strip", s, 0, "Strip"), item("rest", s, 1, "Grass")};
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("peel", arguments, b_.block(items)));
}

void Lowering::choose(const Op& op, Nodes& out) {
  const std::vector<Part> parts = partsOf(op);
  checkShares(parts, op.span);
  const std::vector<double> shares = sharesOf(g_, parts);
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (size_t i = 0; i < parts.size(); ++i) {
    const NodeId body = sequence(parts[i].body, rule_->name);
    b_.at(op.span);
    branches.emplace_back(i + 1 == parts.size() ? kNoNode : b_.number(shares[i]), body);
  }
  if (branches.size() == 1) out.push_back(b_.push(branches[0].second));
  if (branches.size() > 1) out.push_back(b_.choice(lang::ChoiceKind::Percent, branches));
}

// The same files as modelFile() names, while the grammar is read.
void Lowering::checkModel(const Op& op, const std::string& file, bool typed) {
  if (!files_.loader || file.empty() || file.find(':') != std::string::npos) return;
  const auto exists = [&](const std::string& path) {
    return files_.loader->exists(path, files_.path);
  };
  bool found = typed && exists(file);
  for (const char* type : kModelTypes) found = found || (!typed && exists(file + type));
  found = found || (!typed && exists(kBundledModels + file + ".glb"));
  if (found || !missedModels_.insert(file).second) return;
  std::vector<std::string> names;
  for (std::string name : files_.loader->assets(files_.path)) {
    const size_t dot = name.rfind('.');
    const bool isModel =
        dot != std::string::npos && std::find(std::begin(kModelTypes), std::end(kModelTypes),
                                              lowerCase(name.substr(dot))) != std::end(kModelTypes);
    if (!isModel) continue;
    if (!typed) name.erase(dot);
    names.push_back(std::move(name));
  }
  const std::string nearest = nearestName(file, {names.begin(), names.end()});
  // By the name with which the derivation tells it, so that it is told once.
  diagnostics_.warning("missing-file", op.arguments.empty() ? op.span : spanOf(op, 0),
                       "there is no file '" + (typed ? file : file + kModelTypes[0]) + "'" +
                           (typed ? "" : ", nor .glb or .gltf of that name"),
                       nearest.empty() ? "a box stands for it; models lie in the assets folder, "
                                         "at the root of the project or beside the grammar"
                                       : "did you mean '" + nearest + "'?");
}

void Lowering::model(const Op& op, Nodes& out) {
  std::string file = op.arguments.empty() ? "" : op.arguments[0].text;
  std::erase_if(file, [](char c) { return c == '"'; });
  while (!file.empty() && file.front() == ' ') file.erase(0, 1);
  while (!file.empty() && file.back() == ' ') file.pop_back();
  const bool typed = file.find('.') != std::string::npos;
  if (!typed) models_ = true;
  checkModel(op, file, typed);
  // A file without a type is the first there is of those that can be read.
  const auto path = [&] { return typed ? b_.text(file) : b_.call(modelFile_, {b_.text(file)}); };
  const auto inserted = [&](NodeId of) {
    return b_.apply("i", {of, b_.word("yUp"), b_.word("keepSizeAlignPosition")});
  };
  const std::string name = rule_->name;
  // Models have colours of their own. What is missing is reported, and a box stands for it.
  const NodeId white = b_.apply("color", {b_.text("#ffffff")});
  const NodeId found = b_.sequence({white, inserted(path()), b_.leaf(name)});
  const NodeId missing = inserted(b_.text(typed ? file : file + ".obj"));
  const NodeId box =
      b_.sequence({missing, inserted(b_.text("builtin:cube")), colour(name), b_.leaf(name)});
  const NodeId exists = b_.call("fileExists", {path()});
  out.push_back(b_.choice(lang::ChoiceKind::Case, {{exists, found}, {kNoNode, box}}));
}

NodeId Lowering::modelFile() {
  const auto named = [&](const char* type) {
    return b_.binary(lang::BinaryOp::Add, b_.word("name"), b_.text(type));
  };
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (const char* type : kModelTypes) {
    const NodeId exists = b_.call("fileExists", {named(type)});
    branches.emplace_back(exists, named(type));
  }
  // One of those that come with Gable.
  const auto bundled = [&] {
    return b_.binary(lang::BinaryOp::Add, b_.text(kBundledModels), named(".glb"));
  };
  const NodeId exists = b_.call("fileExists", {bundled()});
  branches.emplace_back(exists, bundled());
  branches.emplace_back(kNoNode, named(".obj"));
  return b_.function(modelFile_, {"name"}, b_.valueChoice(branches));
}

void Lowering::innerRect(const Op& op, Nodes& out) {
  const Slots s = slotsOf(op, {{"shape"}, {"remainder", "rest"}});
  checkWords(op, 0, {"scope", "edge"});
  noElse(op);
  const std::string along = lowerCase(text(op, 0)) == "edge" ? "edge" : "scope";
  const Nodes items{item("shape", s, 0, "Shape"), item("remainder", s, 1, "Grass")};
  out.push_back(b_.apply("innerRectangle", {b_.word(along)}, b_.block(items)));
}

void Lowering::contract(const Op& op, Nodes& out) {
  checkWords(op, 1, {"centre", "center"});
  const std::string towards = lowerCase(text(op, 1));
  const bool centre = towards == "centre" || towards == "center";
  double v = 0;
  const bool share = centre && known(text(op, 0), v) && v <= 0.9;
  Nodes arguments{share ? b_.relative(v) : number(op, 0, 1)};
  if (centre && !share) arguments.push_back(b_.word("centre"));
  const NodeId block = elseBlock(op);
  out.push_back(b_.apply("contract", arguments, block));
}

}  // namespace gable::park
