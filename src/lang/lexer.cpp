// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One pass over the bytes. Dots decide most of it: "a.b" is one name, "X." a name and a dot, ".5"
// and "5." are numbers, ".+" is an operator, and a dot before an operator belongs to the operator
// ("1.==x" compares element by element). Brackets are paired on the way with a stack on which a
// closing brace overrules open parentheses and brackets, but not the other way round; so a
// forgotten
// ")" does not spoil the block around it.

#include "lang/lexer.h"

#include <array>
#include <optional>
#include <utility>

#include "base/text.h"
#include "lang/other_languages.h"

namespace gable::lang {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isNameStart(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}

Keyword keywordOf(std::string_view s) {
  static constexpr std::pair<std::string_view, Keyword> kWords[] = {
      {"attr", Keyword::Attr},           {"const", Keyword::Const},
      {"style", Keyword::Style},         {"extends", Keyword::Extends},
      {"import", Keyword::Import},       {"version", Keyword::Version},
      {"case", Keyword::Case},           {"else", Keyword::Else},
      {"with", Keyword::With},           {"start", Keyword::Start},
      {"extension", Keyword::Extension}, {"true", Keyword::True},
      {"false", Keyword::False},         {"inline", Keyword::Inline},
      {"union", Keyword::Union},         {"subtract", Keyword::Subtract},
      {"intersect", Keyword::Intersect},
  };
  if (s.size() < 4 || s.size() > 9) return Keyword::None;
  for (const auto& [word, keyword] : kWords) {
    if (word == s) return keyword;
  }
  return Keyword::None;
}

// Pairs brackets as they come. `opened` counts what is open above the innermost brace, so that a
// closer knows without a search whether its partner exists; each token is pushed and popped once.
class BracketMatcher {
 public:
  void open(std::vector<Token>& tokens, uint32_t index) {
    const TokenKind kind = tokens[index].kind;
    stack_.push_back({index, parens_, brackets_});
    if (kind == TokenKind::LBrace) {
      parens_ = brackets_ = 0;
      ++braces_;
    } else {
      ++(kind == TokenKind::LParen ? parens_ : brackets_);
    }
  }

  void close(std::vector<Token>& tokens, uint32_t index) {
    const TokenKind kind = tokens[index].kind;
    const TokenKind opener = kind == TokenKind::RBrace   ? TokenKind::LBrace
                             : kind == TokenKind::RParen ? TokenKind::LParen
                                                         : TokenKind::LBracket;
    const uint32_t open = opener == TokenKind::LBrace   ? braces_
                          : opener == TokenKind::LParen ? parens_
                                                        : brackets_;
    if (open == 0) return;
    for (;;) {
      const Open top = stack_.back();
      stack_.pop_back();
      parens_ = top.parens;
      brackets_ = top.brackets;
      if (tokens[top.index].kind == TokenKind::LBrace) --braces_;
      if (tokens[top.index].kind != opener) continue;
      tokens[top.index].match = index;
      tokens[index].match = top.index;
      return;
    }
  }

