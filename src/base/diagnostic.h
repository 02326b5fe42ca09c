// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What we tell the author of a rule file, a model or an attribute: a code, a place, a sentence and
// a remedy. Diagnostics are collected, never thrown, and all of one run are reported.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gable {

/// A range of bytes in a source file. An empty file id (kNoFile) means "no place in a text".
struct Span {
  static constexpr uint32_t kNoFile = 0xffffffff;
  uint32_t file = kNoFile;
  uint32_t begin = 0;
  uint32_t end = 0;

  bool valid() const { return file != kNoFile; }
  /// The smallest span that covers both; both must be of one file.
  static Span cover(Span a, Span b);
};

/// 1-based, columns counted in bytes of UTF-8.
struct LineColumn {
  uint32_t line = 0;
  uint32_t column = 0;
};

/// The texts that spans point into.
class Sources {
 public:
  uint32_t add(std::string path, std::string text);
  size_t size() const { return files_.size(); }
  const std::string& path(uint32_t file) const { return files_[file].path; }
  std::string_view text(uint32_t file) const { return files_[file].text; }
  /// O(log lines).
  LineColumn locate(uint32_t file, uint32_t offset) const;
  /// The text of a 1-based line, without its end.
  std::string_view line(uint32_t file, uint32_t line) const;

 private:
  struct File {
    std::string path;
    std::string text;
    std::vector<uint32_t> lineStarts;
  };
  std::vector<File> files_;
};

/// A remedy that can be carried out: `text` in place of the span.
struct Replacement {
  Span span;
  std::string text;
};

enum class Severity : uint8_t { Note, Warning, Error };

class Diagnostics {
 public:
  /// A diagnostic whose place is a span of sources at hand.
  struct Entry {
    Severity severity = Severity::Error;
    /// Stable, kebab-case; every code has a line in docs/reference/diagnostics.md.
    std::string code;
    Span span;
    /// One sentence that names the thing: "'extrud' is not an operation".
    std::string message;
    /// The remedy: "did you mean 'extrude'?"; may be empty.
    std::string hint;
    /// For what happened during a derivation: the rules from the initial shape down; may be empty.
    std::string shapePath;
    /// What the hint says, as an edit, where it is one.
    std::optional<Replacement> fix;
  };

  void add(Entry d);
  void error(std::string code, Span span, std::string message, std::string hint = {});
  void warning(std::string code, Span span, std::string message, std::string hint = {});
  /// The remedy of the message that was added last.
  void fixLast(Span span, std::string text);
  bool hasErrors() const { return errors_ > 0; }
  size_t errorCount() const { return errors_; }
  const std::vector<Entry>& all() const { return all_; }
  void append(const Diagnostics& other);
  /// Sorts by file and place, keeping the order of equals; drops exact repetitions.
  void sortByPlace();

 private:
  std::vector<Entry> all_;
  size_t errors_ = 0;
};

/// "file:line:column: error: message [code]", the source line, a caret line and the hint.
std::string format(const Diagnostics::Entry& d, const Sources& sources);

const char* severityName(Severity s);

}  // namespace gable
