// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules as forms: gable/rule_forms.h says what is answered. Offsets are bytes of the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gable/language.h"
#include "language/library.h"

namespace gable::language {

TextForm formOf(const Parsed& parsed, const std::string& rule);

/// The body of a rule of Gable's own language as parts (pieces.cpp).
Piece piecesOf(const Parsed& parsed, lang::NodeId rule);

/// What is deleted to take away something that stands between two offsets: the blanks before it
/// too, or the line that only it stood on.
Range removalOf(const Text& text, uint32_t begin, uint32_t end);

// --- GBBG (box_rules.cpp) ---

/// A rule of a grammar, as far as it can be found: a mistake hides nothing but its values.
struct BoxHead {
  std::string title, name;
  uint32_t begin = 0, nameBegin = 0, nameEnd = 0, end = 0;
};
std::vector<BoxHead> boxHeads(std::string_view text);
/// What forms show of the whole grammar: symbols, assets, where further ones go.
void addGrammar(const Text& text, TextForm& out);
/// The values of the rule at an offset, or why there are none.
void addBoxRule(const Text& text, const BoxHead& head, RuleForm& out);
std::optional<std::vector<Edit>> boxEdits(const Text& text, const std::string& rule,
                                          const BoxRule& box);

/// Edits of the words from `begin` to `end` alone that make them those of `after`; comments between
/// them stay.
std::vector<Edit> wordEdits(const Text& text, uint32_t begin, uint32_t end, std::string_view after);

}  // namespace gable::language
