// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Declarations, and what all productions share. The language has no separators: a declaration ends
// where the next one begins, which headAt and declarationAt see from a few tokens ahead because
// brackets know their partners. The same test, made stricter inside braces, is what a forgotten
// bracket recovers at: the head of the next rule closes everything that is open.

#include "lang/parser.h"

#include <algorithm>
#include <utility>

#include "lang/lexer.h"
#include "lang/parser_impl.h"

namespace gable::lang {

Parser::Parser(std::string_view text, uint32_t file, const Tokens& tokens, Diagnostics& diagnostics)
    : text_(text),
      file_(file),
      tokens_(tokens.tokens),
      comments_(tokens.comments),
      diagnostics_(diagnostics),
      tree_(file) {}

// --- Tokens ---

bool Parser::accept(TokenKind kind) {
  if (!is(kind)) return false;
  advance();
  return true;
}

bool Parser::expect(TokenKind kind, const char* where) {
  if (accept(kind)) return true;
  unexpected(std::string(tokenKindName(kind)) + " " + where);
  return false;
}

bool Parser::isName(const Token& t) const {
  return t.kind == TokenKind::Name && t.keyword != Keyword::Case && t.keyword != Keyword::Else &&
         t.keyword != Keyword::True && t.keyword != Keyword::False;
}

bool Parser::isWord(const Token& t, std::string_view word) const {
  const std::string_view text = textOf(t);
  return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

size_t Parser::skipBrackets(size_t index) const {
  const Token& t = token(index);
  if (t.kind != TokenKind::LParen || t.match == Token::kNoMatch) return index;
  return t.match + 1;
}

Parser::Head Parser::headAt(size_t index) const {
  if (!isName(token(index))) return Head::None;
  size_t next = skipBrackets(index + 1);
  if (token(next).keyword == Keyword::With) next = skipBrackets(next + 1);
  if (token(next).kind == TokenKind::Arrow) return Head::Rule;
  const bool value = token(next).kind == TokenKind::Equal || foreignArrowAt(next);
  return value ? Head::Function : Head::None;
}

bool Parser::declarationAt(size_t index, bool insideBlock) const {
  const Token& t = token(index);
  const Token& next = token(index + 1);
  if (t.kind == TokenKind::At) return true;
  if (t.kind != TokenKind::Name) return false;
  switch (t.keyword) {
    case Keyword::Attr:
    case Keyword::Const:
    case Keyword::Import:
    case Keyword::Style:
      if (isName(next)) return true;
      break;
    case Keyword::Version:
      if (next.kind == TokenKind::String) return true;
      break;
    case Keyword::Start:
    case Keyword::Extension:
      if (headAt(index + 1) == Head::Rule) return true;
      break;
    default: break;
  }
  const Head head = headAt(index);
  return head == Head::Rule || (head == Head::Function && !insideBlock);
}

// Inside blocks `name =` is a selector; but not at the beginning of a line when the brace of the
// block is never closed.
bool Parser::declarationHere() const {
  if (at_ == itemAt_) return false;
  if (place_.comparing) return declarationAt(at_, true);
  if (place_.blocks == 0 || !place_.open) return declarationAt(at_, place_.blocks > 0);
  const uint32_t begin = current().begin;
  return declarationAt(at_, begin > 0 && text_[begin - 1] != '\n');
}

void Parser::skipToDeclaration() {
  while (!atEnd() && !declarationAt(at_, false)) advance();
}

void Parser::findUserWords() {
  for (size_t i = 0; i < tokens_.size(); ++i) {
    const auto keyword = static_cast<size_t>(tokens_[i].keyword);
    if (tokens_[i].keyword >= Keyword::Inline && headAt(i) == Head::Rule) userWord_[keyword] = true;
  }
}

// --- Reports ---

void Parser::error(const char* code, Span span, std::string message, std::string hint) {
  reported_ = !panic_ && at_ != lastErrorAt_;
  if (!reported_) return;
  lastErrorAt_ = at_;
  if (inAnnotation_) {
    diagnostics_.warning("bad-annotation", span, std::move(message), std::move(hint));
    return;
  }
  diagnostics_.error(code, span, std::move(message), std::move(hint));
  if (++errors_ < kMaxSyntaxErrors) return;
  reported_ = false;
  diagnostics_.error("too-many-errors", span, "the rest of the file is not read after this mistake",
                     "correct the mistakes above first");
  panic_ = true;
  at_ = tokens_.size() - 1;
}

void Parser::warning(const char* code, Span span, std::string message, std::string hint) {
  reported_ = !panic_;
  if (reported_) diagnostics_.warning(code, span, std::move(message), std::move(hint));
}

void Parser::fix(Span span, std::string text) {
  if (reported_) diagnostics_.fixLast(span, std::move(text));
}

std::string Parser::describe(const Token& t) const {
  constexpr size_t kShown = 40;
  if (t.kind == TokenKind::End) return "the end of the file";
  std::string s(textOf(t).substr(0, kShown));
  if (t.end - t.begin > kShown) s += "...";
  return t.kind == TokenKind::String ? "the string " + s : "'" + s + "'";
}

void Parser::unexpected(const std::string& expected, std::string hint) {
  const bool separator = hint.empty() && is(TokenKind::Semicolon);
  if (separator) hint = "statements need no separator; remove it";
  const bool joined = is(TokenKind::Colon) && at_ > 0 && isName(tokens_[at_ - 1]) &&
                      isName(ahead(1)) && endOfLast() == current().begin &&
                      ahead(1).begin == current().end;
  if (hint.empty() && joined) {
    hint = "names have no colon; the property 'a:b' of a map is the attribute 'a_b'";
  }
  const bool unit = at_ > 0 && tokens_[at_ - 1].kind == TokenKind::Number && isName(current()) &&
                    endOfLast() == current().begin;
  if (hint.empty() && unit) {
    hint = "a number has no letters behind it: write " + std::string(textOf(tokens_[at_ - 1]));
  }
  error("unexpected-token", spanOf(current()),
        describe(current()) + " is unexpected here; expected " + expected, std::move(hint));
  if (separator) fix(spanOf(current()), "");
}

bool Parser::reportBareColour() {
  const uint32_t from = endOfLast();
  const std::string_view gap = text_.substr(from, current().begin - from);
  const size_t sign = gap.find_first_not_of(" \t\r\n");
  if (sign == std::string_view::npos || gap[sign] != '#') return false;
  const std::string_view rest = gap.substr(sign + 1);
  const size_t digits = std::min(rest.find_first_not_of("0123456789abcdefABCDEF"), rest.size());
  if (digits != 3 && digits != 6 && digits != 8) return false;
  const std::string colour(gap.substr(sign, digits + 1));
  const auto begin = static_cast<uint32_t>(from + sign);
  const Span span = {file_, begin, begin + static_cast<uint32_t>(colour.size())};
  error("unexpected-token", span, "a value is missing: '" + colour + "' begins a comment here",
        "write the colour in quotes: \"" + colour + "\"");
  fix(span, "\"" + colour + "\"");
  return true;
}

void Parser::tooDeep() {
  if (panic_) return;
  error("nesting-too-deep", spanOf(current()),
        "expressions and blocks nest deeper than the limit of " + std::to_string(kMaxNesting) +
            " levels",
        "move inner parts to rules or functions of their own");
  panic_ = true;
  advance();
  skipToDeclaration();
}

// --- Nodes ---

Node Parser::node(NodeKind kind, uint32_t begin) const {
  Node n;
  n.kind = kind;
  n.begin = begin;
  n.end = std::max(begin, endOfLast());
  return n;
}

NodeId Parser::make(Node n, const Nodes& children) {
  const NodeId id = tree_.add(n, children);
  if (tree_.depth(id) <= kMaxTreeDepth) return id;
  if (!panic_) {
    error("nesting-too-deep", {file_, n.begin, n.begin + 1},
          "this expression has too many parts in a row",
          "store parts of it in functions or constants");
    panic_ = true;
    skipToDeclaration();
  }
  return missing();
}

NodeId Parser::named(NodeKind kind, const Token& t) {
  Node n;
  n.kind = kind;
  n.begin = t.begin;
  n.end = t.end;
  n.text = tree_.intern(textOf(t));
  return tree_.add(n);
}

NodeId Parser::missing() {
  Node n;
  n.kind = NodeKind::Missing;
  n.begin = n.end = current().begin;
  return tree_.add(n);
}

// --- Declarations ---

NodeId Parser::parseAnnotationValue() {
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  const uint32_t begin = current().begin;
  if (accept(TokenKind::LBrace)) {
    Nodes items;
    while (!panic_ && !is(TokenKind::RBrace) && !atEnd()) {
      items.push_back(parseAnnotationValue());
      if (!accept(TokenKind::Comma)) break;
    }
    accept(TokenKind::RBrace);
    return make(node(NodeKind::BraceList, begin), items);
  }
  if (isName(current()) && ahead(1).kind == TokenKind::Equal) {
    Node n = node(NodeKind::NamedArg, begin);
    n.text = tree_.intern(textOf(current()));
    advance();
    advance();
    const NodeId value = parseAnnotationValue();
    n.end = endOfLast();
    return make(n, {value});
  }
  const NodeId value = parseExpression();
  // @Handle(shape=Window^2): a rule with two parameters.
  if (!accept(TokenKind::Caret)) return value;
  const NodeId index = parsePrimary();
  return make(node(NodeKind::Index, begin), {value, index, kNoNode});
}

// Whether a further argument of an annotation stands here, without a comma before it; reports that.
bool Parser::reportMissingComma(const std::string& annotation) {
  const Token& t = current();
  const bool value =
      t.kind == TokenKind::Name || t.kind == TokenKind::Number || t.kind == TokenKind::String;
  if (!value || panic_ || at_ == 0 || !onOneLine(tokens_[at_ - 1], t)) return false;
  unexpected("',' or ')' in the arguments of '@" + annotation + "'", "write ',' before it");
  fix(spanAt(endOfLast()), ",");
  return true;
}

// Annotations never stop a file: a malformed one is a warning, and its brackets are passed over.
NodeId Parser::parseAnnotation() {
  const uint32_t begin = current().begin;
  advance();
  if (!is(TokenKind::Name)) {
    unexpected("the name of an annotation after '@'");
    return kNoNode;
  }
  Node n = node(NodeKind::Annotation, begin);
  const std::string name(textOf(current()));
  n.text = tree_.intern(name);
  advance();
  Nodes arguments;
  if (is(TokenKind::LParen)) {
    const Token open = current();
    advance();
    inAnnotation_ = true;
    while (!panic_ && !is(TokenKind::RParen) && !atEnd() && !declarationAt(at_, true)) {
      arguments.push_back(parseAnnotationValue());
      if (accept(TokenKind::Comma)) continue;
      // One is told.
      if (n.flags == kFlagBroken || !reportMissingComma(name)) break;
      n.flags = kFlagBroken;
    }
    if (!is(TokenKind::RParen)) {
      n.flags = kFlagBroken;
      if (open.match == Token::kNoMatch) {
        error("unclosed-bracket", spanOf(open), "this '(' of '@" + name + "' is never closed",
              "add ')' behind its arguments");
        fix(spanAt(endOfLast()), ")");
      } else {
        unexpected("',' or ')' in the arguments of '@" + name + "'");
      }
      if (open.match != Token::kNoMatch && open.match >= at_) at_ = open.match;
    }
    accept(TokenKind::RParen);
    inAnnotation_ = false;
  }
  n.end = endOfLast();
  return make(n, arguments);
}

NodeId Parser::parseVersion() {
  Node n = node(NodeKind::Version, current().begin);
  advance();
  n.text = tree_.intern(stringValue(textOf(current())));
  advance();
  n.end = endOfLast();
  return make(n, {});
}

NodeId Parser::parseStyle(NodeId annotations) {
  advance();
  Node n = node(NodeKind::Style, current().begin);
  n.text = tree_.intern(textOf(current()));
  advance();
  NodeId base = kNoNode;
  if (is(Keyword::Extends)) {
    advance();
    if (isName(current())) {
      base = named(NodeKind::Name, current());
      advance();
    } else {
      unexpected("the name of a style after 'extends'");
    }
  }
  n.end = endOfLast();
  return make(n, {annotations, base});
}

NodeId Parser::parseStyleNames() {
  const uint32_t begin = current().begin;
  advance();
  Nodes names;
  while (isName(current())) {
    names.push_back(named(NodeKind::Name, current()));
    advance();
    if (!accept(TokenKind::Comma)) break;
  }
  expect(TokenKind::RParen, "after the styles to import");
  return list(begin, names);
}

// One item of an override list: `name`, `name = value` or `Name(params) --> successors`.
NodeId Parser::parseOverride() {
  const uint32_t begin = current().begin;
  if (!isName(current())) {
    unexpected("the name of an attribute or of an extension rule");
    return kNoNode;
  }
  const Token name = current();
  if (headAt(at_) == Head::Rule) return parseDefinition(kNoNode, Keyword::None);
  advance();
  if (!accept(TokenKind::Equal)) return named(NodeKind::Name, name);
  Node n = node(NodeKind::NamedArg, begin);
  n.text = tree_.intern(textOf(name));
  const NodeId value = parseExpression();
  n.end = endOfLast();
  return make(n, {value});
}

// The sign before the path of an import, or what stands in its place.
bool Parser::takeColonOfImport() {
  if (accept(TokenKind::Colon)) return true;
  if (!is(TokenKind::Equal) && !is(TokenKind::String)) {
    unexpected("':' before the path of the import", "write import name : \"file.cga\"");
    return false;
  }
  const bool equals = is(TokenKind::Equal);
  error("unexpected-token", spanOf(current()), "the path of an import has ':' before it",
        equals ? "write ':' for '='" : "write import name : " + std::string(textOf(current())));
  fix(equals ? spanOf(current()) : spanAt(endOfLast()), equals ? ":" : " :");
  if (equals) advance();
  return true;
}

NodeId Parser::parsePathOfImport() {
  if (is(TokenKind::String)) {
    Node s = node(NodeKind::String, current().begin);
    s.text = tree_.intern(stringValue(textOf(current())));
    advance();
    s.end = endOfLast();
    return tree_.add(s);
  }
  // What stands there up to a blank, where that is a path without its quotes.
  const uint32_t begin = current().begin;
  const size_t end = std::min(text_.find_first_of(" \t\r\n(\"", begin), text_.size());
  const std::string path(text_.substr(begin, end - begin));
  const bool isPath = !atEnd() && (path.find('/') != std::string::npos || path.ends_with(".cga"));
  if (!isPath || declarationAt(at_, false)) {
    unexpected("the path of a rule file as a string", "write import name : \"file.cga\"");
    return kNoNode;
  }
  const Span span = {file_, begin, static_cast<uint32_t>(end)};
  error("unexpected-token", span, "the path of an import stands in quotes",
        "write \"" + path + "\"");
  fix(span, "\"" + path + "\"");
  Node s = node(NodeKind::String, begin);
  s.text = tree_.intern(path);
  while (!atEnd() && current().begin < end) advance();
  s.end = static_cast<uint32_t>(end);
  return tree_.add(s);
}

NodeId Parser::parseImport(NodeId annotations) {
  if (is(Keyword::Import) && isName(ahead(1))) advance();
  Node n = node(NodeKind::Import, current().begin);
  n.text = tree_.intern(textOf(current()));
  advance();
  const NodeId styles = is(TokenKind::LParen) ? parseStyleNames() : kNoNode;
  const NodeId path = takeColonOfImport() ? parsePathOfImport() : kNoNode;
  NodeId overrides = kNoNode;
  if (is(TokenKind::LParen)) {
    const Enter enter(*this, {0, false, true});
    const uint32_t open = current().begin;
    advance();
    Nodes items;
    while (!panic_ && !is(TokenKind::RParen) && !atEnd()) {
      const size_t before = at_;
      const NodeId item = parseOverride();
      if (item != kNoNode) items.push_back(item);
      if (!accept(TokenKind::Comma) && (at_ == before || !isName(current()))) break;
    }
    expect(TokenKind::RParen, "after the overrides of the import");
    overrides = list(open, items);
  }
  n.end = endOfLast();
  return make(n, {annotations, path, styles, overrides});
}

NodeId Parser::parseParams() {
  const uint32_t begin = current().begin;
  advance();
  Nodes params;
  while (isName(current())) {
    params.push_back(named(NodeKind::Param, current()));
    const std::string name(textOf(current()));
    advance();
    if (is(TokenKind::Equal)) {
      error("unexpected-token", spanOf(current()), "the parameter '" + name + "' has no default",
            "define the short form as well, which calls the long one with the value");
      advance();
      parseExpression();
    }
    if (!accept(TokenKind::Comma)) break;
  }
  if (!is(TokenKind::RParen)) {
    unexpected("the name of a parameter or ')'");
    const size_t open = at_;
    while (!atEnd() && !is(TokenKind::RParen) && !declarationAt(at_, true)) advance();
    if (!is(TokenKind::RParen)) at_ = open;
  }
  accept(TokenKind::RParen);
  return list(begin, params);
}

NodeId Parser::parseLocals() {
  const uint32_t begin = current().begin;
  advance();
  Nodes locals;
  if (expect(TokenKind::LParen, "after 'with'")) {
    while (!panic_ && isName(current())) {
      Node n = node(NodeKind::Local, current().begin);
      n.text = tree_.intern(textOf(current()));
      advance();
      if (!accept(TokenKind::Assign)) {
        unexpected("':=' and the value of the local variable", "write 'name := value'");
        if (!accept(TokenKind::Equal) && !accept(TokenKind::Colon)) break;
      }
      const NodeId value = parseExpression();
      n.end = endOfLast();
      locals.push_back(make(n, {value}));
      accept(TokenKind::Comma);
    }
    expect(TokenKind::RParen, "after the local variables");
  }
  return list(begin, locals);
}

// Whether the declaration whose name is at `name` stands among the operations of the rule before.
bool Parser::isWithinRule(size_t name) const {
  if (declarations_.empty() || tree_.kind(declarations_.back()) != NodeKind::Rule) return false;
  const bool word = name > 0 && (tokens_[name - 1].keyword == Keyword::Attr ||
                                 tokens_[name - 1].keyword == Keyword::Const);
  const Token& first = tokens_[word ? name - 1 : name];
  const std::optional<size_t> rule = indentOf(tree_[declarations_.back()].begin);
  return !beginsLine(first) || indentOf(first.begin).value_or(0) > rule.value_or(0);
}

// `name`: the token of the declaration's name.
void Parser::reportAfterValue(size_t name) {
  if (panic_ || atEnd() || declarationAt(at_, false) || place_.inOverrides) return;
  if (isName(current()) && ahead(1).kind == TokenKind::Colon &&
      ahead(2).kind == TokenKind::String) {
    return;
  }
  const std::string written(textOf(tokens_[name]));
  const bool operations = isName(current()) || is(TokenKind::LBracket);
  std::string hint;
  const bool decimals = is(TokenKind::Comma) && at_ > 0 && ahead(1).kind == TokenKind::Number &&
                        tokens_[at_ - 1].kind == TokenKind::Number;
  if (decimals) {
    hint = "numbers have a decimal point: write " + std::string(textOf(tokens_[at_ - 1])) + "." +
           std::string(textOf(ahead(1)));
  } else if (isName(current()) && isWord(current(), "if")) {
    hint = "choose by case: case a > 2: 10 else: 5";
  } else if (operations && isWithinRule(name)) {
    hint =
        "a declaration ends the rule before it: put it above the rule; a value of the rule "
        "itself is written 'Rule with (" +
        written + " := value) --> ...'";
  }
  // What follows a value that was told of already belongs to it.
  if (!(operations && name == foreignHeadAt_)) {
    unexpected("a new declaration after the value of '" + written + "'", std::move(hint));
  }
  if (decimals) fix(spanOf(current()), ".");
  skipToDeclaration();
}

bool Parser::dashesHere() const {
  return is(TokenKind::Minus) && ahead(1).kind == TokenKind::Minus &&
         ahead(1).begin == current().end;
}

// Behind a value "-- text" may subtract what is negative. It does not where the line ends, where
// two words follow, or one that stands nowhere else in the file.
bool Parser::dashCommentHere() {
  if (!dashesHere() || at_ == 0 || tokens_[at_ - 1].end == current().begin) return false;
  const size_t end = std::min(text_.find('\n', ahead(1).end), text_.size());
  const auto operand = [&](const Token& t) {
    const bool value = t.kind == TokenKind::Name || t.kind == TokenKind::Number;
    return value && t.keyword == Keyword::None && t.begin < end;
  };
  const Token& first = ahead(2);
  if (first.kind == TokenKind::End || first.begin >= end) return true;
  if (first.begin == ahead(1).end || !operand(first)) return false;
  const Token& second = ahead(3);
  if (operand(second) && !declarationAt(at_ + 3, false)) return true;
  if (!isName(first) || second.kind == TokenKind::LParen || second.kind == TokenKind::LBracket ||
      textOf(first).find('.') != std::string_view::npos) {
    return false;
  }
  return usesOf(textOf(first)) == 1;
}

size_t Parser::usesOf(std::string_view name) {
  if (nameUses_.empty()) {
    for (const Token& t : tokens_) {
      if (isName(t)) ++nameUses_[textOf(t)];
    }
  }
  const auto at = nameUses_.find(name);
  return at == nameUses_.end() ? 0 : at->second;
}

// A comment of another language, "-- text": reports it and goes on behind its line.
void Parser::skipDashComment() {
  const Span dashes{file_, current().begin, ahead(1).end};
  error("unexpected-token", dashes, "'--' begins no comment", "write '//' before a comment");
  fix(dashes, "//");
  const size_t end = std::min(text_.find('\n', dashes.end), text_.size());
  while (!atEnd() && current().begin < end) advance();
}

// building:levels, as a map calls its property, where a name is to stand.
void Parser::takeTagName(const Token& first, Node& definition) {
  if (!is(TokenKind::Colon) || !isName(ahead(1)) || ahead(1).begin != current().end) return;
  if (ahead(2).kind != TokenKind::Equal && ahead(2).kind != TokenKind::Colon) return;
  std::string written(textOf(first)), name = written;
  while (is(TokenKind::Colon) && isName(ahead(1))) {
    advance();
    written += ':' + std::string(textOf(current()));
    name += '_' + std::string(textOf(current()));
    advance();
  }
  const Span span{file_, first.begin, endOfLast()};
  error("unexpected-token", span, "'" + written + "' is no name: names have no colon",
        "write '" + name + "', which takes the property '" + written + "' of a map");
  fix(span, name);
  definition.text = tree_.intern(name);
}

// attr, const, function or rule: all share the head `name(params) with (locals)`.
NodeId Parser::parseDefinition(NodeId annotations, Keyword keyword) {
  const size_t nameIndex = at_;
  const Token name = current();
  advance();
  const NodeId params = is(TokenKind::LParen) ? parseParams() : kNoNode;
  const NodeId locals = is(Keyword::With) ? parseLocals() : kNoNode;
  Node n = node(NodeKind::Function, name.begin);
  n.text = tree_.intern(textOf(name));

  if (acceptArrow()) {
    if (keyword == Keyword::Attr || keyword == Keyword::Const) {
      warning("keyword-on-rule", spanOf(name),
              "'" + std::string(textOf(name)) + "' is a rule; the keyword before it has no effect",
              "remove the keyword");
      fix({file_, tokens_[nameIndex - 1].begin, name.begin}, "");
    }
    n.kind = NodeKind::Rule;
    if (keyword == Keyword::Start) n.flags = kFlagStart;
    if (keyword == Keyword::Extension) n.flags = kFlagExtension;
    const NodeId body = parseSequence();
    n.end = std::max(n.end, endOfLast());
    return make(n, {annotations, params, locals, body});
  }

  if (keyword == Keyword::Attr || keyword == Keyword::Const) takeTagName(name, n);
  const bool hasWord = keyword == Keyword::Attr || keyword == Keyword::Const;
  const bool assigns = is(TokenKind::Assign);
  if (assigns) reportAssign(name, hasWord);
  if (keyword == Keyword::Attr || (assigns && !hasWord)) n.kind = NodeKind::Attr;
  if (keyword == Keyword::Const) n.kind = NodeKind::Const;
  if (hasWord) takeWrittenType(name);
  NodeId value = kNoNode;
  const bool valueHere = is(TokenKind::Number) || is(TokenKind::String) || is(Keyword::True) ||
                         is(Keyword::False) || is(TokenKind::LBracket);
  if (valueHere) {
    unexpected("'=' and a value after the name", "write '=' before the value");
    fix(spanAt(current().begin), "= ");
    value = parseExpression();
  } else if (accept(TokenKind::Assign) || expect(TokenKind::Equal, "and a value after the name") ||
             accept(TokenKind::Colon)) {
    value = parseExpression();
  } else {
    value = missing();
    if (!panic_) skipToDeclaration();
  }
  n.end = endOfLast();
  const NodeId id = make(n, {annotations, params, locals, value});
  reportAfterValue(nameIndex);
  return id;
}

void Parser::parseDeclaration() {
  panic_ = errors_ >= kMaxSyntaxErrors;
  dented_ = nullptr;
  inAnnotation_ = false;
  const uint32_t begin = current().begin;
  Nodes annotations;
  while (is(TokenKind::At)) {
    const NodeId a = parseAnnotation();
    if (a != kNoNode) annotations.push_back(a);
  }
  const NodeId attached = annotations.empty() ? kNoNode : list(begin, annotations);
  const auto stray = [&] {
    declarations_.insert(declarations_.end(), annotations.begin(), annotations.end());
  };

  const Keyword keyword = current().keyword;
  const bool nameNext = isName(ahead(1));
  if (keyword == Keyword::Version && ahead(1).kind == TokenKind::String) {
    stray();
    declarations_.push_back(parseVersion());
  } else if (keyword == Keyword::Style && nameNext) {
    declarations_.push_back(parseStyle(attached));
  } else if (keyword == Keyword::Import && nameNext) {
    declarations_.push_back(parseImport(attached));
  } else if ((keyword == Keyword::Attr || keyword == Keyword::Const) && nameNext) {
    advance();
    declarations_.push_back(parseDefinition(attached, keyword));
  } else if ((keyword == Keyword::Start || keyword == Keyword::Extension) &&
             headAt(at_ + 1) == Head::Rule) {
    advance();
    declarations_.push_back(parseDefinition(attached, keyword));
  } else if (headAt(at_) != Head::None || assignsHere()) {
    declarations_.push_back(parseDefinition(attached, Keyword::None));
  } else if (isName(current()) && ahead(1).kind == TokenKind::Colon &&
             ahead(2).kind == TokenKind::String) {
    warning("import-without-keyword", spanOf(current()),
            "this import stands without the word 'import'", "write 'import' before each import");
    fix(spanAt(current().begin), "import ");
    declarations_.push_back(parseImport(attached));
  } else if (dashesHere()) {
    stray();
    skipDashComment();
    skipToDeclaration();
  } else if (takeForeign()) {
    stray();
    if (headAt(at_) == Head::None) skipToDeclaration();
  } else {
    stray();
    if (atEnd()) return;
    const bool import = keyword == Keyword::Import && ahead(1).kind == TokenKind::String;
    const char* const form = "a rule is written 'Name --> ...', a function 'name(a) = ...'";
    unexpected("a declaration", import ? "an import has a name: import id : \"file.cga\""
                                : isName(current()) ? form
                                                    : "");
    advance();
    skipToDeclaration();
  }
}

Tree Parser::run() {
  findUserWords();
  while (!atEnd()) {
    const size_t before = at_;
    parseDeclaration();
    if (at_ == before) advance();
  }
  Node n = node(NodeKind::File, 0);
  n.end = static_cast<uint32_t>(text_.size());
  tree_.setRoot(tree_.add(n, declarations_));
  return std::move(tree_);
}

Tree parse(std::string_view text, uint32_t file, const Tokens& tokens, Diagnostics& diagnostics) {
  return Parser(text, file, tokens, diagnostics).run();
}

Tree parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const Tokens tokens = tokenize(text, file, diagnostics);
  return parse(text, file, tokens, diagnostics);
}

}  // namespace gable::lang
