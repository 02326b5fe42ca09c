// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What @Label and tags say of the leaves of a model, for city models and building models. A scene
// does not hold that: each initial shape whose rules say something is derived once more, with its
// derivation tree and without sharing. Memory is that of one such shape, or of all where rules ask
// about other shapes.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "io/exporters/write_model.h"

namespace gable {

class CityLabels {
 public:
  /// `model` must outlive it. The second derivations end where `cancel` says so; it may be null.
  CityLabels(const Model::Impl& model, const std::atomic<bool>* cancel);

  /// As WriteOptions::labelsOf. O(shapes made for the root).
  std::vector<LabelledLeaves> of(size_t root);
  /// Roots that have none because their second derivation came to another end.
  uint64_t unread() const { return unread_; }

 private:
  /// Whether shapes of the rule may get a label that says a part.
  std::vector<bool> rulesThatSay() const;
  /// The rule that a shape starts with; below 0 for none.
  int32_t ruleOf(const ShapeFootprint& shape) const;
  bool says(const ShapeFootprint& shape) const;
  std::shared_ptr<const Model::Impl> derivedAgain(std::optional<size_t> shape) const;
  std::vector<LabelledLeaves> labelsIn(const Model::Impl& again) const;

  const Model::Impl& model_;
  const std::atomic<bool>* const cancel_;
  /// By rule: its label, where that says a part.
  std::vector<std::string> labels_;
  std::vector<bool> rulesSay_;
  /// By prototype of the model.
  std::vector<uint64_t> leafCounts_;
  /// Rules ask about other shapes: all are derived at once, and the labels are of all leaves.
  bool together_ = false;
  std::optional<std::vector<LabelledLeaves>> all_;
  std::vector<uint64_t> firstOfRoots_;
  uint64_t unread_ = 0;
};

}  // namespace gable