 private:
  struct Open {
    uint32_t index;
    uint32_t parens;
    uint32_t brackets;
  };
  std::vector<Open> stack_;
  uint32_t parens_ = 0;
  uint32_t brackets_ = 0;
  uint32_t braces_ = 0;
};

class Lexer {
 public:
  Lexer(std::string_view text, uint32_t file, Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {}

  Tokens run() {
    if (text_.substr(0, 3) == "\xef\xbb\xbf") at_ = 3;
    while (skipSpace(), at_ < text_.size()) {
      if (out_.tokens.size() >= kMaxTokens) {
        error("file-too-large", at_, at_ + 1,
              "the file has more than " + std::to_string(kMaxTokens) + " words and signs",
              "split it into several files and import them");
        break;
      }
      lexToken();
    }
    const auto end = static_cast<uint32_t>(at_);
    out_.tokens.push_back({end, end, Token::kNoMatch, TokenKind::End, Keyword::None, false});
    return std::move(out_);
  }

 private:
  char peek(size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool startsWith(std::string_view s) const { return text_.substr(at_, s.size()) == s; }

  // True inside a name. Letters outside ASCII are letters of names: public files have some.
  bool isNamePart(size_t i) const {
    if (i >= text_.size()) return false;
    const char c = text_[i];
    return isNameStart(c) || isDigit(c) || (static_cast<unsigned char>(c) >= 0x80 && isLetter(i));
  }

  // Signs that word processors and web pages leave in a text are not letters.
  bool isLetter(size_t i) const {
    const auto u = static_cast<unsigned char>(text_[i]);
    if (u < 0x80) return isNameStart(text_[i]);
    const size_t length = utf8Length(text_, i);
    if (length == 0)
      return u >= 0x80 && u < 0xc0 && i > 0 && static_cast<unsigned char>(text_[i - 1]) >= 0x80;
    if (length == 2) return !(u == 0xc2 && static_cast<unsigned char>(text_[i + 1]) < 0xc0);
    return !(u == 0xe2 && static_cast<unsigned char>(text_[i + 1]) <= 0x81) &&
           text_.substr(i, 3) != "\xef\xbb\xbf" && text_.substr(i, 3) != "\xe3\x80\x80";
  }

  void error(const char* code, size_t begin, size_t end, std::string message, std::string hint,
             std::optional<Replacement> fix = {}) {
    if (diagnostics_.errorCount() > 200) return;
    diagnostics_.error(code, spanOf(begin, end), std::move(message), std::move(hint));
    if (fix) diagnostics_.fixLast(fix->span, std::move(fix->text));
  }

  Span spanOf(size_t begin, size_t end) const {
    return {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
  }

  void addComment(size_t begin, bool toLineEnd) {
    out_.comments.push_back({static_cast<uint32_t>(begin), static_cast<uint32_t>(at_), toLineEnd});
  }

  // White space, the spaces of web pages, and comments.
  void skipSpace() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v') {
        ++at_;
      } else if (c == '#' || startsWith("//")) {
        skipLineComment();
      } else if (startsWith("/*")) {
        skipBlockComment();
      } else if (startsWith("\xc2\xa0")) {
        at_ += 2;
      } else if (startsWith("\xef\xbb\xbf") || startsWith("\xe2\x80\x8b") ||
                 startsWith("\xe3\x80\x80")) {
        at_ += 3;
      } else {
        return;
      }
    }
  }

  void skipLineComment() {
    const size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    addComment(begin, true);
  }

  void skipBlockComment() {
    const size_t begin = at_;
    const size_t close = text_.find("*/", at_ + 2);
    at_ = close == std::string_view::npos ? text_.size() : close + 2;
    if (close == std::string_view::npos) {
      error("unterminated-comment", begin, begin + 2, "this comment is never closed",
            "end it with '*/'", Replacement{spanOf(at_, at_), "*/"});
    }
    addComment(begin, false);
  }

  void push(TokenKind kind, size_t length, bool elementwise = false) {
    Token t;
    t.begin = static_cast<uint32_t>(at_);
    at_ += length;
    t.end = static_cast<uint32_t>(at_);
    t.kind = kind;
    t.elementwise = elementwise;
    out_.tokens.push_back(t);
    const auto index = static_cast<uint32_t>(out_.tokens.size() - 1);
    if (kind == TokenKind::LParen || kind == TokenKind::LBracket || kind == TokenKind::LBrace) {
      brackets_.open(out_.tokens, index);
    } else if (kind == TokenKind::RParen || kind == TokenKind::RBracket ||
               kind == TokenKind::RBrace) {
      brackets_.close(out_.tokens, index);
    }
  }

  void lexToken() {
    const char c = peek();
    if (isLetter(at_)) return lexName();
    if (isDigit(c)) return lexNumber();
    if (c == '"') return lexString();
    if (c == '\'' && quotedLength() > 0) return lexQuoted();
    if (c == '.') return lexDot();
    lexSign();
  }

