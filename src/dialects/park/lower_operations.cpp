// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each operation of the notation as operations on regions.
#include "base/number.h"
#include "dialects/park/lowering.h"

namespace gable::park {

namespace {

// Of what is swept without saying how wide: a box hedge.
constexpr double kHedgeWidth = 0.6, kHedgeHeight = 1;

}  // namespace

void Lowering::grid(const Op& op, Nodes& out) {
  Slots s = slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center", "junction"}});
  std::string junction = "none";
  JunctionChoices choices;
  Part junctionPart;
  bool onPlate = false;
  if (s.part[2] && !s.empty[2]) {
    choices = junctionChoices(g_, *s.part[2]);
    junctionPart = *s.part[2];
    if (!choices.parts.empty()) {
      junction = choices.figures;
    } else if (const std::string figure = headOf(junctionPart, onPlate); !figure.empty()) {
      junction = figure;
    }
    s.part[2] = &junctionPart;
  }
  const Op* together = joinedOp(g_, s.part[1]);
  Sequence joinedRest;
  if (together) {
    const Joined joined = joinedParts(g_, *together);
    if (!joined.figures.empty()) junction = joined.figures;
    joinedRest = joined.rest;
  }
  std::string options;
  for (size_t i = 2; i < op.arguments.size(); ++i) options += (i > 2 ? " " : "") + text(op, i);
  Nodes arguments;
  for (size_t i = 0; i < 2; ++i) {
    const std::string dim = text(op, i);
    double v = 0;
    if (known(dim, v)) {
      arguments.push_back(b_.number(v));
    } else {
      arguments.push_back(textNode(dim.empty() && op.arguments.empty() ? "2" : dim));
    }
  }
  arguments.push_back(b_.number(s.empty[1] ? 0 : pathWidth_));
  arguments.push_back(textNode(junction));
  arguments.push_back(textNode(options));
  Nodes items{item("region", s, 0, "Grass")};
  if (together) {
    const NodeId both = b_.choiceOfWords("path", "junction");
    items.push_back(b_.together(both, sequence(joinedRest, "Path")));
  } else if (!s.empty[1]) {
    items.push_back(item("path", s.part[1], "Path"));
    items.push_back(!choices.parts.empty()    ? choiceItem(choices, s.part[1])
                    : onPlate                 ? plateItem(junctionPart)
                    : s.part[2] || s.empty[2] ? item("junction", s, 2, "Path")
                                              : item("junction", s.part[1], "Path"));
  }
  items.push_back(item("remainder", s, 0, "Grass"));
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("grid", arguments, b_.block(items)));
}

std::string Lowering::headOf(Part& part, bool& onPlate) {
  bool own = false;
  const std::string figure = figureAtHead(g_, part.body, &own);
  if (own) {
    Op plate;
    plate.name = "Centre";
    plate.span = part.body[0].span;
    part.body[0] = plate;
  }
  onPlate = own && part.body.size() > 1;
  return figure;
}

NodeId Lowering::choiceItem(const JunctionChoices& choices, const Part* path) {
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (size_t i = 0; i < choices.parts.size(); ++i) {
    Part part = choices.parts[i];
    bool onPlate = false;
    const std::string figure = headOf(part, onPlate);
    const NodeId body = onPlate ? plateBody(part) : sequence(part.body, "Region");
    b_.at(part.span);
    const NodeId is = b_.binary(lang::BinaryOp::Equal, b_.word("region.choice"),
                                b_.number(figure.empty() ? 0 : static_cast<double>(i + 1)));
    branches.emplace_back(is, body);
  }
  const NodeId plain = path && !path->body.empty() ? sequence(path->body, "Path")
                                                   : b_.sequence({colour("Path"), b_.leaf("Path")});
  branches.emplace_back(kNoNode, plain);
  const NodeId which = b_.choice(lang::ChoiceKind::Case, branches);
  return b_.item(b_.word("junction"), b_.sequence({which}));
}

NodeId Lowering::plateBody(const Part& p) {
  const Sequence rest(p.body.begin() + 1, p.body.end());
  b_.at(p.span);
  const NodeId plate = b_.push(b_.sequence({colour("Centre"), b_.leaf("Centre")}));
  const NodeId above = b_.push(sequence(rest, ""));
  b_.at(p.span);
  return b_.sequence({plate, above});
}

