// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/gbbg/lexer.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace gable::gbbg {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
// Letters of other scripts come as bytes of UTF-8 above 127.
bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool isSign(char c) { return std::string_view("(){}[],:|").find(c) != std::string_view::npos; }

class Lexer {
 public:
  Lexer(std::string_view text, uint32_t file, Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {}

  std::vector<Token> run() {
    std::vector<Token> out;
    if (text_.size() > kMaxText) {
      diagnostics_.error("file-too-large", {file_, 0, 0}, "this grammar is larger than 16 MB",
                         "split it, and put the parts together with 'use'");
      text_ = {};
    }
    do {
      out.push_back(next(out.empty()));
    } while (out.back().kind != TokenKind::End);
    return out;
  }

 private:
  char at(size_t i) const { return i < text_.size() ? text_[i] : '\0'; }

  // Passes blanks and comments, which go to the token.
  void skip(Token& t, bool first) {
    int lines = first ? 1 : 0;
    bool commented = false;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') ++lines;
      if (lines > 1 && !commented) t.apart = true;
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        ++at_;
      } else if (c == '#' || (c == '/' && at(at_ + 1) == '/')) {
        comment(t, lines == 0, text_.find('\n', at_), 0);
        commented = commented || lines > 0;
      } else if (c == '/' && at(at_ + 1) == '*') {
        const size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) {
          error("unterminated-comment", at_, at_ + 2, "this comment is never closed", "add '*/'");
        }
        comment(t, lines == 0, end, 2);
        commented = commented || lines > 0;
      } else {
        return;
      }
    }
  }

  void comment(Token& t, bool sameLine, size_t end, size_t mark) {
    end = end == std::string_view::npos ? text_.size() : end + mark;
    std::string_view body = text_.substr(at_, end - at_);
    while (!body.empty() && (body.back() == '\r' || body.back() == ' ')) body.remove_suffix(1);
    t.comments.emplace_back(body);
    if (sameLine) ++t.sameLine;
    at_ = end;
  }

  Token next(bool first) {
    Token t;
    skip(t, first);
    while (at_ < text_.size() && !begins(text_[at_])) {
      error("unexpected-character", at_, at_ + 1, "this character means nothing here",
            "put names with such characters into double quotes");
      ++at_;
      skip(t, false);
    }
    t.begin = static_cast<uint32_t>(at_);
    t.firstOfLine = at_ == 0 || text_[at_ - 1] == '\n';
    if (at_ < text_.size()) read(t, text_[at_]);
    t.end = static_cast<uint32_t>(at_);
    return t;
  }

  static bool begins(char c) {
    return isSign(c) || isLetter(c) || isDigit(c) || c == '-' || c == '+' || c == '.' || c == '"';
  }

  void read(Token& t, char c) {
    if (isSign(c)) {
      t.kind = TokenKind::Sign;
      t.sign = c;
      ++at_;
    } else if (c == '-' && at(at_ + 1) == '>') {
      t.kind = TokenKind::Arrow;
      at_ += at(at_ + 2) == '>' ? 3 : 2;
    } else if (c == '"') {
      quoted(t);
    } else if (isLetter(c)) {
      word(t);
    } else {
      number(t);
    }
  }

  void word(Token& t) {
    const size_t from = at_;
    while (isLetter(at(at_)) || isDigit(at(at_))) ++at_;
    t.kind = TokenKind::Word;
    t.text = text_.substr(from, at_ - from);
  }

  void number(Token& t) {
    const size_t from = at_;
    const char* begin = text_.data() + at_ + (text_[at_] == '+' ? 1 : 0);
    const char* end = readNumber(begin, text_.data() + text_.size(), t.number);
    if (end == begin || !std::isfinite(t.number)) {
      t.number = 0;
      error("bad-number", at_, at_ + 1, "this is no number", "write it as 2.5 or -2.5");
      at_ = std::max(at_ + 1, static_cast<size_t>(end - text_.data()));
      t.kind = TokenKind::Number;
      return;
    }
    at_ = static_cast<size_t>(end - text_.data());
    if (isLetter(at(at_)) && isDigit(text_[from])) {
      word(t);
      t.text = text_.substr(from, at_ - from);
      return;
    }
    t.kind = TokenKind::Number;
  }

  void quoted(Token& t) {
    const size_t from = ++at_;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') ++at_;
    t.kind = TokenKind::Text;
    t.text = text_.substr(from, at_ - from);
    if (at(at_) == '"') {
      ++at_;
    } else {
      error("unterminated-string", from - 1, at_, "this text is never closed", "add '\"'");
    }
  }

  void error(const char* code, size_t begin, size_t end, std::string message, std::string hint) {
    if (++errors_ > 100) return;
    diagnostics_.error(code, {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)},
                       std::move(message), std::move(hint));
  }

  std::string_view text_;
  uint32_t file_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  size_t errors_ = 0;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics) {
  return Lexer(text, file, diagnostics).run();
}

}  // namespace gable::gbbg
