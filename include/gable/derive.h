// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Derivation: rules on initial shapes, to a model.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/limits.h"
#include "gable/model.h"
#include "gable/rules.h"
#include "gable/shapes.h"
#include "gable/trace.h"

namespace gable {

struct DeriveSettings {
  /// Absent: the rules' own start rule.
  std::optional<std::string> startRule;
  double seed = 0;
  /// Seeds of single initial shapes, by index, in place of `seed`.
  std::vector<std::pair<size_t, double>> shapeSeeds;
  /// Names and values as text; arrays as [1,2;3,4]. Over the shapes' own attributes.
  std::vector<std::pair<std::string, std::string>> attributes;
  /// Derive equal parts once. Off gives the same model, flattened.
  bool sharing = true;
  /// Keep the derivation tree for Model::trace. Turns sharing off.
  bool trace = false;
  /// With `trace`: what of it is kept.
  TraceFilter traceFilter;
  /// With `trace`: the model also has the shapes that rules replace, each as they got it, so that a
  /// derivation can be shown step by step.
  bool traceShapes = false;
  /// Model::attributes gives hidden ones and those of imports as well; leaves and files do not.
  bool importedAttributes = false;
  /// Threads; absent: one a processor.
  std::optional<int> jobs;
  /// Keep in the model what a later derivation needs to take parts of it over.
  bool remember = false;
  /// A model that was made with `remember`, by rules that these came after (LoadSettings::before).
  /// Parts whose rules, attributes, seed and footprints are as they were are taken over from it;
  /// the result is the same as without. Implies `remember`. May be null.
  const Model* before = nullptr;
  Limits limits;
  /// Called from any thread with the number of initial shapes that are done, and of all.
  std::function<void(size_t done, size_t total)> progress;
  /// Ends the derivation soon after it becomes true. May be null.
  const std::atomic<bool>* cancel = nullptr;
};

/// With mistakes in the settings the model is empty and has their diagnostics. It is empty where
/// `rules` are not ok(), too; what rules and shapes tell is not repeated.
Model derive(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings = {});

}  // namespace gable
