// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a command answers with --json: one object, the same for all commands. Its form is a promise
// to scripts: docs/reference/command-line.md#answers.
//
//   {"command": "pack", "status": 0, "files": ["a.rpk"], "diagnostics": [], ...what the command
//   adds}
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gable/diagnostic.h"
#include "json/answers.h"

class Answer {
 public:
  /// "tiles plan".
  void begin(const std::string& command) { command_ = command; }
  void add(const gable::DiagnosticList& diagnostics);
  /// A file or folder that was written.
  void wrote(const std::string& path) { files_.push_back(path); }

  /// A member of the command's own, whose value is JSON already.
  void member(std::string_view name, std::string_view json);
  /// A text as a member.
  void text(std::string_view name, std::string_view value);
  /// All members of an object, given as its text.
  void members(std::string_view object);

  /// The files with their sizes, a line each.
  std::string filesText() const;
  /// The object, and makes ready for the next one (--watch).
  std::string take(int status);
  /// Whether one was taken.
  bool given() const { return given_; }

 private:
  std::string command_;
  gable::DiagnosticList diagnostics_;
  std::vector<std::string> files_;
  /// ",\n \"name\": value" for each.
  std::string own_;
  bool given_ = false;
};

/// That of this run; without --json nobody reads it.
Answer& answer();

/// Takes the answer, and prints it to the standard output with --json; else, on a terminal, what
/// was written by a command that has done its work and has said nothing.
void printAnswer(int status);
