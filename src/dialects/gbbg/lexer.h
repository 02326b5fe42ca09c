// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text to tokens, for the parser alone. Comments are kept beside the tokens: the formatter writes
// them back. Linear in the text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace gable::gbbg {

enum class TokenKind : uint8_t {
  /// A name, or a word that begins with digits such as 2D.
  Word,
  /// In double quotes; `text` is what stands between them.
  Text,
  Number,
  Arrow,
  /// ( ) { } [ ] , : |
  Sign,
  End,
};

struct Token {
  TokenKind kind = TokenKind::End;
  char sign = 0;
  double number = 0;
  std::string text;
  uint32_t begin = 0, end = 0;
  /// Comments between the token before and this one, each with its mark; `sameLine` of them stand
  /// on the line of the token before.
  std::vector<std::string> comments;
  uint32_t sameLine = 0;
  /// An empty line stands before it, or before its comments.
  bool apart = false;
  /// It stands at the very beginning of a line.
  bool firstOfLine = false;
};

/// The last token is End. Texts longer than kMaxText bytes are refused with one error.
inline constexpr size_t kMaxText = 16u << 20;
std::vector<Token> tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics);

}  // namespace gable::gbbg
