// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A GBBG grammar as it is written: shapes, rules, axiom, post-process table. Numbers and axes are
// those of the notation, whose frame is left-handed (x right, y up, z away); lower.h mirrors them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace gable::gbbg {

using Triple = std::array<double, 3>;

struct Symbol {
  std::string text;
  Span span;
};

/// One thing that may come of a piece. The chances of a slot count in proportion to each other.
struct Possibility {
  Symbol symbol;
  double chance = 1;
  bool chanceWritten = false;
};

/// Drawn anew for each piece that it stands for.
struct Slot {
  std::vector<Possibility> possibilities;
  Span span;
};

enum class Axis : uint8_t { X, Y, Z };
enum class Operator : uint8_t { Scope, Split, Repeat, Grid, Margin, Component };
enum class Orientation : uint8_t { Default, FacingOut, FacingIn };
enum class Faces : uint8_t {
  AllFaces,
  Sides,
  Top,
  Bottom,
  SidesPlusTop,
  SidesPlusBottom,
  TopPlusBottom
};

/// One of the three changes of a Scope rule. What is not written is off.
struct Change {
  bool written = false;
  bool on = true;
  Triple value{};
  bool set = false;
  bool world = false;
  bool relative = false;
};

struct Rule {
  /// The name that an author gave the rule; it says nothing to the derivation.
  std::string title;
  Symbol predecessor;
  Operator op = Operator::Scope;
  Span opSpan;
  Axis axis = Axis::Y;
  /// Scope.
  Change translate, rotate, scale;
  /// Split: the widths of all pieces but the last.
  std::vector<double> points;
  bool toRoot = false;
  /// Margin.
  double margin = 0;
  bool relativeMargin = false;
  Orientation orientation = Orientation::Default;
  bool center = true;
  /// Component.
  Faces faces = Faces::AllFaces;
  std::vector<Slot> slots;
  /// Counts where rules of one symbol are chosen by weight.
  double weight = 1;
};

enum class Dimensions : uint8_t { Three, Two, Empty };

struct ShapeLine {
  Symbol symbol;
  bool terminal = false;
  Dimensions dimensions = Dimensions::Three;
  /// 0 along an axis: any size.
  Triple preferred{};
};

/// A shape that the derivation begins with: a box of its own, or what stands on the footprint.
struct Start {
  Symbol symbol;
  bool onFootprint = false;
  double height = 0;
  bool heightWritten = false;
  Triple at{}, rotate{}, size{};
};

struct AssetLine {
  Symbol symbol;
  std::string path;
  /// Fit the asset's bounding box to the scope instead of its declared volume.
  bool fitBounds = false;
  /// Comments above the line, as written.
  std::vector<std::string> comments;
};

enum class Selection : uint8_t { First, Random, Weighted };

enum class StatementKind : uint8_t { Axiom, Shapes, Select, Use, Rule, PostProcess };

struct Statement {
  StatementKind kind = StatementKind::Rule;
  Span span;
  /// Comments before it, as written, and one behind it on its last line.
  std::vector<std::string> comments;
  std::string trailing;
  /// An empty line stood before it.
  bool apart = false;
  std::vector<Start> starts;
  std::vector<ShapeLine> shapes;
  Selection selection = Selection::First;
  std::string path;
  Rule rule;
  std::vector<AssetLine> assets;
  /// Comments before the closing brace of a table.
  std::vector<std::string> lastComments;
};

struct Grammar {
  uint32_t file = 0;
  std::vector<Statement> statements;
  /// Comments at the end of the file.
  std::vector<std::string> lastComments;
};

/// How many successors a rule has to have.
size_t slotCount(const Rule& rule);
/// What the slots stand for, in order: "sides", "top", ...
std::string slotNames(const Rule& rule);

bool hasSides(Faces f);
bool hasTop(Faces f);
bool hasBottom(Faces f);

const char* operatorName(Operator op);
const char* facesName(Faces f);

}  // namespace gable::gbbg
