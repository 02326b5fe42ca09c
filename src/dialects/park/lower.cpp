// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Names mean three things: a rule of the grammar; a set of points or lines that an argument names
// (a rule of one ScatterCircles, Corners or Parametrise); else a leaf, drawn in a colour that its
// name suggests. Operations that put things into a region leave the region itself to the end of
// the rule, where it becomes the leaf.
#include "dialects/park/lower.h"

#include <algorithm>
#include <set>

#include "base/number.h"
#include "dialects/park/expression.h"

namespace gable::park {

namespace {

using lang::kNoNode;
using lang::NodeId;
using Nodes = std::vector<NodeId>;

constexpr double kPathWidth = 3;
// Of what is swept without saying how wide: a box hedge.
constexpr double kHedgeWidth = 0.6, kHedgeHeight = 1;

bool isFigure(std::string_view op) {
  return op == "romb" || op == "rombcenter" || op == "circle" || op == "square" || op == "rect" ||
         op == "polygon";
}
bool isPointSet(std::string_view op) {
  return op == "scattercircles" || op == "scatter" || op == "corners" || op == "entrances";
}

bool isMaterialWord(std::string_view name) {
  return name.size() > 1 &&
         std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

// What a name looks like.
const char* colourOf(std::string_view name) {
  struct Hint {
    const char* part;
    const char* colour;
  };
  static constexpr Hint kHints[] = {
      {"blue", "#5f8f8f"},   {"tree", "#3f7a34"},   {"bush", "#4a7f3a"},   {"hedge", "#3f7034"},
      {"plant1", "#c86a8a"}, {"plant2", "#c9a24a"}, {"plant", "#8f7ab8"},  {"flower", "#c86a8a"},
      {"cement", "#b5b5b0"}, {"stone", "#a89f92"},  {"path", "#cbbfa6"},   {"fountain", "#8fa8b8"},
      {"water", "#6f9fc0"},  {"centre", "#b8b0a4"}, {"center", "#b8b0a4"}, {"grass", "#6fa854"},
      {"green", "#5f9f4a"},  {"region", "#7fb25f"}, {"park", "#7fb25f"},   {"smooth", "#7fb25f"}};
  const std::string low = lowered(name);
  for (const Hint& h : kHints) {
    if (low.find(h.part) != std::string::npos) return h.colour;
  }
  return "#9a9a92";
}

class Lowering {
 public:
  Lowering(const Grammar& g, uint32_t file, Diagnostics& diagnostics)
      : g_(g), b_(file), diagnostics_(diagnostics) {
    const auto found = g.constants.find("PathWidth");
    pathWidth_ = found != g.constants.end() ? found->second : kPathWidth;
  }

  lang::Tree run(uint32_t size) {
    Nodes rules;
    bool first = true;
    for (const Rule& r : g_.rules) {
      if (r.function || isExpression(r)) continue;
      rules.push_back(rule(r, first));
      first = false;
    }
    return b_.finish(rules, size);
  }

 private:
  // --- Rules ---

  static const Op* onlyOp(const Rule& r) {
    if (r.branches.size() != 1 || r.branches[0].body.size() != 1) return nullptr;
    return &r.branches[0].body[0];
  }
  static bool isExpression(const Rule& r) {
    const Op* op = onlyOp(r);
    return op && op->blocks.empty() && isPointSet(lowered(op->name)) && op->called;
  }

  NodeId rule(const Rule& r, bool start) {
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
      const NodeId condition =
          br.condition.empty() ? kNoNode : expression(g_, br.condition, br.span, b_, diagnostics_);
      branches.emplace_back(condition, steps);
    }
    b_.at(r.nameSpan);
    if (!branches.empty()) {
      if (branches.back().first != kNoNode) {
        branches.emplace_back(kNoNode, b_.sequence({colour(r.name), b_.leaf(r.name)}));
      }
      body = b_.sequence({b_.choice(lang::ChoiceKind::Case, branches)});
    }
    return b_.rule(r.name, notes, body);
  }

  NodeId colour(std::string_view name) { return b_.apply("color", {b_.text(colourOf(name))}); }

  // --- Sequences ---

  // `owner` names the leaf that the region itself becomes; none for parts that stand for nothing.
  NodeId sequence(const Sequence& ops, std::string_view owner) {
    Nodes steps;
    bool open = true;
    for (const Op& op : ops) open = step(op, steps);
    if (open && !owner.empty()) {
      if (!coloured(ops)) steps.push_back(colour(owner));
      steps.push_back(b_.leaf(owner));
    }
    return b_.sequence(steps);
  }
  static bool coloured(const Sequence& ops) {
    return std::any_of(ops.begin(), ops.end(), [](const Op& op) {
      return !op.called && op.blocks.empty() && isMaterialWord(op.name);
    });
  }

  // Adds what an operation becomes; false when the region has been given away by it.
  bool step(const Op& op, Nodes& out) {
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
    if (name == "contract" || name == "insert") return contract(op, out), true;
    if (isFigure(name)) return figure(op, out), true;
    if (name == "place") return place(op, out), true;
    if (name == "distribute") return distribute(op, out), true;
    if (name == "scatter" || name == "scattercircles") return scatter(op, out), true;
    if (name == "sweep" || name == "distributesmooth" || name == "smoothdistribute") {
      return sweep(op, out), true;
    }
    if (name == "parametrise") return lines(op, out), true;
    if (g_.rule(op.name)) {
      out.push_back(b_.apply(op.name));
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

  bool symbol(const Op& op, Nodes& out) {
    const Rule* r = g_.rule(op.name);
    if (r && !r->function) {
      out.push_back(b_.apply(op.name));
      return false;
    }
    if (lowered(op.name) == "grid") return grid(op, out), false;
    if (isMaterialWord(op.name)) {
      out.push_back(colour(op.name));
      return true;
    }
    out.push_back(colour(op.name));
    out.push_back(b_.leaf(op.name));
    return false;
  }

  // --- Blocks ---

  // The parts of an operation's blocks by what they are for: { r } { p } { c }, { r | p | c }, or
  // with names.
  struct Slots {
    std::vector<const Part*> part;
    // Braces with nothing in them, which is not the same as none.
    std::vector<bool> empty;
  };
  Slots slotsOf(const Op& op, const std::vector<std::vector<std::string>>& names) {
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

  NodeId item(const char* word, const Part* p, const char* otherwise) {
    if (p && !p->body.empty()) {
      const NodeId body = sequence(p->body, "Region");
      b_.at(p->span);
      return b_.item(b_.word(word), body);
    }
    return b_.item(b_.word(word), b_.sequence({colour(otherwise), b_.leaf(otherwise)}));
  }
  void addElse(const Op& op, Nodes& items) {
    if (!op.hasElse) return;
    const NodeId body = sequence(op.otherwise, "Region");
    b_.at(op.span);
    items.push_back(b_.item(b_.word("otherwise"), body));
  }

  // --- Arguments ---

  std::string text(const Op& op, size_t i) const {
    return i < op.arguments.size() ? withConstants(g_, op.arguments[i].text) : std::string();
  }
  NodeId number(const Op& op, size_t i, double otherwise) {
    if (i >= op.arguments.size()) return b_.number(otherwise);
    std::string t = op.arguments[i].text;
    if (const size_t name = t.find('='); name != std::string::npos && t.find("==") == t.npos) {
      t = t.substr(name + 1);
    }
    double v = 0;
    if (!t.empty() && (t.front() == '\'' || t.back() == '%')) {
      const bool percent = t.back() == '%';
      const std::string bare = percent ? t.substr(0, t.size() - 1) : t.substr(1);
      if (constantValue(g_, bare, v)) return b_.relative(percent ? v / 100 : v);
    }
    if (constantValue(g_, t, v)) return b_.number(v);
    return expression(g_, t, op.arguments[i].span, b_, diagnostics_);
  }

  // A figure at the head of a sequence, or of the rule that it names alone: "romb(3)".
  std::string figureAtHead(const Sequence& s, bool* own = nullptr, int depth = 0) const {
    if (s.empty() || depth > 20) return {};
    const std::string name = lowered(s[0].name);
    if (isFigure(name) && s[0].called) {
      if (own) *own = depth == 0;
      return figureText(s[0]);
    }
    const Rule* r = s[0].called ? nullptr : g_.rule(s[0].name);
    if (s.size() != 1 || !r || r->branches.size() != 1) return {};
    return figureAtHead(r->branches[0].body, own, depth + 1);
  }
  std::string figureText(const Op& op) const {
    std::string out = lowered(op.name) == "rombcenter" ? "romb" : lowered(op.name);
    out += '(';
    for (size_t i = 0; i < op.arguments.size(); ++i) {
      double v = 0;
      const bool known = constantValue(g_, op.arguments[i].text, v);
      // RombCenter(..) of the sketches.
      out += (i > 0 ? ", " : "") + (known ? shortestText(v) : std::string("3"));
    }
    return out + ')';
  }

  // The operation that an argument names through a rule of its own, or writes itself.
  const Op* expressionRule(const std::string& name) const {
    const Rule* r = g_.rule(name);
    return r ? onlyOp(*r) : nullptr;
  }

  // --- Operations ---

  void grid(const Op& op, Nodes& out) {
    Slots s = slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center", "junction"}});
    std::string junction = "none";
    Part junctionPart;
    bool onPlate = false;
    if (s.part[2] && !s.empty[2]) {
      bool own = false;
      const std::string figure = figureAtHead(s.part[2]->body, &own);
      if (!figure.empty()) junction = figure;
      // The figure itself is what the grid cuts out.
      junctionPart = *s.part[2];
      if (own) {
        // What follows the figure stands on it.
        Op plate;
        plate.name = "Centre";
        plate.span = junctionPart.body[0].span;
        junctionPart.body[0] = plate;
      }
      onPlate = own && junctionPart.body.size() > 1;
      s.part[2] = &junctionPart;
    }
    const bool together = joinedPath(s.part[1], junction);
    std::string options;
    for (size_t i = 2; i < op.arguments.size(); ++i) options += (i > 2 ? " " : "") + text(op, i);
    Nodes arguments;
    for (size_t i = 0; i < 2; ++i) {
      const std::string dim = text(op, i);
      double v = 0;
      if (constantValue(g_, dim, v)) {
        arguments.push_back(b_.number(v));
      } else {
        arguments.push_back(b_.text(dim.empty() && op.arguments.empty() ? "2" : dim));
      }
    }
    arguments.push_back(b_.number(s.empty[1] ? 0 : pathWidth_));
    arguments.push_back(b_.text(junction));
    arguments.push_back(b_.text(options));
    Nodes items{item("region", s.part[0], "Grass")};
    if (together) {
      const NodeId both = b_.choiceOfWords("path", "junction");
      items.push_back(b_.together(both, joinedBody(*s.part[1])));
    } else if (!s.empty[1]) {
      items.push_back(item("path", s.part[1], "Path"));
      items.push_back(onPlate                    ? plateItem(junctionPart)
                      : s.part[2] && !s.empty[2] ? item("junction", s.part[2], "Path")
                                                 : item("junction", s.part[1], "Path"));
    }
    items.push_back(item("remainder", s.part[0], "Grass"));
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("grid", arguments, b_.block(items)));
  }

  // The figure as a leaf of its own, and what stands there.
  NodeId plateItem(const Part& p) {
    const Sequence rest(p.body.begin() + 1, p.body.end());
    b_.at(p.span);
    const NodeId plate = b_.push(b_.sequence({colour("Centre"), b_.leaf("Centre")}));
    const NodeId above = b_.push(sequence(rest, ""));
    b_.at(p.span);
    return b_.item(b_.word("junction"), b_.sequence({plate, above}));
  }

  // { ParkPathCentered }, where that is joined { RombCenter(r) ParkPath }: junctions and paths in
  // one shape.
  bool joinedPath(const Part* path, std::string& junction) const {
    const Op* op = joinedOp(path);
    if (!op || op->blocks.empty() || op->blocks[0].parts.empty()) return false;
    for (const Op& inner : op->blocks[0].parts[0].body) {
      if (isFigure(lowered(inner.name))) junction = figureText(inner);
    }
    return true;
  }
  const Op* joinedOp(const Part* path) const {
    if (!path || path->body.size() != 1) return nullptr;
    const Op* op = &path->body[0];
    if (!op->called && op->blocks.empty()) op = expressionRule(op->name);
    return op && lowered(op->name) == "joined" ? op : nullptr;
  }
  NodeId joinedBody(const Part& path) {
    Sequence rest;
    for (const Op& inner : joinedOp(&path)->blocks[0].parts[0].body) {
      if (!isFigure(lowered(inner.name))) rest.push_back(inner);
    }
    return sequence(rest, "Path");
  }

  void joined(const Op& op, Nodes& out) {
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) {
        const NodeId body = sequence(p.body, rule_->name);
        out.push_back(b_.push(body));
      }
    }
  }

  // A count with a radius: "5 {[5-10]}".
  std::string discs(const std::string& argument) const {
    if (const Op* op = expressionRule(argument)) {
      return op->arguments.empty() ? "1" : withConstants(g_, op->arguments[0].text);
    }
    const size_t bracket = argument.find('(');
    if (bracket != std::string::npos && argument.back() == ')') {
      return withConstants(g_, argument.substr(bracket + 1, argument.size() - bracket - 2));
    }
    return withConstants(g_, argument);
  }

  void voronoi(const Op& op, Nodes& out) {
    const Slots s = slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}});
    const std::string sites = op.arguments.empty() ? "5 {3}" : discs(op.arguments[0].text);
    std::string smooth = text(op, 1), options = text(op, 2);
    if (smooth.find('=') != std::string::npos) std::swap(smooth, options);
    if (smooth.empty()) smooth = "average(2)";
    Nodes items{item("region", s.part[0], "Grass")};
    if (!s.empty[1]) items.push_back(item("path", s.part[1], "Path"));
    if (s.part[2]) items.push_back(item("centre", s.part[2], "Centre"));
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply(
        "voronoi",
        {b_.text(sites), b_.number(s.empty[1] ? 0 : pathWidth_), b_.text(smooth), b_.text(options)},
        b_.block(items)));
  }

  void rays(const Op& op, Nodes& out) {
    // CentrePoint [CentreRegionSize]: brackets give the centre a size.
    std::string source = op.arguments.empty() ? "centre" : op.arguments[0].text, size = "0";
    const size_t bracket = source.find('[');
    if (bracket != std::string::npos && source.back() == ']' &&
        (std::isalpha(static_cast<unsigned char>(source[0])) || source[0] == '_')) {
      size = withConstants(g_, source.substr(bracket + 1, source.size() - bracket - 2));
      source = source.substr(0, source.find_last_not_of(' ', bracket - 1) + 1);
    }
    double v = 0;
    const bool sized = constantValue(g_, size, v) && v > 0;
    const bool middle = lowered(source) == "centre" || lowered(source) == "center";
    std::string targets = op.arguments.size() > 1 ? op.arguments[1].text : "corners";
    if (const Op* t = expressionRule(targets)) targets = lowered(t->name);
    if (lowered(targets).starts_with("corners")) targets = "corners";
    // With a sized centre and two blocks these are { centre } { region }.
    const bool swapped = sized && op.blocks.size() == 2 && op.blocks[0].parts.size() == 1 &&
                         op.blocks[0].parts[0].label.empty();
    const Slots s = swapped ? slotsOf(op, {{"centre", "center"}, {"region"}, {"path", "section"}})
                            : slotsOf(op, {{"region"}, {"path", "section"}, {"centre", "center"}});
    const size_t region = swapped ? 1 : 0, path = swapped ? 2 : 1, centre = swapped ? 0 : 2;
    std::string options;
    for (size_t i = 2; i < op.arguments.size(); ++i) options += (i > 2 ? " " : "") + text(op, i);
    Nodes items{item("region", s.part[region], "Grass")};
    if (!s.empty[path]) items.push_back(item("path", s.part[path], "Path"));
    items.push_back(item("centre", s.part[centre], "Centre"));
    addElse(op, items);
    b_.at(op.span);
    double count = 0;
    const bool counted = constantValue(g_, targets, count);
    out.push_back(b_.apply(
        "castRays",
        {b_.text(middle ? "centre" : discs(source)), counted ? b_.number(count) : b_.text(targets),
         b_.number(s.empty[path] ? 0 : pathWidth_), b_.text(sized ? size : "0"), b_.text(options)},
        b_.block(items)));
  }

  void peel(const Op& op, Nodes& out) {
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
      if (lowered(op.arguments[i].text) == "cornersorthogonal") options = "orthogonal";
    }
    const std::string selection = op.arguments.empty() ? "outer" : text(op, 0);
    Nodes items{item("strip", s.part[0], "Strip"), item("rest", s.part[1], "Grass")};
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("peel", {b_.text(selection), number(sized, 1, 1), b_.text(options)},
                           b_.block(items)));
  }

  void choose(const Op& op, Nodes& out) {
    std::vector<const Part*> parts;
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) parts.push_back(&p);
    }
    if (parts.empty()) return;
    std::vector<double> weights;
    double given = 0, open = 0;
    for (const Part* p : parts) {
      std::string label = p->label;
      if (!label.empty() && label.back() == '%') label.pop_back();
      double w = -1;
      if (!constantValue(g_, label, w)) w = -1;
      weights.push_back(w);
      given += std::max(0.0, w);
      open += w < 0;
    }
    const double each = open > 0 ? std::max(0.0, 100 - given) / open : 0;
    std::vector<std::pair<NodeId, NodeId>> branches;
    for (size_t i = 0; i < parts.size(); ++i) {
      const NodeId body = sequence(parts[i]->body, rule_->name);
      b_.at(op.span);
      const bool last = i + 1 == parts.size();
      const double w = weights[i] < 0 ? each : weights[i] * (given > 100 ? 100 / given : 1);
      branches.emplace_back(last ? kNoNode : b_.number(w), body);
    }
    if (branches.size() == 1) {
      out.push_back(b_.push(branches[0].second));
    } else {
      out.push_back(b_.choice(lang::ChoiceKind::Percent, branches));
    }
  }

  void model(const Op& op, Nodes& out) {
    std::string file = op.arguments.empty() ? "" : op.arguments[0].text;
    std::erase_if(file, [](char c) { return c == '"'; });
    while (!file.empty() && file.front() == ' ') file.erase(0, 1);
    while (!file.empty() && file.back() == ' ') file.pop_back();
    std::vector<std::string> tries{file};
    if (file.find('.') == std::string::npos) tries = {file + ".obj", file + ".glb", file + ".gltf"};
    const auto inserted = [&](const std::string& path) {
      return b_.apply("i", {b_.text(path), b_.word("yUp"), b_.word("keepSizeAlignPosition")});
    };
    std::vector<std::pair<NodeId, NodeId>> branches;
    const std::string name = rule_->name;
    for (const std::string& path : tries) {
      branches.emplace_back(b_.call("fileExists", {b_.text(path)}),
                            b_.sequence({inserted(path), b_.leaf(name)}));
    }
    // What is missing is reported, and a box stands for it.
    branches.emplace_back(kNoNode, b_.sequence({inserted(tries[0]), inserted("builtin:cube"),
                                                colour(name), b_.leaf(name)}));
    out.push_back(b_.choice(lang::ChoiceKind::Case, branches));
  }

  void innerRect(const Op& op, Nodes& out) {
    const Slots s = slotsOf(op, {{"shape"}, {"remainder", "rest"}});
    const std::string along = lowered(text(op, 0)) == "edge" ? "edge" : "scope";
    const Nodes items{item("shape", s.part[0], "Shape"), item("remainder", s.part[1], "Grass")};
    out.push_back(b_.apply("innerRectangle", {b_.word(along)}, b_.block(items)));
  }

  void contract(const Op& op, Nodes& out) {
    Nodes arguments{number(op, 0, 1)};
    const std::string towards = lowered(text(op, 1));
    if (towards == "centre" || towards == "center") arguments.push_back(b_.word("centre"));
    out.push_back(b_.apply("contract", arguments));
  }

  void figure(const Op& op, Nodes& out) {
    const std::string name = lowered(op.name);
    Nodes arguments;
    for (size_t i = 0; i < op.arguments.size(); ++i) arguments.push_back(number(op, i, 1));
    if (arguments.empty()) arguments.push_back(b_.number(1));
    out.push_back(b_.apply(name == "rombcenter" ? "romb"
                           : name == "polygon"  ? "regularPolygon"
                                                : name,
                           arguments));
  }

  NodeId things(const Op& op) {
    NodeId body = kNoNode;
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) body = sequence(p.body, "Thing");
    }
    b_.at(op.span);
    return b_.block({b_.item(kNoNode, body != kNoNode ? body : b_.sequence({}))});
  }
  std::string figureOfBlock(const Op& op) const {
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) {
        const std::string f = figureAtHead(p.body);
        if (!f.empty()) return f;
      }
    }
    return "none";
  }

  static bool hasFlag(const Op& op, std::string_view flag) {
    return std::any_of(op.arguments.begin(), op.arguments.end(),
                       [&](const Argument& a) { return lowered(a.text) == flag; });
  }

  void place(const Op& op, Nodes& out) {
    std::string where = op.arguments.empty() ? "centre" : text(op, 0);
    if (where.find(':') != std::string::npos && where.find('(') != 0) return distribute(op, out);
    if (lowered(where) == "centre" || lowered(where) == "center") where = "centre";
    const NodeId block = things(op);
    out.push_back(b_.apply(
        "place",
        {b_.text(where), b_.text(figureOfBlock(op)), b_.text(hasFlag(op, "over") ? "over" : "")},
        block));
  }

  // sel : inset, positions
  void distribute(const Op& op, Nodes& out) {
    std::string selection = op.arguments.empty() ? "all" : text(op, 0);
    double inset = 0;
    if (const size_t colon = selection.find(':'); colon != std::string::npos) {
      constantValue(g_, std::string_view(selection).substr(colon + 1), inset);
      selection.resize(colon);
    }
    const NodeId block = things(op);
    double spacing = 1;
    const std::string positions = text(op, 1);
    const bool spaced = positions.empty() || constantValue(g_, positions, spacing);
    out.push_back(b_.apply(
        "distribute",
        {b_.text(selection), spaced ? b_.number(spacing) : b_.text(positions), b_.number(inset),
         b_.text(figureOfBlock(op)), b_.text(hasFlag(op, "over") ? "over" : "")},
        block));
  }

  void scatter(const Op& op, Nodes& out) {
    const std::string what = op.arguments.empty() ? "1 {1}" : text(op, 0);
    std::string count = what, radius = "1";
    if (const size_t brace = what.find('{'); brace != std::string::npos) {
      count = what.substr(0, brace);
      radius = what.substr(brace + 1, what.find('}') - brace - 1);
    }
    double n = 0;
    if (count.find_first_not_of(' ') != std::string::npos && !constantValue(g_, count, n)) {
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
        b_.apply("scatterCircles", {b_.number(n), b_.text(radius), b_.text(options)}, block));
  }

  // Lines that an argument means: a function of the grammar, a Parametrise, or a selection.
  struct Lines {
    std::string ranges;
    double inset = 0;
    std::string figure;
  };
  Lines linesOf(const std::string& argument, int depth = 0) {
    Lines l;
    l.ranges = withConstants(g_, argument);
    std::string name = argument.substr(0, argument.find('('));
    while (!name.empty() && name.back() == ' ') name.pop_back();
    const Rule* r = g_.rule(name);
    const Op* op = r ? onlyOp(*r) : nullptr;
    if (!op || depth > 20) return l;
    return linesOf(*op);
  }
  Lines linesOf(const Op& op) {
    Lines l;
    for (const Argument& a : op.arguments) {
      const std::string word = lowered(a.text.substr(0, a.text.find('(')));
      if (isFigure(word) && a.text.back() == ')') {
        l.figure = withConstants(g_, a.text);
      } else if (lowered(a.text) != "perimeter") {
        l.ranges += (l.ranges.empty() ? "" : " ") + withConstants(g_, a.text);
      }
    }
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) {
        for (const Op& inner : p.body) {
          double v = 0;
          if (lowered(inner.name) == "contract" && !inner.arguments.empty() &&
              constantValue(g_, inner.arguments[0].text, v)) {
            l.inset = v;
          }
        }
      }
    }
    return l;
  }

  void sweep(const Op& op, Nodes& out) {
    const Lines l = linesOf(op.arguments.empty() ? std::string("all") : op.arguments[0].text);
    double width = kHedgeWidth, height = 0;
    std::string options;
    for (size_t i = 1; i < op.arguments.size(); ++i) {
      const std::string a = lowered(op.arguments[i].text);
      const size_t equals = a.find('=');
      const std::string value =
          equals != std::string::npos ? op.arguments[i].text.substr(equals + 1) : "";
      if (a.starts_with("width")) constantValue(g_, value, width);
      if (a.starts_with("height")) constantValue(g_, value, height);
      if (a.find("round") != std::string::npos) options = "round";
    }
    // What has no rule is a hedge.
    Nodes body;
    for (const Block& b : op.blocks) {
      for (const Part& p : b.parts) {
        const bool bare = p.body.size() == 1 && !p.body[0].called && !g_.rule(p.body[0].name);
        if (bare || height > 0) {
          b_.at(p.span);
          body.push_back(b_.apply("extrude", {b_.number(height > 0 ? height : kHedgeHeight)}));
        }
        body.push_back(b_.push(sequence(p.body, "Hedge")));
      }
    }
    b_.at(op.span);
    out.push_back(b_.apply(
        "sweep", {b_.text(l.ranges), b_.number(width), b_.number(l.inset), b_.text(options)},
        b_.block({b_.item(kNoNode, b_.sequence(body))})));
  }

  void lines(const Op& op, Nodes& out) {
    Op bare = op;
    bare.blocks.clear();
    const Lines l = linesOf(bare);
    if (!l.figure.empty()) {
      const size_t bracket = l.figure.find('(');
      Op shape;
      shape.name = l.figure.substr(0, bracket);
      shape.span = op.span;
      shape.arguments.push_back(
          {l.figure.substr(bracket + 1, l.figure.size() - bracket - 2), op.span});
      figure(shape, out);
    }
    const NodeId block = op.blocks.empty()
                             ? b_.block({b_.item(kNoNode, b_.sequence({b_.leaf("Line")}))})
                             : things(op);
    out.push_back(b_.apply("parametrise", {b_.text(l.ranges), b_.number(0)}, block));
  }

  const Grammar& g_;
  gbbg::TreeBuilder b_;
  Diagnostics& diagnostics_;
  const Rule* rule_ = nullptr;
  double pathWidth_ = kPathWidth;
};

}  // namespace

lang::Tree lower(const Grammar& grammar, uint32_t file, uint32_t size, Diagnostics& diagnostics) {
  return Lowering(grammar, file, diagnostics).run(size);
}

}  // namespace gable::park
