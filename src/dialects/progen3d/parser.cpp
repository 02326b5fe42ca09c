// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// First the tokens are divided into rules, then each rule is parsed on its own: a mistake in one
// never hides the next. A line begins a rule when a name comes first in it and an arrow behind what
// can be a header; any other line goes on with the rule before.
//
// Mistakes are warnings here: the users of this notation expect that what can be drawn is drawn.

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/text.h"
#include "dialects/progen3d/grammar.h"
#include "dialects/progen3d/token_reader.h"

namespace gable::progen3d {

namespace {

using Kind = Expression::Kind;

struct CommandWord {
  std::string_view word;
  Step::Kind kind;
  size_t least, most;
  const char* form;
};
constexpr CommandWord kCommands[] = {
    {"S", Step::Kind::Scale, 3, 3, "S ( x y z )"},
    {"T", Step::Kind::Move, 3, 3, "T ( x y z )"},
    {"A", Step::Kind::Turn, 2, 2, "A ( degrees axis )"},
    {"D", Step::Kind::Taper, 3, 3, "D ( x y z )"},
    {"DS", Step::Kind::Front, 3, 3, "DS ( x y z )"},
    {"DT", Step::Kind::Top, 3, 3, "DT ( x y z )"},
    {"I", Step::Kind::Insert, 0, 3, "I ( Cube texture rotate scale )"},
};

constexpr std::pair<std::string_view, Body> kBodies[] = {{"Cube", Body::Cube},
                                                         {"CubeX", Body::CubeX},
                                                         {"CubeY", Body::CubeY},
                                                         {"Sphere", Body::Sphere},
                                                         {"Cylinder", Body::Cylinder}};

const CommandWord* commandOf(std::string_view word) {
  for (const CommandWord& c : kCommands) {
    if (c.word == word) return &c;
  }
  return nullptr;
}

class Parser : TokenReader {
 public:
  using TokenReader::TokenReader;

  Grammar run() {
    const std::vector<size_t> begins = ruleBegins();
    const size_t first = begins.empty() ? tokens_.size() - 1 : begins[0];
    if (first > 0) {
      error("no-arrow", {file_, tokens_[0].begin, tokens_[first - 1].end},
            "what stands before the first rule belongs to none", "write 'Name -> ...'");
    }
    for (size_t r = 0; r < begins.size(); ++r) {
      const size_t end = r + 1 < begins.size() ? begins[r + 1] : tokens_.size() - 1;
      parseRule(begins[r], end);
    }
    return std::move(grammar_);
  }

 private:
  // --- Rules: where they begin ---

  bool beginsRule(size_t i) const {
    if (!tokens_[i].firstOfLine || tokens_[i].kind != TokenKind::Name) return false;
    const bool command = commandOf(textOf(tokens_[i])) || textOf(tokens_[i]) == "R";
    for (size_t k = i + 1; k + 1 < tokens_.size() && !tokens_[k].firstOfLine; ++k) {
      switch (tokens_[k].kind) {
        case TokenKind::Arrow: return true;
        case TokenKind::Push:
        case TokenKind::Pop:
        case TokenKind::Pipe:
        case TokenKind::BraceOpen:
        case TokenKind::BraceClose: return false;
        case TokenKind::Open:
          if (command && k == i + 1) return false;
          break;
        default: break;
      }
    }
    return false;
  }

  std::vector<size_t> ruleBegins() const {
    std::vector<size_t> begins;
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (beginsRule(i)) begins.push_back(i);
    }
    return begins;
  }

  // --- Rules ---

  void parseRule(size_t begin, size_t end) {
    window(begin, end);
    Rule rule;
    rule.name = textOf(current());
    rule.nameSpan = spanOf(current());
    rule.span = {file_, tokens_[begin].begin, tokens_[end - 1].end};
    ++at_;
    parseHeader(rule);
    std::vector<Section> sections = parseSections();
    placeSections(rule, std::move(sections));
    if (accept(TokenKind::Arrow)) {
      rule.hasAlternate = true;
      rule.alternate = parseAlternate();
    }
    if (is(TokenKind::Arrow)) {
      error("unexpected-token", spanOf(current()),
            "a rule has one alternative; this is a third arrow", "move it to a rule of its own");
    }
    if (grammar_.rule(rule.name)) {
      warning(
          "rule-repeated", rule.nameSpan,
          "the rule '" + std::string(rule.name) + "' stands above already; the first one counts",
          "give this one another name");
      return;
    }
    grammar_.ruleIndex.emplace(rule.name, grammar_.rules.size());
    grammar_.rules.push_back(std::move(rule));
  }

