// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/web_expressions.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "dialects/progen3d/web_words.h"
#include "dialects/proposal.h"

namespace gable::progen3d::web {

namespace {

using Kind = Expression::Kind;

constexpr double kPi = 3.141592653589793, kE = 2.718281828459045;

// The variable of rand(variable); empty for others.
std::string_view rolledBy(const Grammar& g, const Expression& e) {
  if (e.kind != Kind::Function || e.name != "rand" || e.parts.size() != 1) return {};
  const Expression& of = g.expressions[e.parts[0]];
  return of.kind == Kind::Name ? of.name : std::string_view();
}

BinaryOp operatorOf(Kind kind) {
  switch (kind) {
    case Kind::Add: return BinaryOp::Add;
    case Kind::Subtract: return BinaryOp::Subtract;
    case Kind::Multiply: return BinaryOp::Multiply;
    case Kind::Less: return BinaryOp::Less;
    case Kind::LessEqual: return BinaryOp::LessEqual;
    case Kind::Greater: return BinaryOp::Greater;
    case Kind::GreaterEqual: return BinaryOp::GreaterEqual;
    case Kind::Equal: return BinaryOp::Equal;
    default: return BinaryOp::NotEqual;
  }
}

}  // namespace

// --- Statements ---

void Expressions::enterRule() {
  lost_.clear();
  inStatement_ = false;
}

void Expressions::enterStatement(const Statement& s) {
  inStatement_ = true;
  held_ = 0;
  reads_.clear();
  rolled_.clear();
  for (const uint32_t a : s.arguments) countReads(a);
}

void Expressions::countReads(uint32_t id) {
  const Expression& e = g_.expressions[id];
  const std::string_view rolled = rolledBy(g_, e);
  if (!rolled.empty()) rolled_.insert(rolled);
  if (e.kind == Kind::Name) ++reads_[e.name];
  for (const uint32_t part : e.parts) countReads(part);
}

bool Expressions::mustHold(std::string_view variable) const {
  const auto reads = reads_.find(variable);
  return rolled_.count(variable) > 0 && reads != reads_.end() && reads->second > 1;
}

void Expressions::leaveBracket(const Sequence& body) { drawnIn(body, lost_); }

void Expressions::inTurns(bool yes) {
  inTurns_ = yes;
  readsTurn_ = false;
}

std::string Expressions::heldName(size_t k) const {
  return names_.function("held" + std::to_string(k + 1));
}

std::string Expressions::hold(NodeId value, Span at) {
  const std::string name = heldName(held_++);
  mostHeld_ = std::max(mostHeld_, held_);
  before_.push_back(b_.apply("set", {b_.name(name, at), value}, at));
  return name;
}

// --- Draws ---

NodeId Expressions::set(const std::string& written, NodeId value, Span at) {
  return b_.apply("set", {b_.name(names_.value(written), at), value}, at);
}

// From the range that it was drawn from last.
NodeId Expressions::anew(std::string_view variable, Span at) {
  const NodeId least = b_.name(names_.value(leastOf(variable)), at);
  const NodeId most = b_.name(names_.value(mostOf(variable)), at);
  const NodeId any = b_.call("rand", {least, most}, at);
  return uses_.drawn().at(variable).whole ? b_.call("floor", {any}, at) : any;
}

Nodes Expressions::draw(const Statement& s) {
  const Span at = s.span;
  const std::string variable(s.name);
  lost_.erase(s.name);
  if (!uses_.isDrawn(s.name)) {
    unknownVariable(s.name, s.nameSpan);
    return {};
  }
  if (s.arguments.empty()) return {set(variable, anew(s.name, at), at)};
  bool known = true;
  double low = constant(s.arguments[0], known), high = constant(s.arguments[1], known);
  if (known && low > high) {
    diagnostics_.warning("reversed-range", at,
                         "the range of '" + variable + "' begins above its end",
                         "write the least value first");
    std::swap(low, high);
  }
  const bool whole = s.whole;
  NodeId least, most;
  if (known) {
    if (whole) {
      low = std::ceil(low);
      high = std::max(low, std::floor(high)) + 1;
    }
    least = b_.number(low, at);
    most = b_.number(high, at);
  } else {
    least = value(s.arguments[0]);
    most = value(s.arguments[1]);
    if (whole) {
      least = b_.call("ceil", {least}, at);
      most = b_.binary(BinaryOp::Add, b_.call("floor", {most}, at), b_.number(1, at), at);
    }
  }
  if (uses_.drawn().at(s.name).redrawn) {
    return {set(leastOf(s.name), least, at), set(mostOf(s.name), most, at),
            set(variable, anew(s.name, at), at)};
  }
  if (known && low == high) return {set(variable, least, at)};
  const NodeId any = b_.call("rand", {least, most}, at);
  return {set(variable, whole ? b_.call("floor", {any}, at) : any, at)};
}

NodeId Expressions::rand(const Expression& e) {
  const std::string_view variable = rolledBy(g_, e);
  if (variable.empty() || !uses_.isDrawn(variable)) {
    const NodeId least = value(e.parts[0]);
    if (e.parts.size() == 1 && variable.empty()) {
      diagnostics_.error("wrong-argument-count", e.span,
                         "'rand' draws between two values, or anew from the range of a variable",
                         "write 'rand(min max)'");
    }
    return e.parts.size() == 1 ? least : b_.call("rand", {least, value(e.parts[1])}, e.span);
  }
  // In the head of a rule nothing can stand before.
  if (!inStatement_) return anew(variable, e.span);
  before_.push_back(set(std::string(variable), anew(variable, e.span), e.span));
  lost_.erase(variable);
  return read(variable, e.span);
}

NodeId Expressions::read(std::string_view variable, Span at) {
  const NodeId value = b_.name(names_.value(variable), at);
  return mustHold(variable) ? b_.name(hold(value, at), at) : value;
}

// --- Names and functions ---

void Expressions::unknownVariable(std::string_view name, Span at) {
  if (!unknown_.insert(name).second) return;
  std::vector<std::string_view> known;
  for (const auto& [variable, drawn] : uses_.drawn()) known.push_back(variable);
  known.insert(known.end(), uses_.parameters().begin(), uses_.parameters().end());
  const std::string nearest = nearestName(name, known);
  std::string hint =
      nearest.empty() ? "declare it: R " + std::string(name) + " ( min max )" : meaning(nearest);
  diagnostics_.error("unknown-variable", at, "there is no variable '" + std::string(name) + "'",
                     std::move(hint));
  propose(diagnostics_, at, name, nearest);
}

NodeId Expressions::name(const Expression& e) {
  if (isConstant(e.name)) return b_.number(e.name == "e" || e.name == "E" ? kE : kPi, e.span);
  if (isTurnIndex(e.name)) {
    readsTurn_ = readsTurn_ || inTurns_;
    return inTurns_ ? b_.name(names_.value("repeatIndex"), e.span) : b_.number(0, e.span);
  }
  if (!uses_.isDrawn(e.name) && !uses_.isParameter(e.name)) {
    unknownVariable(e.name, e.span);
    return b_.number(0, e.span);
  }
  if (lost_.erase(e.name) > 0) {
    diagnostics_.error("drawn-in-brackets", e.span,
                       "'" + std::string(e.name) +
                           "' was drawn in brackets, and has its value "
                           "from before them again",
                       "draw it before the '['");
  }
  return read(e.name, e.span);
}

NodeId Expressions::function(const Expression& e) {
  const Function* f = functionNamed(e.name);
  if (!f) {
    std::vector<std::string_view> known;
    for (const std::string_view n : {"sin", "cos", "tan", "abs", "sqrt", "floor", "ceil", "min",
                                     "max", "float", "int", "rand"}) {
      known.push_back(n);
    }
    const std::string nearest = nearestName(e.name, known);
    diagnostics_.error("unknown-function", e.span,
                       "there is no function '" + std::string(e.name) + "'", meaning(nearest));
    // The call begins with its name.
    const auto length = static_cast<uint32_t>(e.name.size());
    propose(diagnostics_, {e.span.file, e.span.begin, e.span.begin + length}, e.name, nearest);
    return b_.number(0, e.span);
  }
  if (e.parts.size() < f->least || e.parts.size() > f->most) {
    diagnostics_.error("wrong-argument-count", e.span,
                       "'" + std::string(e.name) + "' cannot take " +
                           std::to_string(e.parts.size()) + " arguments",
                       std::string("write '") + f->form + "'");
    return b_.number(0, e.span);
  }
  if (e.name == "rand") return rand(e);
  const NodeId first = value(e.parts[0]);
  if (e.name == "float") return first;
  if (e.name == "sin" || e.name == "cos" || e.name == "tan") {
    return b_.ofRadians(f->name.data(), first, e.span);
  }
  if (e.name == "int") {
    truncates_ = true;
    return b_.call(names_.function("truncated"), {first}, e.span);
  }
  if (e.name == "sqrt") {
    return b_.call("sqrt", {b_.call("max", {b_.number(0, e.span), first}, e.span)}, e.span);
  }
  if (e.name != "min" && e.name != "max") return b_.call(e.name, {first}, e.span);
  NodeId out = first;
  for (size_t k = 1; k < e.parts.size(); ++k) {
    out = b_.call(e.name, {out, value(e.parts[k])}, e.span);
  }
  return out;
}

NodeId Expressions::quotient(NodeId a, NodeId b, Span at) {
  divides_ = true;
  return b_.call(names_.function("quotient"), {a, b}, at);
}

void Expressions::declareHelpers(Nodes& declarations, Span at) {
  if (divides_) declarations.push_back(b_.quotient(names_.function("quotient"), at));
  const auto a = [&] { return b_.name("a", at); };
  if (asksTruth_) {
    const NodeId one = b_.number(1, at);
    const NodeId body = b_.either(a(), one, b_.number(0, at), at);
    declarations.push_back(b_.function(names_.function("truth"), {"a"}, body, at));
  }
  if (truncates_) {
    const NodeId negative = b_.binary(BinaryOp::Less, a(), b_.number(0, at), at);
    const NodeId up = b_.call("ceil", {a()}, at);
    const NodeId body = b_.either(negative, up, b_.call("floor", {a()}, at), at);
    declarations.push_back(b_.function(names_.function("truncated"), {"a"}, body, at));
  }
}

// --- Values ---

double Expressions::constant(uint32_t id, bool& known) const {
  const Expression& e = g_.expressions[id];
  const auto part = [&](size_t k) { return constant(e.parts[k], known); };
  switch (e.kind) {
    case Kind::Number: return e.number;
    case Kind::Negate: return -part(0);
    case Kind::Add: return part(0) + part(1);
    case Kind::Subtract: return part(0) - part(1);
    case Kind::Multiply: return part(0) * part(1);
    case Kind::Divide: {
      const double by = part(1);
      return by == 0 ? 0 : part(0) / by;
    }
    default: known = false; return 0;
  }
}

NodeId Expressions::condition(uint32_t id) {
  const Expression& e = g_.expressions[id];
  if (!e.compares()) {
    return b_.binary(BinaryOp::NotEqual, value(id), b_.number(0, e.span), e.span);
  }
  const NodeId left = value(e.parts[0]);
  return b_.binary(operatorOf(e.kind), left, value(e.parts[1]), e.span);
}

NodeId Expressions::value(uint32_t id) {
  const Expression& e = g_.expressions[id];
  if (e.compares()) {
    asksTruth_ = true;
    return b_.call(names_.function("truth"), {condition(id)}, e.span);
  }
  switch (e.kind) {
    case Kind::Number: return b_.number(e.number, e.span);
    case Kind::Name: return name(e);
    case Kind::Function: return function(e);
    case Kind::Negate: return b_.unary(lang::UnaryOp::Minus, value(e.parts[0]), e.span);
    default: break;
  }
  const NodeId left = value(e.parts[0]), right = value(e.parts[1]);
  if (e.kind == Kind::Divide) return quotient(left, right, e.span);
  if (e.kind == Kind::Power) return b_.call("pow", {left, right}, e.span);
  return b_.binary(operatorOf(e.kind), left, right, e.span);
}

}  // namespace gable::progen3d::web
