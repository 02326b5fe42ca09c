// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The canonical layout of a rule file. Only white space changes: every word, sign and comment stays
// as it was written and in its order.
//
// Promises:
//  1. The formatted text parses to the same tree.
//  2. Formatting a formatted text changes nothing.
//  3. Lines stay within 120 columns where a break is possible; comments are never broken.
// Linear in the text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "lang/token.h"
#include "lang/tree.h"

namespace gable::lang {

/// The text itself when it has syntax errors, which are reported: such a file has no layout.
std::string format(const Sources& sources, uint32_t file, Diagnostics& diagnostics);

/// The same for a text that is tokenized and parsed already, without errors.
std::string formatTokens(std::string_view text, const Tokens& tokens, const Tree& tree);

}  // namespace gable::lang
