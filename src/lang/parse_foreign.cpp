// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is written as in other languages: each such construction is reported once, with what rules
// have in its place, and is passed over as a whole or read as it is meant. The words and signs are
// those of lang/other_languages.h.

#include <algorithm>
#include <string>

#include "base/text.h"
#include "lang/other_languages.h"
#include "lang/parser_impl.h"

namespace gable::lang {

// Whether a rule, a function or an attribute of the file has this name.
bool Parser::isDeclared(std::string_view name) {
  const auto [at, isNew] = declaredWords_.try_emplace(name, false);
  if (!isNew) return at->second;
  for (size_t i = 0; i < tokens_.size() && !at->second; ++i) {
    at->second = isName(tokens_[i]) && textOf(tokens_[i]) == name && headAt(i) != Head::None;
  }
  return at->second;
}

const ForeignWord* Parser::foreignAt(size_t index, ForeignUse use) {
  const Token& t = token(index);
  if (t.kind != TokenKind::Name || t.keyword != Keyword::None) return nullptr;
  const ForeignWord* const word = foreignWord(use, textOf(t));
  return word && !isDeclared(textOf(t)) ? word : nullptr;
}

// --- Places of the text ---

uint32_t Parser::lineEnd(uint32_t at) const {
  return static_cast<uint32_t>(std::min(text_.find('\n', at), text_.size()));
}

uint32_t Parser::lineOf(const Token& t) const {
  return static_cast<uint32_t>(std::count(text_.begin(), text_.begin() + t.begin, '\n')) + 1;
}

bool Parser::beginsLine(const Token& t) const {
  const size_t before =
      t.begin == 0 ? std::string_view::npos : text_.find_last_not_of(" \t", t.begin - 1);
  return before == std::string_view::npos || text_[before] == '\n' || text_[before] == '\r';
}

// Whether two tokens stand on one line, the second behind the first.
bool Parser::onOneLine(const Token& a, const Token& b) const {
  return b.kind != TokenKind::End && b.begin < lineEnd(a.end);
}

// Goes on behind a construction: its brackets, its braces, the rest of its line, and the lines that
// are indented deeper.
void Parser::skipForeign(const Token& first) {
  const uint32_t end = lineEnd(first.begin);
  const size_t indent = indentOf(first.begin).value_or(0);
  bool deeper = false;
  while (!atEnd()) {
    const Token& t = current();
    if (beginsLine(t)) deeper = indentOf(t.begin).value_or(0) > indent;
    if (t.begin >= end && (!deeper || declarationAt(at_, false))) return;
    const bool opens = t.kind == TokenKind::LParen || t.kind == TokenKind::LBrace;
    if ((t.kind == TokenKind::RBrace || t.kind == TokenKind::RBracket) &&
        (t.match == Token::kNoMatch || tokens_[t.match].begin < first.begin)) {
      return;
    }
    if (opens && t.match != Token::kNoMatch) at_ = t.match;
    advance();
    const bool block = t.kind == TokenKind::LBrace && t.match != Token::kNoMatch;
    if (block && !is(Keyword::Else)) return;
  }
}

// --- Statements ---

bool Parser::loopHere() const {
  const Token& next = ahead(1);
  if (next.kind == TokenKind::LParen) {
    const Token& behind = token(skipBrackets(at_ + 1));
    return behind.kind == TokenKind::LBrace ||
           (onOneLine(next, behind) && behind.kind == TokenKind::Name);
  }
  return isName(next) && (isWord(ahead(2), "in") || conditionEnd(at_) != 0);
}

bool Parser::resultHere() const {
  const TokenKind next = ahead(1).kind;
  const bool value = next == TokenKind::Number || next == TokenKind::String ||
                     next == TokenKind::Name || next == TokenKind::LParen ||
                     next == TokenKind::Minus;
  return value && beginsLine(current()) && onOneLine(current(), ahead(1));
}

// A loop, a choice by 'switch' or a result: reports it and goes on behind it.
bool Parser::takeForeignStatement() {
  const Token word = current();
  const ForeignWord* const row = foreignAt(at_, ForeignUse::Statement);
  if (!row || !row->instead.empty()) return false;
  if (row->word == "return" ? !resultHere() : !loopHere()) return false;
  error("unexpected-token", spanOf(word), describe(word) + " is no word of rules", remedyOf(*row));
  advance();
  skipForeign(word);
  return true;
}

// A word before the name of a declaration: def f(x), var x = 3. Reports it; what stands behind it
// is read where it is a declaration by itself, and passed over where not.
bool Parser::takeForeignDeclaration() {
  const Token word = current();
  const Token& next = ahead(1);
  const TokenKind sign = ahead(2).kind;
  const bool values =
      next.kind == TokenKind::Name && (sign == TokenKind::Equal || sign == TokenKind::Assign);
  const bool heads = next.kind == TokenKind::Name && beginsLine(word) &&
                     (sign == TokenKind::LParen || sign == TokenKind::Arrow ||
                      sign == TokenKind::LBrace || sign == TokenKind::Colon);
  const bool files = beginsLine(word) &&
                     (next.kind == TokenKind::String || token(at_ + 2).keyword == Keyword::Import);
  if ((!values && !heads && !files) || !onOneLine(word, next)) return false;
  const ForeignWord* const row = foreignAt(at_, ForeignUse::Declaration);
  if (!row) return false;
  error("unexpected-token", spanOf(word), describe(word) + " is no word of rules", remedyOf(*row));
  const bool outside = beginsLine(word) && indentOf(word.begin).value_or(1) == 0;
  if (values && outside && !row->instead.empty()) fix(spanOf(word), std::string(row->instead));
  advance();
  if (headAt(at_) == Head::None) {
    skipForeign(word);
  } else {
    foreignHeadAt_ = at_;
  }
  return true;
}

// h := 5 on a line of its own, where a declaration may stand.
bool Parser::assignsHere() const {
  return isName(current()) && ahead(1).kind == TokenKind::Assign && beginsLine(current()) &&
         indentOf(current().begin).value_or(1) == 0;
}

// The sign of a declaration, behind the name.
void Parser::reportAssign(const Token& name, bool hasWord) {
  const std::string written(textOf(name));
  const std::string remedy =
      lowerCase(written[0]) == written[0]
          ? remedyOf(*foreignWord(ForeignUse::Declaration, "var"))
          : "write '" + written + " -->' for a rule, 'attr " + written + " =' for a value";
  error("unexpected-token", spanOf(current()), "':=' declares no value here",
        hasWord ? "write '='" : remedy);
  fix({file_, hasWord ? current().begin : name.begin, current().end},
      hasWord ? "=" : "attr " + written + " =");
}

// attr height : float = 10. Reports the type and passes it.
void Parser::takeWrittenType(const Token& name) {
  if (!is(TokenKind::Colon) || !isName(ahead(1)) || ahead(2).kind != TokenKind::Equal) return;
  const Span span = {file_, current().begin, ahead(1).end};
  error("unexpected-token", span, "types are not written: a value has its own",
        "write 'attr " + std::string(textOf(name)) + " = value'");
  fix(span, "");
  at_ += 2;
}

// a := 1, a += 1 and a++ behind other operations.
bool Parser::takeAssignment() {
  if (!isName(current())) return false;
  const Token& sign = ahead(1);
  if (sign.kind == TokenKind::Assign) {
    error("unexpected-token", spanOf(sign), "':=' is no operator",
          remedyOf(*foreignWord(ForeignUse::Operator, ":=")));
    at_ += 2;
    if (!atEnd()) parseExpression();
    return true;
  }
  const Token& second = ahead(2);
  if (sign.end != second.begin) return false;
  const bool counts = sign.kind == TokenKind::Plus && second.kind == TokenKind::Plus &&
                      !onOneLine(second, ahead(3));
  const bool assigns = second.kind == TokenKind::Equal &&
                       (sign.kind == TokenKind::Plus || sign.kind == TokenKind::Minus ||
                        sign.kind == TokenKind::Star || sign.kind == TokenKind::Slash);
  if (!counts && !assigns) return false;
  const Span span = {file_, sign.begin, second.end};
  const std::string_view written = text_.substr(span.begin, span.end - span.begin);
  const ForeignWord* const row = foreignWord(ForeignUse::Operator, written);
  if (!row) return false;
  error("unexpected-token", span, "'" + std::string(written) + "' is no operator", remedyOf(*row));
  at_ += 3;
  if (assigns && !atEnd()) parseExpression();
  return true;
}

bool Parser::takeForeign() {
  if (!isName(current())) return false;
  return takeForeignStatement() || takeForeignDeclaration() || takeAssignment();
}

// --- Signs ---

// The token behind the name or the size that begins at `index`.
size_t Parser::behindHead(size_t index) const {
  const TokenKind kind = token(index).kind;
  if (kind == TokenKind::Tilde || kind == TokenKind::Quote) ++index;
  const TokenKind first = token(index).kind;
  if (first != TokenKind::Name && first != TokenKind::Number) return index;
  return skipBrackets(index + 1);
}

bool Parser::foreignArrowAt(size_t index) const {
  const Token& t = token(index);
  const bool line = t.kind == TokenKind::Equal || t.kind == TokenKind::EqualEqual;
  return line && token(index + 1).kind == TokenKind::Greater && token(index + 1).begin == t.end;
}

// An arrow between a size or a selector and what it is for: { side => Wall }.
bool Parser::arrowOfItemHere() {
  if (place_.open || place_.blocks == 0 || at_ == 0) return false;
  const TokenKind before = tokens_[at_ - 1].kind;
  if (before != TokenKind::LBrace && before != TokenKind::Pipe) return false;
  const size_t behind = behindHead(at_);
  if (behind == at_ || (token(behind).kind != TokenKind::Arrow && !foreignArrowAt(behind))) {
    return false;
  }
  itemAt_ = at_;
  arrowAt_ = behind;
  return true;
}

// Reports the arrow before which the parser stands, and passes it.
void Parser::takeArrowOfItem() {
  const size_t tokens = is(TokenKind::Arrow) ? 1 : 2;
  const Span span = {file_, current().begin, ahead(tokens - 1).end};
  error("unexpected-token", span,
        "'" + std::string(text_.substr(span.begin, span.end - span.begin)) +
            "' stands behind a size or a selector",
        "write ':' there; an arrow stands behind the head of a rule");
  fix(span, ":");
  at_ += tokens;
}

// Passes the arrow of a rule, and reports one that is written as in other languages.
bool Parser::acceptArrow() {
  const bool other = foreignArrowAt(at_);
  if (!other && !is(TokenKind::Arrow)) return false;
  const Span span = {file_, current().begin, ahead(other ? 1 : 0).end};
  const std::string_view written = text_.substr(span.begin, span.end - span.begin);
  if (const ForeignWord* const row = foreignWord(ForeignUse::Arrow, written)) {
    error("bad-arrow", span, "'" + std::string(written) + "' is no arrow of this language",
          remedyOf(*row));
    fix(span, std::string(row->instead));
  }
  at_ += other ? 2 : 1;
  return true;
}

// condition ? a : b. Reports it and passes it.
void Parser::skipTernary() {
  const ForeignWord& row = *foreignWord(ForeignUse::Operator, "?");
  error("unexpected-token", spanOf(current()), "'?' is no operator", remedyOf(row));
  advance();
  parseExpression();
  if (accept(TokenKind::Colon)) parseExpression();
}

// Where a bracket is not closed: whether what closes it stands in a comment before the current
// token. The remedy, or empty.
std::string Parser::hintOfComment(char closer) const {
  const uint32_t from = endOfLast();
  const auto at =
      std::lower_bound(comments_.begin(), comments_.end(), from,
                       [](const Comment& c, uint32_t place) { return c.begin < place; });
  if (at == comments_.end() || at->begin >= current().begin) return {};
  const std::string_view comment = text_.substr(at->begin, at->end - at->begin);
  if (!comment.starts_with("//") || comment.find(closer) == std::string_view::npos) return {};
  return "'" + std::string(1, closer) + "' stands in the comment that '//' begins; " +
         remedyOf(*foreignWord(ForeignUse::Operator, "//"));
}

// --- Choices ---

// The token that ends the condition behind the word at `index`: its colon, or the brace that
// begins its branch. 0 where no condition stands there.
size_t Parser::conditionEnd(size_t index) const {
  constexpr size_t kMost = 100;
  const size_t last = std::min(index + kMost, tokens_.size());
  for (size_t i = index + 1; i < last; ++i) {
    const Token& t = tokens_[i];
    switch (t.kind) {
      case TokenKind::Colon: return i > index + 1 ? i : 0;
      case TokenKind::LBrace: return i > index + 1 && t.match != Token::kNoMatch ? i : 0;
      case TokenKind::LParen:
      case TokenKind::LBracket:
        if (t.match == Token::kNoMatch) return 0;
        i = t.match;
        break;
      case TokenKind::Number:
      case TokenKind::String:
      case TokenKind::Plus:
      case TokenKind::Minus:
      case TokenKind::Star:
      case TokenKind::Slash:
      case TokenKind::Not:
      case TokenKind::Less:
      case TokenKind::LessEqual:
      case TokenKind::Greater:
      case TokenKind::GreaterEqual:
      case TokenKind::Equal:
      case TokenKind::EqualEqual:
      case TokenKind::NotEqual:
      case TokenKind::And:
      case TokenKind::Or: break;
      case TokenKind::Name:
        if (t.keyword == Keyword::Case || t.keyword == Keyword::Else) return 0;
        if (isWord(t, "then")) return i;
        break;
      default: return 0;
    }
  }
  return 0;
}

// A choice by `if` and braces as rules write it, from the word at `index` on; empty where that
// cannot be said. `end` becomes the place behind it.
std::string Parser::asCase(size_t index, bool expressions, uint32_t& end) const {
  const auto between = [&](uint32_t from, uint32_t to) {
    while (from < to && std::string_view(" \t\r\n").find(text_[from]) != std::string_view::npos)
      ++from;
    while (from < to && std::string_view(" \t\r\n").find(text_[to - 1]) != std::string_view::npos)
      --to;
    return std::string(text_.substr(from, to - from));
  };
  std::string out;
  for (;;) {
    const size_t brace = conditionEnd(index);
    if (brace == 0 || token(brace).kind != TokenKind::LBrace) return {};
    const Token& close = tokens_[token(brace).match];
    const std::string body = between(token(brace).end, close.begin);
    // A comment in it would take what follows.
    if (body.find('#') != std::string::npos || body.find("//") != std::string::npos) return {};
    out += "case " + between(tokens_[index].end, token(brace).begin) + " : ";
    out += body.empty() ? "NIL" : body;
    end = close.end;
    size_t next = token(brace).match + 1;
    if (isName(token(next)) && foreignWord(ForeignUse::Branch, textOf(token(next)))) {
      out += ' ';
      index = next;
      continue;
    }
    if (token(next).keyword != Keyword::Else) return expressions ? "" : out + " else : NIL";
    if (isWord(token(++next), "if")) {
      out += ' ';
      index = next;
      continue;
    }
    const Token& open = token(next);
    if (open.kind != TokenKind::LBrace || open.match == Token::kNoMatch) return {};
    const std::string rest = between(open.end, tokens_[open.match].begin);
    end = tokens_[open.match].end;
    return out + " else : " + (rest.empty() ? "NIL" : rest);
  }
}

// At a word that begins a choice in other languages: reports it, with the whole choice as it is
// written here where its branches stand in braces. The choice is read from here as by `case`.
bool Parser::takeIf(bool expressions) {
  if (!isName(current()) || !isWord(current(), "if") || conditionEnd(at_) == 0) return false;
  if (isDeclared(textOf(current()))) return false;
  const ForeignWord& row = *foreignWord(ForeignUse::Statement, "if");
  error("unexpected-token", spanOf(current()), "'if' is no word of rules", remedyOf(row));
  uint32_t end = 0;
  const bool braces = token(conditionEnd(at_)).kind == TokenKind::LBrace;
  const std::string whole = asCase(at_, expressions, end);
  if (!whole.empty()) {
    fix({file_, current().begin, end}, whole);
  } else if (!braces) {
    fix(spanOf(current()), std::string(row.instead));
  }
  ifAt_ = at_;
  return true;
}

// A branch in braces, where a colon is to stand before it.
NodeId Parser::parseBracedBranch(bool expressions) {
  const size_t close = current().match;
  advance();
  NodeId body;
  {
    Place inner = place_;
    inner.inChoice = false;
    inner.blocks = place_.blocks + 1;
    const Enter enter(*this, inner);
    body = expressions ? parseExpression() : parseSequence();
  }
  if (!panic_ && at_ < close) unexpected("'}' at the end of the branch");
  if (!panic_) at_ = close + 1;
  return body;
}

// The words of other languages for a further branch: elif, elseif, else if.
bool Parser::elseIfHere() const {
  if (is(Keyword::Else)) return isWord(ahead(1), "if") && conditionEnd(at_ + 1) != 0;
  if (!isName(current())) return false;
  const ForeignWord* const row = foreignWord(ForeignUse::Branch, textOf(current()));
  return row && row->instead == "case" && conditionEnd(at_) != 0;
}

// Has the next branch begin there; tells of it unless the whole choice has been told of.
void Parser::takeElseIf(bool told) {
  const size_t tokens = is(Keyword::Else) ? 2 : 1;
  const Span span = {file_, current().begin, ahead(tokens - 1).end};
  if (!told) {
    const ForeignWord& row = *foreignWord(ForeignUse::Branch, "else if");
    error("unexpected-token", span,
          "'" + std::string(text_.substr(span.begin, span.end - span.begin)) +
              "' is no word of rules",
          remedyOf(row));
    fix(span, std::string(row.instead));
  }
  at_ += tokens - 1;
  ifAt_ = at_;
}

// The words of other languages for the last branch. In a block they may be selectors.
bool Parser::otherwiseHere() const {
  if (place_.blocks != 0 || !isName(current()) || ahead(1).kind != TokenKind::Colon) return false;
  const ForeignWord* const row = foreignWord(ForeignUse::Branch, textOf(current()));
  return row && row->instead == "else";
}

}  // namespace gable::lang
