// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/progen3d.h"

#include "dialects/progen3d/grammar.h"
#include "dialects/progen3d/lower.h"

namespace gable {

namespace {

lang::Tree parse(const DialectInput& input, Diagnostics& diagnostics) {
  const std::string_view text = input.sources.text(input.file);
  const progen3d::Grammar grammar = progen3d::parseGrammar(text, input.file, diagnostics);
  if (grammar.rules.empty() && !grammar.isWebLanguage) {
    diagnostics.error("no-rules", {input.file, 0, 0}, "this grammar has no rule",
                      "write 'X -> I ( Cube )'");
  }
  return progen3d::lower(grammar, input.file, input.catalogue, diagnostics);
}

constexpr const char* kExtensions[] = {".grammar", ".pg3d"};

}  // namespace

const Dialect kProgen3d{"progen3d", "ProGen3d", kExtensions, parse, nullptr, true};

}  // namespace gable
