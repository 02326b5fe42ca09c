// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Words and signs that people bring along from Python, JavaScript, C and earlier shape grammars,
// and what rules have in their place. Lexer, parser and analysis ask this table, and tell what it
// says. A word in it is an ordinary name where the file gives it a meaning.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lang/token.h"

namespace gable::lang {

/// Where a word or a sign stands.
enum class ForeignUse : uint8_t {
  /// Between two values.
  Operator,
  /// Behind the head of a rule, or behind a size or a selector.
  Arrow,
  /// Begins a further branch of a choice, or its last.
  Branch,
  /// Begins a declaration: a word, a name, then its value or its parameters.
  Declaration,
  /// Begins a loop, a result or the like.
  Statement,
  /// A name in the place of a value.
  Value,
  /// A name with arguments in the place of a value.
  Function,
  /// A name in the place of an operation.
  Operation,
  /// A name in the place of a selector.
  Selector,
};

struct ForeignWord {
  std::string_view word;
  ForeignUse use;
  /// What stands in its place, when nothing else has to change; else empty.
  std::string_view instead;
  /// The remedy as a sentence; empty where it is to write what stands in its place.
  std::string_view remedy = {};
  /// What an operator is read as.
  TokenKind meant = TokenKind::End;
};

/// All of them, those of one use together.
std::span<const ForeignWord> foreignWords();

/// The entry of a word; capitals do not matter. Null where there is none.
const ForeignWord* foreignWord(ForeignUse use, std::string_view word);

/// The remedy as a sentence.
std::string remedyOf(const ForeignWord& word);

/// What to write for the name of a module with a member of another language: "Math.sqrt" is "sqrt".
/// Empty where it is no such name.
std::string_view withoutForeignModule(std::string_view name);

}  // namespace gable::lang
