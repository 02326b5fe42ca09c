// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The rules of a symbol become one rule of its name. A terminal becomes a leaf, or a rule where it
// has an asset or prefers a size; EMPTY becomes NIL. The axiom becomes the start rule.

#include "dialects/gbbg/lower.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/hash.h"
#include "dialects/gbbg/names.h"
#include "dialects/gbbg/tree_builder.h"

namespace gable::gbbg {

namespace {

using lang::NodeId;
using Nodes = TreeBuilder::Nodes;

const char* axisWord(Axis a) { return a == Axis::X ? "x" : a == Axis::Y ? "y" : "z"; }

// What each chance comes to in percent. Those whose sum is no number count by their share of the
// largest.
std::vector<double> percentsOf(std::vector<double> chances) {
  constexpr double kLarge = 1e300;
  const double most = *std::max_element(chances.begin(), chances.end());
  double sum = 0;
  for (double& c : chances) {
    if (most > kLarge) c /= most;
    sum += c;
  }
  for (double& c : chances) c = 100 * c / sum;
  return chances;
}

// A light colour for each name, so that symbols can be told apart before they have assets.
std::string colourOf(std::string_view name) {
  constexpr uint64_t kHues = 24, kSteps = 6;
  const uint64_t hue = hashBytes(name) % kHues, sixth = hue / (kHues / kSteps);
  const uint64_t rise = hue % (kHues / kSteps) * 24;
  constexpr uint64_t kLow = 136, kHigh = 232;
  const uint64_t up = kLow + rise, down = kHigh - rise;
  const uint64_t wheel[kSteps][3] = {{kHigh, up, kLow},   {down, kHigh, kLow}, {kLow, kHigh, up},
                                     {kLow, down, kHigh}, {up, kLow, kHigh},   {kHigh, kLow, down}};
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out = "#";
  for (const uint64_t v : wheel[sixth]) {
    out += kHex[v / 16];
    out += kHex[v % 16];
  }
  return out;
}

class Lowering {
 public:
  Lowering(const Grammar& grammar, Vocabulary& vocabulary, const Catalogue& catalogue,
           uint32_t file)
      : grammar_(grammar), vocabulary_(vocabulary), names_(catalogue), t_(file) {}

  lang::Tree run(uint32_t size);

 private:
  // --- Declarations ---
  void attributes();
  void axiom();
  NodeId startOf(const Start& s);
  void ruleOf(const SymbolInfo& s);
  void terminalRule(const SymbolInfo& s);
  Nodes notesOf(const SymbolInfo& s);

  // --- Bodies ---
  NodeId bodyOf(const Rule& r);
  Nodes scope(const Rule& r);
  void translate(const Change& c, Nodes& out);
  void rotate(const Change& c, Nodes& out);
  void scale(const Change& c, Nodes& out);
  NodeId split(const Rule& r);
  NodeId fitted(const Rule& r, const char* operation);
  NodeId margin(const Rule& r);
  Nodes component(const Rule& r);

  // --- Successors ---
  NodeId slotOf(const Slot& slot, bool flat, Nodes before = {});
  NodeId possibilityOf(const Possibility& p, bool flat, Nodes body);
  void addSymbol(const SymbolInfo& s, Nodes& out);
  NodeId colour(const SymbolInfo& s);
  Nodes boxOf(const SymbolInfo& s);

  NodeId move(NodeId z) { return t_.apply("t", {t_.number(0), t_.number(0), z}); }
  /// To the corner that is the root in GBBG, and back.
  NodeId toRoot() { return move(t_.relative(1)); }
  NodeId fromRoot() { return move(t_.relative(-1)); }
  /// Without texture coordinates a box stays one when it is divided.
  NodeId cube() { return t_.apply("i", {t_.text("builtin:cube:notex")}); }
  NodeId turn(double x, double y, double z) {
    return t_.apply("rotateScope", {t_.word("scope"), t_.number(x), t_.number(y), t_.number(z)});
  }