  void lexName() {
    size_t end = at_;
    for (;;) {
      while (isNamePart(end)) ++end;
      if (end + 1 >= text_.size() || text_[end] != '.' || !isLetter(end + 1)) break;
      ++end;
    }
    const Keyword keyword = keywordOf(text_.substr(at_, end - at_));
    push(TokenKind::Name, end - at_);
    out_.tokens.back().keyword = keyword;
  }

  // Length of the operator at `i`, which may follow a dot; 0 if there is none. Comments are none.
  size_t operatorLength(size_t i) const {
    const std::string_view rest = text_.substr(i, 3);
    const std::string_view two = rest.substr(0, 2);
    if (two == "//" || two == "/*" || rest == "-->") return 0;
    for (const std::string_view s : {"||", "&&", "==", "!=", "<=", ">="}) {
      if (two == s) return 2;
    }
    return !rest.empty() && std::string_view("+-*/%<>!").find(rest[0]) != std::string_view::npos;
  }

  void lexNumber() {
    size_t end = at_;
    while (end < text_.size() && isDigit(text_[end])) ++end;
    if (end < text_.size() && text_[end] == '.' && operatorLength(end + 1) == 0) {
      ++end;
      while (end < text_.size() && isDigit(text_[end])) ++end;
    }
    push(TokenKind::Number, exponentEnd(end) - at_);
  }

  size_t exponentEnd(size_t end) const {
    if (end >= text_.size() || (text_[end] != 'e' && text_[end] != 'E')) return end;
    size_t digits = end + 1;
    if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
    if (digits >= text_.size() || !isDigit(text_[digits])) return end;
    while (digits < text_.size() && isDigit(text_[digits])) ++digits;
    return digits;
  }

  // The place of the quote that closes the string at `from`, or of the end of the text; the end of
  // the line where the string must end with it.
  size_t stringEnd(size_t from, bool inLine) const {
    size_t end = from + 1;
    while (end < text_.size() && text_[end] != '"' && !(inLine && text_[end] == '\n')) {
      end += text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] != '\n' ? 2 : 1;
    }
    return std::min(end, text_.size());
  }

  // Whether every string from `from` on is closed somewhere. If not, a quote is missing, and the
  // next one begins another string.
  bool stringsAreClosed(size_t from) const {
    for (size_t i = from; i < text_.size(); ++i) {
      const std::string_view two = text_.substr(i, 2);
      if (text_[i] == '"') {
        i = stringEnd(i, false);
        if (i == text_.size()) return false;
      } else if (text_[i] == '#' || two == "//") {
        i = std::min(text_.find('\n', i), text_.size());
      } else if (two == "/*") {
        const size_t close = text_.find("*/", i + 2);
        i = close == std::string_view::npos ? text_.size() : close + 1;
      }
    }
    return true;
  }

  // A string may run over several lines. In a file where a quote is missing all end with their
  // line, so that the mistake is told where it stands, and so does one that would hold a rule.
  void lexString() {
    size_t end = stringEnd(at_, true);
    if (end < text_.size() && text_[end] == '\n') {
      if (!runsOver_) runsOver_ = stringsAreClosed(at_);
      const size_t last = *runsOver_ ? stringEnd(at_, false) : end;
      if (text_.substr(end, last - end).find("-->") == std::string_view::npos) end = last;
    }
    if (end >= text_.size() || text_[end] != '"') {
      if (end > at_ + 1 && text_[end - 1] == '\r') --end;
      error("unterminated-string", at_, at_ + 1, "this string is never closed", "end it with '\"'",
            Replacement{spanOf(end, end), "\""});
      push(TokenKind::String, end - at_);
    } else {
      push(TokenKind::String, end + 1 - at_);
    }
  }

