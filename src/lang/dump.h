// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The tree and the tokens as text, for goldens, tests and readers. One line a declaration,
// successor, branch or item, two spaces of indent a level; expressions on their line with all
// brackets written. Equal trees give equal text. Linear in the tree.
#pragma once

#include <string>
#include <string_view>

#include "lang/token.h"
#include "lang/tree.h"

namespace gable::lang {

std::string dump(const Tree& tree);

/// One expression node: "(a + (b * 2))".
std::string dumpExpression(const Tree& tree, NodeId id);

/// One token a line: kind and text.
std::string dumpTokens(const Tokens& tokens, std::string_view text);

/// `text` as a string literal of the language, quotes included.
std::string quoted(std::string_view text);

}  // namespace gable::lang