  const Grammar& grammar_;
  Vocabulary& vocabulary_;
  Names names_;
  TreeBuilder t_;
  Nodes declarations_;
  /// What World and Set count from: the rounded mean of the start shapes' places.
  Triple root_{};
};

// --- Declarations ---

lang::Tree Lowering::run(uint32_t size) {
  // Symbols come before what has to be named besides them.
  for (const SymbolInfo& s : vocabulary_.symbols) names_.of(s.name);
  attributes();
  axiom();
  for (const SymbolInfo& s : vocabulary_.symbols) {
    if (!s.rules.empty()) {
      ruleOf(s);
    } else if (s.asset || s.preferred != Triple{}) {
      terminalRule(s);
    }
  }
  return t_.finish(declarations_, size);
}

void Lowering::attributes() {
  double height = 10;
  bool onFootprint = vocabulary_.starts.empty();
  for (const Start* s : vocabulary_.starts) {
    onFootprint = onFootprint || s->onFootprint;
    if (s->heightWritten) height = s->height;
  }
  if (onFootprint) declarations_.push_back(t_.attribute("height", t_.number(height)));
  for (const SymbolInfo& s : vocabulary_.symbols) {
    if (!s.asset) continue;
    declarations_.push_back(t_.attribute("postProcess", t_.boolean(true)));
    break;
  }
}

void Lowering::axiom() {
  Start onFootprint;
  onFootprint.symbol.text = "START";
  onFootprint.onFootprint = true;
  std::vector<const Start*> starts = vocabulary_.starts;
  if (starts.empty()) starts.push_back(&onFootprint);
  for (size_t i = 0; i < 3; ++i) {
    for (const Start* s : starts) root_[i] += s->at[i] / static_cast<double>(starts.size());
    root_[i] = std::nearbyint(root_[i]);
  }
  // Assets fill their scopes: no neighbour trims them.
  Nodes body = {t_.apply("set", {t_.word("trim.vertical"), t_.boolean(false)})};
  for (const Start* s : starts) body.push_back(startOf(*s));
  const NodeId note = t_.annotation("StartRule", {});
  declarations_.push_back(t_.rule(names_.fresh("Axiom"), {note}, t_.sequence(body)));
}

NodeId Lowering::startOf(const Start& s) {
  t_.at(s.symbol.span);
  Nodes body;
  if (s.onFootprint) {
    body.push_back(t_.apply("s", {t_.relative(1), t_.word("height"), t_.relative(1)}));
    body.push_back(cube());
  } else {
    body.push_back(t_.apply("translate", {t_.word("abs"), t_.word("object"), t_.number(s.at[0]),
                                          t_.number(s.at[1]), t_.number(-s.at[2])}));
    body.push_back(t_.apply("rotate", {t_.word("abs"), t_.word("object"), t_.number(0),
                                       t_.number(-s.rotate[1]), t_.number(0)}));
    Change rest;
    rest.value = {s.rotate[0], 0, s.rotate[2]};
    rotate(rest, body);
    // A size of zero makes a face of the cube.
    Triple size = s.size;
    bool flat = false;
    for (double& v : size) {
      flat = flat || v == 0;
      if (v == 0) v = 1;
    }
    body.push_back(t_.apply("s", {t_.number(size[0]), t_.number(size[1]), t_.number(size[2])}));
    body.push_back(cube());
    body.push_back(fromRoot());
    if (flat) {
      body.push_back(t_.apply("resize", {t_.word("set"), t_.number(s.size[0]), t_.number(s.size[1]),
                                         t_.number(s.size[2]), t_.word("front")}));
    }
  }
  const SymbolInfo* info = vocabulary_.find(s.symbol.text);
  if (info)
    addSymbol(*info, body);
  else
    body.push_back(t_.leaf(names_.of(s.symbol.text)));
  return t_.push(t_.sequence(body));
}

Nodes Lowering::notesOf(const SymbolInfo& s) {
  if (s.preferred == Triple{}) return {};
  Nodes sizes;
  for (const double v : s.preferred) sizes.push_back(t_.number(v));
  return {t_.annotation("PreferredSize", sizes)};
}

void Lowering::ruleOf(const SymbolInfo& s) {
  t_.at(s.rules[0]->predecessor.span);
  const Nodes notes = notesOf(s);
  const bool weighted = vocabulary_.selection == Selection::Weighted;
  std::vector<double> weights;
  for (const Rule* r : s.rules) weights.push_back(weighted ? r->weight : 1);
  const bool some = *std::max_element(weights.begin(), weights.end()) > 0;
  const size_t count = vocabulary_.selection == Selection::First || !some ? 1 : s.rules.size();
  if (count > 1) weights = percentsOf(weights);
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (size_t i = 0; i < count; ++i) {
    const Rule& r = *s.rules[i];
    const NodeId weight = i + 1 < count ? t_.number(weights[i]) : lang::kNoNode;
    branches.emplace_back(weight, bodyOf(r));
  }
  t_.at(s.rules[0]->predecessor.span);
  const NodeId body = count == 1 ? branches[0].second
                                 : t_.sequence({t_.choice(lang::ChoiceKind::Percent, branches)});
  declarations_.push_back(t_.rule(names_.of(s.name), notes, body));
}

void Lowering::terminalRule(const SymbolInfo& s) {
  t_.at(s.span);
  const Nodes notes = notesOf(s);
  Nodes body;
  if (s.asset) {
    t_.at(s.asset->symbol.span);
    Nodes arguments = {t_.text(s.asset->path)};
    if (!s.asset->fitBounds) {
      arguments.push_back(t_.word("yUp"));
      arguments.push_back(t_.word("unitCube"));
    }
    const NodeId with = t_.sequence({t_.apply("i", arguments)});
    const NodeId without = t_.sequence(boxOf(s));
    body.push_back(t_.choice(lang::ChoiceKind::Case,
                             {{t_.word("postProcess"), with}, {lang::kNoNode, without}}));
  } else {
    body.push_back(colour(s));
  }
  t_.at(s.span);
  declarations_.push_back(t_.rule(names_.of(s.name), notes, t_.sequence(body)));
}

// --- Bodies ---

NodeId Lowering::bodyOf(const Rule& r) {
  t_.at(r.opSpan);
  switch (r.op) {
    case Operator::Scope: {
      Nodes body = scope(r);
      return slotOf(r.slots[0], false, std::move(body));
    }
    case Operator::Split: return t_.sequence({split(r)});
    case Operator::Repeat: return t_.sequence({fitted(r, "splitRepeat")});
    case Operator::Grid: return t_.sequence({fitted(r, "splitGrid")});
    case Operator::Margin: return t_.sequence({margin(r)});
    case Operator::Component: return t_.sequence(component(r));
  }
  return t_.sequence({});
}

Nodes Lowering::scope(const Rule& r) {
  Nodes out;
  if (r.translate.written && r.translate.on) translate(r.translate, out);
  if (r.rotate.written && r.rotate.on) {
    out.push_back(toRoot());
    rotate(r.rotate, out);
    out.push_back(fromRoot());
  }
  if (r.scale.written && r.scale.on) scale(r.scale, out);
  return out;
}

void Lowering::translate(const Change& c, Nodes& out) {
  const Triple& v = c.value;
  if (c.set) {
    out.push_back(
        t_.apply("translate", {t_.word("abs"), t_.word("object"), t_.number(root_[0] + v[0]),
                               t_.number(root_[1] + v[1]), t_.number(-(root_[2] + v[2]))}));
    out.push_back(fromRoot());
    return;
  }
  out.push_back(t_.apply("translate", {t_.word("rel"), t_.word(c.world ? "object" : "scope"),
                                       t_.number(v[0]), t_.number(v[1]), t_.number(-v[2])}));
}

// Unity turns about z, then x, then y, each about a fixed axis: R = Ry Rx Rz. One operation an
// axis, in that order about the root's axes, and in the opposite order about the scope's own.
void Lowering::rotate(const Change& c, Nodes& out) {
  const Triple mirrored = {-c.value[0], -c.value[1], c.value[2]};
  const auto turnAbout = [&](size_t axis, const char* mode, const char* system) {
    Nodes arguments = {t_.word(mode), t_.word(system)};
    for (size_t i = 0; i < 3; ++i) arguments.push_back(t_.number(i == axis ? mirrored[i] : 0));
    out.push_back(t_.apply("rotate", arguments));
  };
  const auto turnUnlessZero = [&](size_t axis, const char* system) {
    if (mirrored[axis] != 0) turnAbout(axis, "rel", system);
  };
  if (c.world && !c.set) {
    for (const size_t axis : {2u, 0u, 1u}) turnUnlessZero(axis, "object");
    return;
  }
  if (c.set) turnAbout(1, "abs", "object");
  if (!c.set) turnUnlessZero(1, "scope");
  for (const size_t axis : {0u, 2u}) turnUnlessZero(axis, "scope");
}

void Lowering::scale(const Change& c, Nodes& out) {
  Nodes arguments = {t_.word(c.set ? "set" : c.relative ? "multiply" : "add")};
  for (const double v : c.value) {
    // -1 leaves the axis alone.
    arguments.push_back(c.set && v == -1 ? t_.relative(1) : t_.number(v));
  }
  arguments.push_back(t_.word("front"));
  out.push_back(t_.apply("resize", arguments));
}

NodeId Lowering::split(const Rule& r) {
  Nodes items;
  for (size_t i = 0; i < r.slots.size(); ++i) {
    const bool last = i == r.points.size();
    const NodeId body = slotOf(r.slots[i], false);
    t_.at(r.opSpan);
    items.push_back(t_.item(last ? t_.floating(1) : t_.number(r.points[i]), body));
  }
  const bool toRoot = r.toRoot != (r.axis == Axis::Z);
  return t_.apply("split", {t_.word(axisWord(r.axis)), t_.word(toRoot ? "toRoot" : "fromRoot")},
                  t_.block(items));
}

NodeId Lowering::fitted(const Rule& r, const char* operation) {
  const NodeId body = slotOf(r.slots[0], false);
  t_.at(r.opSpan);
  return t_.apply(operation, {t_.word(axisWord(r.axis)), t_.word("even")},
                  t_.block({t_.item(lang::kNoNode, body)}));
}

// Facing pieces have the axes that the mirrored table asks for: see the frames in lower.h.
NodeId Lowering::margin(const Rule& r) {
  const bool turned = r.orientation != Orientation::Default;
  Nodes corner, edge;
  if (turned && r.axis == Axis::Y) {
    corner.push_back(turn(0, -90, 0));
    edge.push_back(turn(0, 180, 0));
  }
  if (turned && r.axis == Axis::X) corner.push_back(turn(90, 0, 0));
  Nodes items = {t_.item(t_.word("corner"), slotOf(r.slots[0], false, corner)),
                 t_.item(t_.word("edge"), slotOf(r.slots[1], false, edge))};
  if (r.center) items.push_back(t_.item(t_.word("center"), slotOf(r.slots[2], false)));
  t_.at(r.opSpan);
  static constexpr const char* kOrientations[] = {"default", "out", "in"};
  return t_.apply("margin",
                  {t_.word(axisWord(r.axis)),
                   r.relativeMargin && r.margin > 0 ? t_.relative(r.margin) : t_.number(r.margin),
                   t_.word(kOrientations[static_cast<size_t>(r.orientation)])},
                  t_.block(items));
}

// The axis of the rule becomes y, the other axes follow in the cycle x y z.
Nodes Lowering::component(const Rule& r) {
  Nodes out;
  if (r.axis == Axis::X) out.push_back(turn(0, 90, -90));
  if (r.axis == Axis::Z) out.push_back(turn(-90, 0, 90));
  Nodes items;
  size_t next = 0;
  const auto add = [&](bool wanted, const char* selector) {
    if (!wanted) return;
    const NodeId body = slotOf(r.slots[next++], true);
    items.push_back(t_.item(t_.word(selector), body));
  };
  add(hasSides(r.faces), "side");
  add(hasTop(r.faces), "top");
  add(hasBottom(r.faces), "bottom");
  t_.at(r.opSpan);
  out.push_back(t_.apply("comp", {t_.word("f")}, t_.block(items)));
  return out;
}

// --- Successors ---

NodeId Lowering::slotOf(const Slot& slot, bool flat, Nodes before) {
  t_.at(slot.span);
  std::vector<const Possibility*> some;
  std::vector<double> chances;
  for (const Possibility& p : slot.possibilities) {
    if (!(p.chance > 0)) continue;
    some.push_back(&p);
    chances.push_back(p.chance);
  }
  if (some.size() == 1) return possibilityOf(*some[0], flat, std::move(before));
  const std::vector<double> percents = percentsOf(chances);
  std::vector<std::pair<NodeId, NodeId>> branches;
  for (size_t i = 0; i < some.size(); ++i) {
    t_.at(some[i]->symbol.span);
    const NodeId weight = i + 1 < some.size() ? t_.number(percents[i]) : lang::kNoNode;
    branches.emplace_back(weight, possibilityOf(*some[i], flat, {}));
  }
  t_.at(slot.span);
  const NodeId choice = t_.choice(lang::ChoiceKind::Percent, branches);
  if (before.empty()) return t_.sequence({choice});
  // A choice stands first, or in brackets.
  before.push_back(t_.push(t_.sequence({choice})));
  return t_.sequence(before);
}

NodeId Lowering::possibilityOf(const Possibility& p, bool flat, Nodes body) {
  t_.at(p.symbol.span);
  const SymbolInfo* s = vocabulary_.find(p.symbol.text);
  if (!s) return t_.sequence({t_.leaf(names_.of(p.symbol.text))});
  if (s->dimensions == Dimensions::Two && !flat) {
    body.push_back(t_.apply("resize", {t_.word("set"), t_.relative(1), t_.relative(1), t_.number(0),
                                       t_.word("front")}));
  }
  addSymbol(*s, body);
  return t_.sequence(body);
}

void Lowering::addSymbol(const SymbolInfo& s, Nodes& out) {
  const std::string& name = names_.of(s.name);
  if (s.dimensions == Dimensions::Empty) {
    out.push_back(t_.apply("NIL"));
  } else if (!s.rules.empty() || s.asset || s.preferred != Triple{}) {
    out.push_back(t_.apply(name));
  } else {
    for (const NodeId step : boxOf(s)) out.push_back(step);
  }
}

NodeId Lowering::colour(const SymbolInfo& s) {
  return t_.apply("color", {t_.text(colourOf(s.name))});
}

// The box itself, in the colour of its symbol.
Nodes Lowering::boxOf(const SymbolInfo& s) { return {colour(s), t_.leaf(names_.of(s.name))}; }

}  // namespace

lang::Tree lower(const Grammar& grammar, Vocabulary& vocabulary, const Catalogue& catalogue,
                 uint32_t file, uint32_t size) {
  return Lowering(grammar, vocabulary, catalogue, file).run(size);
}

}  // namespace gable::gbbg
