// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A text of any notation as words, signs, strings and comments. Nothing is refused, since texts are
// being written; all notations share these forms.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace gable::language {

enum class WordKind : uint8_t { Name, Number, String, Comment, Mark };

struct Word {
  uint32_t begin = 0, end = 0;
  WordKind kind = WordKind::Mark;
};

/// In the order of the text. Comments begin with //, # or /*.
std::vector<Word> wordsOf(std::string_view text);

}  // namespace gable::language
