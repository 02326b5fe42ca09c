// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grammar of ProGen3d's web language as it is written: rules with parameters and variants, of
// sequences of statements. It shares the name, the signs and the bodies with the notation of the
// desktop program (grammar.h), and little else; the page of the notation has a table of what
// differs. Expressions lie in a vector and name each other by index (kNone for a missing one).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "dialects/progen3d/lexer.h"

namespace gable::progen3d::web {

inline constexpr uint32_t kNone = 0xffffffff;
/// How deep brackets, conditions and expressions may nest.
inline constexpr uint32_t kMaxNesting = 60;

struct Expression {
  enum class Kind : uint8_t {
    Number,
    Name,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    /// name(parts)
    Function,
  } kind = Kind::Number;
  double number = 0;
  std::string_view name;
  std::vector<uint32_t> parts;
  /// The longest way down; 1 for a number.
  uint32_t depth = 1;
  Span span;

  bool compares() const { return kind >= Kind::Less && kind <= Kind::NotEqual; }
};

struct Statement;
using Sequence = std::vector<Statement>;

struct Statement {
  enum class Kind : uint8_t {
    Scale,       // S
    Move,        // T
    Turn,        // A, R
    SideScale,   // DSX DSY DSZ
    SideMove,    // DTX DTY DTZ
    JointScale,  // GDSX GDSY GDSZ
    JointMove,   // GDTX GDTY GDTZ
    Insert,      // I
    Call,
    Group,      // [ ... ]
    Condition,  // ?( ... ) a : b
    Draw,       // R name ( min max ), R name
  } kind = Kind::Call;
  /// Of sides: 0 is x, 1 is y, 2 is z. Of bodies: the axis they grow along, 3 for none.
  uint32_t axis = 0;
  /// Of the rule, the variable or the texture.
  std::string_view name;
  Span nameSpan;
  bool whole = false;
  std::vector<uint32_t> arguments;
  /// Of a group, or of a condition that holds; and of one that does not.
  Sequence body, otherwise;
  Span span;
};

/// One of the variants of a name.
struct Variant {
  struct Parameter {
    std::string_view name;
    Span span;
  };
  std::vector<Parameter> parameters;
  /// kNone: once.
  uint32_t repeat = kNone;
  /// kNone: 1.
  uint32_t weight = kNone;
  /// The sections one after the other: all of them run in each turn.
  Sequence body;
  Span span;
};

struct Rule {
  std::string_view name;
  Span nameSpan;
  std::vector<Variant> variants;
};

struct Grammar {
  std::vector<Expression> expressions;
  /// The first is where it starts.
  std::vector<Rule> rules;

  /// Null when there is none.
  const Rule* rule(std::string_view name) const;
};

/// Whether the tokens hold something that only the web language has.
bool isWebLanguage(std::string_view text, const std::vector<Token>& tokens);

/// Views into `text`; it must outlive the grammar. What is wrong is reported and left out.
Grammar parseGrammar(std::string_view text, uint32_t file, std::vector<Token> tokens,
                     Diagnostics& diagnostics);

}  // namespace gable::progen3d::web
