// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions by precedence climbing (Richards 1979, "operator precedence parsing" in BCPL style).
// A '%' directly before ':' is no modulo but the end of a weight; ':' is an operator in brackets
// only, where it makes a range.

#include <algorithm>
#include <limits>
#include <string>

#include "base/number.h"
#include "lang/lexer.h"
#include "lang/other_languages.h"
#include "lang/parser_impl.h"

namespace gable::lang {

namespace {

struct Operator {
  BinaryOp op;
  int precedence;
};

// Precedence 0: no binary operator.
Operator operatorOf(TokenKind kind) {
  switch (kind) {
    case TokenKind::Or: return {BinaryOp::Or, 1};
    case TokenKind::And: return {BinaryOp::And, 2};
    case TokenKind::EqualEqual: return {BinaryOp::Equal, 3};
    case TokenKind::NotEqual: return {BinaryOp::NotEqual, 3};
    case TokenKind::Less: return {BinaryOp::Less, 4};
    case TokenKind::LessEqual: return {BinaryOp::LessEqual, 4};
    case TokenKind::Greater: return {BinaryOp::Greater, 4};
    case TokenKind::GreaterEqual: return {BinaryOp::GreaterEqual, 4};
    case TokenKind::Plus: return {BinaryOp::Add, 5};
    case TokenKind::Minus: return {BinaryOp::Subtract, 5};
    case TokenKind::Star: return {BinaryOp::Multiply, 6};
    case TokenKind::Slash: return {BinaryOp::Divide, 6};
    case TokenKind::Percent: return {BinaryOp::Modulo, 6};
    default: return {BinaryOp::Or, 0};
  }
}

}  // namespace

// A whole expression: what an argument, a size or the value of a function may be.
NodeId Parser::parseExpression() {
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  const uint32_t begin = current().begin;
  if (is(TokenKind::Tilde) || is(TokenKind::Quote)) {
    const NodeKind kind = is(TokenKind::Tilde) ? NodeKind::Floating : NodeKind::Relative;
    advance();
    const NodeId operand = parseExpression();
    return make(node(kind, begin), {operand});
  }
  const NodeId value = parseBinary(1);
  if (is(TokenKind::Percent) && ahead(1).kind == TokenKind::Colon) {
    return parsePercentChoice(value, begin, true);
  }
  if (is(TokenKind::Question)) skipTernary();
  return value;
}

// Signs of other languages: two that stand together, or '^', read as the one that is meant.
Parser::Sign Parser::foreignSignHere() const {
  if (at_ == arrowAt_ || inAnnotation_) return {};
  const Token& second = ahead(1);
  const bool pairs = second.begin == current().end &&
                     (second.kind == TokenKind::Greater || second.kind == TokenKind::Less ||
                      second.kind == TokenKind::Equal || second.kind == TokenKind::Star);
  if (!pairs && !is(TokenKind::Caret)) return {};
  const uint32_t end = pairs ? second.end : current().end;
  const ForeignWord* const row =
      foreignWord(ForeignUse::Operator, text_.substr(current().begin, end - current().begin));
  if (!row || row->meant == TokenKind::End) return {};
  return {row->meant, pairs ? 2u : 1u, row};
}

// The word or the single sign that stands where an operator is meant.
Parser::Sign Parser::wordOperatorHere() const {
  // Between the parts of a block it is a sign of its own.
  const bool bar = is(TokenKind::Pipe) && place_.blocks == 0;
  if (!bar && (!isName(current()) || declarationHere())) return {};
  const ForeignWord* const row = foreignWord(ForeignUse::Operator, textOf(current()));
  return row ? Sign{row->meant, 1, row} : Sign{};
}

// The operator at the current token, and how many tokens it has. What is written as in other
// languages is reported, and read as it is meant.
Parser::Sign Parser::operatorHere() {
  Sign sign = foreignSignHere();
  if (sign.tokens == 0) sign = wordOperatorHere();
  const bool assigns = sign.tokens == 0 && place_.comparing && is(TokenKind::Equal);
  if (assigns) sign = {TokenKind::EqualEqual, 1, nullptr};
  if (sign.tokens == 0) return {current().kind, 1, nullptr};
  const Span span = {file_, current().begin, ahead(sign.tokens - 1).end};
  const std::string written(text_.substr(span.begin, span.end - span.begin));
  error("unexpected-token", span,
        "'" + written + (assigns ? "' does not compare" : "' is no operator"),
        assigns ? "write '=='" : remedyOf(*sign.foreign));
  const std::string_view instead = assigns ? "==" : sign.foreign->instead;
  if (!instead.empty()) fix(span, std::string(instead));
  return sign;
}

// A unit behind a number: 1.2m, or 1.2 m where nothing else can be meant. Behind a name only as the
// last word of an argument: (height m).
bool Parser::unitAt(size_t at) const {
  constexpr std::string_view kUnits[] = {"m", "cm", "mm", "km", "ft", "deg"};
  const Token& t = token(at);
  if (at == 0 || !isName(t) ||
      std::find(std::begin(kUnits), std::end(kUnits), textOf(t)) == std::end(kUnits)) {
    return false;
  }
  const Token& before = token(at - 1);
  const Token& next = token(at + 1);
  const bool ends = next.kind == TokenKind::Comma || next.kind == TokenKind::RParen;
  if (before.kind != TokenKind::Number && !(isName(before) && ends)) return false;
  if (before.end == t.begin) return true;
  const std::string_view between = text_.substr(before.end, t.begin - before.end);
  if (between.find_first_not_of(" \t") != std::string_view::npos) return false;
  const bool endsLine =
      next.kind == TokenKind::End ||
      text_.substr(t.end, next.begin - t.end).find('\n') != std::string_view::npos;
  return ends || endsLine || next.kind == TokenKind::Colon || next.kind == TokenKind::Pipe;
}

void Parser::skipUnit() {
  if (!unitAt(at_) || declarationHere()) return;
  const Token& t = current();
  const std::string_view unit = textOf(t);
  error("unexpected-token", spanOf(t),
        "lengths and angles have no unit, but " + describe(t) + " stands here",
        unit == "m" || unit == "deg" ? "remove it: lengths are in metres, angles in degrees"
                                     : "lengths are in metres: write the number of metres alone");
  if (unit == "m" || unit == "deg") fix(spanOf(t), "");
  advance();
}

// Whether a value ends behind the token here: an argument, or a declaration before the next one.
bool Parser::endsBehind() const {
  const Token& next = ahead(1);
  switch (next.kind) {
    case TokenKind::Comma:
    case TokenKind::RParen:
    case TokenKind::At:
    case TokenKind::End: return true;
    default: break;
  }
  switch (next.keyword) {
    case Keyword::Attr:
    case Keyword::Const:
    case Keyword::Style:
    case Keyword::Import: return true;
    default: return next.kind == TokenKind::Name && ahead(2).kind == TokenKind::Arrow;
  }
}

// The sign of a share behind its number, 0.5'. Before a number it belongs to that one.
bool Parser::shareBehindAt(size_t at) const {
  const Token& t = token(at);
  if (at == 0 || t.kind != TokenKind::Quote) return false;
  const Token& next = token(at + 1);
  const bool before =
      next.begin == t.end && (next.kind == TokenKind::Number || next.kind == TokenKind::Name ||
                              next.kind == TokenKind::LParen);
  return !before && tokens_[at - 1].kind == TokenKind::Number && tokens_[at - 1].end == t.begin;
}

// Reports it, and reads the number as the share that is meant.
NodeId Parser::takeShareBehind(NodeId number) {
  if (!shareBehindAt(at_)) return number;
  const Token& digits = tokens_[at_ - 1];
  const std::string share = "'" + std::string(textOf(digits));
  const Span span = {file_, digits.begin, current().end};
  error("unexpected-token", span, "the sign of a share stands before its number",
        "write " + share + " for a share of the scope's size");
  fix(span, share);
  advance();
  return make(node(NodeKind::Relative, digits.begin), {number});
}

// A '%' that nothing follows to divide by: 50% in the place of '0.5.
bool Parser::skipPercent(NodeId left) {
  if (!is(TokenKind::Percent) || !endsBehind()) return false;
  const bool written = tree_.kind(left) == NodeKind::Number;
  const std::string share = written ? shortestText(tree_.number(left) / 100) : "0.5";
  error("unexpected-token", spanOf(current()), "'%' is no unit of a value",
        "write '" + share + " for a share of the scope's size, " + share + " for a plain number");
  advance();
  return true;
}

// `not` before a value.
bool Parser::notHere() const {
  const Token& next = ahead(1);
  const bool operand = next.kind == TokenKind::Number || next.kind == TokenKind::Name;
  return isName(current()) && isWord(current(), "not") && operand &&
         next.keyword != Keyword::Else && !isWord(next, "and") && !isWord(next, "or");
}

NodeId Parser::parseNot() {
  const Token word = current();
  advance();
  constexpr int kComparison = 3;
  const uint32_t begin = current().begin;
  const NodeId operand = parseBinary(kComparison);
  const uint32_t end = std::max(begin, endOfLast());
  const bool simple = tree_.kind(operand) != NodeKind::Binary;
  const std::string negated(text_.substr(begin, end - begin));
  const std::string written = simple ? "!" + negated : "!(" + negated + ")";
  error("unexpected-token", spanOf(word), describe(word) + " is no operator", "write " + written);
  fix({file_, word.begin, end}, written);
  Node n = node(NodeKind::Unary, word.begin);
  n.op = static_cast<uint8_t>(UnaryOp::Not);
  return make(n, {operand});
}

NodeId Parser::parseBinary(int minPrecedence) {
  const uint32_t begin = current().begin;
  NodeId left = parseUnary();
  while (!panic_) {
    const Sign sign = operatorHere();
    const Operator op = operatorOf(sign.kind);
    if (op.precedence == 0 || op.precedence < minPrecedence) break;
    if (is(TokenKind::Percent) && ahead(1).kind == TokenKind::Colon) break;
    if (skipPercent(left)) break;
    if (dashCommentHere()) {
      skipDashComment();
      break;
    }
    const bool elementwise = current().elementwise;
    for (size_t i = 0; i < sign.tokens; ++i) advance();
    const NodeId right = parseBinary(op.precedence + 1);
    Node n = node(NodeKind::Binary, begin);
    n.op = static_cast<uint8_t>(op.op);
    if (elementwise) n.flags = kFlagElementwise;
    left = make(n, {left, right});
  }
  return left;
}

NodeId Parser::parseUnary() {
  const TokenKind kind = current().kind;
  const bool prefix = kind == TokenKind::Quote || kind == TokenKind::Tilde;
  const bool isNot = notHere() && !declarationHere();
  if (!prefix && !isNot && kind != TokenKind::Minus && kind != TokenKind::Plus &&
      kind != TokenKind::Not) {
    return parsePostfix();
  }
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  if (isNot) return parseNot();
  const Token sign = current();
  advance();
  const NodeId operand = parseUnary();
  if (prefix) {
    return make(
        node(kind == TokenKind::Tilde ? NodeKind::Floating : NodeKind::Relative, sign.begin),
        {operand});
  }
  Node n = node(NodeKind::Unary, sign.begin);
  n.op = static_cast<uint8_t>(kind == TokenKind::Minus  ? UnaryOp::Minus
                              : kind == TokenKind::Plus ? UnaryOp::Plus
                                                        : UnaryOp::Not);
  if (sign.elementwise) n.flags = kFlagElementwise;
  return make(n, {operand});
}

NodeId Parser::parsePostfix() {
  const TokenKind first = current().kind;
  NodeId value = parsePrimary();
  if (first == TokenKind::Number || first == TokenKind::String) return value;
  while (!panic_ && is(TokenKind::LBracket) && tree_.kind(value) != NodeKind::Missing) {
    value = parseIndex(value);
  }
  return value;
}

NodeId Parser::parsePrimary() {
  if (panic_) return missing();
  const Token t = current();
  if (t.kind == TokenKind::Number) {
    Node n = node(NodeKind::Number, t.begin);
    // Digits that fit no double: beyond the largest unless the exponent is negative.
    if (!parseNumber(textOf(t), n.number)) {
      const bool small = textOf(t).find('-') != std::string_view::npos;
      n.number = small ? 0 : std::numeric_limits<double>::infinity();
    }
    advance();
    skipUnit();
    n.end = t.end;
    return takeShareBehind(tree_.add(n));
  }
  if (t.kind == TokenKind::String) {
    Node n = node(NodeKind::String, t.begin);
    n.text = tree_.intern(stringValue(textOf(t)));
    advance();
    n.end = t.end;
    return tree_.add(n);
  }
  if (t.kind == TokenKind::LParen) {
    advance();
    const NodeId inner = parseExpression();
    if (!accept(TokenKind::RParen)) {
      const std::string comment = hintOfComment(')');
      if (!comment.empty()) {
        error("unclosed-bracket", spanOf(t), "this '(' is never closed", comment);
      } else {
        unexpected("')' to close the expression");
      }
    }
    tree_.setSpan(inner, t.begin, endOfLast());
    return inner;
  }
  if (t.kind == TokenKind::LBracket) return parseArray();
  if (t.keyword == Keyword::Case) {
    const Nest nest(*this);
    return nest.ok() ? parseCaseChoice(true) : missing();
  }
  if (t.keyword == Keyword::True || t.keyword == Keyword::False) {
    Node n = node(NodeKind::Bool, t.begin);
    n.number = t.keyword == Keyword::True ? 1 : 0;
    advance();
    n.end = t.end;
    return tree_.add(n);
  }
  if (takeIf(true)) {
    const Nest nest(*this);
    return nest.ok() ? parseCaseChoice(true) : missing();
  }
  if (isName(t) && !declarationHere()) return parseNameExpression();
  if (!reportBareColour()) unexpected("a value");
  return missing();
}

NodeId Parser::parseNameExpression() {
  const Token name = current();
  advance();
  if (!is(TokenKind::LParen)) {
    skipUnit();
    return named(NodeKind::Name, name);
  }
  const NodeId arguments = parseArguments();
  if (memberHere()) return parseMember(name, arguments, NodeKind::ImportCall);
  Node n = node(NodeKind::Call, name.begin);
  n.text = tree_.intern(textOf(name));
  const NodeId block = is(TokenKind::LBrace) ? parseBlock(true) : kNoNode;
  n.end = endOfLast();
  return make(n, {arguments, block});
}

// e, e : e or e : e : e.
NodeId Parser::parseRange() {
  const uint32_t begin = current().begin;
  const NodeId from = parseExpression();
  if (!accept(TokenKind::Colon)) return from;
  const NodeId second = parseExpression();
  if (!accept(TokenKind::Colon)) return make(node(NodeKind::Range, begin), {from, kNoNode, second});
  const NodeId to = parseExpression();
  return make(node(NodeKind::Range, begin), {from, second, to});
}

NodeId Parser::parseArray() {
  const uint32_t begin = current().begin;
  advance();
  Nodes rows;
  for (;;) {
    const uint32_t rowBegin = current().begin;
    Nodes values;
    do {
      values.push_back(parseRange());
    } while (!panic_ && accept(TokenKind::Comma));
    rows.push_back(list(rowBegin, values));
    if (panic_ || !accept(TokenKind::Semicolon)) break;
  }
  expect(TokenKind::RBracket, "or ',' after a value of the array");
  return make(node(NodeKind::Array, begin), rows);
}

NodeId Parser::parseIndex(NodeId base) {
  const uint32_t begin = tree_[base].begin;
  advance();
  const NodeId row = parseRange();
  const NodeId column = accept(TokenKind::Comma) ? parseRange() : kNoNode;
  expect(TokenKind::RBracket, "after the index");
  return make(node(NodeKind::Index, begin), {base, row, column});
}

// A value, `name = value`, or within closed brackets an override `Rule --> successors`.
NodeId Parser::parseArgument(bool matched) {
  if (matched && isName(current()) && ahead(1).kind == TokenKind::Colon) {
    const Span name = {file_, current().begin, ahead(2).begin};
    error("unexpected-token", spanOf(ahead(1)), "an argument has no ':' before its value",
          "write the value alone; operations, functions and imports take '" +
              std::string(textOf(current())) + " = value' as well");
    fix(name, "");
    at_ += 2;
    return parseExpression();
  }
  if (isName(current()) && ahead(1).kind == TokenKind::Equal) {
    Node n = node(NodeKind::NamedArg, current().begin);
    n.text = tree_.intern(textOf(current()));
    advance();
    advance();
    const NodeId value = parseExpression();
    n.end = endOfLast();
    return make(n, {value});
  }
  if (matched && headAt(at_) == Head::Rule) {
    const Enter enter(*this, {0, false, true});
    return parseDefinition(kNoNode, Keyword::None);
  }
  return parseExpression();
}

// Whether another argument follows without a comma, as in color(0.5 0.5 0.5): each is reported.
bool Parser::commaMissing(bool matched) {
  if (!matched || (!is(TokenKind::Number) && !is(TokenKind::String))) return false;
  unexpected("',' between arguments", "write ',' before it");
  fix(spanAt(endOfLast()), ",");
  return true;
}

NodeId Parser::parseArguments() {
  const Token open = current();
  advance();
  const bool matched = open.match != Token::kNoMatch;
  Nodes items;
  while (!panic_ && !is(TokenKind::RParen) && (matched || !declarationHere())) {
    items.push_back(parseArgument(matched));
    if (!accept(TokenKind::Comma) && !commaMissing(matched)) break;
    if (is(TokenKind::RParen)) unexpected("another argument after ','");
  }
  if (!accept(TokenKind::RParen)) {
    if (matched) {
      unexpected("',' or ')' after an argument");
      if (open.match >= at_) at_ = open.match;
      accept(TokenKind::RParen);
    } else if (reportBareColour()) {
      items.push_back(missing());
    } else {
      const std::string comment = hintOfComment(')');
      error("unclosed-bracket", spanOf(open), "this '(' is never closed",
            comment.empty() ? "add ')' before " + describe(current()) : comment);
    }
  }
  return list(open.begin, items);
}

}  // namespace gable::lang
