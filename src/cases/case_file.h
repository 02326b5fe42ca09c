// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Reads .test files: cases with sections, as docs/guide/rule-tests.md describes them. What is wrong
// is told with its line: a case with an error fails, so that nothing passes by mistake, and the
// others run. A file that is none of cases has an error of its own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gable/cases.h"

namespace gable::cases {

struct Section {
  std::string name;
  /// The word behind the name in the head: `file walls.cga:` has "walls.cga".
  std::string argument;
  /// Without the common indentation; every line ends in a line feed.
  std::string text;
  /// 1-based line of the head, and of the first line of the text.
  size_t line = 0;
  size_t textLine = 0;
};

struct Case {
  std::string name;
  size_t line = 0;
  std::vector<Section> sections;
  /// What is wrong with its text.
  std::vector<CaseFailure> errors;

  /// Null where the case has no such section.
  const Section* find(std::string_view section) const;
  std::string_view textOf(std::string_view section) const;
};

struct CaseFile {
  std::vector<Case> cases;
  std::vector<CaseFailure> errors;
};

CaseFile parseCases(std::string_view text);

/// One line of a section that lists: its words, "quoted text" being one word without the quotes,
/// and for `dump` the lines below it.
struct Statement {
  std::vector<std::string> words;
  /// By word, whether it was written as quoted text.
  std::vector<bool> quoted;
  size_t line = 0;
  std::string block;
};

/// The statements of a section; blank lines and lines that start with # say nothing. Lines that are
/// indented further than the first belong to the block of the statement above.
std::vector<Statement> statements(const Section& section);
/// Of a statement that takes no block: what is wrong with its lines; empty where it has none.
std::string strayLines(const Statement& statement);

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view s);
/// The lines of a text, without their ends.
std::vector<std::string_view> linesOf(std::string_view text);

}  // namespace gable::cases
