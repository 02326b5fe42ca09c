// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/web_lower.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "dialects/progen3d/dresser.h"
#include "dialects/progen3d/messages.h"
#include "dialects/progen3d/names.h"
#include "dialects/progen3d/nodes.h"
#include "dialects/progen3d/web_expressions.h"
#include "dialects/progen3d/web_uses.h"
#include "dialects/progen3d/web_words.h"

namespace gable::progen3d::web {

namespace {

using Kind = Statement::Kind;

constexpr const char* kTextureRemedy =
    "write words such as brick, redbrick or shinymetal, or put a picture of that name into the "
    "folder textures";

bool leavesBodies(const Statement& s) {
  return s.kind == Kind::Insert || s.kind == Kind::Call || s.kind == Kind::Group ||
         s.kind == Kind::Condition;
}
bool isJoint(const Statement& s) { return s.kind == Kind::JointScale || s.kind == Kind::JointMove; }

class Lowering {
 public:
  Lowering(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
           const FileExists& exists, Diagnostics& diagnostics)
      : g_(grammar),
        b_(file),
        uses_(grammar),
        names_(ruleNames(grammar), valueNames(uses_), catalogue),
        expressions_(grammar, b_, names_, uses_, diagnostics),
        dresser_(b_, exists, diagnostics, kTextureRemedy),
        diagnostics_(diagnostics) {}

  lang::Tree run() {
    if (g_.rules.empty()) return b_.finish({});
    tellOfNames();
    Nodes rules;
    if (needsStartRule(g_.rules[0])) rules.push_back(startRule());
    for (const Rule& r : g_.rules) rules.push_back(rule(r));
    const Span at = g_.rules[0].nameSpan;
    Nodes declarations;
    const auto attribute = [&](const std::string& name) {
      declarations.push_back(b_.add(
          NodeKind::Attr, at, {b_.note("Hidden", at), kNoNode, kNoNode, b_.number(0, at)}, name));
    };
    for (const std::string& v : valueNames(uses_)) attribute(names_.value(v));
    if (uses_.hasSides()) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        for (const bool move : {false, true}) {
          Nodes row;
          for (int k = 0; k < 3; ++k) row.push_back(b_.number(move ? 0 : 1, at));
          declarations.push_back(b_.add(
              NodeKind::Attr, at, {b_.note("Hidden", at), kNoNode, kNoNode, b_.array(row, at)},
              sideName(move, axis)));
        }
      }
    }
    for (size_t k = 0; k < expressions_.held(); ++k) attribute(expressions_.heldName(k));
    expressions_.declareHelpers(declarations, at);
    declarations.insert(declarations.end(), rules.begin(), rules.end());
    return b_.finish(declarations);
  }

 private:
  static std::vector<std::string> ruleNames(const Grammar& g) {
    std::vector<std::string> out;
    for (const Rule& r : g.rules) out.emplace_back(r.name);
    return out;
  }
  // The turn, variables, the ranges of those that are redrawn, and parameters.
  static std::vector<std::string> valueNames(const Uses& uses) {
    std::vector<std::string> out{"repeatIndex"};
    for (const auto& [name, drawn] : uses.drawn()) {
      out.emplace_back(name);
      if (!drawn.redrawn) continue;
      out.push_back(leastOf(name));
      out.push_back(mostOf(name));
    }
    for (const std::string_view p : uses.parameters()) {
      if (!uses.isDrawn(p)) out.emplace_back(p);
    }
    return out;
  }

  void tellOfNames() {
    for (const auto& [name, drawn] : uses_.drawn()) {
      if (isConstant(name)) {
        diagnostics_.warning("reserved-name", drawn.span,
                             "'" + std::string(name) +
                                 "' is a number of its own, so what is drawn "
                                 "is never seen",
                             "give the variable another name");
      }
      if (drawn.ofBothKinds && drawn.redrawn) {
        diagnostics_.warning("variable-repeated", drawn.span,
                             "'" + std::string(name) +
                                 "' is drawn by R and by R*; anew it is "
                                 "drawn as here",
                             "give one of them another name");
      }
    }
    for (const Variant& v : g_.rules[0].variants) {
      if (v.parameters.empty()) continue;
      const std::string name(v.parameters[0].name);
      diagnostics_.warning(
          "wrong-argument-count", g_.rules[0].nameSpan,
          "nothing gives the first rule a value for '" + name + "'; it counts as 0",
          "write a rule without parameters above it, to begin with");
      break;
    }
    for (const Rule& r : g_.rules) {
      if (uses_.isReachable(r.name)) continue;
      diagnostics_.warning("unused-rule", r.nameSpan,
                           "nothing that the first rule leads to runs '" + std::string(r.name) +
                               "', so it draws nothing",
                           "write its name into a rule, remove it, or make it the start rule");
    }
  }

