// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The derivation tree as data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gable/value.h"

namespace gable {

/// Which shapes a trace shows. What is left out takes no memory.
struct TraceFilter {
  /// The shapes of this rule, with what comes of them; absent: all shapes.
  std::optional<std::string> rule;
  /// The shapes that these rules made one out of the other, from the start rule down, with what
  /// comes of them; empty: all shapes.
  std::vector<std::string> path;
  /// So many levels below the topmost shapes that are shown; absent: all.
  std::optional<uint32_t> depth;
};

/// Nodes are in the order of the derivation, a parent before its children, so the index of a node
/// is its step.
struct DerivationTrace {
  /// Where a node, a draw or a choice stands in a text; `file` is an index into files.
  struct Place {
    uint32_t file = 0, line = 0, column = 0, endLine = 0, endColumn = 0;
  };
  /// Numbers of leaves in path order, as draw lists count them: first up to end.
  struct Leaves {
    uint32_t first = 0, end = 0;
  };

  /// A shape of the derivation tree.
  struct Node {
    /// Absent: an initial shape, or the topmost one that a filter shows.
    std::optional<uint32_t> parent;
    /// The initial shape that it belongs to.
    uint32_t shape = 0;
    /// Index into names.
    uint32_t name = 0;
    /// The operation that made the shape.
    std::optional<Place> place;
    /// The scope in the world: an origin, three unit axes, a size.
    std::array<double, 12> frame{};
    std::array<double, 3> size{};
    bool leaf = false, dropped = false;
    /// Made by a rule call, so that a step of the derivation replaces it.
    bool ruleCall = false;
    /// Of those: the rule, an index into Rules::rules(). Rules of two files may have one name.
    std::optional<uint32_t> rule;
    /// Index into tagSets: what all faces of the shape were tagged with, as it was made and while
    /// its rule worked on it outside of blocks.
    uint32_t tags = 0;
    /// The leaves that came of it, itself included.
    std::optional<Leaves> leaves;
    /// Its own places among the leaves: as its rule got it (with DeriveSettings::traceShapes), and
    /// as it stays where it is a leaf.
    std::optional<uint32_t> before, after;
  };

  /// What a step drew or saw, in that order.
  struct Note {
    enum class Kind : uint8_t { Choice, Draw, Attribute, Parameter } kind = Kind::Draw;
    uint32_t node = 0;
    /// The name of an attribute or a parameter; the text of a draw.
    std::string name;
    /// Without items for a choice.
    RuleValue value;
    /// Where a draw or the alternatives of a choice stand.
    std::optional<Place> place;
    /// What was drawn from 0 to 1, which alternative that is, from 0, among how many, and how
    /// likely it was. The alternative behind the last is `else`.
    struct Choice {
      double draw = 0, chance = 0;
      uint32_t chosen = 0, choices = 0;
    };
    /// Present for a choice.
    std::optional<Choice> choice;
  };

  std::vector<Node> nodes;
  std::vector<std::string> names, files;
  /// Each in the order of the alphabet; the first is empty.
  std::vector<std::vector<std::string>> tagSets;
  /// With DeriveSettings::traceShapes.
  std::vector<Note> notes;
};

}  // namespace gable