  // [repeat] [variable ...] [; probability] ->
  void parseHeader(Rule& rule) {
    if (!is(TokenKind::Semicolon) && !is(TokenKind::Arrow)) rule.repeat = parseExpression();
    while (at_ < end_ && !is(TokenKind::Semicolon) && !is(TokenKind::Arrow)) {
      const Token t = current();
      ++at_;
      if (t.kind == TokenKind::Name) {
        rule.draws.push_back({textOf(t), spanOf(t)});
      } else {
        error("unexpected-token", spanOf(t),
              "'" + std::string(textOf(t)) + "' cannot stand in the head of a rule",
              "the form is 'Name repeat variable ... ; probability ->'");
      }
    }
    if (accept(TokenKind::Semicolon)) {
      if (!is(TokenKind::Arrow)) {
        rule.probability = parseExpression();
      } else {
        error("bad-probability", spanOf(tokens_[at_ - 1]),
              "a probability is missing behind this ';'", "write '; 0.5 ->', or remove the ';'");
      }
      const uint32_t begin = current().begin;
      while (at_ < end_ && !is(TokenKind::Arrow)) ++at_;
      if (lastEnd() > begin) {
        error("unexpected-token", since(begin), "this cannot stand behind the probability",
              "the form is 'Name repeat variable ... ; probability ->'");
      }
    }
    accept(TokenKind::Arrow);
  }

  std::vector<Section> parseSections() {
    std::vector<Section> sections(1);
    while (at_ < end_ && !is(TokenKind::Arrow)) {
      if (accept(TokenKind::Pipe)) {
        sections.emplace_back();
        pipe_ = spanOf(tokens_[at_ - 1]);
        continue;
      }
      parseStep(sections.back());
    }
    return sections;
  }

  Section parseAlternate() {
    Section out;
    while (at_ < end_ && !is(TokenKind::Arrow)) {
      if (is(TokenKind::Pipe)) {
        error("unexpected-token", spanOf(current()), "an alternative has no sections", "remove it");
        ++at_;
        continue;
      }
      parseStep(out);
    }
    const Span place = out.empty() ? Span{file_, lastEnd(), lastEnd()} : out.back().span;
    balance({&out}, place);
    return out;
  }

  // One: body. Two: start, body. Three: start, body, end; a '|' at the very end counts for nothing.
  void placeSections(Rule& rule, std::vector<Section> sections) {
    if (sections.size() > 1 && sections.back().empty() && sections.size() != 3) sections.pop_back();
    if (sections.size() > 3) {
      error("too-many-sections", pipe_,
            "the rule '" + std::string(rule.name) + "' has more than three sections",
            "write 'start | repeated | end'");
      return;
    }
    if (sections.size() == 1) {
      rule.body = std::move(sections[0]);
    } else {
      rule.start = std::move(sections[0]);
      rule.body = std::move(sections[1]);
      if (sections.size() == 3) rule.end = std::move(sections[2]);
    }
    const Span place{file_, lastEnd(), lastEnd()};
    balance({&rule.body}, place);
    balance({&rule.start, &rule.end}, place);
  }

  // Leaves out each ']' without a '[' and adds the missing ones at the end. Brackets that nest too
  // deeply are left out in pairs.
  void balance(const std::vector<Section*>& sections, Span place) {
    std::vector<Span> open;
    size_t tooDeep = 0;
    for (Section* s : sections) {
      Section kept;
      for (Step& step : *s) {
        if (step.kind == Step::Kind::Push && open.size() == kMaxNesting) {
          if (tooDeep++ == 0) {
            error("nesting-too-deep", step.span, "brackets nest too deeply here",
                  "move the inner part to a rule");
          }
          continue;
        }
        if (step.kind == Step::Kind::Push) open.push_back(step.span);
        if (step.kind == Step::Kind::Pop) {
          if (tooDeep > 0) {
            --tooDeep;
            continue;
          }
          if (open.empty()) {
            error("unexpected-bracket", step.span, "this ']' closes nothing", "remove it");
            continue;
          }
          open.pop_back();
        }
        kept.push_back(std::move(step));
      }
      *s = std::move(kept);
    }
    for (size_t i = open.size(); i-- > 0;) {
      error("unclosed-bracket", open[i], "this '[' is never closed",
            "add ']'; it ends with the section");
      Step pop;
      pop.kind = Step::Kind::Pop;
      pop.span = place;
      sections.back()->push_back(pop);
    }
  }

  // --- Steps ---

