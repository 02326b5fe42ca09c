// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tokens of the rule language. A token is a range of bytes of its source; comments are kept aside,
// in order, for the formatter. Opening brackets know their closing one, so that the parser can look
// over a pair of brackets in constant time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace gable::lang {

enum class TokenKind : uint8_t {
  End,
  Name,    // a, a.b.c, style$rule
  Number,  // 1, 1.5, .5, 5., 1e3
  String,  // "..." with its quotes
  LParen,
  RParen,
  LBracket,
  RBracket,
  LBrace,
  RBrace,
  Comma,
  Semicolon,
  Colon,
  Assign,   // :=
  Equal,    // =
  Connect,  // =:
  Arrow,    // -->
  Pipe,     // |
  Dot,
  At,
  Tilde,
  Quote,  // '
  Plus,
  Minus,
  Star,
  Slash,
  Percent,
  Not,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  EqualEqual,
  NotEqual,
  And,
  Or,
  Caret,     // ^, in @Handle only
  Question,  // ?, which has no meaning
};

/// Words with a meaning of their own. All but `case`, `else`, `true` and `false` are names wherever
/// the place asks for one.
enum class Keyword : uint8_t {
  None,
  Attr,
  Const,
  Style,
  Extends,
  Import,
  Version,
  Case,
  Else,
  With,
  Start,
  Extension,
  True,
  False,
  Inline,
  Union,
  Subtract,
  Intersect,
};

struct Token {
  static constexpr uint32_t kNoMatch = 0;

  uint32_t begin = 0;
  uint32_t end = 0;
  /// For an opening bracket the index of its closing token and the reverse; kNoMatch if there is
  /// none.
  uint32_t match = kNoMatch;
  TokenKind kind = TokenKind::End;
  Keyword keyword = Keyword::None;
  /// An operator with a dot before it: element by element.
  bool elementwise = false;
};

struct Comment {
  uint32_t begin = 0;
  uint32_t end = 0;
  /// // and # run to the end of their line, /* */ does not.
  bool toLineEnd = false;
};

/// The last token is always End.
struct Tokens {
  std::vector<Token> tokens;
  std::vector<Comment> comments;
};

/// What a reader calls this token: "'-->'", "a name".
const char* tokenKindName(TokenKind kind);

}  // namespace gable::lang