NodeId Lowering::plateItem(const Part& p) { return b_.item(b_.word("junction"), plateBody(p)); }

void Lowering::joined(const Op& op, Nodes& out) {
  const Joined j = joinedParts(g_, op);
  // Figures that other rules make are results like any other, unless there is nothing else.
  Sequence all;
  bool byName = false;
  for (const Part& p : partsOf(op)) {
    for (const Op& inner : p.body) {
      byName = byName || (!inner.called && !figureAtHead(g_, {inner}).empty());
      all.push_back(inner);
    }
  }
  if (j.figures.empty() || (byName && !j.rest.empty())) return joinedLater(op, all, out);
  const NodeId block = elseBlock(op);
  out.push_back(b_.apply("joined", {textNode(j.figures)}, block));
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
    const NodeId condition = b_.call("region.selects", {textNode(constants(p.label))});
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
  Nodes items{item("region", s, 0, "Grass"), item("remainder", s, rest, "Grass")};
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("quadMap", {number(op, 0, 2), number(op, 1, 2)}, b_.block(items)));
}

void Lowering::voronoi(const Op& op, Nodes& out) {
  const Slots s =
      slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}, {"junction"}});
  const std::string sites = op.arguments.empty() ? "5 {3}" : discs(g_, op.arguments[0].text);
  std::string smooth, options;
  for (size_t i = 1; i < op.arguments.size(); ++i) {
    std::string a = text(op, i);
    if (lowered(a).starts_with("jitter(") && a.back() == ')') {
      a = "jitter=" + a.substr(7, a.size() - 8);
    }
    if (lowered(a).starts_with("smooth=")) a = a.substr(7);
    std::string& to = a.find('=') != std::string::npos ? options : smooth;
    to += (to.empty() ? "" : " ") + a;
  }
  if (smooth.empty()) smooth = "average(2)";
  Nodes items{item("region", s, 0, "Grass")};
  if (!s.empty[1]) items.push_back(item("path", s.part[1], "Path"));
  if (s.part[3] || s.empty[3]) items.push_back(item("junction", s, 3, "Path"));
  if (s.part[2] || s.empty[2]) items.push_back(item("centre", s, 2, "Centre"));
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("voronoi",
                         {textNode(sites), b_.number(s.empty[1] ? 0 : pathWidth_), textNode(smooth),
                          textNode(options)},
                         b_.block(items)));
}

void Lowering::rays(const Op& op, Nodes& out) {
  // CentrePoint [CentreRegionSize]: brackets give the centre a size.
  std::string source = op.arguments.empty() ? "centre" : op.arguments[0].text, size = "0";
  const size_t bracket = source.find('[');
  if (bracket != std::string::npos && bracket > 0 && source.back() == ']') {
    size = constants(source.substr(bracket + 1, source.size() - bracket - 2));
    source = source.substr(0, source.find_last_not_of(' ', bracket - 1) + 1);
  }
  double v = 0;
  const bool sized = !known(size, v) || v > 0;
  const bool middle = lowered(source) == "centre" || lowered(source) == "center";
  std::string targets = op.arguments.size() > 1 ? op.arguments[1].text : "corners";
  if (const Op* t = onlyOp(g_, targets)) {
    targets = lowered(t->name) + "(";
    for (const Argument& a : t->arguments) targets += a.text + ' ';
    targets += ')';
  }
  targets = constants(targets);
  if (lowered(targets).starts_with("corners")) targets = "corners";
  if (lowered(targets).starts_with("entrances")) targets = lowered(targets);
  // With a sized centre and two blocks these are { centre } { region }.
  const bool swapped = sized && op.blocks.size() == 2 && op.blocks[0].parts.size() == 1 &&
                       op.blocks[0].parts[0].label.empty();
  const Slots s = swapped ? slotsOf(op, {{"centre", "center"}, {"region"}, {"path", "section"}})
                          : slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}});
  const size_t region = swapped ? 1 : 0, path = swapped ? 2 : 1, centre = swapped ? 0 : 2;
  std::string options;
  for (size_t i = 2; i < op.arguments.size(); ++i) options += (i > 2 ? " " : "") + text(op, i);
  Nodes items{item("region", s, region, "Grass")};
  if (!s.empty[path]) items.push_back(item("path", s.part[path], "Path"));
  items.push_back(item("centre", s, centre, "Centre"));
  addElse(op, items);
  b_.at(op.span);
  double count = 0;
  const bool counted = known(targets, count);
  out.push_back(b_.apply(
      "castRays",
      {textNode(middle ? "centre" : discs(g_, source)),
       counted ? b_.number(count) : textNode(targets), b_.number(s.empty[path] ? 0 : pathWidth_),
       textNode(sized ? size : "0"), textNode(options)},
      b_.block(items)));
}

