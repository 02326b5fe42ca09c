// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rule text to tree. Any text gives a tree: what is wrong is reported, all of it in one run, and
// left out or replaced by Missing nodes. No operation is known here; `name(args) { ... }` is parsed
// alike for all names, except for the words `inline`, `union`, `subtract` and `intersect`, which
// may take the successor behind them instead of a block (unless the file has a rule of that name).
//
// Linear in the text, recursion bounded by kMaxNesting, memory by the token limit of the lexer.
// After kMaxSyntaxErrors errors the rest of the file is not looked at.
#pragma once

#include <cstdint>

#include "base/diagnostic.h"
#include "lang/token.h"
#include "lang/tree.h"

namespace gable::lang {

/// How deep expressions, blocks and choices may nest; a block counts three. Real files stay
/// below 60.
inline constexpr uint32_t kMaxNesting = 400;
inline constexpr size_t kMaxSyntaxErrors = 100;

Tree parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics);

/// The same for tokens that are at hand already; `text` is the source they came from.
Tree parse(std::string_view text, uint32_t file, const Tokens& tokens, Diagnostics& diagnostics);

}  // namespace gable::lang
