// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a grammar means as a whole: which symbols there are, which rules count, and what its author
// should know: rules that never apply, symbols without rules, assets of shapes that are no
// terminals.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/gbbg/grammar.h"

namespace gable::gbbg {

struct SymbolInfo {
  std::string name;
  Span span;
  bool terminal = false;
  bool declared = false;
  Dimensions dimensions = Dimensions::Three;
  Triple preferred{};
  /// In the order of the grammar; of a terminal none.
  std::vector<const Rule*> rules;
  const AssetLine* asset = nullptr;
};

/// Points into the grammar it was made of.
struct Vocabulary {
  /// In the order in which they first occur as predecessors, then as declared, then as successors.
  std::vector<SymbolInfo> symbols;
  std::map<std::string, size_t, std::less<>> index;
  std::vector<const Start*> starts;
  Selection selection = Selection::First;

  SymbolInfo* find(std::string_view name) {
    const auto it = index.find(name);
    return it == index.end() ? nullptr : &symbols[it->second];
  }
};

Vocabulary checked(const Grammar& grammar, Diagnostics& diagnostics);

}  // namespace gable::gbbg