void Lowering::peel(const Op& op, Nodes& out) {
  const Slots s = slotsOf(op, {{"strip", "shape"}, {"rest", "remainder"}});
  Op sized = op;
  size_t flags = 1;
  // The size stands in the block, or behind the selection.
  if (s.part[0] && !s.part[0]->label.empty() && lowered(s.part[0]->label) != "strip") {
    sized.arguments.resize(2);
    sized.arguments[1] = {s.part[0]->label, s.part[0]->span};
  } else {
    flags = 2;
  }
  std::string options;
  for (size_t i = flags; i < op.arguments.size(); ++i) {
    if (lowered(op.arguments[i].text) == "cornersorthogonal") options = "orthogonal ";
  }
  checkWords(op, flags, {"cornersorthogonal", "cornersfollow", "smooth="});
  std::string smooth;
  for (const Argument& a : op.arguments) {
    if (lowered(a.text).starts_with("smooth=")) smooth = constants(a.text);
  }
  options += smooth;
  const std::string selection = op.arguments.empty() ? "outer" : text(op, 0);
  Nodes items{item("strip", s, 0, "Strip"), item("rest", s, 1, "Grass")};
  addElse(op, items);
  b_.at(op.span);
  const bool own = selection.find('{') != std::string::npos;
  out.push_back(b_.apply(
      "peel", {textNode(selection), own ? b_.number(0) : number(sized, 1, 1), textNode(options)},
      b_.block(items)));
}

void Lowering::choose(const Op& op, Nodes& out) {
  const std::vector<Part> parts = partsOf(op);
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

void Lowering::model(const Op& op, Nodes& out) {
  std::string file = op.arguments.empty() ? "" : op.arguments[0].text;
  std::erase_if(file, [](char c) { return c == '"'; });
  while (!file.empty() && file.front() == ' ') file.erase(0, 1);
  while (!file.empty() && file.back() == ' ') file.pop_back();
  const bool typed = file.find('.') != std::string::npos;
  if (!typed) models_ = true;
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
  for (const char* type : {".obj", ".glb"}) {
    const NodeId exists = b_.call("fileExists", {named(type)});
    branches.emplace_back(exists, named(type));
  }
  branches.emplace_back(kNoNode, named(".gltf"));
  return b_.function(modelFile_, {"name"}, b_.valueChoice(branches));
}

void Lowering::innerRect(const Op& op, Nodes& out) {
  const Slots s = slotsOf(op, {{"shape"}, {"remainder", "rest"}});
  checkWords(op, 0, {"scope", "edge"});
  noElse(op);
  const std::string along = lowered(text(op, 0)) == "edge" ? "edge" : "scope";
  const Nodes items{item("shape", s, 0, "Shape"), item("remainder", s, 1, "Grass")};
  out.push_back(b_.apply("innerRectangle", {b_.word(along)}, b_.block(items)));
}

void Lowering::contract(const Op& op, Nodes& out) {
  const std::string towards = lowered(text(op, 1));
  const bool centre = towards == "centre" || towards == "center";
  double v = 0;
  const bool share = centre && known(text(op, 0), v) && v <= 0.9;
  Nodes arguments{share ? b_.relative(v) : number(op, 0, 1)};
  if (centre && !share) arguments.push_back(b_.word("centre"));
  const NodeId block = elseBlock(op);
  out.push_back(b_.apply("contract", arguments, block));
}

void Lowering::insert(const Op& op, Nodes& out) {
  const std::string radius = op.arguments.empty() ? "1" : text(op, 0);
  const std::vector<Part> parts = partsOf(op);
  const bool nothing = parts.empty() || parts[0].body.empty();
  const NodeId body = nothing ? b_.sequence({b_.apply("NIL")}) : sequence(parts[0].body, "Thing");
  Nodes items{b_.item(kNoNode, body)};
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("place", {b_.text("corner(outer)"), textNode("circle(" + radius + ")")},
                         b_.block(items)));
}