  // --- Rules ---

  static size_t parametersOf(const Rule& r) {
    size_t most = 0;
    for (const Variant& v : r.variants) most = std::max(most, v.parameters.size());
    return most;
  }

  // What others call must not begin anew; and a choice stands first.
  bool needsStartRule(const Rule& r) const {
    return uses_.isCalled(r.name) || r.variants.size() > 1 || parametersOf(r) > 0;
  }

  NodeId startRule() {
    const Rule& first = g_.rules[0];
    const Span at = first.nameSpan;
    const Nodes none(parametersOf(first), b_.number(0, at));
    const Nodes steps{b_.apply("affineReset", {}, at), callOf(first, none, at)};
    return b_.add(NodeKind::Rule, at,
                  {b_.note("StartRule", at), kNoNode, kNoNode, b_.sequence(steps, at)},
                  names_.startRule());
  }

  NodeId callOf(const Rule& r, const Nodes& arguments, Span at) {
    const NodeId list = arguments.empty() ? kNoNode : b_.list(at, arguments);
    return b_.add(NodeKind::Apply, at, {list}, names_.rule(r.name));
  }

  static std::string argumentName(size_t k) { return "given" + std::to_string(k + 1); }

  NodeId rule(const Rule& r) {
    expressions_.enterRule();
    Nodes steps = variants(r);
    NodeId notes = kNoNode;
    if (!needsStartRule(r)) {
      steps.insert(steps.begin(), b_.apply("affineReset", {}, r.nameSpan));
      if (&r == &g_.rules[0]) notes = b_.note("StartRule", r.nameSpan);
    }
    std::vector<std::string> given;
    for (size_t k = 0; k < parametersOf(r); ++k) given.push_back(argumentName(k));
    const NodeId params = given.empty() ? kNoNode : b_.params(given, r.nameSpan);
    return b_.add(NodeKind::Rule, r.nameSpan,
                  {notes, params, kNoNode, b_.sequence(steps, r.nameSpan)}, names_.rule(r.name));
  }

  // One of several by weight; the first is what is left over, so it is the one where all weigh
  // nothing.
  Nodes variants(const Rule& r) {
    if (r.variants.size() == 1) {
      if (r.variants[0].weight != kNone) {
        diagnostics_.warning("bad-probability", expressions_.spanOf(r.variants[0].weight),
                             "'" + std::string(r.name) +
                                 "' has one variant, so its weight is "
                                 "without effect",
                             "write a second rule of the name, or remove the weight");
      }
      return variant(r.variants[0]);
    }
    std::vector<double> weights;
    bool known = true;
    for (const Variant& v : r.variants) {
      weights.push_back(v.weight == kNone ? 1 : expressions_.constant(v.weight, known));
    }
    double total = 0;
    for (double& w : weights) total += w = std::max(0.0, w);
    if (known && !(total > 0)) return variant(r.variants[0]);
    Nodes branches;
    for (size_t k = 1; k < r.variants.size(); ++k) {
      const Span at = r.variants[k].span;
      if (known && weights[k] == 0) continue;
      const NodeId weight = known ? b_.number(weights[k] / total * 100, at) : share(r, k, at);
      branches.push_back(
          b_.add(NodeKind::Branch, at, {weight, b_.sequence(variant(r.variants[k]), at)}));
    }
    const Span at = r.variants[0].span;
    if (branches.empty()) return variant(r.variants[0]);
    branches.push_back(
        b_.add(NodeKind::Branch, at, {kNoNode, b_.sequence(variant(r.variants[0]), at)}));
    return {b_.percent(branches, at)};
  }

