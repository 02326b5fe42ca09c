// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Holds what came of a derivation against the statements of a case's `expect` section.
#pragma once

#include <string>
#include <vector>

#include "case_file.h"
#include "gable/gable.h"
#include "scene/scene.h"

namespace gable::cases {

/// What came of a case.
struct Outcome {
  const Scene* scene = nullptr;
  /// Of all stages, in the order in which they came.
  DiagnosticList diagnostics;
  std::string dump;
};

/// A failure has the line of its statement and a sentence with both sides.
struct Failure {
  size_t line = 0;
  std::string message;
};

/// All failures of the statements, and an error message that none of them expects.
std::vector<Failure> failures(const std::vector<Statement>& expected, const Outcome& outcome);

/// Whether a number meets an expectation: `12.5`, `12.5 +- 0.1` (three words) or `10..14`. `used`
/// is the count of words that were read; 0 when they are no number.
bool meets(double found, const std::vector<std::string>& words, size_t at, size_t& used);

}  // namespace gable::cases
