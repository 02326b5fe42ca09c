// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/lower.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/text.h"
#include "dialects/progen3d/dresser.h"
#include "dialects/progen3d/messages.h"
#include "dialects/progen3d/names.h"
#include "dialects/progen3d/nodes.h"
#include "dialects/progen3d/uses.h"
#include "dialects/proposal.h"

namespace gable::progen3d {

namespace {

using Kind = Expression::Kind;

/// A rule that leaves so many bodies is worth being derived once for all its equal calls.
constexpr double kWorthSharing = 4;
/// Of a body that does not say its own.
constexpr double kTextureScale = 0.125;
constexpr const char* kQuotient = "quotient";

class Lowering {
 public:
  Lowering(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
           const FileExists& exists, Diagnostics& diagnostics)
      : g_(grammar),
        b_(file),
        names_(grammar, catalogue),
        uses_(grammar),
        dresser_(b_, exists, diagnostics,
                 "write a number, words such as brick, redbrick or shinymetal, or put a picture of "
                 "that name into the folder textures"),
        diagnostics_(diagnostics) {}

  lang::Tree run() {
    Nodes declarations, rules;
    if (!g_.rules.empty() && needsStartRule(g_.rules[0])) rules.push_back(startRule());
    for (const Rule& r : g_.rules) {
      if (!uses_.isReachable(r.name)) {
        diagnostics_.warning("unused-rule", r.nameSpan,
                             "nothing that the first rule leads to runs '" + std::string(r.name) +
                                 "', so it draws nothing",
                             "write its name into a rule, remove it, or make it the start rule");
      }
      rules.push_back(rule(r));
    }
    for (const Variable& v : g_.variables) declarations.push_back(variable(v));
    for (const std::string& counter : counters_) {
      const Span at = g_.rules[0].nameSpan;
      declarations.push_back(b_.add(NodeKind::Attr, at,
                                    {hidden(at), kNoNode, kNoNode, b_.number(0, at)},
                                    names_.value(counter)));
    }
    if (divides_) declarations.push_back(quotient());
    declarations.insert(declarations.end(), rules.begin(), rules.end());
    return b_.finish(declarations);
  }

 private:
  // --- Declarations ---

  NodeId variable(const Variable& v) {
    const NodeId value = isConstant(v) ? b_.number(constantOf(v), v.span) : draw(v, v.span);
    const NodeId notes = isRedrawn(v) ? hidden(v.span) : kNoNode;
    return b_.add(NodeKind::Attr, v.span, {notes, kNoNode, kNoNode, value}, names_.value(v.name));
  }

  // Each rule that has it in its head draws it, so that a value from outside would have no effect.
  bool isRedrawn(const Variable& v) const {
    if (isConstant(v) || unbound_.count(v.name) > 0) return false;
    for (const Rule& r : g_.rules) {
      for (const Rule::Draw& d : r.draws) {
        if (d.name == v.name) return true;
      }
    }
    return false;
  }

  NodeId hidden(Span at) { return b_.note("Hidden", at); }

  // A whole range holds all integers between its bounds; without one, the lower bound truncated.
  static double least(const Variable& v) {
    const double low = std::min(v.min, v.max), high = std::max(v.min, v.max);
    return std::ceil(low) <= std::floor(high) ? std::ceil(low) : std::trunc(low);
  }
  static double most(const Variable& v) {
    return std::max(least(v), std::floor(std::max(v.min, v.max)));
  }
  static bool isConstant(const Variable& v) {
    return v.whole ? least(v) == most(v) : v.min == v.max;
  }
  static double constantOf(const Variable& v) { return v.whole ? least(v) : v.min; }

  NodeId draw(const Variable& v, Span at) {
    if (isConstant(v)) return b_.number(constantOf(v), at);
    if (!v.whole) return b_.call("rand", {b_.number(v.min, at), b_.number(v.max, at)}, at);
    const NodeId any = b_.call("rand", {b_.number(least(v), at), b_.number(most(v) + 1, at)}, at);
    return b_.call("floor", {any}, at);
  }

  NodeId quotient() { return b_.quotient(names_.function(kQuotient), g_.rules[0].nameSpan); }

  NodeId startAnnotation(Span at) { return b_.note("StartRule", at); }

  // A start rule that others call must not begin anew with each call; and a choice stands first.
  bool needsStartRule(const Rule& r) const {
    return uses_.calledByAny(r.name) || (r.probability != kNone && r.draws.empty());
  }

