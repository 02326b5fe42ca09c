// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A rule as a form shows it: its parts with their places, and for each what takes it away and where
// a further one goes. So a form edits the text where it changes something, and nowhere else;
// comments stay.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gable/language_places.h"

namespace gable::language {

/// Something further is written at a place, between two texts.
struct Insertion {
  Position at;
  std::string before, after;
};

/// A part of the body of a rule.
struct Piece {
  enum class Kind : uint8_t {
    /// Its parts are branches. `insertion`: a further possibility, where they are drawn by chance.
    Body,
    /// Branches. The head, where there is one, is the first part: a condition or a chance in
    /// percent; then come calls, bodies in brackets and bodies. `insertion`: a further call.
    Plain,
    Case,
    Chance,
    Else,
    /// `text` is its name; its parts are arguments and blocks.
    Call,
    Argument,
    /// Its parts are pieces of the shape and blocks within. `insertion`: a further piece.
    Block,
    /// The head (a size, a selector) where there is one, and a body.
    Part,
    Head,
    /// [ body ]
    Scoped,
  };
  Kind kind = Kind::Body;
  Range range;
  std::string text;
  /// Of a block: { }*.
  bool repeated = false;
  /// What is to be deleted to take the part away; nothing where it cannot be.
  std::vector<Range> removal;
  std::optional<Insertion> insertion;
  std::vector<Piece> parts;
};

/// A rule of a notation whose rules are one operation each, with values to set (GBBG).
struct BoxRule {
  struct Change {
    std::array<double, 3> value{};
    bool set = false;
    /// World for moves and turns, relative for sizes.
    bool other = false;
    bool on = true;
  };
  struct Possibility {
    std::string symbol;
    /// None where it is not written, which counts as 1.
    std::optional<double> chance;
  };
  std::string title, predecessor;
  std::string op = "Split", axis = "Y";
  std::optional<Change> translate, rotate, scale;
  std::vector<double> points{1};
  bool toRoot = false;
  double margin = 1;
  bool relative = false;
  std::string orientation = "Default";
  bool center = true;
  std::string faces = "Sides";
  std::vector<std::vector<Possibility>> slots;
  /// What the slots stand for.
  std::vector<std::string> slotNames;
  double weight = 1;
};

struct RuleForm {
  std::string name;
  /// From its first word to its last.
  Range range;
  Range nameRange;
  /// What stands in the brackets behind the name, brackets included; empty behind the name where
  /// there are none.
  Range parametersRange;
  /// The rule with the comments and annotations above it, and the lines that it leaves empty.
  Range removal;
  /// Gable's own language.
  std::optional<Piece> body;
  std::optional<BoxRule> box;
  /// Why there is neither.
  std::string trouble;
};

/// A rule in the list of all.
struct FormRow {
  std::string name;
  std::vector<std::string> parameters;
  /// What it begins with: an operation, "chance", "case"; empty for nothing.
  std::string type;
  Range range;
};

/// Which model takes the place of which symbol.
struct AssetRow {
  std::string symbol, path;
  /// Of the path, quotes left out.
  Range pathRange;
  Range removal;
};

struct TextForm {
  std::vector<FormRow> rules;
  /// What a rule may lead to, and what is taken by a name.
  std::vector<std::string> symbols, taken;
  /// The one that was asked for, else the first.
  std::optional<RuleForm> rule;
  /// Behind the rule that is shown, else at the end.
  Insertion newRule;
  /// GBBG: where a symbol is declared, and models take the place of symbols.
  std::optional<Insertion> newSymbol, newAsset;
  std::vector<AssetRow> assets;
};

}  // namespace gable::language
