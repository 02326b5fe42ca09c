// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where names stand in a text, and what each of them means. A name is known by the file that it
// belongs to, the kind of things it is among, and how it is written there; so all overloads of a
// rule, and its forms in all styles, are one name.
//
// In Gable's own language the analysis says what a word is; what it says nothing of (rules of a
// style that is not derived) is found by name. Texts of other notations have one kind of names, and
// a word means what is declared by that word.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "language/library.h"

namespace gable::language {

enum class Space : uint8_t {
  Rule,
  /// Attributes, constants, functions.
  Value,
  /// A parameter or local variable, known by its declaration.
  Slot,
  Import,
  Style,
  /// The path of an import.
  Path,
  Operation,
  Function,
  ShapeAttribute,
  Selector,
  Annotation,
};

struct Name {
  /// In the text: the word alone, without the imports before it.
  uint32_t begin = 0, end = 0;
  Space space = Space::Rule;
  bool declaration = false;
  /// The unit that it belongs to; of an Import name the unit that writes it.
  uint32_t unit = 0;
  /// Of a slot: the node that declares it.
  lang::NodeId slot = lang::kNoNode;
  lang::NodeId node = lang::kNoNode;
  std::string_view word;
};

/// All names of a unit in the order of its text.
std::vector<Name> namesOf(const Snapshot& snapshot, uint32_t unit, const Catalogue& catalogue);

/// The name at an offset, its end included; null when there is none.
const Name* nameAt(const std::vector<Name>& names, uint32_t offset);

bool sameName(const Name& a, const Name& b);

/// The declaration at the top of a unit's tree that a node stands in; kNoNode for none.
lang::NodeId declarationOf(const lang::Tree& tree, lang::NodeId node);

/// The unit that an import of `unit` means; lang::kNone when it could not be read.
uint32_t importedUnit(const Snapshot& snapshot, uint32_t unit, std::string_view import);

/// Units whose attribute `word` takes its value from that of `unit` or gives it to it, `unit`
/// included: these have one name for one thing.
std::vector<uint32_t> linkedUnits(const Snapshot& snapshot, uint32_t unit, std::string_view word);

}  // namespace gable::language
