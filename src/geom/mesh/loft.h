// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A skin through closed lines, one after the other: bridges from each to the next, and caps on the
// first and the last.
//
//   1. All points of the lines are points of the skin, and it has no others.
//   2. With caps the skin is closed. Its faces look outward where the lines do not cross.
//   3. Which way a line runs, and where it begins, does not matter.
//
// O(n m) for lines of n and m points, in units of work().
#pragma once

#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

using ClosedLine = std::vector<Vec3>;

struct LoftOptions {
  bool capped = true;
  /// From the last line back to the first one: a ring.
  bool around = false;
};

/// Lines of three points at least. An empty mesh where fewer than two are given.
Mesh loft(const std::vector<ClosedLine>& lines, const LoftOptions& options);

}  // namespace gable
