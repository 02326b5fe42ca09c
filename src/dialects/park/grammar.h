// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a park grammar says: rules of operations with braces. Arguments stay text here; the lowering
// makes expressions of them (lang/region_texts.h).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace gable::park {

struct Op;
using Sequence = std::vector<Op>;

/// One alternative of a block: `0.75 : TreeStrip`, `region : Lawn`, `30% : A`.
struct Part {
  std::string label;
  Sequence body;
  Span span;
};

/// `{ ... }`, its parts divided by | or, in Choose, by commas.
struct Block {
  std::vector<Part> parts;
  Span span;
};

struct Argument {
  std::string text;
  Span span;
};

struct Op {
  std::string name;
  std::vector<Argument> arguments;
  /// Brackets behind a name: CentrePoint [CentreRegionSize].
  std::string size;
  bool called = false;
  std::vector<Block> blocks;
  bool hasElse = false;
  Sequence otherwise;
  Span span;
};

/// `case (w == 15) : ...`; no condition for the body of a plain rule and for else.
struct Branch {
  std::string condition;
  Sequence body;
  Span span;
};

struct Rule {
  std::string name;
  std::vector<std::string> parameters;
  bool function = false;
  std::vector<Branch> branches;
  Span span, nameSpan;
};

struct Grammar {
  /// Values of constants, by name.
  std::map<std::string, double> constants;
  /// The same in the order of the text, as they are written.
  struct Constant {
    std::string name, text;
    Span span;
  };
  std::vector<Constant> written;
  std::vector<Rule> rules;

  const Rule* rule(std::string_view name) const;
};

/// Reads any text; mistakes are reported and what is right beside them is kept.
Grammar parseGrammar(std::string_view text, uint32_t file, Diagnostics& diagnostics);

/// A number, a constant, or what + - * / and brackets make of them; false for other texts.
bool constantValue(const Grammar& g, std::string_view text, double& value);

/// The text with other texts in the place of some of its names.
std::string withWords(std::string_view text, const std::map<std::string, std::string>& words);

/// The operations with arguments in the place of the names of parameters.
Sequence withArguments(const Sequence& body, const std::map<std::string, std::string>& words);

/// What stands between the brackets of `Name(a, b)`.
std::vector<std::string> argumentTexts(std::string_view call);

}  // namespace gable::park
