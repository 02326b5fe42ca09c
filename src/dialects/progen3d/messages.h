// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What both forms of the notation tell in the same words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/text.h"
#include "dialects/proposal.h"

namespace gable::progen3d {

/// `Grammar` has `rules` with names.
template <class Grammar>
void warnUnknownRule(const Grammar& grammar, std::string_view name, Span at, Diagnostics& out) {
  std::vector<std::string_view> known;
  for (const auto& rule : grammar.rules) known.push_back(rule.name);
  const std::string nearest = nearestName(name, known);
  out.warning("unknown-rule", at,
              "there is no rule '" + std::string(name) + "'; nothing is drawn for it",
              meaning(nearest));
  propose(out, at, name, nearest);
}

}  // namespace gable::progen3d