  NodeId startRule() {
    const Rule& first = g_.rules[0];
    const Span at = first.nameSpan;
    const Nodes steps{b_.apply("affineReset", {}, at), runInPlace(first, at)};
    return b_.add(NodeKind::Rule, at,
                  {startAnnotation(at), kNoNode, kNoNode, b_.sequence(steps, at)},
                  names_.startRule());
  }

  NodeId rule(const Rule& r) {
    rule_ = &r;
    Nodes steps = body(r);
    NodeId notes = kNoNode;
    if (!needsStartRule(r)) {
      steps.insert(steps.begin(), b_.apply("affineReset", {}, r.nameSpan));
      if (&r == &g_.rules[0]) notes = startAnnotation(r.nameSpan);
    }
    const Span at{r.span.file, r.nameSpan.begin, r.span.end};
    return b_.add(NodeKind::Rule, at, {notes, kNoNode, kNoNode, b_.sequence(steps, at)},
                  names_.rule(r.name));
  }

  // --- A rule's body ---

  Nodes body(const Rule& r) {
    Nodes values;
    std::set<std::string_view> bound;
    for (const Rule::Draw& d : r.draws) {
      const Variable* v = g_.variable(d.name);
      if (!v) {
        unknownVariable(d.name, d.span);
      } else if (bound.insert(d.name).second && !isConstant(*v)) {
        values.push_back(
            b_.add(NodeKind::NamedArg, d.span, {draw(*v, d.span)}, names_.value(d.name)));
      }
    }
    Nodes steps = chosen(r);
    if (values.empty()) return steps;
    return {b_.block("local", values, steps, r.span)};
  }

  Nodes chosen(const Rule& r) {
    if (r.probability == kNone) return sections(r);
    const Expression& p = g_.expressions[r.probability];
    bool known = true;
    const double share = evaluate(g_, r.probability, known);
    if (known) {
      if (share < 0 || share > 1) {
        diagnostics_.error("bad-probability", p.span, "a probability lies between 0 and 1",
                           "write 0.5 for every second time");
      }
      if (share >= 1) return sections(r);
      if (!(share > 0)) return section(r.alternate);
    }
    const NodeId weight = known ? b_.number(share * 100, p.span)
                                : b_.binary(BinaryOp::Multiply, expression(r.probability),
                                            b_.number(100, p.span), p.span);
    const Nodes first = sections(r);
    const NodeId choice = b_.choice(weight, first, section(r.alternate), r.span);
    return {choice};
  }

  Nodes sections(const Rule& r) {
    Nodes repeated = turns(r);
    if (r.start.empty() && r.end.empty()) return repeated;
    // Brackets may open at the start and close at the end.
    Section around = r.start;
    middle_ = around.size();
    around.insert(around.end(), r.end.begin(), r.end.end());
    middleNodes_ = std::move(repeated);
    size_t at = 0;
    Nodes out = steps(around, at, true);
    return out;
  }

  Nodes turns(const Rule& r) {
    Nodes steps = section(r.body);
    if (steps.empty()) return steps;
    const std::string counter = std::string(r.name) + "_count";
    const bool counted = uses_.readsName(counter) && !g_.variable(counter);
    double count = 1;
    const bool known = r.repeat == kNone || g_.expressions[r.repeat].kind == Kind::Number;
    if (r.repeat != kNone && known) count = std::trunc(g_.expressions[r.repeat].number);
    if (known && count < 1) return {};
    if (known && count == 1 && !counted) return steps;
    const Span at = r.repeat == kNone ? r.nameSpan : g_.expressions[r.repeat].span;
    if (counted) {
      counters_.insert(counter);
      const NodeId value =
          b_.add(NodeKind::NamedArg, at, {b_.name("split.index", at)}, names_.value(counter));
      steps = {b_.block("local", {value}, steps, at)};
    }
    const NodeId times = known ? b_.number(count, at) : expression(r.repeat);
    return {b_.block("repeat", {times}, steps, at)};
  }

  // --- Sections ---

  Nodes section(const Section& s) {
    size_t at = 0;
    return steps(s, at, false);
  }

