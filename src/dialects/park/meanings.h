// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What names and arguments of a park grammar mean beyond themselves: a rule that stands for a set
// of points, a figure at the head of a part, the lines that a function gives, the colour of a leaf.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dialects/park/grammar.h"

namespace gable::park {

bool isFigure(std::string_view lowerCaseName);
bool isMaterialWord(std::string_view name);
/// What a name looks like; grey where it tells nothing.
const char* colourOf(std::string_view name);
/// The colour that a name tells; null for none.
const char* knownColourOf(std::string_view name);
/// Words for colours and materials, in lower case.
std::vector<std::string_view> colourWords();
/// The colour or material that was probably meant; empty where none is near.
std::string nearestColour(std::string_view name);

/// The only operation of a rule without cases; else null.
const Op* onlyOp(const Rule& r);
const Op* onlyOp(const Grammar& g, std::string_view rule);
/// Corners, Entrances, Directions and Points, which other operations take as arguments.
bool isPointSetName(std::string_view name);
/// Rules of one point set, which stand for it in arguments and make no shapes.
bool isPointSet(const Rule& r);

/// The figure that a sequence begins with, or that of the rule that it names alone.
struct FigureHead {
  /// Null for none.
  const Op* figure = nullptr;
  /// The sequence that it stands in, the first of it.
  const Sequence* body = nullptr;
  /// The rule of that sequence; null for the sequence itself.
  const Rule* rule = nullptr;
};
FigureHead figureHead(const Grammar& g, const Sequence& s);

/// What operations leave of the ground that they get: nothing, something that stands on it and
/// covers it, or flat ground. Of several ways the one that leaves most.
enum class Ending { Nothing, Raised, Flat };
Ending endingOf(const Grammar& g, const Sequence& s);

/// joined { Romb(3) ParkPath }: the figures in it and what is left to do, once they are one.
struct Joined {
  std::vector<Op> figures;
  Sequence rest;
};
/// Of a part that is one joined, or the name of a rule of one; null for others.
const Op* joinedOp(const Grammar& g, const Part* part);
Joined joinedParts(const Grammar& g, const Op& op);

/// A count with a radius: "5 {[5-10]}", of an argument or the rule that it names.
std::string discs(const Grammar& g, const std::string& argument);

/// Lines that an argument means: a function of the grammar, a Parametrise, or a selection.
struct Lines {
  std::string ranges;
  /// How far inside; empty for not at all.
  std::string inset;
  std::string figure;
  /// What is wrong with the call of a function on the way, as a sentence; empty for nothing.
  std::string mistake;
};
/// "the function 'F' takes 1 argument, not 2".
std::string countMistake(const Rule& function, size_t given);
Lines linesOf(const Grammar& g, const std::string& argument);
Lines linesOf(const Grammar& g, const Op& op);

/// What may stand at the crossings of a grid: figures with shares or conditions, and for each what
/// is done with it. Empty for a part that is no choice.
struct JunctionChoices {
  /// Shares in percent, or conditions (none: else); one of both.
  std::vector<double> shares;
  std::vector<std::string> conditions;
  std::vector<Part> parts;
  /// Where they stand, when that is a rule.
  const Rule* rule = nullptr;
};
JunctionChoices junctionChoices(const Grammar& g, const Part& part);

/// Shares in percent of the parts of a Choose: what is not given is shared by the rest.
std::vector<double> sharesOf(const Grammar& g, const std::vector<Part>& parts);
std::vector<Part> partsOf(const Op& op);

}  // namespace gable::park