  // 100 times the weight of a variant by the sum of all.
  NodeId share(const Rule& r, size_t which, Span at) {
    const auto weight = [&](size_t k) {
      const uint32_t w = r.variants[k].weight;
      if (w == kNone) return b_.number(1, at);
      return b_.call("max", {b_.number(0, at), expressions_.value(w)}, at);
    };
    NodeId sum = weight(0);
    for (size_t k = 1; k < r.variants.size(); ++k) {
      sum = b_.binary(BinaryOp::Add, sum, weight(k), at);
    }
    const NodeId part = b_.binary(BinaryOp::Multiply, b_.number(100, at), weight(which), at);
    return expressions_.quotient(part, sum, at);
  }

  // Its parameters, and the variables that it draws, which those that called it do not see.
  Nodes variant(const Variant& v) {
    Nodes values;
    std::set<std::string_view> own;
    for (size_t k = 0; k < v.parameters.size(); ++k) {
      const auto& p = v.parameters[k];
      if (!own.insert(p.name).second) {
        diagnostics_.error("duplicate-parameter", p.span,
                           "there are two parameters '" + std::string(p.name) + "'",
                           "give one of them another name");
        continue;
      }
      values.push_back(b_.add(NodeKind::NamedArg, p.span, {b_.name(argumentName(k), p.span)},
                              names_.value(p.name)));
    }
    std::set<std::string_view> draws;
    drawnIn(v.body, draws);
    const auto keep = [&](const std::string& name) {
      values.push_back(b_.add(NodeKind::NamedArg, v.span, {b_.name(name, v.span)}, name));
    };
    for (const std::string_view name : draws) {
      if (!uses_.isDrawn(name)) continue;
      if (own.count(name) == 0) keep(names_.value(name));
      if (!uses_.drawn().at(name).redrawn) continue;
      keep(names_.value(leastOf(name)));
      keep(names_.value(mostOf(name)));
    }
    const Nodes steps = turns(v);
    if (values.empty()) return steps;
    return {b_.block("local", values, steps, v.span)};
  }

  Nodes turns(const Variant& v) {
    double count = 1;
    bool known = true;
    if (v.repeat != kNone) count = std::floor(expressions_.constant(v.repeat, known));
    if (known && count < 1) return {};
    if (known && count == 1) {
      expressions_.inTurns(false);
      return sequence(v.body, false);
    }
    const Span at = expressions_.spanOf(v.repeat);
    const NodeId times =
        known ? b_.number(count, at) : b_.call("floor", {expressions_.value(v.repeat)}, at);
    expressions_.inTurns(true);
    const Joint joint = jointOf(v.body, true);
    Nodes steps = sequence(v.body, true);
    if (expressions_.readsTurn()) {
      steps.insert(
          steps.begin(),
          b_.apply("set", {b_.name(names_.value("repeatIndex"), at), b_.name("split.index", at)},
                   at));
    }
    expressions_.inTurns(false);
    const Nodes repeated{b_.block("repeat", {times}, steps, at)};
    return joint.any() ? Nodes{together(joint, repeated)} : repeated;
  }

  // --- Sequences ---

  Nodes sequence(const Sequence& s, bool repeated) {
    Nodes out;
    // Of a repeated rule the deformation lies around all turns.
    const Joint joint = repeated ? Joint() : jointOf(s, false);
    for (size_t k = 0; k < s.size(); ++k) {
      if (joint.any() && k == joint.end) {
        Nodes rest;
        for (; k < s.size(); ++k) statement(s[k], rest);
        out.push_back(together(joint, rest));
        return out;
      }
      statement(s[k], out);
    }
    return out;
  }

  void statement(const Statement& s, Nodes& out) {
    expressions_.enterStatement(s);
    Nodes made;
    lowered(s, made);
    // What an expression draws and keeps is done before.
    const Nodes before = expressions_.takeBefore();
    out.insert(out.end(), before.begin(), before.end());
    out.insert(out.end(), made.begin(), made.end());
  }

