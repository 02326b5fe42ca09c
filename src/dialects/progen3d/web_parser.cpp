// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A line begins a rule when a name comes first in it and an arrow behind what can be a head, as in
// the other notation. Rules are parsed one by one, and mistakes are warnings: what can be drawn is
// drawn.

#include <algorithm>
#include <utility>

#include "base/number.h"
#include "base/text.h"
#include "dialects/progen3d/token_reader.h"
#include "dialects/progen3d/web_grammar.h"
#include "dialects/progen3d/web_words.h"

namespace gable::progen3d::web {

namespace {

using Kind = Expression::Kind;

class Parser : TokenReader {
 public:
  using TokenReader::TokenReader;

  Grammar run() {
    std::vector<size_t> begins;
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (beginsRule(i)) begins.push_back(i);
    }
    const size_t first = begins.empty() ? tokens_.size() - 1 : begins[0];
    if (first > 0) {
      error("no-arrow", {file_, tokens_[0].begin, tokens_[first - 1].end},
            "what stands before the first rule belongs to none", "write 'Name -> ...'");
    }
    for (size_t r = 0; r < begins.size(); ++r) {
      parseRule(begins[r], r + 1 < begins.size() ? begins[r + 1] : tokens_.size() - 1);
    }
    return std::move(grammar_);
  }

 private:
  bool beginsRule(size_t i) const {
    if (!tokens_[i].firstOfLine || tokens_[i].kind != TokenKind::Name) return false;
    int depth = 0;
    for (size_t k = i + 1; k + 1 < tokens_.size() && !tokens_[k].firstOfLine; ++k) {
      switch (tokens_[k].kind) {
        case TokenKind::Open: ++depth; break;
        case TokenKind::Close:
          if (depth-- == 0) return false;
          break;
        case TokenKind::Arrow:
          if (depth == 0) return true;
          break;
        case TokenKind::Push:
        case TokenKind::Pop:
        case TokenKind::Pipe:
        case TokenKind::Question:
        case TokenKind::Colon:
          if (depth == 0) return false;
          break;
        default: break;
      }
    }
    return false;
  }

  // --- Rules ---

  void parseRule(size_t begin, size_t end) {
    window(begin, end);
    const uint32_t place = tokens_[end - 1].end;
    findColons();
    const Token name = current();
    ++at_;
    Variant variant;
    variant.span = {file_, name.begin, place};
    if (accept(TokenKind::Open)) parseParameters(variant);
    if (!is(TokenKind::Semicolon) && !is(TokenKind::Arrow)) variant.repeat = parseExpression();
    if (accept(TokenKind::Semicolon)) {
      if (is(TokenKind::Arrow)) {
        error("bad-probability", spanOf(tokens_[at_ - 1]), "a weight is missing behind this ';'",
              "write '; 2 ->', or remove the ';'");
      } else {
        variant.weight = parseExpression();
      }
    }
    const uint32_t rest = current().begin;
    const size_t from = at_;
    while (at_ < end_ && !is(TokenKind::Arrow)) ++at_;
    if (at_ > from) {
      error("unexpected-token", since(rest), "this cannot stand in the head of a rule",
            "the form is 'Name ( parameters ) repeat ; weight ->'");
    }
    accept(TokenKind::Arrow);
    parseSections(variant.body);
    add(name, std::move(variant));
  }

  void parseParameters(Variant& variant) {
    while (at_ < end_ && !is(TokenKind::Close) && !is(TokenKind::Arrow)) {
      const Token t = current();
      ++at_;
      if (t.kind == TokenKind::Name) {
        variant.parameters.push_back({textOf(t), spanOf(t)});
      } else if (t.kind != TokenKind::Comma) {
        error("unexpected-token", spanOf(t),
              "'" + std::string(textOf(t)) + "' is no name of a parameter",
              "the form is 'Name ( parameters ) repeat ; weight ->'");
      }
    }
    accept(TokenKind::Close);
  }

  void parseSections(Sequence& body) {
    size_t sections = 1;
    while (at_ < end_) {
      parseSequence(body);
      if (at_ >= end_) return;
      const Token t = current();
      ++at_;
      if (t.kind != TokenKind::Pipe) {
        stray(t);
      } else if (++sections > 3) {
        error("too-many-sections", spanOf(t), "a rule has three sections at most",
              "write 'before | main | after'");
        at_ = end_;
      }
    }
  }

  void add(const Token& name, Variant variant) {
    const std::string_view word = textOf(name);
    if (isCommand(word)) {
      warning("reserved-name", spanOf(name),
              "'" + std::string(word) + "' is a word of the language, so this rule is never called",
              "give it another name");
    }
    for (Rule& r : grammar_.rules) {
      if (r.name == word) {
        r.variants.push_back(std::move(variant));
        return;
      }
    }
    Rule& rule = grammar_.rules.emplace_back();
    rule.name = word;
    rule.nameSpan = spanOf(name);
    rule.variants.push_back(std::move(variant));
  }

