// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/park/park.h"

#include "dialects/park/grammar.h"
#include "dialects/park/lower.h"

namespace gable {

namespace {

lang::Tree parse(const DialectInput& input, Diagnostics& diagnostics) {
  const std::string_view text = input.sources.text(input.file);
  const park::Grammar grammar = park::parseGrammar(text, input.file, diagnostics);
  if (grammar.rules.empty()) {
    diagnostics.error("no-rules", {input.file, 0, 0}, "this grammar has no rule",
                      "write 'Region -> Grid(2, 2) { Quarter }'");
  }
  return park::lower(grammar, input.file, text, diagnostics);
}

constexpr const char* kExtensions[] = {".park"};

}  // namespace

const Dialect kParkDialect{"park", "Park grammar", kExtensions, parse, nullptr, false,
                           {},     false,          park::words};

}  // namespace gable