  void lowered(const Statement& s, Nodes& out) {
    switch (s.kind) {
      case Kind::Scale: return apply("affineScale", s, out);
      case Kind::Move: return apply("affineMove", s, out);
      case Kind::SideScale:
      case Kind::SideMove: return side(s, out);
      case Kind::Turn: return turn(s, out);
      case Kind::Insert: return insert(s, out);
      case Kind::Call: return call(s, out);
      case Kind::Draw: return draw(s, out);
      case Kind::Group: return group(s, out);
      case Kind::Condition: return condition(s, out);
      // Where they count they stand around the bodies.
      case Kind::JointScale:
      case Kind::JointMove: return;
    }
  }

  void apply(const char* operation, const Statement& s, Nodes& out) {
    out.push_back(b_.apply(operation, values(s.arguments), s.span));
  }

  Nodes values(const std::vector<uint32_t>& arguments) {
    Nodes out;
    for (const uint32_t a : arguments) out.push_back(expressions_.value(a));
    return out;
  }

  NodeId axisWord(uint32_t axis, Span at) {
    static constexpr const char* kAxes[] = {"x", "y", "z"};
    return b_.name(kAxes[axis], at);
  }

  // Sides are attributes, which end with brackets and rules as the place does.
  void side(const Statement& s, Nodes& out) {
    const std::string name = sideName(s.kind == Kind::SideMove, s.axis);
    const NodeId numbers = b_.array(values(s.arguments), s.span);
    out.push_back(b_.apply("set", {b_.name(name, s.span), numbers}, s.span));
  }

  std::string sideName(bool move, uint32_t axis) const {
    static constexpr const char* kNames[] = {"scaleX", "moveX",  "scaleY",
                                             "moveY",  "scaleZ", "moveZ"};
    return names_.function(kNames[2 * axis + move]);
  }

  void turn(const Statement& s, Nodes& out) {
    bool known = true;
    const double axis = std::floor(expressions_.constant(s.arguments[1], known));
    if (known && (axis < 0 || axis > 2)) {
      diagnostics_.warning("bad-axis", expressions_.spanOf(s.arguments[1]),
                           "there is no such axis, so nothing turns", "0 is x, 1 is y, 2 is z");
      return;
    }
    const NodeId angle = expressions_.value(s.arguments[0]);
    const NodeId about =
        known ? axisWord(static_cast<uint32_t>(axis), s.span) : expressions_.value(s.arguments[1]);
    out.push_back(b_.apply("affineTurn", {angle, about}, s.span));
  }

