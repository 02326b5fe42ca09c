// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// "Did you mean" as an edit, for the notations.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostic.h"

namespace gable {

/// The hint that proposes a name; empty where none is near.
inline std::string meaning(const std::string& nearest) {
  return nearest.empty() ? nearest : "did you mean '" + nearest + "'?";
}

/// The message that was added last offers to write `nearest` over the word `name`, where that word
/// and nothing else stands at `at`: a symbol in quotes stays as it is.
inline void propose(Diagnostics& diagnostics, Span at, std::string_view name,
                    const std::string& nearest) {
  if (nearest.empty() || !at.valid() || at.end - at.begin != name.size()) return;
  diagnostics.fixLast(at, nearest);
}

}  // namespace gable
