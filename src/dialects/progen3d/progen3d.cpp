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
  const std::string& from = input.sources.path(input.file);
  const auto exists = [&](const std::string& path) {
    return input.loader && input.loader->exists(path, from);
  };
  return progen3d::lower(grammar, input.file, input.catalogue, exists, diagnostics);
}

constexpr Remedy kRemedies[] = {
    {"recursion-too-deep",
     "give the rule an end: 'X ; 0.8 -> A X ->' goes on four times of five, then stops"},
    {"too-many-turns", "write a smaller number of turns behind the name of the rule"},
    {"too-many-children", "write a smaller number of turns behind the name of the rule"},
    {"too-many-shapes", "take fewer turns, or raise --max-shapes"},
    {"too-many-steps", "take fewer turns, or raise --max-steps"},
};

constexpr const char* kExtensions[] = {".grammar", ".pg3d"};

}  // namespace

const Dialect kProgen3d{
    "progen3d",      "ProGen3d",
    kExtensions,     parse,
    nullptr,         true,
    kRemedies,       false,
    progen3d::words, "is drawn anew by each rule that has it in its head, or counts turns"};

}  // namespace gable
