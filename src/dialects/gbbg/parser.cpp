// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A statement begins with its keyword, a rule with a symbol and an arrow. After a mistake the
// parser looks for the next such place, at the beginning of a line.

#include "dialects/gbbg/parser.h"

#include <cmath>

#include "base/text.h"
#include "dialects/gbbg/parser_impl.h"
#include "dialects/proposal.h"

namespace gable::gbbg {

namespace {

constexpr std::string_view kKeywords[] = {"axiom", "postprocess", "select",
                                          "shape", "terminal",    "use"};
constexpr size_t kMaxErrors = 100;

bool namesSymbol(const Token& t) {
  return t.kind == TokenKind::Word || (t.kind == TokenKind::Text && !t.text.empty());
}

}  // namespace

Parser::Parser(std::string_view text, uint32_t file, Diagnostics& diagnostics)
    : file_(file), diagnostics_(diagnostics), tokens_(tokenize(text, file, diagnostics)) {}

// --- Tokens ---

bool Parser::wordAt(size_t index, std::string_view word) const {
  const Token& t = tokens_[index < tokens_.size() ? index : tokens_.size() - 1];
  return t.kind == TokenKind::Word && lowerCase(t.text) == lowerCase(word);
}

bool Parser::accept(char sign) {
  if (!isSign(sign)) return false;
  advance();
  return true;
}

bool Parser::acceptWord(std::string_view word) {
  if (!isWord(word)) return false;
  advance();
  return true;
}

// The bracket that a closer which is missing here belongs to.
const Token* Parser::openBefore(char closer) const {
  const char opener = closer == '}' ? '{' : closer == ')' ? '(' : closer == ']' ? '[' : 0;
  size_t closed = 0;
  for (size_t i = at_; opener != 0 && i-- > 0;) {
    const Token& t = tokens_[i];
    if (t.kind != TokenKind::Sign) continue;
    if (t.sign == closer) ++closed;
    if (t.sign == opener && closed-- == 0) return &t;
  }
  return nullptr;
}

bool Parser::expect(char sign, const char* where) {
  if (accept(sign)) return true;
  const Token* const open = atEnd() || statementAt(at_, false) ? openBefore(sign) : nullptr;
  if (open) {
    return error(sign == '}' ? "unclosed-block" : "unclosed-bracket", spanOf(*open),
                 std::string("this '") + open->sign + "' is never closed",
                 std::string("add '") + sign + "' before " + described());
  }
  return unexpected("'" + std::string(1, sign) + "' " + where);
}

bool Parser::expectNumber(double& out, const char* what) {
  if (current().kind != TokenKind::Number) return unexpected(what);
  out = current().number;
  advance();
  return true;
}

bool Parser::expectTriple(Triple& out, const char* what) {
  if (!expect('(', what)) return false;
  for (size_t i = 0; i < 3; ++i) {
    if (i > 0 && !expect(',', "between the numbers of x, y and z")) return false;
    if (!expectNumber(out[i], "a number")) return false;
  }
  return expect(')', "after three numbers");
}

bool Parser::expectSymbol(Symbol& out, const char* what) {
  if (!namesSymbol(current())) return unexpected(what);
  out.text = current().text;
  out.span = spanOf(current());
  advance();
  return true;
}

std::string Parser::described() const {
  const Token& t = current();
  switch (t.kind) {
    case TokenKind::Word: return "'" + t.text + "'";
    case TokenKind::Text: return "a text";
    case TokenKind::Number: return "a number";
    case TokenKind::Arrow: return "'->'";
    case TokenKind::Sign: return "'" + std::string(1, t.sign) + "'";
    case TokenKind::End: return "the end of the file";
  }
  return {};
}

bool Parser::error(const char* code, Span span, std::string message, std::string hint) {
  if (++errors_ <= kMaxErrors) {
    diagnostics_.error(code, span, std::move(message), std::move(hint));
  } else if (errors_ == kMaxErrors + 1) {
    diagnostics_.error("too-many-errors", span, "there are more mistakes than are shown",
                       "mend these first");
  }
  return false;
}

bool Parser::unexpected(const std::string& wanted, std::string hint) {
  return error("unexpected-token", spanOf(current()),
               "here stands " + described() + ", but " + wanted + " is expected", std::move(hint));
}

bool Parser::unknownWord(const char* what, const std::vector<std::string_view>& words) {
  std::string list;
  for (const std::string_view w : words) list += (list.empty() ? "" : ", ") + std::string(w);
  std::string nearest;
  if (current().kind == TokenKind::Word) nearest = nearestName(current().text, words);
  error("gbbg-word", spanOf(current()),
        "here stands " + described() + ", but " + what + " is expected",
        nearest.empty() ? "it is one of: " + list : meaning(nearest));
  if (errors_ <= kMaxErrors) propose(diagnostics_, spanOf(current()), current().text, nearest);
  return false;
}

// --- Statements ---

bool Parser::statementAt(size_t index, bool ruleOnly) const {
  const auto token = [&](size_t i) -> const Token& {
    return tokens_[i < tokens_.size() ? i : tokens_.size() - 1];
  };
  if (namesSymbol(token(index)) && token(index + 1).kind == TokenKind::Arrow) return true;
  if (token(index).kind == TokenKind::Text && namesSymbol(token(index + 1)) &&
      token(index + 2).kind == TokenKind::Arrow) {
    return true;
  }
  if (ruleOnly) return false;
  for (const std::string_view k : kKeywords) {
    if (!wordAt(index, k)) continue;
    const Token& next = token(index + 1);
    return namesSymbol(next) ||
           (k == "postprocess" && next.kind == TokenKind::Sign && next.sign == '{');
  }
  return false;
}

void Parser::recover() {
  const auto begins = [&] {
    return statementAt(at_, false) || (current().firstOfLine && namesSymbol(current()));
  };
  while (!atEnd() && !begins()) advance();
}

Grammar Parser::run() {
  Grammar grammar;
  while (!atEnd()) statement(grammar);
  grammar.lastComments = current().comments;
  if (!grammar.statements.empty() && current().sameLine > 0) {
    grammar.statements.back().trailing = current().comments[0];
    grammar.lastComments.erase(grammar.lastComments.begin());
  }
  return grammar;
}

void Parser::statement(Grammar& grammar) {
  const Token& first = current();
  Statement s;
  s.comments = first.comments;
  s.apart = first.apart;
  if (first.sameLine > 0 && !grammar.statements.empty()) {
    grammar.statements.back().trailing = s.comments[0];
    s.comments.erase(s.comments.begin());
  }
  const uint32_t begin = first.begin;
  const size_t from = at_;
  bool good = false;
  if (statementAt(at_, true)) {
    s.kind = StatementKind::Rule;
    good = rule(s.rule);
  } else if (acceptWord("axiom")) {
    good = axiom(s);
  } else if (acceptWord("shape")) {
    good = shapes(s, false);
  } else if (acceptWord("terminal")) {
    good = shapes(s, true);
  } else if (acceptWord("select")) {
    good = select(s);
  } else if (acceptWord("use")) {
    good = use(s);
  } else if (acceptWord("postprocess")) {
    good = postProcess(s);
  } else {
    std::vector<std::string_view> words(std::begin(kKeywords), std::end(kKeywords));
    const bool word = current().kind == TokenKind::Word && ahead(1).kind != TokenKind::Sign;
    const std::string nearest = word ? nearestName(current().text, words) : std::string();
    unexpected("a statement",
               word ? meaning(nearest)
                    : "a rule is written 'Predecessor -> Operator(Parameters) {Successor}'");
    if (errors_ <= kMaxErrors) propose(diagnostics_, spanOf(current()), current().text, nearest);
  }
  // Comments within a statement go before it.
  for (size_t i = from + 1; i < at_ && s.kind != StatementKind::PostProcess; ++i) {
    s.comments.insert(s.comments.end(), tokens_[i].comments.begin(), tokens_[i].comments.end());
  }
  if (at_ == from) advance();
  if (!good) return recover();
  s.span = {file_, begin, last().end};
  grammar.statements.push_back(std::move(s));
}

bool Parser::axiom(Statement& s) {
  s.kind = StatementKind::Axiom;
  do {
    Start one;
    if (!start(one)) return false;
    s.starts.push_back(std::move(one));
  } while (accept(','));
  return true;
}

bool Parser::start(Start& out) {
  if (!expectSymbol(out.symbol, "the symbol of a start shape")) return false;
  if (acceptWord("on")) {
    if (!acceptWord("footprint")) return unexpected("'footprint'");
    out.onFootprint = true;
    if (!acceptWord("height")) return true;
    out.heightWritten = true;
    const Span span = spanOf(current());
    if (!expectNumber(out.height, "a height")) return false;
    if (out.height >= 0) return true;
    return error("gbbg-size", span, "a height is not negative", "write a height of zero or more");
  }
  if (acceptWord("at") && !expectTriple(out.at, "after 'at'")) return false;
  if (acceptWord("rotate") && !expectTriple(out.rotate, "after 'rotate'")) return false;
  if (!acceptWord("size")) {
    return unexpected("'size'",
                      "write 'axiom START size (30, 30, 30)', or 'axiom START on footprint'");
  }
  const Span span = spanOf(current());
  if (!expectTriple(out.size, "after 'size'")) return false;
  int zeros = 0;
  for (const double v : out.size) {
    if (v < 0)
      return error("gbbg-size", span, "a size is not negative", "write sizes of zero or more");
    zeros += v == 0;
  }
  if (zeros < 2) return true;
  return error("gbbg-size", span, "a start shape needs a size along two axes at least",
               "a size of zero makes it a 2D shape");
}

bool Parser::shapes(Statement& s, bool terminal) {
  s.kind = StatementKind::Shapes;
  do {
    ShapeLine one;
    one.terminal = terminal;
    if (!shapeLine(one)) return false;
    s.shapes.push_back(std::move(one));
  } while (accept(','));
  return true;
}

bool Parser::shapeLine(ShapeLine& out) {
  if (!expectSymbol(out.symbol, "a symbol")) return false;
  if (acceptWord("2D")) {
    out.dimensions = Dimensions::Two;
  } else if (acceptWord("Empty")) {
    out.dimensions = Dimensions::Empty;
  } else {
    acceptWord("3D");
  }
  if (!accept('[')) return true;
  for (size_t i = 0; i < 3; ++i) {
    if (i > 0 && !expect(',', "between the preferred sizes")) return false;
    const Span span = spanOf(current());
    if (!expectNumber(out.preferred[i], "a preferred size")) return false;
    if (out.preferred[i] < 0) {
      return error("gbbg-size", span, "a preferred size is not negative", "0 means any size");
    }
  }
  return expect(']', "after three preferred sizes");
}

bool Parser::select(Statement& s) {
  s.kind = StatementKind::Select;
  if (acceptWord("first")) {
    s.selection = Selection::First;
  } else if (acceptWord("random")) {
    s.selection = Selection::Random;
  } else if (acceptWord("weighted")) {
    s.selection = Selection::Weighted;
  } else {
    return unknownWord("a way to select rules", {"first", "random", "weighted"});
  }
  return true;
}

bool Parser::use(Statement& s) {
  s.kind = StatementKind::Use;
  if (current().kind != TokenKind::Text) {
    return unexpected("the path of a grammar in quotes", "write 'use \"common.gbbg\"'");
  }
  s.path = current().text;
  advance();
  return true;
}

bool Parser::postProcess(Statement& s) {
  s.kind = StatementKind::PostProcess;
  if (!expect('{', "after 'postprocess'")) return false;
  while (!atEnd() && !isSign('}')) {
    AssetLine line;
    line.comments = current().comments;
    if (!assetLine(line)) return false;
    s.assets.push_back(std::move(line));
    accept(',');
  }
  s.lastComments = current().comments;
  return expect('}', "after the last line of the table");
}

bool Parser::assetLine(AssetLine& out) {
  if (!expectSymbol(out.symbol, "the symbol of a terminal shape")) return false;
  if (!expect(':', "between symbol and asset")) return false;
  if (current().kind != TokenKind::Text) {
    return unexpected("the path of a model in quotes", "write 'Wall : \"assets/wall.glb\"'");
  }
  out.path = current().text;
  advance();
  if (!acceptWord("fit")) return true;
  if (acceptWord("bounds")) {
    out.fitBounds = true;
  } else if (!acceptWord("volume")) {
    return unknownWord("what is fitted", {"volume", "bounds"});
  }
  return true;
}

Grammar parse(std::string_view text, uint32_t file, Diagnostics& diagnostics) {
  Grammar grammar = Parser(text, file, diagnostics).run();
  grammar.file = file;
  return grammar;
}

}  // namespace gable::gbbg
