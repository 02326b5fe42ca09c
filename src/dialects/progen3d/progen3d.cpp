// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/progen3d.h"

#include "dialects/line_layout.h"
#include "dialects/progen3d/grammar.h"
#include "dialects/progen3d/lexer.h"
#include "dialects/progen3d/lower.h"
#include "dialects/progen3d/web_lower.h"

namespace gable {

namespace {

lang::Tree parse(const DialectInput& input, Diagnostics& diagnostics) {
  const std::string_view text = input.sources.text(input.file);
  const std::string& from = input.sources.path(input.file);
  const progen3d::FileExists exists = [&](const std::string& path) {
    return input.loader && input.loader->exists(path, from);
  };
  std::vector<progen3d::Token> tokens = progen3d::tokenize(text, input.file, diagnostics);
  const auto tellOfNone = [&](bool none) {
    if (!none) return;
    diagnostics.error("no-rules", {input.file, 0, 0}, "this grammar has no rule",
                      "write 'X -> I ( Cube )'");
  };
  if (progen3d::web::isWebLanguage(text, tokens)) {
    const auto grammar =
        progen3d::web::parseGrammar(text, input.file, std::move(tokens), diagnostics);
    tellOfNone(grammar.rules.empty());
    return progen3d::web::lower(grammar, input.file, input.catalogue, exists, diagnostics);
  }
  const auto grammar = progen3d::parseGrammar(text, input.file, std::move(tokens), diagnostics);
  tellOfNone(grammar.rules.empty());
  return progen3d::lower(grammar, input.file, input.catalogue, exists, diagnostics);
}

std::string format(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  std::vector<progen3d::Token> tokens = progen3d::tokenize(text, file, diagnostics);
  if (progen3d::web::isWebLanguage(text, tokens)) {
    progen3d::web::parseGrammar(text, file, std::move(tokens), diagnostics);
  } else {
    progen3d::parseGrammar(text, file, std::move(tokens), diagnostics);
  }
  return diagnostics.hasErrors() ? std::string(text)
                                 : withLaidOutLines(text, SignSpacing::AsWritten);
}

constexpr const char* kEnd =
    "give the rule an end: 'X ; 0.8 -> A X ->' goes on four times of five, then stops";
constexpr Remedy kRemedies[] = {
    {"endless-rule", kEnd},
    {"recursion-too-deep", kEnd},
    {"too-many-turns", "write a smaller number of turns behind the name of the rule"},
    {"too-many-children", "write a smaller number of turns behind the name of the rule"},
    {"too-many-shapes", "take fewer turns, or raise --max-shapes"},
    {"too-many-steps", "take fewer turns, or raise --max-steps"},
};

constexpr const char* kExtensions[] = {".grammar", ".pg3d"};
// Names that are no rules.
constexpr const char* kDeclaring[] = {"R"};

}  // namespace

const Dialect kProgen3d{"progen3d",
                        "ProGen3d",
                        kExtensions,
                        parse,
                        format,
                        kRemedies,
                        false,
                        progen3d::words,
                        "is drawn anew by each rule that has it in its head, or counts turns",
                        "see the guide to ProGen3d, docs/guide/progen3d.md",
                        kDeclaring};

}  // namespace gable