  // --- Statements ---

  // Up to what cannot stand in a sequence; a ':' ends it where a condition waits for one.
  void parseSequence(Sequence& out) {
    while (at_ < end_) {
      switch (current().kind) {
        case TokenKind::Pipe:
        case TokenKind::Pop: return;
        case TokenKind::Colon:
          if (waitForColon_ > 0) return;
          stray(current());
          ++at_;
          break;
        case TokenKind::Push: parseGroup(out); break;
        case TokenKind::Question: parseCondition(out); break;
        case TokenKind::Name: parseWord(out); break;
        default: stray(current()); ++at_;
      }
    }
  }

  void stray(const Token& t) {
    error("unexpected-token", spanOf(t), "'" + std::string(textOf(t)) + "' cannot stand here",
          "a section is made of words such as T S A I R, of rules, '[', ']' and '?( )'");
  }

  bool enter(const Token& t) {
    if (++depth_ <= kMaxNesting) return true;
    error("nesting-too-deep", spanOf(t), "brackets nest too deeply here",
          "move the inner part to a rule");
    // Nothing of the rest of the rule could be understood.
    at_ = end_;
    return false;
  }

  void parseGroup(Sequence& out) {
    const Token open = current();
    ++at_;
    Statement group;
    group.kind = Statement::Kind::Group;
    const int waiting = std::exchange(waitForColon_, 0);
    if (enter(open)) parseSequence(group.body);
    while (is(TokenKind::Pipe)) {
      stray(current());
      ++at_;
      parseSequence(group.body);
    }
    --depth_;
    waitForColon_ = waiting;
    if (!accept(TokenKind::Pop)) {
      error("unclosed-bracket", spanOf(open), "this '[' is never closed", "add ']'");
    }
    group.span = since(open.begin);
    out.push_back(std::move(group));
  }

  // ?( condition ) Rule, or ?( condition ) statements : statements to the end of the sequence.
  void parseCondition(Sequence& out) {
    const Token question = current();
    ++at_;
    Statement s;
    s.kind = Statement::Kind::Condition;
    const Token open = current();
    if (!accept(TokenKind::Open)) {
      error("unexpected-token", spanOf(question), "a condition needs brackets",
            "write '?( a > 1 ) Rule'");
      return;
    }
    s.arguments.push_back(parseExpression());
    if (!accept(TokenKind::Close)) {
      error("unclosed-bracket", spanOf(open), "this '(' is never closed", "add ')'");
    }
    if (!enter(question)) {
      --depth_;
      return;
    }
    if (colonFollows()) {
      ++waitForColon_;
      parseSequence(s.body);
      --waitForColon_;
      accept(TokenKind::Colon);
      parseSequence(s.otherwise);
    } else if (is(TokenKind::Name)) {
      parseWord(s.body);
    } else {
      error("missing-arguments", spanOf(question), "nothing follows this condition",
            "write '?( a > 1 ) Rule', or '?( a > 1 ) this : that'");
    }
    --depth_;
    s.span = since(question.begin);
    out.push_back(std::move(s));
  }

  bool colonFollows() const { return at_ < end_ && colonAhead_[at_ - begin_]; }

  // For each token of the rule whether a ':' of the same sequence lies ahead, from the end.
  void findColons() {
    colonAhead_.assign(end_ - begin_, false);
    std::vector<bool> levels{false};
    int round = 0;
    for (size_t k = end_; k-- > begin_;) {
      switch (tokens_[k].kind) {
        case TokenKind::Close: ++round; break;
        case TokenKind::Open: round -= round > 0; break;
        case TokenKind::Pop: levels.push_back(false); break;
        case TokenKind::Push:
          if (levels.size() > 1) levels.pop_back();
          break;
        case TokenKind::Pipe: levels.back() = false; break;
        case TokenKind::Colon: levels.back() = levels.back() || round == 0; break;
        default: break;
      }
      colonAhead_[k - begin_] = levels.back();
    }
  }

  void parseWord(Sequence& out) {
    const Token t = current();
    ++at_;
    if (textOf(t) == "R" && (is(TokenKind::Star) || is(TokenKind::Name))) return parseDraw(t, out);
    if (const Command* command = commandNamed(textOf(t))) return parseCommand(t, *command, out);
    Statement call;
    call.name = textOf(t);
    call.nameSpan = spanOf(t);
    if (is(TokenKind::Open)) call.arguments = parseArguments(false);
    call.span = since(t.begin);
    out.push_back(std::move(call));
  }

