// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The parser's state, for parser.cpp (statements) and parse_rules.cpp (rules). A mistake ends its
// statement: the parser goes on where the next one begins.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/gbbg/grammar.h"
#include "dialects/gbbg/lexer.h"

namespace gable::gbbg {

class Parser {
 public:
  Parser(std::string_view text, uint32_t file, Diagnostics& diagnostics);

  Grammar run();

 private:
  // --- Statements (parser.cpp) ---
  void statement(Grammar& grammar);
  bool axiom(Statement& s);
  bool start(Start& out);
  bool shapes(Statement& s, bool terminal);
  bool shapeLine(ShapeLine& out);
  bool select(Statement& s);
  bool use(Statement& s);
  bool postProcess(Statement& s);
  bool assetLine(AssetLine& out);
  /// True where a statement begins; a rule when `ruleOnly`.
  bool statementAt(size_t index, bool ruleOnly) const;
  void recover();

  // --- Rules (parse_rules.cpp) ---
  bool rule(Rule& out);
  bool operation(Rule& out);
  bool scope(Rule& out);
  bool change(Rule& out);
  bool split(Rule& out);
  bool splitPoints(Rule& out);
  bool margin(Rule& out);
  bool marginWord(Rule& out);
  bool component(Rule& out);
  bool axis(Axis& out);
  bool slots(Rule& out);
  bool slot(Slot& out);

  // --- Tokens ---
  const Token& current() const { return tokens_[at_]; }
  const Token& ahead(size_t n) const {
    return tokens_[at_ + n < tokens_.size() ? at_ + n : tokens_.size() - 1];
  }
  const Token& last() const { return tokens_[at_ > 0 ? at_ - 1 : 0]; }
  bool atEnd() const { return current().kind == TokenKind::End; }
  void advance() {
    if (!atEnd()) ++at_;
  }
  bool isSign(char c) const { return current().kind == TokenKind::Sign && current().sign == c; }
  /// Words are read whatever their case.
  bool isWord(std::string_view word) const { return wordAt(at_, word); }
  bool wordAt(size_t index, std::string_view word) const;
  bool accept(char sign);
  bool acceptWord(std::string_view word);
  bool expect(char sign, const char* where);
  const Token* openBefore(char closer) const;
  bool expectNumber(double& out, const char* what);
  bool expectTriple(Triple& out, const char* what);
  bool expectSymbol(Symbol& out, const char* what);
  Span spanOf(const Token& t) const { return {file_, t.begin, t.end}; }
  std::string described() const;
  /// Always false, for `return unexpected(..)`.
  bool unexpected(const std::string& wanted, std::string hint = {});
  bool unknownWord(const char* what, const std::vector<std::string_view>& words);
  bool error(const char* code, Span span, std::string message, std::string hint = {});

  uint32_t file_;
  Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  size_t at_ = 0;
  size_t errors_ = 0;
};

}  // namespace gable::gbbg
