// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words that the web language knows.
#pragma once

#include <string_view>

#include "dialects/progen3d/web_grammar.h"

namespace gable::progen3d::web {

struct Command {
  std::string_view word;
  Statement::Kind kind;
  /// Of sides: 0 is x, 1 is y, 2 is z.
  uint32_t axis;
  /// How many numbers it takes.
  size_t count;
  const char* form;
};

/// Null when there is none.
const Command* commandNamed(std::string_view word);
inline bool isCommand(std::string_view word) { return commandNamed(word) != nullptr; }

struct Function {
  std::string_view name;
  size_t least, most;
  const char* form;
};

/// Null when there is none.
const Function* functionNamed(std::string_view name);
inline bool isFunction(std::string_view name) { return functionNamed(name) != nullptr; }

}  // namespace gable::progen3d::web
