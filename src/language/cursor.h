// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where in a text of Gable's own language a caret stands: in the body of a rule, in an argument,
// before the colon of a part, ... It is found from the tokens alone, from the beginning of the
// declaration on, so that it holds for a text that does not parse yet. Linear in the declaration.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "language/library.h"

namespace gable::language {

enum class Spot : uint8_t {
  /// In a comment, or where only a new name can stand: nothing can be proposed.
  Nothing,
  /// At the beginning of a line outside of all brackets: a declaration, or a body that goes on.
  Declaration,
  /// Operations, rules, leaves.
  Successor,
  /// An expression.
  Value,
  /// The word before the colon of a part of comp, setback, ...
  Selector,
  /// The size before the colon of a part of a split.
  Size,
  Annotation,
  /// In the brackets of an annotation.
  AnnotationArgument,
  /// In a string.
  String,
};

/// A pair of brackets that the caret is in, behind the word that they belong to.
struct Call {
  std::string_view callee;
  /// As a successor: an operation or a rule; else a function.
  bool successor = false;
  uint32_t argument = 0;
  /// The word that ends the first argument, where the caret is behind it: the attribute of set().
  std::string_view first;
  /// The word before '=' where the argument is named.
  std::string_view named;
};

struct Cursor {
  Spot spot = Spot::Nothing;
  /// The word before the caret, with the imports before it, and the rest of it behind the caret.
  uint32_t wordBegin = 0, wordEnd = 0;
  std::string_view typed;
  /// The innermost call with its brackets open, whatever else is open in them.
  bool inCall = false;
  Call call;
  /// The caret is at an argument of `call` itself.
  bool atArgument = false;
  /// The operation whose block the caret is in.
  std::string_view blockOf;
  /// The annotation of AnnotationArgument; "import" for the path of an import.
  std::string_view owner;
  /// Parameters and local variables of the declaration.
  std::vector<std::string_view> slots;
  /// The name of the declaration.
  std::string_view declaration;
};

Cursor cursorAt(const Lexed& lexed, uint32_t offset, const Catalogue& catalogue);

}  // namespace gable::language
