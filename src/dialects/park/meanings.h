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
/// What a name looks like.
const char* colourOf(std::string_view name);

/// The only operation of a rule without cases; else null.
const Op* onlyOp(const Rule& r);
const Op* onlyOp(const Grammar& g, std::string_view rule);
/// Rules of one point set, which stand for it in arguments and make no shapes.
bool isPointSet(const Rule& r);

/// "romb(3)"
std::string figureText(const Grammar& g, const Op& op);
/// A figure at the head of a sequence, or of the rule that it names alone; empty when there is
/// none. `own` says whether it stands in the sequence itself.
std::string figureAtHead(const Grammar& g, const Sequence& s, bool* own = nullptr);
/// The figure at the head of an operation's parts; "none" when there is none.
std::string figureOfBlock(const Grammar& g, const Op& op);

/// joined { Romb(3) ParkPath }: the figures in it and what is left to do, once they are one.
struct Joined {
  std::string figures;
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
};
Lines linesOf(const Grammar& g, const std::string& argument);
Lines linesOf(const Grammar& g, const Op& op);

/// What may stand at the crossings of a grid: figures with shares or conditions, and for each what
/// is done with it. Empty for a part that is no choice.
struct JunctionChoices {
  /// "30%: romb(3) | circle(2)"
  std::string figures;
  std::vector<Part> parts;
};
JunctionChoices junctionChoices(const Grammar& g, const Part& part);

/// Shares in percent of the parts of a Choose: what is not given is shared by the rest.
std::vector<double> sharesOf(const Grammar& g, const std::vector<Part>& parts);
std::vector<Part> partsOf(const Op& op);

}  // namespace gable::park