  void parseStep(Section& out) {
    const Token t = current();
    if (t.kind == TokenKind::Push || t.kind == TokenKind::Pop) {
      ++at_;
      Step step;
      step.kind = t.kind == TokenKind::Push ? Step::Kind::Push : Step::Kind::Pop;
      step.span = spanOf(t);
      out.push_back(std::move(step));
      return;
    }
    if (t.kind == TokenKind::BraceOpen || t.kind == TokenKind::BraceClose ||
        t.kind == TokenKind::Star) {
      ++at_;
      warning("ignored-sign", spanOf(t), "'" + std::string(textOf(t)) + "' has no meaning here",
              t.kind == TokenKind::Star ? "remove it" : "use '[' and ']' to come back to a place");
      return;
    }
    if (t.kind != TokenKind::Name) {
      ++at_;
      error("unexpected-token", spanOf(t), "'" + std::string(textOf(t)) + "' cannot stand here",
            "a section is made of S T A D I R, rules, '[' and ']'");
      return;
    }
    parseWord(out);
  }

  void parseWord(Section& out) {
    const Token t = current();
    const std::string_view word = textOf(t);
    ++at_;
    if (word == "R" && (is(TokenKind::Star) || is(TokenKind::Name))) return parseDeclaration(t);
    const CommandWord* command = commandOf(word);
    if (command && is(TokenKind::Open)) return parseCommand(out, t, *command);
    if (command && command->kind == Step::Kind::Insert) {
      error("missing-arguments", spanOf(t), "'I' needs to know what to insert",
            std::string("write '") + command->form + "'");
      return;
    }
    Step step;
    step.name = word;
    step.span = spanOf(t);
    if (is(TokenKind::Open)) {
      skipArguments();
      errorOfWord("unknown-word", step.span, "there is no operation '" + std::string(word) + "'",
                  "", operationLike(word));
      return;
    }
    out.push_back(std::move(step));
  }

  // Names of one letter are near none but that of the other case.
  static std::string operationLike(std::string_view word) {
    constexpr std::string_view kOperations[] = {"S", "T", "A", "D", "I", "R", "DS", "DT"};
    for (const std::string_view o : kOperations) {
      if (lowerCase(o) == lowerCase(word)) return std::string(o);
    }
    return nearestName(word, {std::begin(kOperations), std::end(kOperations)});
  }

  void skipArguments() {
    int depth = 0;
    while (at_ < end_) {
      if (is(TokenKind::Open)) ++depth;
      if (is(TokenKind::Close) && --depth == 0) {
        ++at_;
        return;
      }
      if (endsArguments()) return;
      ++at_;
    }
  }

  bool endsArguments() const {
    switch (current().kind) {
      case TokenKind::End:
      case TokenKind::Push:
      case TokenKind::Pop:
      case TokenKind::Pipe:
      case TokenKind::Semicolon:
      case TokenKind::Arrow:
      case TokenKind::BraceOpen:
      case TokenKind::BraceClose: return true;
      default: return false;
    }
  }

  // The expressions up to the closing bracket; the opening one is next.
  std::vector<uint32_t> parseArguments() {
    const Token open = current();
    ++at_;
    std::vector<uint32_t> out;
    while (!endsArguments() && !is(TokenKind::Close)) {
      if (accept(TokenKind::Comma)) continue;
      out.push_back(parseExpression());
    }
    if (!accept(TokenKind::Close)) {
      error("unclosed-bracket", spanOf(open), "this '(' is never closed", "add ')'");
    }
    return out;
  }

  void parseCommand(Section& out, const Token& word, const CommandWord& command) {
    Step step;
    step.kind = command.kind;
    bool known = true;
    if (command.kind == Step::Kind::Insert) {
      known = false;
      if (ahead(1).kind == TokenKind::Name) {
        const Token type = ahead(1);
        known = bodyNamed(type, step.body);
        // The type leaves the list of arguments.
        tokens_[at_ + 1] = {type.begin, type.end, TokenKind::Comma, false, false};
      } else {
        error("missing-arguments", spanOf(word), "'I' needs to know what to insert",
              std::string("write '") + command.form + "'");
      }
    }
    step.arguments = parseArguments();
    step.span = since(word.begin);
    if (step.arguments.size() > command.most) {
      error("wrong-argument-count", step.span,
            "'" + std::string(command.word) + "' has more arguments than it takes",
            std::string("the form is '") + command.form + "'; separate arguments by blanks only");
      step.arguments.resize(command.most);
    }
    if (step.arguments.size() < command.least) {
      error("wrong-argument-count", step.span,
            "'" + std::string(command.word) + "' takes " + std::to_string(command.least) +
                (command.least == 1 ? " argument, not " : " arguments, not ") +
                std::to_string(step.arguments.size()),
            std::string("the form is '") + command.form + "'");
      return;
    }
    if (!known) return;
    if (command.kind == Step::Kind::Turn) checkAxis(step);
    grammar_.centred |= command.kind == Step::Kind::Front || command.kind == Step::Kind::Top;
    out.push_back(std::move(step));
  }