  // The length of 'text' in single quotes; 0 where the quote is the prefix of a relative size. Two
  // prefixes of one line have an operator, a bracket or a separator between them.
  size_t quotedLength() const {
    size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '\'') {
      if (std::string_view("\n\r\"(){}[]|,:;").find(text_[end]) != std::string_view::npos) return 0;
      ++end;
    }
    if (end >= text_.size() || end == at_ + 1) return 0;
    const std::string_view space = " \t\r\n";
    const char last = text_[end - 1];
    if (std::string_view(" \t+-*/%<>=!&").find(last) != std::string_view::npos) return 0;
    const char next = end + 1 < text_.size() ? text_[end + 1] : '\n';
    const bool closes = (space.find(next) != std::string_view::npos) ||
                        std::string_view("),]}|:;").find(next) != std::string_view::npos;
    return closes ? end + 1 - at_ : 0;
  }

  void lexQuoted() {
    const size_t length = quotedLength();
    const std::string_view inner = text_.substr(at_ + 1, length - 2);
    error("unexpected-character", at_, at_ + length, "a text stands in double quotes",
          "write \"" + std::string(inner) + "\"",
          Replacement{spanOf(at_, at_ + length), "\"" + std::string(inner) + "\""});
    push(TokenKind::String, length);
  }

  // A dot right after a name ends a terminal symbol, even before a digit.
  void lexDot() {
    const bool afterName = !out_.tokens.empty() && out_.tokens.back().end == at_ &&
                           out_.tokens.back().kind == TokenKind::Name;
    if (isDigit(peek(1)) && !afterName) {
      size_t end = at_ + 1;
      while (end < text_.size() && isDigit(text_[end])) ++end;
      push(TokenKind::Number, exponentEnd(end) - at_);
      return;
    }
    const size_t length = operatorLength(at_ + 1);
    if (length == 0) return push(TokenKind::Dot, 1);
    push(operatorKind(text_.substr(at_ + 1, length)), length + 1, true);
  }

  static TokenKind operatorKind(std::string_view s) {
    static constexpr std::pair<std::string_view, TokenKind> kOperators[] = {
        {"||", TokenKind::Or},       {"&&", TokenKind::And},       {"==", TokenKind::EqualEqual},
        {"!=", TokenKind::NotEqual}, {"<=", TokenKind::LessEqual}, {">=", TokenKind::GreaterEqual},
        {"+", TokenKind::Plus},      {"-", TokenKind::Minus},      {"*", TokenKind::Star},
        {"/", TokenKind::Slash},     {"%", TokenKind::Percent},    {"<", TokenKind::Less},
        {">", TokenKind::Greater},   {"!", TokenKind::Not},
    };
    for (const auto& [text, kind] : kOperators) {
      if (text == s) return kind;
    }
    return TokenKind::End;
  }

  void lexSign() {
    static constexpr std::pair<std::string_view, TokenKind> kSigns[] = {
        {"-->", TokenKind::Arrow},  {":=", TokenKind::Assign},   {"=:", TokenKind::Connect},
        {"(", TokenKind::LParen},   {")", TokenKind::RParen},    {"[", TokenKind::LBracket},
        {"]", TokenKind::RBracket}, {"{", TokenKind::LBrace},    {"}", TokenKind::RBrace},
        {",", TokenKind::Comma},    {";", TokenKind::Semicolon}, {":", TokenKind::Colon},
        {"@", TokenKind::At},       {"~", TokenKind::Tilde},     {"'", TokenKind::Quote},
        {"^", TokenKind::Caret},    {"?", TokenKind::Question},
    };
    for (const auto& [text, kind] : kSigns) {
      if (startsWith(text)) return push(kind, text.size());
    }
    // The parser reports it, with what stands there instead.
    if (startsWith("->")) return push(TokenKind::Arrow, 2);
    if (const size_t length = operatorLength(at_)) {
      return push(operatorKind(text_.substr(at_, length)), length);
    }
    if (peek() == '=') return push(TokenKind::Equal, 1);
    if (peek() == '|') return push(TokenKind::Pipe, 1);
    lexUnknown();
  }

  void lexUnknown() {
    if (peek() == '&') {
      error("unexpected-character", at_, at_ + 1, "'&' is no operator",
            remedyOf(*foreignWord(ForeignUse::Operator, "&")),
            Replacement{spanOf(at_, at_ + 1), "&&"});
      return push(TokenKind::And, 1);
    }
    const size_t length = std::max<size_t>(1, utf8Length(text_, at_));
    const std::string_view sign = text_.substr(at_, length);
    const bool typographic = sign == "\xe2\x80\x9c" || sign == "\xe2\x80\x9d" ||
                             sign == "\xe2\x80\x98" || sign == "\xe2\x80\x99";
    const bool printable = length > 1 || (sign[0] > ' ' && sign[0] < 0x7f);
    error("unexpected-character", at_, at_ + length,
          printable ? "'" + std::string(sign) + "' has no meaning here"
                    : std::string("a byte that is no text has no meaning here"),
          typographic          ? "use the straight quotes \" and '"
          : sign == "\xc2\xb0" ? "remove it: angles are in degrees"
                               : "remove it");
    // One report for a whole run of such bytes.
    at_ += length;
    while (at_ < text_.size() && !isLetter(at_) &&
           (static_cast<unsigned char>(text_[at_]) >= 0x7f ||
            static_cast<unsigned char>(text_[at_]) < '\t')) {
      ++at_;
    }
  }

  std::string_view text_;
  uint32_t file_;
  Diagnostics& diagnostics_;
  Tokens out_;
  BracketMatcher brackets_;
  size_t at_ = 0;
  // Whether strings run over lines; known once one does not end in its own.
  std::optional<bool> runsOver_;
};

