// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text to grammar, by the EBNF of the page of the notation. Any text gives a grammar: mistakes are
// reported, all of them in one run, and what is right beside them is kept. Linear in the text; no
// recursion.
#pragma once

#include <cstdint>
#include <string_view>

#include "dialects/gbbg/grammar.h"

namespace gable::gbbg {

Grammar parse(std::string_view text, uint32_t file, Diagnostics& diagnostics);

}  // namespace gable::gbbg