  void checkAxis(const Step& turn) {
    bool known = true;
    const double axis = evaluate(grammar_, turn.arguments[1], known);
    if (!known || axis == 0 || axis == 1 || axis == 2) return;
    warning("bad-axis", grammar_.expressions[turn.arguments[1]].span,
            "there is no such axis; the place turns about " +
                std::string(std::trunc(axis) == 0   ? "x"
                            : std::trunc(axis) == 1 ? "y"
                                                    : "z"),
            "0 is x, 1 is y, 2 is z");
  }

  bool bodyNamed(const Token& t, Body& body) {
    for (const auto& [name, b] : kBodies) {
      if (name != textOf(t)) continue;
      body = b;
      return true;
    }
    std::vector<std::string_view> names;
    for (const auto& [name, b] : kBodies) names.push_back(name);
    errorOfWord("unknown-primitive", spanOf(t),
                "there is no primitive '" + std::string(textOf(t)) + "'",
                "there are Cube, CubeX, CubeY, Sphere and Cylinder", nearestName(textOf(t), names));
    return false;
  }

  // R name ( min max ) and R* name ( min max ), wherever it stands.
  void parseDeclaration(const Token& word) {
    Variable v;
    v.whole = accept(TokenKind::Star);
    if (!is(TokenKind::Name) || ahead(1).kind != TokenKind::Open) {
      error("missing-arguments", spanOf(word), "a variable needs a name and a range",
            "write 'R name ( min max )'");
      return;
    }
    v.name = textOf(current());
    ++at_;
    const std::vector<uint32_t> bounds = parseArguments();
    v.span = since(word.begin);
    if (bounds.size() != 2) {
      error("wrong-argument-count", v.span,
            "the range of '" + std::string(v.name) + "' is a least and a greatest value",
            "write 'R name ( min max )'");
      if (bounds.empty()) return;
    }
    v.min = constant(bounds[0], v.span);
    v.max = bounds.size() > 1 ? constant(bounds[1], v.span) : v.min;
    if (v.min > v.max) {
      warning("reversed-range", v.span,
              "the range of '" + std::string(v.name) + "' begins above its end",
              "write the least value first");
    }
    if (const Variable* first = grammar_.variable(v.name)) {
      if (first->min != v.min || first->max != v.max || first->whole != v.whole) {
        warning(
            "variable-repeated", v.span,
            "the variable '" + std::string(v.name) + "' has a range already; the first one counts",
            "give this one another name");
      }
      return;
    }
    grammar_.variableIndex.emplace(v.name, grammar_.variables.size());
    grammar_.variables.push_back(v);
  }

  double constant(uint32_t id, Span place) {
    bool known = true;
    const double v = evaluate(grammar_, id, known);
    if (!known || !std::isfinite(v)) {
      error("not-constant", place, "a range needs numbers", "write numbers without variables");
      return 0;
    }
    return v;
  }

  // --- Expressions: + - below * / below unary - below ^ ---

  uint32_t add(Expression e, uint32_t begin) {
    e.span = since(begin);
    for (const uint32_t part : {e.left, e.right}) {
      if (part != kNone) e.depth = std::max(e.depth, grammar_.expressions[part].depth + 1);
    }
    if (e.depth > kMaxNesting) {
      error("nesting-too-deep", e.span, "this expression is too long", "divide it");
      at_ = end_;
      e = Expression();
    }
    grammar_.expressions.push_back(e);
    return static_cast<uint32_t>(grammar_.expressions.size() - 1);
  }

  uint32_t number(double v, uint32_t begin) {
    Expression e;
    e.number = v;
    return add(e, begin);
  }

  uint32_t binary(Kind kind, uint32_t left, uint32_t right, uint32_t begin) {
    Expression e;
    e.kind = kind;
    e.left = left;
    e.right = right;
    return add(e, begin);
  }

  // Outside of inner brackets a sign with a blank before it and none behind begins an argument.
  bool signIsBinary() const {
    return innerBrackets_ > 0 || !current().spaceBefore || ahead(1).spaceBefore;
  }