int hexDigit(char c) {
  if (isDigit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// The value of the four digits after "\u"; -1 if they are not there.
int unicodeEscape(std::string_view s, size_t digits) {
  if (digits + 4 > s.size()) return -1;
  int value = 0;
  for (size_t i = digits; i < digits + 4; ++i) {
    if (hexDigit(s[i]) < 0) return -1;
    value = value * 16 + hexDigit(s[i]);
  }
  return value;
}

}  // namespace

Tokens tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics) {
  return Lexer(text, file, diagnostics).run();
}

std::string stringValue(std::string_view s) {
  const char quote = !s.empty() && s.front() == '\'' ? '\'' : '"';
  if (!s.empty() && s.front() == quote) s.remove_prefix(1);
  // The last quote closes the string unless a backslash takes it.
  std::string out;
  out.reserve(s.size());
  for (size_t i = 0; i < s.size(); ++i) {
    if (s[i] == quote) break;
    if (s[i] != '\\' || i + 1 >= s.size()) {
      out += s[i];
      continue;
    }
    const char c = s[++i];
    if (c == 'n') {
      out += '\n';
    } else if (c == 't') {
      out += '\t';
    } else if (c == 'r') {
      out += '\r';
    } else if (c == '"' || c == '\\') {
      out += c;
    } else if (const int code = c == 'u' ? unicodeEscape(s, i + 1) : -1; code >= 0) {
      appendUtf8(out, static_cast<uint32_t>(code));
      i += 4;
    } else {
      out += '\\';
      out += c;
    }
  }
  return out;
}

const char* tokenKindName(TokenKind kind) {
  static constexpr std::array<const char*, 38> kNames = {"the end of the file",
                                                         "a name",
                                                         "a number",
                                                         "a string",
                                                         "'('",
                                                         "')'",
                                                         "'['",
                                                         "']'",
                                                         "'{'",
                                                         "'}'",
                                                         "','",
                                                         "';'",
                                                         "':'",
                                                         "':='",
                                                         "'='",
                                                         "'=:'",
                                                         "'-->'",
                                                         "'|'",
                                                         "'.'",
                                                         "'@'",
                                                         "'~'",
                                                         "a single quote",
                                                         "'+'",
                                                         "'-'",
                                                         "'*'",
                                                         "'/'",
                                                         "'%'",
                                                         "'!'",
                                                         "'<'",
                                                         "'<='",
                                                         "'>'",
                                                         "'>='",
                                                         "'=='",
                                                         "'!='",
                                                         "'&&'",
                                                         "'||'",
                                                         "'^'",
                                                         "'?'"};
  return kNames[static_cast<size_t>(kind)];
}

}  // namespace gable::lang
