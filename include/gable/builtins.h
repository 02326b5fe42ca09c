// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is built into the language: operations, functions, shape attributes and selectors with their
// documentation.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gable {

struct BuiltinTerm;

struct BuiltinParameter {
  std::string name, type, doc;
  /// Absent: the argument has to be given.
  std::optional<std::string> defaultText;
  /// The words that it takes, "a|b|c"; absent: any value of the type.
  std::optional<std::string> words;
  /// The numbers that it takes, "0 or more"; empty for all. `least` and `most` are bounds of it.
  std::string range;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// What a selection is made of; empty for other types. The terms of a term's own parameter are
  /// left out where they are the same again.
  std::vector<BuiltinTerm> terms;
  /// One term alone, without && and ||.
  bool single = false;
};

/// A term of a selection: outer, range(from, to).
struct BuiltinTerm {
  std::string name, doc;
  std::vector<BuiltinParameter> parameters;
};

/// A named part of a block: { strip : .. | rest : .. }.
struct BuiltinPart {
  std::string name, doc;
};

struct BuiltinSignature {
  std::vector<BuiltinParameter> parameters;
  /// The last parameter may be given any number of times.
  bool variadic = false;
  /// The type of a function's value; empty for operations.
  std::string result;
};

struct BuiltinCall {
  std::string name, family, summary;
  /// How an operation's block is written; empty when it has none.
  std::string block;
  /// The parts that its block may name.
  std::vector<BuiltinPart> parts;
  /// Beside or without such parts the block takes the general selectors: front, world.up.
  bool selectors = false;
  /// A function that is written without brackets.
  bool bare = false;
  std::vector<BuiltinSignature> signatures;
};

struct BuiltinAttribute {
  std::string name, type, doc;
  bool writable = false;
};

struct BuiltinSelector {
  std::string name, doc;
};

struct Builtins {
  std::vector<BuiltinCall> operations, functions;
  std::vector<BuiltinAttribute> attributes;
  std::vector<BuiltinSelector> selectors;
};

Builtins builtins();

/// A word of another notation than Gable's own.
struct NotationWord {
  std::string word;
  /// As its users call the notation, the extension of its files, and the page that explains it.
  std::string notation, extension, guide;
  /// How the word is written, and one sentence; the sentence may be empty.
  std::string call, text;
};

std::vector<NotationWord> notationWords();

/// What to say of a name that is none of those known: "did you mean 'grid'?", or nothing.
std::string suggestion(const std::string& name, const std::vector<std::string>& known);

}  // namespace gable