  // R name ( min max ), R* name ( min max ), R name.
  void parseDraw(const Token& word, Sequence& out) {
    Statement s;
    s.kind = Statement::Kind::Draw;
    s.whole = accept(TokenKind::Star);
    if (!is(TokenKind::Name)) {
      error("missing-arguments", spanOf(word), "a variable needs a name and a range",
            "write 'R name ( min max )'");
      return;
    }
    s.name = textOf(current());
    s.nameSpan = spanOf(current());
    ++at_;
    if (is(TokenKind::Open)) {
      s.arguments = parseArguments(true);
      if (s.arguments.size() != 2) {
        error("wrong-argument-count", since(word.begin),
              "the range of '" + std::string(s.name) + "' is a least and a greatest value",
              "write 'R name ( min max )'");
        if (s.arguments.empty()) return;
        s.arguments.resize(2, s.arguments[0]);
      }
    }
    s.span = since(word.begin);
    out.push_back(std::move(s));
  }

  void parseCommand(const Token& word, const Command& command, Sequence& out) {
    Statement s;
    s.kind = command.kind;
    s.axis = command.axis;
    if (!is(TokenKind::Open)) {
      error("missing-arguments", spanOf(word),
            "'" + std::string(command.word) + "' needs arguments",
            std::string("write '") + command.form + "'");
      return;
    }
    bool known = true;
    if (command.kind == Statement::Kind::Insert) known = parseBody(s);
    s.arguments = parseArguments(true);
    s.span = since(word.begin);
    if (s.arguments.size() != command.count) {
      error("wrong-argument-count", s.span,
            "'" + std::string(command.word) + "' takes " + std::to_string(command.count) +
                (command.count == 1 ? " number, not " : " numbers, not ") +
                std::to_string(s.arguments.size()),
            std::string("the form is '") + command.form +
                "'; a '-' with a blank before it begins a new argument, so put brackets around "
                "such calculations");
      if (s.arguments.size() < command.count) return;
      s.arguments.resize(command.count);
    }
    if (known) out.push_back(std::move(s));
  }

  // The body and the texture behind the bracket, which become commas.
  bool parseBody(Statement& s) {
    const Token body = ahead(1), texture = ahead(2);
    const auto take = [&](size_t n) {
      const Token& t = tokens_[at_ + n];
      tokens_[at_ + n] = {t.begin, t.end, TokenKind::Comma, false, false};
    };
    if (body.kind != TokenKind::Name) {
      error("missing-arguments", spanOf(current()), "'I' needs to know what to insert",
            "write 'I ( Cube brick 0.5 )'");
      return false;
    }
    take(1);
    if (texture.kind == TokenKind::Name) {
      s.name = textOf(texture);
      s.nameSpan = spanOf(texture);
      take(2);
    } else {
      error("missing-arguments", spanOf(texture), "a texture has a name here",
            "write 'I ( Cube brick 0.5 )'");
    }
    static constexpr std::string_view kBodies[] = {"CubeX", "CubeY", "CubeZ", "Cube"};
    const auto* at = std::find(std::begin(kBodies), std::end(kBodies), textOf(body));
    s.axis = static_cast<uint32_t>(at - kBodies);
    if (at != std::end(kBodies)) return true;
    errorOfWord("unknown-primitive", spanOf(body),
                "there is no primitive '" + std::string(textOf(body)) + "'",
                "there are Cube, CubeX, CubeY and CubeZ",
                nearestName(textOf(body), {"Cube", "CubeX", "CubeY", "CubeZ"}));
    return false;
  }

  // --- Arguments: `parted` are those where a '-' with a blank before it begins a new one ---

  bool endsArguments() const {
    switch (current().kind) {
      case TokenKind::End:
      case TokenKind::Push:
      case TokenKind::Pop:
      case TokenKind::Pipe:
      case TokenKind::Semicolon:
      case TokenKind::Arrow:
      case TokenKind::Question:
      case TokenKind::Colon: return true;
      default: return false;
    }
  }

  std::vector<uint32_t> parseArguments(bool parted) {
    const Token open = current();
    ++at_;
    const bool before = std::exchange(parted_, parted);
    const int brackets = std::exchange(innerBrackets_, 0);
    std::vector<uint32_t> out;
    while (!endsArguments() && !is(TokenKind::Close)) {
      if (!accept(TokenKind::Comma)) out.push_back(parseExpression());
    }
    parted_ = before;
    innerBrackets_ = brackets;
    if (!accept(TokenKind::Close)) {
      error("unclosed-bracket", spanOf(open), "this '(' is never closed", "add ')'");
    }
    return out;
  }

  // --- Expressions: comparisons below + - below * / below ^ below unary - ---

  uint32_t add(Expression e, uint32_t begin) {
    e.span = since(begin);
    for (const uint32_t part : e.parts) {
      e.depth = std::max(e.depth, grammar_.expressions[part].depth + 1);
    }
    if (e.depth > kMaxNesting) {
      error("nesting-too-deep", e.span, "this expression is too long", "divide it");
      at_ = end_;
      e = Expression();
    }
    grammar_.expressions.push_back(std::move(e));
    return static_cast<uint32_t>(grammar_.expressions.size() - 1);
  }

