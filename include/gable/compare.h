// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What differs between two models: face by face, in numbers and as a model to look at.
//
// A face is the same when its corners lie at the same places (to a millimetre), run the same way
// round, and its material has the same name, colour and opacity. Which leaf or node it belongs to
// does not count, so two files whose parts are grouped in another way compare equal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/model.h"

namespace gable {

/// Before and after.
template <class T>
using Change = std::pair<T, T>;

struct MaterialChange {
  /// The name, or the colour of a material that has none.
  std::string name;
  std::string color;
  /// Square metres.
  Change<double> area{};
};

struct FaceSum {
  uint64_t faces = 0;
  /// Square metres.
  double area = 0;
  /// Absent when there is none.
  std::optional<BoundingBox> bounds;
};

struct Comparison {
  Change<Statistics> statistics;
  /// Square metres of all faces.
  Change<double> area{};
  /// Faces that are in the second model alone, in the first alone, and in both.
  FaceSum added, removed, kept;
  /// Materials whose area differs, by name and colour.
  std::vector<MaterialChange> materials;
  /// What is kept in grey, added in green, removed in red.
  Model picture{nullptr};
  DiagnosticList diagnostics;

  bool same() const { return added.faces == 0 && removed.faces == 0; }
};

/// O(n log n) for the faces of both, instances expanded.
Comparison compare(const Model& before, const Model& after, const FileLimits& limits = {});

}  // namespace gable
