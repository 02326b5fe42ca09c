// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How the program speaks: what goes to whom, in which colours, and how much of it.
//
// The standard output has what was asked for, the error output what is to be known besides. With
// --json the standard output is one object (answer.h) and nothing else.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "gable/diagnostic.h"

/// The options that every command has.
struct TerminalOptions {
  /// Errors alone: no warnings, no progress, no words about what went well.
  bool quiet = false;
  /// Each step with the time that it took.
  bool verbose = false;
  /// One object in place of text.
  bool json = false;
  /// "auto", "always" or "never".
  std::string color = "auto";
};

/// Those of this run; main sets them.
TerminalOptions& terminal();

/// Whether text to this stream has colours: --color; else NO_COLOR, CLICOLOR_FORCE, CLICOLOR and
/// TERM as is usual; else whether it is a terminal.
bool hasColors(std::FILE* stream);
/// Whether the stream is a terminal on which a line can be drawn anew.
bool isScreen(std::FILE* stream);

/// Columns of the terminal behind the error output; 80 where it does not tell.
int terminalColumns();

/// Rendered diagnostics with colours, where the stream has them.
std::string painted(const std::string& diagnostics, std::FILE* stream);

/// Prints diagnostics, or puts them into the answer.
void print(const gable::DiagnosticList& diagnostics, std::FILE* stream = stderr);

/// Whether print() got a warning since the last question, shown or not.
bool hasWarned();
/// kExitWrong in place of kExitDone where `strict` and there was a warning since.
int strictStatus(int status, bool strict);

/// Says what went well, to people: nothing with --quiet or --json.
void tell(const std::string& text);
/// Prints what was asked for, as text; nothing with --json, where the answer has it.
void put(const std::string& text);

/// Whether tell() or put() have said something since the last question.
bool hasTold();

/// A word beside the work, on the error output; nothing with --quiet or --json.
void note(const std::string& text);
/// What rules print, a line each.
void printLines(const std::vector<std::string>& lines, std::FILE* stream);

/// Says why a command cannot go on, with a remedy in the message or as a hint; gives `status`.
int fail(int status, const std::string& message, const std::string& hint = {});
