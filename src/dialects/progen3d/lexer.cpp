// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/lexer.h"

namespace gable::progen3d {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
// Any byte of UTF-8 beyond ASCII may stand in a name.
bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

class Lexer {
 public:
  Lexer(std::string_view text, uint32_t file, Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {}

  std::vector<Token> run() {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    for (;;) {
      skipSpace();
      if (at_ >= text_.size()) break;
      token();
    }
    const auto end = static_cast<uint32_t>(text_.size());
    out_.push_back({end, end, TokenKind::End, true, true});
    return std::move(out_);
  }

 private:
  char peek(size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void skipSpace() {
    while (at_ < text_.size()) {
      if (isSpace(text_[at_])) {
        newLine_ = newLine_ || text_[at_] == '\n';
        space_ = true;
        ++at_;
      } else if (peek() == '#' || (peek() == '/' && peek(1) == '/')) {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
        space_ = true;
      } else if (peek() == '/' && peek(1) == '*') {
        skipComment();
      } else {
        return;
      }
    }
  }

  void skipComment() {
    const size_t begin = at_;
    const size_t end = text_.find("*/", at_ + 2);
    space_ = true;
    if (end != std::string_view::npos) {
      at_ = end + 2;
      return;
    }
    at_ = text_.size();
    diagnostics_.error("unclosed-comment",
                       {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(begin + 2)},
                       "this comment has no end", "add '*/'");
  }

  void add(TokenKind kind, size_t length) {
    out_.push_back(
        {static_cast<uint32_t>(at_), static_cast<uint32_t>(at_ + length), kind, space_, newLine_});
    at_ += length;
    space_ = newLine_ = false;
  }

  void token() {
    const char c = peek();
    if (isDigit(c) || (c == '.' && isDigit(peek(1)))) return number();
    if (isLetter(c)) return name(1);
    if (c == '-' && peek(1) == '>') return add(TokenKind::Arrow, 2);
    switch (c) {
      case '(': return add(TokenKind::Open, 1);
      case ')': return add(TokenKind::Close, 1);
      case '[': return add(TokenKind::Push, 1);
      case ']': return add(TokenKind::Pop, 1);
      case '{': return add(TokenKind::BraceOpen, 1);
      case '}': return add(TokenKind::BraceClose, 1);
      case '|': return add(TokenKind::Pipe, 1);
      case ';': return add(TokenKind::Semicolon, 1);
      case ',': return add(TokenKind::Comma, 1);
      case '+': return add(TokenKind::Plus, 1);
      case '-': return add(TokenKind::Minus, 1);
      case '*': return add(TokenKind::Star, 1);
      case '/': return add(TokenKind::Slash, 1);
      case '^': return add(TokenKind::Caret, 1);
      case '&': return add(TokenKind::Ampersand, 1);
      case '?': return add(TokenKind::Question, 1);
      case ':': return add(TokenKind::Colon, 1);
      case '<': return compare(TokenKind::Less, TokenKind::LessEqual);
      case '>': return compare(TokenKind::Greater, TokenKind::GreaterEqual);
      case '=': return compare(TokenKind::Other, TokenKind::Equal);
      case '!': return compare(TokenKind::Other, TokenKind::NotEqual);
      default: return add(TokenKind::Other, 1);
    }
  }

  // A sign alone, or with a '=' behind it.
  void compare(TokenKind alone, TokenKind withEqual) {
    const bool equal = peek(1) == '=';
    add(equal ? withEqual : alone, equal ? 2 : 1);
  }

  // Digits that run on into letters are a name ("2Floors"), but for an exponent.
  void number() {
    size_t n = 0;
    while (isDigit(peek(n))) ++n;
    if (peek(n) == '.') {
      ++n;
      while (isDigit(peek(n))) ++n;
    }
    if (peek(n) == 'e' || peek(n) == 'E') {
      size_t e = n + 1;
      if (peek(e) == '+' || peek(e) == '-') ++e;
      if (isDigit(peek(e))) {
        while (isDigit(peek(e))) ++e;
        n = e;
      }
    }
    if (isLetter(peek(n))) return name(n);
    add(TokenKind::Number, n);
  }

  // The first `n` characters are known to belong to it.
  void name(size_t n) {
    while (isLetter(peek(n)) || isDigit(peek(n)) || (peek(n) == '.' && isLetter(peek(n + 1)))) ++n;
    add(TokenKind::Name, n);
  }

  std::string_view text_;
  uint32_t file_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  bool space_ = true, newLine_ = true;
  std::vector<Token> out_;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics) {
  return Lexer(text, file, diagnostics).run();
}

}  // namespace gable::progen3d
