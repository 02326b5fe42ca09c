// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bodies of rules. What makes them delicate is that "30% : A" starts with an expression, that
// "{ head : A }" and "{ A }" look alike until the colon, and that a branch ends where the next
// case, else or weight begins. All three are decided by looking ahead over whole brackets, at most
// once for each token of a level, so that parsing stays linear.

#include <algorithm>
#include <optional>
#include <string>

#include "lang/parser_impl.h"

namespace gable::lang {

namespace {

constexpr const char* kColonBefore = "write ':' before what it chooses";
constexpr const char* kNoBraces =
    "a branch has a colon and no braces: 'case condition : ... else : ...'";

}  // namespace

// True where a weight "... % :" begins: no successor starts with a number or a bracket, none is
// followed by an operator.
bool Parser::weightHere() const {
  if (is(TokenKind::Number) || is(TokenKind::LParen)) return true;
  if (!isName(current())) return false;
  const size_t next = skipBrackets(at_ + 1);
  switch (token(next).kind) {
    case TokenKind::Percent:
    case TokenKind::Plus:
    case TokenKind::Slash: return true;
    case TokenKind::Minus:
      return token(next + 1).kind != TokenKind::Minus || token(next + 1).begin != token(next).end;
    case TokenKind::Star: return !starHere(next);
    default: return false;
  }
}

// A '*' that was meant to repeat: nothing to multiply with follows.
bool Parser::starHere(size_t index) const {
  const TokenKind next = token(index + 1).kind;
  return token(index).kind == TokenKind::Star &&
         (next == TokenKind::RBrace || next == TokenKind::Pipe);
}

// True where, inside a block, the next item begins although there was no '|'.
bool Parser::separatorMissing() const {
  if (place_.blocks == 0) return false;
  if (is(TokenKind::Tilde) || is(TokenKind::Quote)) return true;
  if (!is(TokenKind::Number) && !isName(current())) return false;
  const TokenKind next = token(skipBrackets(at_ + 1)).kind;
  return next == TokenKind::Colon || next == TokenKind::Connect || next == TokenKind::Equal;
}

NodeId Parser::parseSequence() {
  const uint32_t begin = current().begin;
  Nodes items;
  const Nest nest(*this);
  while (nest.ok() && !panic_ && parseSuccessor(items)) {
  }
  Node n = node(NodeKind::Sequence, begin);
  return make(n, items);
}

// Tells what is known of a token that begins no successor. False where nothing is.
bool Parser::reportBadSuccessor() {
  if (is(TokenKind::Comma)) {
    error("unexpected-token", spanOf(current()), "operations have no ',' between them",
          "remove it: they follow one another, as in extrude(5) comp(f) { ... }");
    fix(spanOf(current()), "");
    return true;
  }
  if (starHere(at_)) {
    error("unexpected-token", spanOf(current()), "'*' repeats what stands in braces",
          "write it behind the closing brace: }*");
    const Token& close = ahead(1);
    if (close.kind == TokenKind::RBrace) fix({file_, current().begin, close.end}, "}*");
    return true;
  }
  if ((is(TokenKind::RBrace) || is(TokenKind::RParen) || is(TokenKind::RBracket)) &&
      current().match == Token::kNoMatch) {
    error("unexpected-token", spanOf(current()), describe(current()) + " closes nothing here",
          "remove it, or write its opening partner where it belongs");
    return true;
  }
  return false;
}

// Reports a token that begins no successor and passes it. False where the sequence ends instead.
bool Parser::skipBadSuccessor() {
  const bool closes = is(TokenKind::RBrace) || is(TokenKind::RParen) || is(TokenKind::RBracket);
  if (atEnd() || (closes && current().match != Token::kNoMatch)) return false;
  if (is(TokenKind::Pipe) && place_.blocks > 0) return false;
  if (wrongSeparatorHere()) return false;
  if (is(TokenKind::Comma) && place_.inOverrides) return false;
  if (separatorMissing()) return false;
  if (dashesHere()) {
    skipDashComment();
    return true;
  }
  if (!reportBadSuccessor()) {
    unexpected("an operation, a rule or a new declaration",
               is(TokenKind::LBrace)
                   ? "a block stands behind its operation: split(x) { ... }; '[' and ']' keep "
                     "operations together"
                   : "");
  }
  if (is(TokenKind::LBrace) && current().match != Token::kNoMatch) at_ = current().match;
  advance();
  return true;
}

// A ',' or a ';' in the place of the '|' between the parts of a block.
bool Parser::wrongSeparatorHere() const {
  const bool part = ahead(1).kind == TokenKind::LBrace || headAfter(at_ + 1);
  return (is(TokenKind::Comma) || is(TokenKind::Semicolon)) && place_.blocks > 0 && part;
}

// Adds one successor; false where the sequence ends.
bool Parser::parseSuccessor(Nodes& items) {
  if (declarationHere() || assignsHere()) return false;
  if (is(Keyword::Else)) {
    if (place_.inChoice) return false;
    unexpected("an operation or a rule", "'else' belongs to a 'case' or to weights before it");
    advance();
    accept(TokenKind::Colon);
    return true;
  }
  if (takeForeign()) return true;
  takeIf(false);
  if (place_.inChoice && (elseIfHere() || otherwiseHere())) return false;
  if (!caseHere() && separatorMissing()) return false;
  if (caseHere() || weightHere()) return parseChoiceInSequence(items);
  if (is(TokenKind::LBracket)) {
    items.push_back(parsePush());
    return true;
  }
  if (isName(current())) {
    items.push_back(parseApply());
    return true;
  }
  return skipBadSuccessor();
}

bool Parser::parseChoiceInSequence(Nodes& items) {
  if (place_.inChoice && !items.empty()) return false;
  if (!items.empty()) {
    warning("choice-not-first", spanOf(current()),
            "this choice stands behind other operations; some programs refuse that",
            "put '[' and ']' around the choice, or move it to a rule of its own");
  }
  items.push_back(parseChoice());
  return true;
}

NodeId Parser::parseChoice() {
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  if (caseHere()) return parseCaseChoice(false);
  const uint32_t begin = current().begin;
  const size_t before = at_;
  const NodeId weight = parseBinary(0);
  if (!is(TokenKind::Percent)) {
    unexpected("'%' and ':' after a weight");
    // Goes on behind the expression; the rest reads as successors.
    if (at_ == before) advance();
    return missing();
  }
  return parsePercentChoice(weight, begin, false);
}

NodeId Parser::parseBranchBody(bool expressions) {
  if (expressions) return parseExpression();
  Place inner = place_;
  inner.inChoice = true;
  const Enter enter(*this, inner);
  return parseSequence();
}

// The branch behind "else"; kNoNode if there is none. `told`: its braces have been told of.
NodeId Parser::parseElse(bool expressions, bool told) {
  if (otherwiseHere()) {
    error("unexpected-token", spanOf(current()), describe(current()) + " is no word of 'case'",
          "write 'else'");
    fix(spanOf(current()), "else");
  } else if (!is(Keyword::Else)) {
    return kNoNode;
  }
  Node n = node(NodeKind::Branch, current().begin);
  advance();
  const bool braces = is(TokenKind::LBrace) && current().match != Token::kNoMatch;
  if (!(told && braces) && !accept(TokenKind::Colon)) {
    unexpected("':' after 'else'", is(Keyword::Case) ? "write 'else : case ...' or only 'case ...'"
                                   : braces          ? kNoBraces
                                                     : kColonBefore);
    if (!braces) fix(spanAt(endOfLast()), " :");
  }
  const NodeId body = braces ? parseBracedBranch(expressions) : parseBranchBody(expressions);
  n.end = endOfLast();
  return make(n, {kNoNode, body});
}

// Whether there is a '=' between here and the ':' of the condition. Brackets of calls are passed
// over: names of arguments have one.
bool Parser::comparesWithEqual() const {
  bool found = false;
  // One comparison has one sign; the next stands behind '&&' or '||'.
  bool compared = false;
  for (size_t i = at_; i < tokens_.size(); ++i) {
    const Token& t = tokens_[i];
    if (t.kind == TokenKind::And || t.kind == TokenKind::Or || isWord(t, "and") || isWord(t, "or"))
      compared = false;
    switch (t.kind) {
      case TokenKind::Colon: return found;
      case TokenKind::Equal:
        if (compared || i == at_) return false;
        found = compared = true;
        break;
      case TokenKind::LParen:
        if (i > at_ && tokens_[i - 1].kind == TokenKind::Name)
          i = skipBrackets(i) - (t.match ? 1 : 0);
        break;
      // A condition that ends as in other languages.
      case TokenKind::LBrace: return found && t.match != Token::kNoMatch;
      case TokenKind::RBrace:
      case TokenKind::Pipe:
      case TokenKind::Arrow:
      case TokenKind::Assign:
      case TokenKind::At:
      case TokenKind::End: return false;
      default:
        if (isWord(t, "then")) return found;
        if (t.keyword == Keyword::Case || t.keyword == Keyword::Else ||
            t.keyword == Keyword::Attr || t.keyword == Keyword::Const) {
          return false;
        }
    }
  }
  return false;
}

void Parser::expectColonOfCondition() {
  if (accept(TokenKind::Colon)) return;
  const bool word = isName(current()) && isWord(current(), "then");
  unexpected("':' after the condition of 'case'", word                    ? "write ':' for 'then'"
                                                  : is(TokenKind::LBrace) ? kNoBraces
                                                                          : kColonBefore);
  if (word) fix(spanOf(current()), ":");
  if (!word && isName(current())) fix(spanAt(endOfLast()), " :");
  if (word) advance();
}

// One branch of a case, from its word on. `told`: the choice has been told of because of its
// braces; the first branch in braces is told of here, and tells of the whole.
NodeId Parser::parseCaseBranch(bool expressions, bool& told) {
  const size_t first = at_;
  Node n = node(NodeKind::Branch, current().begin);
  advance();
  NodeId condition;
  {
    Place inner = place_;
    inner.comparing = comparesWithEqual();
    const Enter enter(*this, inner);
    condition = parseBinary(0);
  }
  const bool braces = is(TokenKind::LBrace) && current().match != Token::kNoMatch;
  if (!braces || !told) expectColonOfCondition();
  if (uint32_t end = 0; braces && !told) {
    const std::string whole = asCase(first, expressions, end);
    if (!whole.empty()) fix({file_, tokens_[first].begin, end}, whole);
    told = true;
  }
  const NodeId body = braces ? parseBracedBranch(expressions) : parseBranchBody(expressions);
  n.end = endOfLast();
  return make(n, {condition, body});
}

NodeId Parser::parseCaseChoice(bool expressions) {
  const Token first = current();
  bool told = at_ == ifAt_ && token(conditionEnd(at_)).kind == TokenKind::LBrace;
  Nodes branches;
  while (!panic_ && (caseHere() || elseIfHere())) {
    if (!caseHere()) takeElseIf(told);
    branches.push_back(parseCaseBranch(expressions, told));
  }
  if (is(TokenKind::Pipe) && ahead(1).keyword == Keyword::Else) {
    error("unexpected-token", spanOf(current()), "'|' parts the branches of 'case' here",
          "remove it; or write 'else : NIL' before it, and another word than 'else' behind it");
    fix(spanOf(current()), "");
    advance();
  }
  if (const NodeId otherwise = parseElse(expressions, told); otherwise != kNoNode) {
    branches.push_back(otherwise);
  } else if (!panic_ && !told) {
    error("missing-else", spanOf(first), "this 'case' has no 'else'",
          expressions ? "add 'else : value'" : "add 'else : NIL', or what else shall happen");
    if (!expressions) fix(spanAt(endOfLast()), " else : NIL");
  }
  Node n = node(NodeKind::Choice, first.begin);
  n.op = static_cast<uint8_t>(ChoiceKind::Case);
  return make(n, branches);
}

// "% :" is next; `firstWeight` stands before it.
NodeId Parser::parsePercentChoice(NodeId firstWeight, uint32_t begin, bool expressions) {
  Nodes branches;
  NodeId weight = firstWeight;
  uint32_t branchBegin = begin;
  for (;;) {
    Node n = node(NodeKind::Branch, branchBegin);
    accept(TokenKind::Percent);
    expect(TokenKind::Colon, "after '%'");
    const NodeId body = parseBranchBody(expressions);
    n.end = endOfLast();
    branches.push_back(make(n, {weight, body}));
    if (panic_ || separatorMissing() || declarationHere() || !weightHere()) break;
    branchBegin = current().begin;
    const size_t before = at_;
    weight = parseBinary(0);
    if (is(TokenKind::Percent)) continue;
    unexpected("'%' and ':' after a weight");
    if (at_ == before) advance();
    break;
  }
  if (const NodeId otherwise = parseElse(expressions, false); otherwise != kNoNode) {
    branches.push_back(otherwise);
  }
  Node n = node(NodeKind::Choice, begin);
  n.op = static_cast<uint8_t>(ChoiceKind::Percent);
  return make(n, branches);
}

NodeId Parser::parsePush() {
  const Token open = current();
  advance();
  NodeId body;
  {
    Place inner;
    inner.blocks = place_.blocks + 1;
    const Enter enter(*this, inner);
    body = parseSequence();
  }
  if (!accept(TokenKind::RBracket)) {
    const std::string comment = hintOfComment(']');
    error("unclosed-bracket", spanOf(open), "this '[' is never closed",
          comment.empty() ? "add ']' before " + describe(current()) : comment);
  }
  return make(node(NodeKind::Push, open.begin), {body});
}

// True at ".name" directly behind a closing bracket: `imp(a = 1).Rule`.
bool Parser::memberHere() const {
  return is(TokenKind::Dot) && isName(ahead(1)) && ahead(1).begin == current().end && at_ > 0 &&
         tokens_[at_ - 1].kind == TokenKind::RParen;
}

NodeId Parser::parseMember(const Token& importName, NodeId overrides, NodeKind kind) {
  advance();
  Node n = node(kind, importName.begin);
  n.text = tree_.intern(textOf(current()));
  advance();
  const NodeId arguments = is(TokenKind::LParen) ? parseArguments() : kNoNode;
  n.end = endOfLast();
  const NodeId name = named(NodeKind::Name, importName);
  return make(n, {name, overrides, arguments});
}

// The successor behind `inline`, as the only item of a block.
NodeId Parser::parseOperand() {
  const uint32_t begin = current().begin;
  const NodeId operand = parseApply();
  const NodeId sequence = make(node(NodeKind::Sequence, begin), {operand});
  const NodeId item = make(node(NodeKind::Item, begin), {kNoNode, kNoNode, sequence});
  return make(node(NodeKind::Block, begin), {item});
}

// A number behind a name, where no weight begins: extrude 10.
bool Parser::bareArgumentHere() const {
  if (!is(TokenKind::Number)) return false;
  const Token& next = ahead(1);
  return (isName(next) && next.begin > current().end && !headAfter(at_)) ||
         next.kind == TokenKind::RBrace || next.kind == TokenKind::Pipe ||
         next.kind == TokenKind::RBracket || next.kind == TokenKind::LBracket ||
         next.kind == TokenKind::LBrace || next.kind == TokenKind::End;
}

NodeId Parser::parseBareArgument(const Token& name) {
  const Token number = current();
  const std::string written = "(" + std::string(textOf(number)) + ")";
  error("unexpected-token", spanOf(number),
        describe(number) + " stands behind " + describe(name) + " without brackets",
        "put it in brackets: " + std::string(textOf(name)) + written);
  fix({file_, name.end, number.end}, written);
  const NodeId value = parsePrimary();
  return list(number.begin, {value});
}

NodeId Parser::parseApply() {
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  const Token name = current();
  advance();
  Nodes children = {is(TokenKind::LParen) ? parseArguments() : kNoNode};
  if (memberHere()) return parseMember(name, children[0], NodeKind::ImportApply);

  Node n = node(NodeKind::Apply, name.begin);
  n.text = tree_.intern(textOf(name));
  const bool takesOperand =
      name.keyword >= Keyword::Inline && !userWord_[static_cast<size_t>(name.keyword)];
  if (accept(TokenKind::Dot)) {
    n.flags |= kFlagTerminal;
    // X.(a), the same as X(a). ; a weight in brackets has its sign behind.
    const bool arguments = is(TokenKind::LParen) && children[0] == kNoNode &&
                           token(skipBrackets(at_)).kind != TokenKind::Percent;
    if (arguments) children[0] = parseArguments();
  } else if (takesOperand && isName(current()) && !declarationHere()) {
    n.flags |= kFlagOperand;
    children.push_back(parseOperand());
  } else {
    if (children[0] == kNoNode && bareArgumentHere()) children[0] = parseBareArgument(name);
    if (bracketedBlockHere()) children.push_back(parseBracketedBlock());
    while (!panic_ && is(TokenKind::LBrace)) children.push_back(parseBlock(false));
  }
  n.end = endOfLast();
  return make(n, children);
}

// Looks from the start of an item for the ':' or '=' that ends its head. Two operands in a row are
// successors, so the search ends there.
bool Parser::headAfter(size_t first) const {
  const Token& begin = token(first);
  if (begin.kind == TokenKind::Tilde || begin.kind == TokenKind::Quote) return true;
  if (begin.keyword == Keyword::Case) return false;
  bool afterOperand = false;
  for (size_t i = first; i < tokens_.size(); ++i) {
    const Token& t = tokens_[i];
    switch (t.kind) {
      case TokenKind::Colon:
      case TokenKind::Equal:
      case TokenKind::Connect: return i > first && tokens_[i - 1].kind != TokenKind::Percent;
      case TokenKind::LParen:
      case TokenKind::LBracket:
      case TokenKind::LBrace:
        if (t.match == Token::kNoMatch) return false;
        i = t.match;
        afterOperand = true;
        break;
      case TokenKind::Name:
      case TokenKind::Number:
      case TokenKind::String:
        if (unitAt(i)) break;
        if (afterOperand) return false;
        afterOperand = true;
        break;
      case TokenKind::Tilde:
      case TokenKind::Quote:
        if (afterOperand && !shareBehindAt(i)) return false;
        break;
      case TokenKind::Pipe:
      case TokenKind::RBrace:
      case TokenKind::RParen:
      case TokenKind::RBracket:
      case TokenKind::Comma:
      case TokenKind::Semicolon:
      case TokenKind::Dot:
      case TokenKind::At:
      case TokenKind::Arrow:
      case TokenKind::End: return false;
      default: afterOperand = false;
    }
  }
  return false;
}

// "* : A", as a grid of another program says the rest.
bool Parser::parseStarHead(NodeId& head) {
  if (!is(TokenKind::Star) || ahead(1).kind != TokenKind::Colon) return false;
  error("unexpected-token", spanOf(current()), "'*' is neither a size nor a selector",
        "write '~1' for the rest of a split, 'all' for all parts");
  head = missing();
  advance();
  return true;
}

// split(y) { A : 3 }, a size behind its part. Reports it, and reads the size alone.
bool Parser::takeSwappedSize(NodeId& head) {
  const bool rule =
      isName(current()) && text_[current().begin] >= 'A' && text_[current().begin] <= 'Z';
  if (!rule || ahead(1).kind != TokenKind::Colon) return false;
  const TokenKind sign = ahead(2).kind;
  const size_t at = sign == TokenKind::Tilde || sign == TokenKind::Quote ? 3 : 2;
  const TokenKind behind = ahead(at + 1).kind;
  const bool ends = behind == TokenKind::Pipe || behind == TokenKind::RBrace;
  if (ahead(at).kind != TokenKind::Number || !ends) return false;
  const uint32_t size = ahead(2).begin, end = ahead(at).end;
  const std::string mended =
      std::string(text_.substr(size, end - size)) + " : " +
      std::string(text_.substr(current().begin, current().end - current().begin));
  const Span span = {file_, current().begin, end};
  error("unexpected-head", span, "the size stands behind its part", "write '" + mended + "'");
  fix(span, mended);
  advance();
  advance();
  head = parseExpression();
  return true;
}

NodeId Parser::parseItem(bool expressions) {
  if (is(TokenKind::LBrace)) return parseBlock(expressions);
  Node n = node(NodeKind::Item, current().begin);
  NodeId head = kNoNode;
  NodeId second = kNoNode;
  if (!expressions && takeSwappedSize(head)) {
    n.op = static_cast<uint8_t>(ItemKind::Each);
    n.end = endOfLast();
    return make(n, {head, second, missing()});
  }
  const bool arrow = at_ == itemAt_;
  if (arrow || headHere()) {
    // `else :` is a word that no block has; the analysis says what to write for it.
    if (is(Keyword::Else)) {
      head = named(NodeKind::Name, current());
      advance();
    } else if (!parseStarHead(head)) {
      head = parseExpression();
    }
    if (arrow && at_ == arrowAt_) {
      takeArrowOfItem();
      n.op = static_cast<uint8_t>(ItemKind::Each);
    } else if (accept(TokenKind::Equal)) {
      n.op = static_cast<uint8_t>(ItemKind::Combine);
    } else if (accept(TokenKind::Connect)) {
      n.op = static_cast<uint8_t>(ItemKind::Connect);
    } else {
      expect(TokenKind::Colon, "or '=' after a size or selector");
      n.op = static_cast<uint8_t>(ItemKind::Each);
      if (!expressions && headHere()) {
        second = parseExpression();
        expect(TokenKind::Colon, "after the second size");
      }
    }
  }
  const NodeId body = expressions ? parseExpression() : parseSequence();
  n.end = std::max(n.begin, endOfLast());
  const bool nothing = !expressions && head != kNoNode && tree_.children(body).empty();
  if (nothing && (is(TokenKind::Pipe) || is(TokenKind::RBrace))) {
    warning("empty-item", spanAt(endOfLast()), "there is nothing behind the ':' of this part",
            "write the rule or the operations for it, or NIL where nothing shall be made");
  }
  return make(n, {head, second, body});
}

// split(y) [ 3 : A | ~1 : B ]: what a block holds, in brackets of another kind.
bool Parser::bracketedBlockHere() const {
  const bool other = is(TokenKind::LBracket) || is(TokenKind::LParen);
  if (!other || current().match == Token::kNoMatch || at_ == 0) return false;
  return tokens_[at_ - 1].kind == TokenKind::RParen && headAfter(at_ + 1);
}

NodeId Parser::parseBracketedBlock() {
  const Token open = current();
  const Token& close = tokens_[open.match];
  error("unexpected-token", spanOf(open), "the parts of a block stand in braces",
        "write '{' and '}' for " + describe(open) + " and " + describe(close));
  const std::string_view inner = text_.substr(open.end, close.begin - open.end);
  fix({file_, open.begin, close.end}, "{" + std::string(inner) + "}");
  return parseBlock(false);
}

// How far the line of a place is indented; none when the line begins too far away.
std::optional<size_t> Parser::indentOf(uint32_t at) const {
  constexpr uint32_t kFurthest = 1000;
  uint32_t begin = at;
  while (begin > 0 && text_[begin - 1] != '\n') {
    if (at - --begin > kFurthest) return std::nullopt;
  }
  return std::min(text_.find_first_not_of(" \t", begin), static_cast<size_t>(at)) - begin;
}

// Remembers a closer that begins its line, and stands further left than the line of its opener.
void Parser::noteDentedCloser(const Token& open) {
  if (dented_ || open.match == Token::kNoMatch) return;
  const Token& close = tokens_[open.match];
  uint32_t lineBegin = close.begin;
  while (lineBegin > 0 && (text_[lineBegin - 1] == ' ' || text_[lineBegin - 1] == '\t'))
    --lineBegin;
  if (lineBegin == 0 || text_[lineBegin - 1] != '\n') return;
  const std::optional<size_t> indent = indentOf(open.begin);
  if (indent && close.begin - lineBegin < *indent) dented_ = &tokens_[close.match];
}

// Tells the brace that is missing its partner: by the indentation where that says more.
void Parser::reportUnclosed(const Token& open) {
  const bool inner = dented_ && dented_->begin > open.begin;
  const Token& place = inner ? *dented_ : open;
  const std::string line =
      onOneLine(open, current()) || atEnd() ? "" : " of line " + std::to_string(lineOf(current()));
  error("unclosed-block", spanOf(place), "this '{' is never closed",
        "add '}' before " +
            (inner ? "the '}' that begins a line further left" : describe(current()) + line));
}

NodeId Parser::parseBlock(bool expressions) {
  const Nest nest(*this);
  if (!nest.ok()) return missing();
  const Token open = current();
  const TokenKind closer = open.kind == TokenKind::LBrace   ? TokenKind::RBrace
                           : open.kind == TokenKind::LParen ? TokenKind::RParen
                                                            : TokenKind::RBracket;
  advance();
  Place inner;
  inner.blocks = place_.blocks + 1;
  inner.open = open.match == Token::kNoMatch;
  const Enter enter(*this, inner);
  Nodes items;
  bool wantItem = true;
  while (!panic_ && !is(closer)) {
    if (atEnd() || (!arrowOfItemHere() && declarationHere())) break;
    const size_t before = at_;
    if (is(TokenKind::Pipe)) {
      if (wantItem) {
        warning("empty-item", spanOf(current()), "there is nothing before this '|'",
                "remove it, or write what belongs there");
        fix(spanOf(current()), "");
      }
      advance();
      wantItem = true;
      continue;
    }
    if (!wantItem && wrongSeparatorHere()) {
      error("missing-separator", spanOf(current()), "the parts of a block have '|' between them",
            "write '|' for " + describe(current()));
      fix(spanOf(current()), endOfLast() < current().begin ? "|" : " |");
      advance();
      wantItem = true;
      continue;
    }
    if (!wantItem) {
      error("missing-separator", spanOf(current()), "'|' is missing before " + describe(current()),
            "write '|' between the parts of a block");
      fix(spanAt(current().begin), "| ");
    }
    items.push_back(parseItem(expressions));
    wantItem = false;
    if (at_ == before) {
      unexpected("a size, a selector or an operation");
      advance();
    }
  }
  if (wantItem && !items.empty() && is(closer)) {
    warning("empty-item", spanOf(current()), "there is nothing between the last '|' and '}'",
            "remove the '|'");
  }
  if (is(closer)) noteDentedCloser(open);
  if (!accept(closer)) reportUnclosed(open);
  Node n = node(NodeKind::Block, open.begin);
  if (!expressions && accept(TokenKind::Star)) n.flags |= kFlagRepeat;
  n.end = endOfLast();
  return make(n, items);
}

}  // namespace gable::lang
