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
#include "dialects/park/meanings.h"

namespace gable::park {

namespace {

using lang::kNoNode;
using lang::NodeId;
using Nodes = std::vector<NodeId>;

constexpr double kPathWidth = 3;
// Of what is swept without saying how wide: a box hedge.
constexpr double kHedgeWidth = 0.6, kHedgeHeight = 1;

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
      if (r.function || isPointSet(r)) continue;
      rules.push_back(rule(r, first));
      first = false;
    }
    return b_.finish(rules, size);
  }

 private:
  // --- Rules ---

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
    if (name == "select") return select(op, out), false;
    if (name == "quadmap") return quadMap(op, out), false;
    if (name == "contract") return contract(op, out), true;
    if (name == "insert") return insert(op, out), true;
    if (name == "noholes") return out.push_back(b_.applyBare("cutHoles")), true;
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

  bool symbol(const Op& op, Nodes& out) {
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

  void call(const Rule& r, const Op& op, Nodes& out) {
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

  // The steps of a function, with the arguments in the place of its parameters.
  bool inlined(const Rule& r, const Op& op, Nodes& out) {
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
    return i < op.arguments.size() ? constants(op.arguments[i].text) : std::string();
  }
  // With constants in the place of their names; a parameter of the rule hides a constant.
  std::string constants(const std::string& text) const {
    if (rule_->parameters.empty()) return withConstants(g_, text);
    Grammar rest;
    rest.constants = g_.constants;
    for (const std::string& p : rule_->parameters) rest.constants.erase(p);
    return withConstants(rest, text);
  }
  NodeId expressionOf(std::string_view text, Span span) {
    return expression(g_, rule_->parameters, text, span, b_, diagnostics_);
  }
  // A number that is known before the rule runs.
  bool known(std::string_view text, double& value) const {
    for (const std::string& p : rule_->parameters) {
      if (withWords(text, {{p, ""}}) != text) return false;
    }
    return constantValue(g_, text, value);
  }
  bool isParameter(const std::string& word) const {
    const auto& all = rule_->parameters;
    return std::find(all.begin(), all.end(), word) != all.end();
  }
  // A text in which parameters of the rule stand is put together when the rule runs.
  NodeId textNode(const std::string& text) {
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
  NodeId number(const Op& op, size_t i, double otherwise) {
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

  // --- Operations ---

  void grid(const Op& op, Nodes& out) {
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
    Nodes items{item("region", s.part[0], "Grass")};
    if (together) {
      const NodeId both = b_.choiceOfWords("path", "junction");
      items.push_back(b_.together(both, sequence(joinedRest, "Path")));
    } else if (!s.empty[1]) {
      items.push_back(item("path", s.part[1], "Path"));
      items.push_back(!choices.parts.empty()     ? choiceItem(choices, s.part[1])
                      : onPlate                  ? plateItem(junctionPart)
                      : s.part[2] && !s.empty[2] ? item("junction", s.part[2], "Path")
                                                 : item("junction", s.part[1], "Path"));
    }
    items.push_back(item("remainder", s.part[0], "Grass"));
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("grid", arguments, b_.block(items)));
  }

  // The figure at the head of a part. The figure itself is what the grid cuts out; what follows it
  // stands on it.
  std::string headOf(Part& part, bool& onPlate) {
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

  // What stands at a junction depends on which of several figures it is.
  NodeId choiceItem(const JunctionChoices& choices, const Part* path) {
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
    const NodeId plain = path && !path->body.empty()
                             ? sequence(path->body, "Path")
                             : b_.sequence({colour("Path"), b_.leaf("Path")});
    branches.emplace_back(kNoNode, plain);
    const NodeId which = b_.choice(lang::ChoiceKind::Case, branches);
    return b_.item(b_.word("junction"), b_.sequence({which}));
  }

  // The figure as a leaf of its own, and what stands there.
  NodeId plateBody(const Part& p) {
    const Sequence rest(p.body.begin() + 1, p.body.end());
    b_.at(p.span);
    const NodeId plate = b_.push(b_.sequence({colour("Centre"), b_.leaf("Centre")}));
    const NodeId above = b_.push(sequence(rest, ""));
    b_.at(p.span);
    return b_.sequence({plate, above});
  }
  NodeId plateItem(const Part& p) { return b_.item(b_.word("junction"), plateBody(p)); }

  // The region becomes the figures in one; what else stands in the braces is done with that.
  void joined(const Op& op, Nodes& out) {
    const Joined j = joinedParts(g_, op);
    if (!j.figures.empty()) out.push_back(b_.apply("joined", {textNode(j.figures)}));
    bool open = true;
    for (const Op& inner : j.rest) open = step(inner, out);
    if (open) {
      out.push_back(colour(rule_->name));
      out.push_back(b_.leaf(rule_->name));
    }
  }

  // Each part takes the region when its selection means an edge of it; the first that does.
  void select(const Op& op, Nodes& out) {
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

  void quadMap(const Op& op, Nodes& out) {
    const Slots s = slotsOf(op, {{"region"}, {"remainder", "rest"}});
    Nodes items{item("region", s.part[0], "Grass"),
                item("remainder", s.part[1] ? s.part[1] : s.part[0], "Grass")};
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("quadMap", {number(op, 0, 2), number(op, 1, 2)}, b_.block(items)));
  }

  void voronoi(const Op& op, Nodes& out) {
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
    Nodes items{item("region", s.part[0], "Grass")};
    if (!s.empty[1]) items.push_back(item("path", s.part[1], "Path"));
    if (s.part[3]) items.push_back(item("junction", s.part[3], "Path"));
    if (s.part[2]) items.push_back(item("centre", s.part[2], "Centre"));
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("voronoi",
                           {textNode(sites), b_.number(s.empty[1] ? 0 : pathWidth_),
                            textNode(smooth), textNode(options)},
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
    const bool sized = known(size, v) && v > 0;
    const bool middle = lowered(source) == "centre" || lowered(source) == "center";
    std::string targets = op.arguments.size() > 1 ? op.arguments[1].text : "corners";
    if (const Op* t = onlyOp(g_, targets)) {
      targets = lowered(t->name) + "(";
      for (const Argument& a : t->arguments) targets += a.text + " ";
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
    Nodes items{item("region", s.part[region], "Grass")};
    if (!s.empty[path]) items.push_back(item("path", s.part[path], "Path"));
    items.push_back(item("centre", s.part[centre], "Centre"));
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
      if (lowered(op.arguments[i].text) == "cornersorthogonal") options = "orthogonal ";
    }
    std::string smooth;
    for (const Argument& a : op.arguments) {
      if (lowered(a.text).starts_with("smooth=")) smooth = constants(a.text);
    }
    options += smooth;
    const std::string selection = op.arguments.empty() ? "outer" : text(op, 0);
    Nodes items{item("strip", s.part[0], "Strip"), item("rest", s.part[1], "Grass")};
    addElse(op, items);
    b_.at(op.span);
    const bool own = selection.find('{') != std::string::npos;
    out.push_back(b_.apply(
        "peel", {textNode(selection), own ? b_.number(0) : number(sized, 1, 1), textNode(options)},
        b_.block(items)));
  }

  void choose(const Op& op, Nodes& out) {
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
      // Models have colours of their own.
      const NodeId white = b_.apply("color", {b_.text("#ffffff")});
      branches.emplace_back(b_.call("fileExists", {b_.text(path)}),
                            b_.sequence({white, inserted(path), b_.leaf(name)}));
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

  // With a centre, what is 0.9 or less is a share of the way to it.
  void contract(const Op& op, Nodes& out) {
    const std::string towards = lowered(text(op, 1));
    const bool centre = towards == "centre" || towards == "center";
    double v = 0;
    const bool share = centre && known(text(op, 0), v) && v <= 0.9;
    Nodes arguments{share ? b_.relative(v) : number(op, 0, 1)};
    if (centre && !share) arguments.push_back(b_.word("centre"));
    Nodes items;
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("contract", arguments, items.empty() ? kNoNode : b_.block(items)));
  }

  // Cuts discs off the outer corners.
  void insert(const Op& op, Nodes& out) {
    const std::string radius = op.arguments.empty() ? "1" : text(op, 0);
    const NodeId nothing = b_.sequence({b_.apply("NIL")});
    Nodes items{b_.item(kNoNode, nothing)};
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply("place", {b_.text("corner(outer)"), textNode("circle(" + radius + ")")},
                           b_.block(items)));
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
    Nodes items{b_.item(kNoNode, body != kNoNode ? body : b_.sequence({}))};
    addElse(op, items);
    b_.at(op.span);
    return b_.block(items);
  }
  static std::string flagsOf(const Op& op) {
    std::string out;
    for (const Argument& a : op.arguments) {
      const std::string word = lowered(a.text);
      if (word == "over" || word == "split" || word == "align") {
        out += (out.empty() ? "" : " ") + word;
      }
    }
    return out;
  }

  void place(const Op& op, Nodes& out) {
    std::string where = op.arguments.empty() ? "centre" : text(op, 0);
    if (where.find(':') != std::string::npos && where.find('(') != 0) return distribute(op, out);
    if (lowered(where) == "centre" || lowered(where) == "center") where = "centre";
    const NodeId block = things(op);
    out.push_back(b_.apply(
        "place", {textNode(where), textNode(figureOfBlock(g_, op)), b_.text(flagsOf(op))}, block));
  }

  // sel : inset, positions
  void distribute(const Op& op, Nodes& out) {
    std::string selection = op.arguments.empty() ? "all" : text(op, 0);
    NodeId inset = b_.number(0);
    if (const size_t colon = selection.find(':'); colon != std::string::npos) {
      Op by = op;
      by.arguments[0].text = selection.substr(colon + 1);
      inset = number(by, 0, 0);
      selection.resize(colon);
    }
    const NodeId block = things(op);
    double spacing = 1;
    const std::string positions = text(op, 1);
    const bool spaced = positions.empty() || known(positions, spacing);
    out.push_back(b_.apply("distribute",
                           {textNode(selection), spaced ? b_.number(spacing) : textNode(positions),
                            inset, textNode(figureOfBlock(g_, op)), b_.text(flagsOf(op))},
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

  void sweep(const Op& op, Nodes& out) {
    const Lines l = linesOf(g_, op.arguments.empty() ? std::string("all") : op.arguments[0].text);
    double width = kHedgeWidth, height = 0;
    std::string options;
    for (size_t i = 1; i < op.arguments.size(); ++i) {
      const std::string a = lowered(op.arguments[i].text);
      const size_t equals = a.find('=');
      const std::string value =
          equals != std::string::npos ? op.arguments[i].text.substr(equals + 1) : "";
      if (a.starts_with("width")) known(value, width);
      if (a.starts_with("height")) known(value, height);
      if (a == "round") options += "round ";
      if (a.starts_with("joins") || a.starts_with("ends")) options += a + " ";
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
    Nodes items{b_.item(kNoNode, b_.sequence(body))};
    addElse(op, items);
    b_.at(op.span);
    out.push_back(b_.apply(
        "sweep", {textNode(l.ranges), b_.number(width), b_.number(l.inset), b_.text(options)},
        b_.block(items)));
  }

  void lines(const Op& op, Nodes& out) {
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
    const bool moved = l.inset > 0 && parts.size() == 1 && parts[0].body.size() == 1;
    const NodeId block = op.blocks.empty() || moved
                             ? b_.block({b_.item(kNoNode, b_.sequence({b_.leaf("Line")}))})
                             : things(op);
    out.push_back(
        b_.apply("parametrise", {textNode(l.ranges), b_.number(moved ? l.inset : 0)}, block));
  }

  const Grammar& g_;
  gbbg::TreeBuilder b_;
  Diagnostics& diagnostics_;
  const Rule* rule_ = nullptr;
  double pathWidth_ = kPathWidth;
  // Functions within functions.
  int functions_ = 0;
};

}  // namespace

lang::Tree lower(const Grammar& grammar, uint32_t file, uint32_t size, Diagnostics& diagnostics) {
  return Lowering(grammar, file, diagnostics).run(size);
}

}  // namespace gable::park