  uint32_t make(Kind kind, std::vector<uint32_t> parts, uint32_t begin) {
    Expression e;
    e.kind = kind;
    e.parts = std::move(parts);
    return add(std::move(e), begin);
  }

  // Operators that associate to the left, from a table of tokens and kinds.
  template <size_t N, class Next>
  uint32_t leftToRight(const std::pair<TokenKind, Kind> (&table)[N], Next next) {
    const uint32_t begin = current().begin;
    uint32_t left = next();
    for (;;) {
      const auto* found = std::find_if(std::begin(table), std::end(table), [&](const auto& row) {
        return row.first == current().kind;
      });
      if (found == std::end(table) || partsHere()) return left;
      ++at_;
      left = make(found->second, {left, next()}, begin);
    }
  }

  bool partsHere() const {
    return parted_ && innerBrackets_ == 0 && is(TokenKind::Minus) && current().spaceBefore;
  }

  uint32_t parseExpression() {
    static constexpr std::pair<TokenKind, Kind> kComparisons[] = {
        {TokenKind::Less, Kind::Less},       {TokenKind::LessEqual, Kind::LessEqual},
        {TokenKind::Greater, Kind::Greater}, {TokenKind::GreaterEqual, Kind::GreaterEqual},
        {TokenKind::Equal, Kind::Equal},     {TokenKind::NotEqual, Kind::NotEqual}};
    static constexpr std::pair<TokenKind, Kind> kSums[] = {{TokenKind::Plus, Kind::Add},
                                                           {TokenKind::Minus, Kind::Subtract}};
    static constexpr std::pair<TokenKind, Kind> kProducts[] = {{TokenKind::Star, Kind::Multiply},
                                                               {TokenKind::Slash, Kind::Divide}};
    return leftToRight(kComparisons, [&] {
      return leftToRight(kSums, [&] { return leftToRight(kProducts, [&] { return power(); }); });
    });
  }

  uint32_t power() {
    const uint32_t begin = current().begin;
    if (++depth_ > kMaxNesting) return tooDeep();
    const uint32_t base = signedValue();
    uint32_t out = base;
    if (accept(TokenKind::Caret)) out = make(Kind::Power, {base, power()}, begin);
    --depth_;
    return out;
  }

  uint32_t signedValue() {
    const uint32_t begin = current().begin;
    bool negative = false;
    while (is(TokenKind::Minus) || is(TokenKind::Plus)) {
      negative ^= is(TokenKind::Minus);
      ++at_;
    }
    const uint32_t value = primary();
    return negative ? make(Kind::Negate, {value}, begin) : value;
  }

  uint32_t tooDeep() {
    const Span place = spanOf(current());
    error("nesting-too-deep", place, "this expression nests too deeply", "divide it");
    at_ = end_;
    --depth_;
    return add(Expression(), place.begin);
  }

  uint32_t primary() {
    const Token t = current();
    Expression e;
    switch (t.kind) {
      case TokenKind::Number:
        ++at_;
        if (!parseNumber(textOf(t), e.number)) e.number = 0;
        return add(std::move(e), t.begin);
      case TokenKind::Name:
        ++at_;
        e.name = textOf(t);
        e.kind = Kind::Name;
        // Elsewhere a bracket behind a name begins the next argument.
        if (is(TokenKind::Open) && (isFunction(e.name) || !parted_)) {
          e.kind = Kind::Function;
          e.parts = parseArguments(false);
        }
        return add(std::move(e), t.begin);
      case TokenKind::Open: ++at_; return inBrackets([&] { return parseExpression(); });
      default: break;
    }
    error("unexpected-token", spanOf(t),
          t.kind == TokenKind::End ? "a value is missing here"
                                   : "'" + std::string(textOf(t)) + "' is no value",
          "write a number, a variable or a calculation");
    if (!is(TokenKind::Close) && !is(TokenKind::Comma) && !endsArguments()) ++at_;
    return add(std::move(e), t.begin);
  }

  Grammar grammar_;
  std::vector<bool> colonAhead_;
  int waitForColon_ = 0;
  bool parted_ = false;
  uint32_t depth_ = 0;
};

}  // namespace

const Rule* Grammar::rule(std::string_view name) const {
  for (const Rule& r : rules) {
    if (r.name == name) return &r;
  }
  return nullptr;
}

Grammar parseGrammar(std::string_view text, uint32_t file, std::vector<Token> tokens,
                     Diagnostics& diagnostics) {
  return Parser(text, file, std::move(tokens), diagnostics).run();
}

}  // namespace gable::progen3d::web
