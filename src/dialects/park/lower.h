// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From a park grammar to the neutral tree: every operation becomes one of Gable's own on regions.
#pragma once

#include <string>

#include "dialects/park/grammar.h"
#include "lang/sema/analyse.h"
#include "lang/tree.h"

namespace gable::park {

/// The text of a grammar, for the places of what is wrong, and where models are looked for.
struct LowerInput {
  uint32_t file = 0;
  std::string_view source;
  std::string path;
  /// Null: nothing is said of models.
  lang::FileLoader* loader = nullptr;
};

lang::Tree lower(const Grammar& grammar, const LowerInput& input, Diagnostics& diagnostics);

}  // namespace gable::park
