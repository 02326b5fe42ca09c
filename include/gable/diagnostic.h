// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the library tells its caller: mistakes of rules, files and requests, each with a code, a
// place, a sentence and a remedy. Nothing is printed and nothing thrown; diagnostics stand beside
// the result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gable {

/// A piece of a text. Lines and columns count from 1, columns in bytes of UTF-8.
struct TextRange {
  std::string file;
  uint32_t line = 0, column = 0, endLine = 0, endColumn = 0;
};

/// A remedy that can be carried out: `text` in place of what stands in the range.
struct TextEdit {
  TextRange range;
  std::string text;
};

struct Diagnostic {
  enum class Severity : uint8_t { Note, Warning, Error };

  Severity severity = Severity::Error;
  /// Stable, kebab-case; listed in the reference.
  std::string code;
  /// Absent when no text is to blame.
  std::optional<TextRange> range;
  /// One sentence that names the thing.
  std::string message;
  /// The remedy; may be empty.
  std::string hint;
  /// The rules from the initial shape down to where it happened; empty before a derivation.
  std::string shapePath;
  /// What the hint says, as an edit, where it is one.
  std::optional<TextEdit> fix;
  /// The whole with its place, the line of text and a caret, as a terminal shows it.
  std::string rendered;

  bool isError() const { return severity == Severity::Error; }
};

using DiagnosticList = std::vector<Diagnostic>;

bool hasErrors(const DiagnosticList& diagnostics);
/// As a terminal shows them: first the errors, then the warnings and notes, each kind in the order
/// of the list. Of a file with more than three names that are no rules or operations these are one
/// line, at the end.
std::string render(const DiagnosticList& diagnostics);

}  // namespace gable
