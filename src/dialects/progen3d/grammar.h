// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A ProGen3d grammar as it is written: rules of sections of steps. Expressions and steps lie in
// vectors and name each other by index (kNone for a missing one).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "dialects/progen3d/lexer.h"

namespace gable::progen3d {

inline constexpr uint32_t kNone = 0xffffffff;
/// How deep brackets and expressions may nest.
inline constexpr uint32_t kMaxNesting = 100;

struct Expression {
  enum class Kind : uint8_t {
    Number,
    /// A variable, or the count of a rule's turns.
    Name,
    /// A fresh draw of a variable: &name.
    Draw,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Sin,
    Cos,
  } kind = Kind::Number;
  double number = 0;
  std::string_view name;
  uint32_t left = kNone, right = kNone;
  /// The longest way down; 1 for a number.
  uint32_t depth = 1;
  Span span;
};

enum class Body : uint8_t { Cube, CubeX, CubeY, Sphere, Cylinder };

struct Step {
  enum class Kind : uint8_t {
    Scale,   // S
    Move,    // T
    Turn,    // A
    Taper,   // D
    Front,   // DS
    Top,     // DT
    Insert,  // I
    Call,
    Push,
    Pop,
  } kind = Kind::Call;
  Body body = Body::Cube;
  /// Of the rule called.
  std::string_view name;
  std::vector<uint32_t> arguments;
  Span span;
};

using Section = std::vector<Step>;

struct Variable {
  std::string_view name;
  double min = 0, max = 0;
  bool whole = false;
  Span span;
};

struct Rule {
  std::string_view name;
  Span nameSpan, span;
  /// kNone: once.
  uint32_t repeat = kNone;
  /// Variables drawn anew at each call.
  struct Draw {
    std::string_view name;
    Span span;
  };
  std::vector<Draw> draws;
  /// kNone: not written.
  uint32_t probability = kNone;
  Section start, body, end;
  bool hasAlternate = false;
  Section alternate;
};

struct Grammar {
  std::vector<Expression> expressions;
  std::vector<Variable> variables;
  /// The first is where it starts; later rules of a name are left out.
  std::vector<Rule> rules;
  /// It uses DS or DT, and with them the pivots of that version.
  bool centred = false;

  /// Null when there is none.
  const Variable* variable(std::string_view name) const;
  const Rule* rule(std::string_view name) const;

  /// Places in the lists, by name.
  std::unordered_map<std::string_view, size_t> variableIndex, ruleIndex;
};

/// The value of an expression without variables and draws; `known` becomes false for others.
double evaluate(const Grammar& grammar, uint32_t expression, bool& known);

/// Views into `text`; it must outlive the grammar. What is wrong is reported and left out.
Grammar parseGrammar(std::string_view text, uint32_t file, std::vector<Token> tokens,
                     Diagnostics& diagnostics);

}  // namespace gable::progen3d