void Lowering::figure(const Op& op, Nodes& out) {
  const std::string name = lowered(op.name);
  Nodes arguments;
  bool free = false;
  for (size_t i = 0; i < op.arguments.size(); ++i) {
    if (lowered(op.arguments[i].text) == "free") {
      free = true;
    } else {
      arguments.push_back(number(op, i, 1));
    }
  }
  if (arguments.empty()) arguments.push_back(b_.number(1));
  if (free && name == "circle" && arguments.size() == 1) arguments.push_back(b_.number(24));
  if (free) arguments.push_back(b_.word("free"));
  const NodeId block = elseBlock(op);
  out.push_back(b_.apply(name == "rombcenter" ? "romb"
                         : name == "polygon"  ? "regularPolygon"
                                              : name,
                         arguments, block));
}

NodeId Lowering::things(const Op& op) {
  NodeId body = kNoNode;
  for (const Block& b : op.blocks) {
    for (const Part& p : b.parts) body = sequence(p.body, "Thing");
  }
  b_.at(op.span);
  Nodes items{b_.item(kNoNode, body != kNoNode ? body : b_.sequence({}))};
  addElse(op, items);
  b_.at(op.span);
  return b_.block(items);
}

std::string Lowering::flagsOf(const Op& op) {
  std::string out;
  for (const Argument& a : op.arguments) {
    const std::string word = lowered(a.text);
    if (word == "over" || word == "split" || word == "align" || word == "chain") {
      out += (out.empty() ? "" : " ") + word;
    }
  }
  return out;
}

void Lowering::place(const Op& op, Nodes& out) {
  std::string where = op.arguments.empty() ? "centre" : text(op, 0);
  if (where.find(':') != std::string::npos && where.find('(') != 0) return distribute(op, out);
  if (lowered(where) == "centre" || lowered(where) == "center") where = "centre";
  // Several places, with commas between or in brackets.
  size_t flags = 1;
  for (; flags < op.arguments.size() && op.arguments[flags].text[0] == '('; ++flags) {
    where += ' ' + text(op, flags);
  }
  if (where.size() > 2 && where.front() == '[' && where.back() == ']') {
    where = where.substr(1, where.size() - 2);
  }
  checkWords(op, flags, {"cut", "over", "split", "align"});
  const NodeId block = things(op);
  out.push_back(b_.apply(
      "place", {textNode(where), textNode(figureOfBlock(g_, op)), b_.text(flagsOf(op))}, block));
}

void Lowering::distribute(const Op& op, Nodes& out) {
  std::string selection = op.arguments.empty() ? "all" : text(op, 0);
  NodeId inset = b_.number(0);
  if (const size_t colon = selection.find(':'); colon != std::string::npos) {
    Op by = op;
    by.arguments[0].text = selection.substr(colon + 1);
    inset = number(by, 0, 0);
    selection.resize(colon);
  }
  while (!selection.empty() && selection.back() == ' ') selection.pop_back();
  const NodeId block = things(op);
  checkWords(op, 2, {"cut", "over", "split", "align", "chain"});
  double spacing = 1;
  const std::string positions = text(op, 1);
  const bool spaced = positions.empty() || known(positions, spacing);
  out.push_back(b_.apply("distribute",
                         {textNode(selection), spaced ? b_.number(spacing) : textNode(positions),
                          inset, textNode(figureOfBlock(g_, op)), b_.text(flagsOf(op))},
                         block));
}

