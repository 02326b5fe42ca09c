// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// `values` sections: expressions and what they give.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/case_file.h"

namespace gable::cases {

struct ValueLine {
  std::string expression;
  std::string wanted;
  size_t line = 0;
};

/// The lines of a `values` section; an empty expression where a line is not understood.
std::vector<ValueLine> valueLines(const Section& section);

/// Whether a value as `print` shows it is the one that a case wants: a number with the tolerance of
/// expectations, a truth value, a quoted text, or an array of these.
bool sameValue(std::string_view found, std::string_view wanted);

}  // namespace gable::cases
