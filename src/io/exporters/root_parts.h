// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the leaves of one initial shape are, in path order: by their attributes, by the labels and
// tags of the shapes above them, by their names (city_kinds.h). A reader goes along as walk() does:
// it takes each leaf by next() or an instance as a whole by skip().
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"
#include "io/exporters/city_runs.h"
#include "io/exporters/write_model.h"

namespace gable {

class RootParts {
 public:
  /// `kinds` must outlive it.
  explicit RootParts(const CityParts& kinds) : kinds_(kinds) {}

  /// Another root; labels that say no part are left out.
  void open(const std::vector<LabelledLeaves>& labels);
  /// Divides a root of that kind into elements (city_runs.h) and goes back to its first leaf: from
  /// now on next() knows what trim is of, and what lies around a building. O(n) in the leaves.
  void settle(const Scene& scene, const Root& root, CityFaces& faces, CityKind kindOfShape);
  /// Back to the first leaf.
  void begin();
  /// The part of the leaf that comes next.
  CityPart next(const Leaf& leaf);
  /// After settle(): the leaf that next() gave last is the first of an element.
  bool begins() const { return runs_->begins(at_ - 1); }
  /// The part of an instance that comes next and stands for itself, such as a tree.
  std::optional<CityPart> solitary(uint32_t prototype);
  /// After settle(): that of one whose leaves are an element, if it is known. What is unknown is
  /// told by where its leaves look.
  std::optional<CityPart> element(uint32_t prototype);
  /// The instance that comes next was taken as a whole.
  void skip(uint32_t prototype) { at_ += kinds_.leafCount(prototype); }

 private:
  struct Label {
    uint64_t first = 0, end = 0;
    CityKind kind = CityKind::Unknown;
    uint32_t shape = 0;
  };
  double footOf(const Scene& scene, const Root& root, CityFaces& faces);
  /// The part that an instance which comes next is of with all its leaves, if it is of one; of a
  /// labelled shape it has to be the whole.
  std::optional<CityPart> whole(uint32_t prototype);
  /// The label of the leaf that comes next, or null.
  const Label* label();
  /// What a leaf under a label is, or under none where that is null.
  CityPart partOf(const Leaf& leaf, const Label* label) const;

  const CityParts& kinds_;
  std::vector<Label> labels_;
  uint64_t at_ = 0;
  /// No label before it reaches as far as the next leaf.
  size_t near_ = 0;
  std::optional<CityRuns> runs_;
};

}  // namespace gable
