// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The command line as data, read from its own declaration: what completion and man pages are made
// of.
#pragma once

#include <string>
#include <vector>

/// What stands behind an option, or for a positional.
enum class ValueKind { None, Text, Number, Word, File, Folder };

struct OptionDescription {
  /// "-o", "--output"; of a positional its name alone.
  std::vector<std::string> names;
  ValueKind kind = ValueKind::None;
  /// What help writes for the value: FILE, FOLDER, NUMBER, TEXT or {a,b}.
  std::string value;
  /// Of a Word.
  std::vector<std::string> words;
  /// Of a File: "glb", "obj"; empty where any will do.
  std::vector<std::string> endings;
  bool required = false, repeated = false;
  /// Sentences, without a line break.
  std::string text;
};

struct CommandDescription {
  /// "gable tiles plan".
  std::string name;
  std::string text;
  std::vector<OptionDescription> options, positionals;
  std::vector<std::string> examples;
  std::vector<CommandDescription> commands;
};

/// Lines that a user may type, of "tiles plan"; empty for a command that has none.
std::vector<std::string> examplesOf(const std::string& command);

/// A file of bash, zsh or fish that completes the commands; empty for any other shell.
std::string completionText(const CommandDescription& program, const std::string& shell);
std::vector<std::string> completionShells();

/// The page of a command for man(1).
std::string manPage(const CommandDescription& command);
/// "gable-tiles-plan.1".
std::string manFileName(const CommandDescription& command);

struct CompletionArguments {
  std::string shell;
};
struct ManArguments {
  /// "tiles plan"; empty: the program's own page.
  std::vector<std::string> command;
  /// A folder that gets all pages; empty: one page to the standard output.
  std::string output;
};
int runCompletion(const CommandDescription& program, const CompletionArguments& arguments);
int runMan(const CommandDescription& program, const ManArguments& arguments);
