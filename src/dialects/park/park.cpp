// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/park/park.h"

#include "dialects/line_layout.h"
#include "dialects/park/expression.h"
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
  return park::lower(grammar, {input.file, text, input.sources.path(input.file), input.loader},
                     diagnostics);
}

std::string format(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  park::parseGrammar(text, file, diagnostics);
  return diagnostics.hasErrors() ? std::string(text) : withLaidOutLines(text, SignSpacing::Even);
}

constexpr const char* kEnd = "let the rule end: 'case (w > 2): A else: B'";

constexpr Remedy kRemedies[] = {
    {"unknown-name", park::kExpressionHint},
    {"no-cells",
     "make the region larger, or write fewer cells, a narrower PathWidth, or a smaller "
     "minarea"},
    {"scatter-full", "scatter fewer or smaller ones, or write what else shall happen: else { A }"},
    {"endless-rule", kEnd},
    {"recursion-too-deep", kEnd},
    {"too-many-shapes", "write larger cells or fewer of them, or raise --max-shapes"},
    {"too-many-children", "write larger cells or fewer of them"},
};

constexpr const char* kExtensions[] = {".park"};
// Names that are no rules.
constexpr const char* kDeclaring[] = {"fun"};

}  // namespace

const Dialect kParkDialect{"park",      "Park grammar",
                           kExtensions, parse,
                           format,      kRemedies,
                           false,       park::words,
                           nullptr,     "see the guide to park grammars, docs/guide/park.md",
                           kDeclaring};

}  // namespace gable
