// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the parsers of both forms of the notation do with tokens: they read a window of them, in
// most cases that of one rule, and tell mistakes as warnings, up to a number of them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "dialects/progen3d/lexer.h"
#include "dialects/proposal.h"

namespace gable::progen3d {

class TokenReader {
 public:
  TokenReader(std::string_view text, uint32_t file, std::vector<Token> tokens,
              Diagnostics& diagnostics)
      : text_(text), file_(file), tokens_(std::move(tokens)), diagnostics_(diagnostics) {}

 protected:
  /// Behind the window every token is an End.
  const Token& ahead(size_t n) const { return at_ + n < end_ ? tokens_[at_ + n] : endToken_; }
  const Token& current() const { return ahead(0); }
  bool is(TokenKind kind) const { return current().kind == kind; }
  bool accept(TokenKind kind) {
    if (!is(kind)) return false;
    ++at_;
    return true;
  }
  std::string_view textOf(const Token& t) const { return text_.substr(t.begin, t.end - t.begin); }
  Span spanOf(const Token& t) const { return {file_, t.begin, t.end}; }
  /// Where the token before the current one ends.
  uint32_t lastEnd() const { return at_ > begin_ ? tokens_[at_ - 1].end : tokens_[begin_].begin; }
  Span since(uint32_t begin) const { return {file_, begin, std::max(begin, lastEnd())}; }

  void error(const char* code, Span span, std::string message, std::string hint = {}) {
    if (++told_ <= kMaxTold) diagnostics_.error(code, span, std::move(message), std::move(hint));
  }
  void warning(const char* code, Span span, std::string message, std::string hint = {}) {
    if (++told_ <= kMaxTold) diagnostics_.warning(code, span, std::move(message), std::move(hint));
  }

  /// An error about the word at `span`, which may mean `nearest`.
  void errorOfWord(const char* code, Span span, std::string message, std::string hint,
                   const std::string& nearest) {
    error(code, span, std::move(message), nearest.empty() ? std::move(hint) : meaning(nearest));
    if (!nearest.empty() && told_ <= kMaxTold) diagnostics_.fixLast(span, nearest);
  }

  void window(size_t begin, size_t end) {
    begin_ = at_ = begin;
    end_ = end;
    const uint32_t place = end > begin ? tokens_[end - 1].end : tokens_[begin].begin;
    endToken_ = {place, place, TokenKind::End, true, true};
  }

  /// The rest of "( expression )", whose '(' is the token before the current one.
  template <class Parse>
  uint32_t inBrackets(const Parse& parseExpression) {
    const Token open = tokens_[at_ - 1];
    ++innerBrackets_;
    const uint32_t inner = parseExpression();
    --innerBrackets_;
    if (!accept(TokenKind::Close)) {
      error("unclosed-bracket", spanOf(open), "this '(' is never closed", "add ')'");
    }
    return inner;
  }

  std::string_view text_;
  uint32_t file_;
  std::vector<Token> tokens_;
  Diagnostics& diagnostics_;
  size_t begin_ = 0, at_ = 0, end_ = 0;
  int innerBrackets_ = 0;

 private:
  static constexpr size_t kMaxTold = 200;

  Token endToken_;
  size_t told_ = 0;
};

}  // namespace gable::progen3d
