// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Holds what came of a derivation against the statements of a case's `expect` section.
#pragma once

#include <string>
#include <vector>

#include "cases/case_file.h"
#include "cases/golden.h"
#include "gable/gable.h"
#include "geom/region/region.h"
#include "scene/scene.h"

namespace gable::cases {

/// What came of a case.
struct Outcome {
  const Scene* scene = nullptr;
  /// Of all stages, in the order in which they came.
  DiagnosticList diagnostics;
  std::string dump;
  /// The initial shapes seen from above.
  Region lot;
  /// The height of the lowest corner of the initial shapes.
  double ground = 0;
  /// Null where nothing was derived.
  const Model* model = nullptr;
  /// Null: there are no expected files.
  GoldenFiles* golden = nullptr;
};

/// All failures of the statements, and an error message that none of them expects.
std::vector<CaseFailure> failures(const std::vector<Statement>& expected, const Outcome& outcome);

/// Whether a number meets an expectation: `12.5`, `12.5 +- 0.1` (three words) or `10..14`. `used`
/// is the count of words that were read; 0 when they are no number.
bool meets(double found, const std::vector<std::string>& words, size_t at, size_t& used);

}  // namespace gable::cases