void Lowering::scatter(const Op& op, Nodes& out) {
  const std::string what = op.arguments.empty() ? "1 {1}" : text(op, 0);
  std::string count = what, radius = "1";
  if (const size_t brace = what.find('{'); brace != std::string::npos) {
    count = what.substr(0, brace);
    radius = what.substr(brace + 1, what.find('}') - brace - 1);
  }
  double n = 0;
  if (count.find_first_not_of(' ') != std::string::npos && !known(count, n)) {
    diagnostics_.error("bad-argument", op.span, "'" + what + "' is no count with a radius",
                       "write 5 {[2,4]}");
  }
  std::string options;
  for (size_t i = 1; i < op.arguments.size(); ++i) {
    std::string o = text(op, i);
    if (lowered(o).starts_with("min")) o = "gap" + o.substr(3);
    options += (i > 1 ? " " : "") + o;
  }
  const NodeId block = things(op);
  out.push_back(
      b_.apply("scatterCircles", {b_.number(n), textNode(radius), textNode(options)}, block));
}

std::string Lowering::valueOf(const std::string& text) {
  const size_t equals = text.find('=');
  const size_t begin = equals == text.npos ? text.npos : text.find_first_not_of(' ', equals + 1);
  return begin == text.npos ? std::string() : text.substr(begin);
}

NodeId Lowering::insetOf(const Lines& l, const Op& op) {
  Op by = op;
  by.arguments.assign(1, {l.inset.empty() ? "0" : l.inset, op.span});
  return number(by, 0, 0);
}

void Lowering::sweep(const Op& op, Nodes& out) {
  const Lines l = linesOf(g_, op.arguments.empty() ? std::string("all") : op.arguments[0].text);
  checkWords(op, 1, {"width=", "height=", "profile=", "joins=", "ends=", "round"});
  NodeId width = kNoNode, height = kNoNode;
  std::string options, tall;
  bool profiled = false;
  for (size_t i = 1; i < op.arguments.size(); ++i) {
    const std::string a = lowered(op.arguments[i].text);
    if (a.starts_with("width")) width = number(op, i, 0);
    if (a.starts_with("height")) {
      height = number(op, i, 0);
      tall = valueOf(text(op, i));
    }
    if (a == "round") options += "round ";
    if (a.starts_with("joins") || a.starts_with("ends")) options += a + " ";
    if (a.starts_with("profile")) {
      profiled = true;
      std::string section = valueOf(constants(a));
      std::erase(section, ' ');
      options += "profile=" + section + ' ';
    }
  }
  // The volume of a cross-section is made at once, any other by drawing the ribbon up.
  if (profiled) {
    options += "height=" + (tall.empty() ? shortestText(kHedgeHeight) : tall) + ' ';
    height = kNoNode;
  }
  b_.at(op.span);
  if (width == kNoNode) width = b_.number(kHedgeWidth);
  // What has no rule is a hedge.
  Nodes body;
  for (const Block& b : op.blocks) {
    for (const Part& p : b.parts) {
      const bool bare = p.body.size() == 1 && !p.body[0].called && !g_.rule(p.body[0].name);
      if (!profiled && (bare || height != kNoNode)) {
        b_.at(p.span);
        body.push_back(b_.apply("extrude", {height != kNoNode ? height : b_.number(kHedgeHeight)}));
      }
      body.push_back(b_.push(sequence(p.body, "Hedge")));
    }
  }
  b_.at(op.span);
  Nodes items{b_.item(kNoNode, b_.sequence(body))};
  addElse(op, items);
  b_.at(op.span);
  out.push_back(b_.apply("sweep", {textNode(l.ranges), width, insetOf(l, op), textNode(options)},
                         b_.block(items)));
}

void Lowering::lines(const Op& op, Nodes& out) {
  const Lines l = linesOf(g_, op);
  if (!l.figure.empty()) {
    Op shape;
    shape.name = l.figure.substr(0, l.figure.find('('));
    shape.span = op.span;
    for (const std::string& a : argumentTexts(l.figure)) shape.arguments.push_back({a, op.span});
    figure(shape, out);
  }
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
  const NodeId inset = moved ? insetOf(l, op) : b_.number(0);
  out.push_back(b_.apply("parametrise", {textNode(l.ranges), inset}, block));
}

}  // namespace gable::park