  uint32_t parseExpression() {
    const uint32_t begin = current().begin;
    uint32_t left = parseProduct();
    while ((is(TokenKind::Plus) || is(TokenKind::Minus)) && signIsBinary()) {
      const Kind kind = is(TokenKind::Plus) ? Kind::Add : Kind::Subtract;
      ++at_;
      left = binary(kind, left, parseProduct(), begin);
    }
    return left;
  }

  uint32_t parseProduct() {
    const uint32_t begin = current().begin;
    uint32_t left = parseSigned();
    while (is(TokenKind::Star) || is(TokenKind::Slash)) {
      const Kind kind = is(TokenKind::Star) ? Kind::Multiply : Kind::Divide;
      ++at_;
      left = binary(kind, left, parseSigned(), begin);
    }
    return left;
  }

  uint32_t parseSigned() {
    const uint32_t begin = current().begin;
    if (++depth_ > kMaxNesting) return tooDeep();
    uint32_t out;
    if (accept(TokenKind::Plus)) {
      out = parseSigned();
    } else if (accept(TokenKind::Minus)) {
      const uint32_t operand = parseSigned();
      out = binary(Kind::Negate, operand, kNone, begin);
    } else {
      out = parsePower();
    }
    --depth_;
    return out;
  }

  uint32_t parsePower() {
    const uint32_t begin = current().begin;
    const uint32_t base = parsePrimary();
    if (!accept(TokenKind::Caret)) return base;
    return binary(Kind::Power, base, parseSigned(), begin);
  }

  uint32_t tooDeep() {
    const Span place = spanOf(current());
    error("nesting-too-deep", place, "this expression nests too deeply", "divide it");
    // Nothing of the rest of the rule could be understood.
    at_ = end_;
    --depth_;
    return number(0, place.begin);
  }

  uint32_t parsePrimary() {
    const Token t = current();
    Expression e;
    switch (t.kind) {
      case TokenKind::Number:
        ++at_;
        if (!parseNumber(textOf(t), e.number)) e.number = 0;
        return add(e, t.begin);
      case TokenKind::Name: ++at_; return parseName(t);
      case TokenKind::Ampersand:
        ++at_;
        e.kind = Kind::Draw;
        if (is(TokenKind::Name)) {
          e.name = textOf(current());
          ++at_;
          return add(e, t.begin);
        }
        error("unexpected-token", spanOf(t), "'&' needs the name of a variable", "write '&name'");
        return number(0, t.begin);
      case TokenKind::Open: ++at_; return inBrackets([&] { return parseExpression(); });
      default: break;
    }
    error("unexpected-token", spanOf(t),
          t.kind == TokenKind::End ? "a value is missing here"
                                   : "'" + std::string(textOf(t)) + "' is no value",
          "write a number, a variable or a calculation");
    const bool closes = t.kind == TokenKind::Close || t.kind == TokenKind::Comma || endsArguments();
    if (!closes) ++at_;
    return number(0, t.begin);
  }

  uint32_t parseName(const Token& t) {
    Expression e;
    e.name = textOf(t);
    const bool function = e.name == "sin" || e.name == "cos";
    if (function && accept(TokenKind::Open)) {
      e.kind = e.name == "sin" ? Kind::Sin : Kind::Cos;
      e.left = inBrackets([&] { return parseExpression(); });
      return add(e, t.begin);
    }
    e.kind = Kind::Name;
    return add(e, t.begin);
  }

  Grammar grammar_;
  Span pipe_;
  uint32_t depth_ = 0;
};

}  // namespace

const Variable* Grammar::variable(std::string_view name) const {
  const auto at = variableIndex.find(name);
  return at == variableIndex.end() ? nullptr : &variables[at->second];
}

const Rule* Grammar::rule(std::string_view name) const {
  const auto at = ruleIndex.find(name);
  return at == ruleIndex.end() ? nullptr : &rules[at->second];
}

double evaluate(const Grammar& grammar, uint32_t id, bool& known) {
  const Expression& e = grammar.expressions[id];
  const auto left = [&] { return evaluate(grammar, e.left, known); };
  const auto right = [&] { return evaluate(grammar, e.right, known); };
  switch (e.kind) {
    case Kind::Number: return e.number;
    case Kind::Negate: return -left();
    case Kind::Add: return left() + right();
    case Kind::Subtract: return left() - right();
    case Kind::Multiply: return left() * right();
    case Kind::Divide: {
      const double by = right();
      return by == 0 ? 0 : left() / by;
    }
    default: known = false; return 0;
  }
}

Grammar parseGrammar(std::string_view text, uint32_t file, std::vector<Token> tokens,
                     Diagnostics& diagnostics) {
  return Parser(text, file, std::move(tokens), diagnostics).run();
}

}  // namespace gable::progen3d