  // The body in its texture; one that reaches along an axis moves the place to its end.
  void insert(const Statement& s, Nodes& out) {
    const Span at = s.span;
    bool known = true;
    const double scale = expressions_.constant(s.arguments[0], known);
    std::string held;
    if (!known) held = expressions_.hold(expressions_.value(s.arguments[0]), at);
    const auto share = [&] {
      if (known) return b_.number(2 * scale, at);
      return b_.binary(BinaryOp::Multiply, b_.number(2, at), b_.name(held, at), at);
    };
    Nodes inner;
    if (!s.name.empty()) {
      inner =
          dresser_.operations({s.name, s.nameSpan, at, share, [&] { return b_.number(0, at); }});
    }
    Nodes arguments;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      arguments.push_back(b_.number(axis == s.axis ? 0 : 0.5, at));
    }
    if (uses_.hasSides()) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        for (const bool move : {false, true}) {
          arguments.push_back(b_.name(sideName(move, axis), at));
        }
      }
      inner.push_back(b_.apply("affineSidedBox", arguments, at));
    } else {
      arguments.push_back(b_.name("y", at));
      inner.push_back(b_.apply("affineBox", arguments, at));
    }
    if (inner.size() == 1) {
      out.push_back(inner[0]);
    } else {
      out.push_back(b_.add(NodeKind::Push, at, {b_.sequence(inner, at)}));
    }
    if (s.axis > 2) return;
    Nodes steps;
    for (uint32_t axis = 0; axis < 3; ++axis) steps.push_back(b_.number(axis == s.axis, at));
    out.push_back(b_.apply("affineMove", steps, at));
  }

  void call(const Statement& s, Nodes& out) {
    const Rule* r = g_.rule(s.name);
    if (!r) {
      warnUnknownRule(g_, s.name, s.nameSpan, diagnostics_);
      return;
    }
    Nodes arguments = values(s.arguments);
    const size_t wanted = parametersOf(*r);
    if (arguments.size() != wanted) {
      diagnostics_.error(
          "wrong-argument-count", s.span,
          "'" + std::string(s.name) + "' takes " + std::to_string(wanted) +
              (wanted == 1 ? " argument, not " : " arguments, not ") +
              std::to_string(arguments.size()),
          "write one for each parameter in the head of '" + std::string(s.name) + "'");
    }
    arguments.resize(wanted, b_.number(0, s.span));
    out.push_back(callOf(*r, arguments, s.span));
  }

  void draw(const Statement& s, Nodes& out) {
    const Nodes steps = expressions_.draw(s);
    out.insert(out.end(), steps.begin(), steps.end());
  }

  void group(const Statement& s, Nodes& out) {
    const Nodes inner = sequence(s.body, false);
    expressions_.leaveBracket(s.body);
    if (inner.empty()) return;
    out.push_back(b_.add(NodeKind::Push, s.span, {b_.sequence(inner, s.span)}));
  }

  void condition(const Statement& s, Nodes& out) {
    const NodeId holds = expressions_.condition(s.arguments[0]);
    const Nodes before = expressions_.takeBefore();
    out.insert(out.end(), before.begin(), before.end());
    const Nodes first = sequence(s.body, false), second = sequence(s.otherwise, false);
    const NodeId a = b_.add(NodeKind::Branch, s.span, {holds, b_.sequence(first, s.span)});
    const NodeId b = b_.add(NodeKind::Branch, s.span, {kNoNode, b_.sequence(second, s.span)});
    const NodeId choice = b_.add(NodeKind::Choice, s.span, {a, b});
    out.push_back(b_.block("repeat", {b_.number(1, s.span)}, {choice}, s.span));
  }

  // --- Deformations of several bodies together ---

  struct Joint {
    /// The statements that set it, by side; null where none does.
    std::array<const Statement*, 3> scales{}, moves{};
    /// Behind the last of them.
    size_t end = 0;
    Span span;
    bool any() const { return end > 0; }
  };

  // They mean all that follows in the bracket or rule, so they stand before its bodies; in a
  // repeated rule, which goes on from where it was, before all else.
  Joint jointOf(const Sequence& s, bool repeated) {
    Joint out;
    bool late = false;
    for (size_t k = 0; k < s.size(); ++k) {
      if (!isJoint(s[k])) {
        late = late || repeated || leavesBodies(s[k]);
        continue;
      }
      if (late) {
        diagnostics_.warning(
            "late-deformation", s[k].span,
            "a deformation of several bodies stands before them, so this one is "
            "left out",
            "put it with its bodies into brackets of their own: [ GDSX ( 1.2 1 1 ) "
            "... ]");
        continue;
      }
      (s[k].kind == Kind::JointScale ? out.scales : out.moves)[s[k].axis] = &s[k];
      out.end = k + 1;
      out.span = s[k].span;
    }
    return out;
  }

  NodeId together(const Joint& joint, const Nodes& parts) {
    const auto numbers = [&](const std::array<const Statement*, 3>& sides, double otherwise) {
      Nodes row;
      for (const Statement* s : sides) {
        for (size_t k = 0; k < 3; ++k) {
          row.push_back(s ? expressions_.value(s->arguments[k]) : b_.number(otherwise, joint.span));
        }
      }
      return b_.array(row, joint.span);
    };
    const NodeId factors = numbers(joint.scales, 1);
    return b_.block("affineTogether", {factors, numbers(joint.moves, 0)}, parts, joint.span);
  }

  const Grammar& g_;
  Builder b_;
  Uses uses_;
  Names names_;
  Expressions expressions_;
  Dresser dresser_;
  Diagnostics& diagnostics_;
};

}  // namespace

lang::Tree lower(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
                 const FileExists& exists, Diagnostics& diagnostics) {
  return Lowering(grammar, file, catalogue, exists, diagnostics).run();
}

}  // namespace gable::progen3d::web