  // Steps up to the bracket that closes, or the end; with `around`, the repeated part goes between
  // start and end.
  Nodes steps(const Section& s, size_t& at, bool around) {
    Nodes out;
    for (;;) {
      if (around && at == middle_) {
        out.insert(out.end(), middleNodes_.begin(), middleNodes_.end());
        middleNodes_.clear();
        middle_ = kNone;
      }
      if (at >= s.size()) return out;
      const Step& step = s[at++];
      if (step.kind == Step::Kind::Pop) return out;
      if (step.kind == Step::Kind::Push) {
        out.push_back(bracket(s, at, around, step.span));
      } else if (step.kind == Step::Kind::Call) {
        call(step, at < s.size() && s[at].kind == Step::Kind::Pop && !(around && at == middle_),
             out);
      } else {
        out.push_back(operation(step));
      }
    }
  }

  NodeId bracket(const Section& s, size_t& at, bool around, Span open) {
    const Nodes inner = steps(s, at, around);
    const Span span{open.file, open.begin, std::max(open.end, s[at - 1].span.end)};
    return b_.add(NodeKind::Push, span, {b_.sequence(inner, span)});
  }

  NodeId runInPlace(const Rule& r, Span at) {
    return b_.apply("do", {b_.name(names_.rule(r.name), at)}, at);
  }

  void call(const Step& step, bool bracketFollows, Nodes& out) {
    const Rule* r = g_.rule(step.name);
    if (!r) {
      warnUnknownRule(g_, step.name, step.span, diagnostics_);
      return;
    }
    // Before a closing bracket a copy of the shape serves as well, and what comes of the copy can
    // be shared.
    const bool child =
        bracketFollows && !uses_.isRandom(r->name) && uses_.bodies(r->name) >= kWorthSharing;
    if (child)
      out.push_back(b_.add(NodeKind::Apply, step.span, {kNoNode}, names_.rule(r->name)));
    else
      out.push_back(runInPlace(*r, step.span));
  }

  NodeId operation(const Step& step) {
    Nodes arguments;
    if (step.kind == Step::Kind::Insert) return insert(step);
    for (const uint32_t a : step.arguments) arguments.push_back(expression(a));
    if (step.kind == Step::Kind::Turn) arguments[1] = axis(step.arguments[1], arguments[1]);
    static constexpr const char* kNames[] = {"affineScale", "affineMove",  "affineTurn",
                                             "affineTaper", "affineFront", "affineTop"};
    return b_.apply(kNames[static_cast<size_t>(step.kind)], arguments, step.span);
  }

  // The axis as a word where it is a number: 0 is x, 1 is y, any other z.
  NodeId axis(uint32_t id, NodeId value) {
    const Expression& e = g_.expressions[id];
    if (e.kind != Kind::Number) return value;
    const double v = std::trunc(e.number);
    return b_.name(v == 0 ? "x" : v == 1 ? "y" : "z", e.span);
  }

  NodeId insert(const Step& step) {
    const Span at = step.span;
    Nodes arguments;
    const auto pivot = [&](double x, double y, double z, const char* far) {
      for (const double v : {x, y, z}) arguments.push_back(b_.number(v, at));
      arguments.push_back(b_.name(far, at));
    };
    const double low = g_.centred ? 0.5 : 0;
    const char* name = "affineBox";
    switch (step.body) {
      case Body::Cube: pivot(0.5, low, 0.5, "y"); break;
      case Body::CubeX: pivot(0, low, 0.5, "x"); break;
      case Body::CubeY:
        // Along z in the first versions, upright in those that have DS and DT.
        if (g_.centred)
          pivot(0.5, 0, 0.5, "y");
        else
          pivot(0.5, 0, 0, "z");
        break;
      case Body::Sphere: name = "affineSphere"; break;
      case Body::Cylinder: name = "affineCylinder"; break;
    }
    if (!step.arguments.empty() && isTextureName(g_.expressions[step.arguments[0]])) {
      Nodes inner = dressed(step);
      inner.push_back(b_.apply(name, arguments, at));
      return b_.add(NodeKind::Push, at, {b_.sequence(inner, at)});
    }
    if (step.arguments.empty()) arguments.push_back(b_.number(0, at));
    for (const uint32_t a : step.arguments) arguments.push_back(expression(a));
    return b_.apply(name, arguments, at);
  }

  // --- Textures by name ---

  bool isTextureName(const Expression& e) const {
    return e.kind == Kind::Name && !g_.variable(e.name) && !e.name.ends_with("_count");
  }

