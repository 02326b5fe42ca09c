// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tokens of a ProGen3d grammar. White space separates arguments in this notation, so each token
// knows whether some stands before it; and rules end at line ends, so each knows whether it is the
// first of its line. Comments (#, //, /* */) are gone. Linear in the text.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace gable::progen3d {

enum class TokenKind : uint8_t {
  End,
  Name,
  Number,
  Open,   // (
  Close,  // )
  Push,   // [
  Pop,    // ]
  BraceOpen,
  BraceClose,
  Pipe,
  Semicolon,
  Comma,
  Arrow,  // ->
  Plus,
  Minus,
  Star,
  Slash,
  Caret,
  Ampersand,
  Question,
  Colon,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Equal,     // ==
  NotEqual,  // !=
  Other,
};

struct Token {
  uint32_t begin = 0, end = 0;
  TokenKind kind = TokenKind::End;
  bool spaceBefore = false;
  bool firstOfLine = false;
};

/// The last token is always End. A comment without its end is reported.
std::vector<Token> tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics);

}  // namespace gable::progen3d