  // What stands before a body with a named texture, in the same brackets.
  Nodes dressed(const Step& step) {
    const Span at = step.span;
    const Expression& texture = g_.expressions[step.arguments[0]];
    const auto times = [&](size_t argument, double factor, double otherwise) {
      if (argument >= step.arguments.size()) return b_.number(factor * otherwise, at);
      const NodeId value = expression(step.arguments[argument]);
      return b_.binary(BinaryOp::Multiply, b_.number(factor, at), value, at);
    };
    return dresser_.operations({texture.name, texture.span, at,
                                [&] { return times(2, 2, kTextureScale); },
                                [&] { return times(1, 90, 0); }});
  }

  // --- Expressions ---

  void unknownVariable(std::string_view name, Span at) {
    if (!unknown_.insert(name).second) return;
    std::vector<std::string_view> known;
    for (const Variable& v : g_.variables) known.push_back(v.name);
    const std::string nearest = nearestName(name, known);
    std::string hint =
        nearest.empty() ? "declare it: R " + std::string(name) + " ( min max )" : meaning(nearest);
    diagnostics_.error("unknown-variable", at, "there is no variable '" + std::string(name) + "'",
                       std::move(hint));
    propose(diagnostics_, at, name, nearest);
  }

  NodeId name(const Expression& e) {
    const std::string counter(e.name);
    if (!g_.variable(e.name) && e.name.ends_with("_count") &&
        g_.rule(e.name.substr(0, e.name.size() - 6))) {
      counters_.insert(counter);
      return b_.name(names_.value(counter), e.span);
    }
    if (!g_.variable(e.name)) {
      unknownVariable(e.name, e.span);
      return b_.number(0, e.span);
    }
    if (uses_.isReachable(rule_->name) && !isConstant(*g_.variable(e.name)) &&
        !uses_.mayBind(rule_->name, e.name) && unbound_.insert(e.name).second) {
      diagnostics_.warning("unbound-variable", e.span,
                           "no rule that leads here draws '" + std::string(e.name) +
                               "' in its head, so it has one value throughout",
                           "write it behind the number of turns of a rule above, if it shall vary");
    }
    return b_.name(names_.value(e.name), e.span);
  }

  NodeId freshDraw(const Expression& e) {
    if (const Variable* v = g_.variable(e.name)) return draw(*v, e.span);
    unknownVariable(e.name, e.span);
    return b_.number(0, e.span);
  }

  // Dividing by zero gives 0; a divisor that is another number needs no care.
  NodeId division(const Expression& e) {
    const Expression& by = g_.expressions[e.right];
    const NodeId left = expression(e.left), right = expression(e.right);
    if (by.kind == Kind::Number && by.number != 0) {
      return b_.binary(BinaryOp::Divide, left, right, e.span);
    }
    divides_ = true;
    return b_.call(names_.function(kQuotient), {left, right}, e.span);
  }

  // The trigonometric functions of the notation take radians.
  NodeId trigonometric(const char* function, const Expression& e) {
    return b_.ofRadians(function, expression(e.left), e.span);
  }

  NodeId expression(uint32_t id) {
    const Expression& e = g_.expressions[id];
    const auto both = [&](BinaryOp op) {
      const NodeId left = expression(e.left);
      return b_.binary(op, left, expression(e.right), e.span);
    };
    switch (e.kind) {
      case Kind::Number: return b_.number(e.number, e.span);
      case Kind::Name: return name(e);
      case Kind::Draw: return freshDraw(e);
      case Kind::Negate: return b_.unary(lang::UnaryOp::Minus, expression(e.left), e.span);
      case Kind::Add: return both(BinaryOp::Add);
      case Kind::Subtract: return both(BinaryOp::Subtract);
      case Kind::Multiply: return both(BinaryOp::Multiply);
      case Kind::Divide: return division(e);
      case Kind::Power: {
        const NodeId base = expression(e.left);
        return b_.call("pow", {base, expression(e.right)}, e.span);
      }
      case Kind::Sin: return trigonometric("sin", e);
      case Kind::Cos: return trigonometric("cos", e);
    }
    return kNoNode;
  }

  const Grammar& g_;
  Builder b_;
  Names names_;
  Uses uses_;
  Dresser dresser_;
  Diagnostics& diagnostics_;
  const Rule* rule_ = nullptr;
  size_t middle_ = kNone;
  Nodes middleNodes_;
  bool divides_ = false;
  std::set<std::string> counters_;
  std::set<std::string_view> unknown_, unbound_;
};

}  // namespace

lang::Tree lower(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
                 const FileExists& exists, Diagnostics& diagnostics) {
  return Lowering(grammar, file, catalogue, exists, diagnostics).run();
}

}  // namespace gable::progen3d
