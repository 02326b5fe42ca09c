// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the leaves of one initial shape are, in path order: by their attributes, by the labels and
// tags of the shapes above them, by their names (city_kinds.h). A reader goes along as walk() does:
// it takes each leaf by next() or an instance as a whole by skip(). Trim, such as a frame or a
// sill, is of what it touches among the leaves that come just before and after it; else it stays
// what its name says.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"
#include "io/exporters/write_model.h"

namespace gable {

class RootParts {
 public:
  /// `kinds` must outlive it.
  explicit RootParts(const CityParts& kinds) : kinds_(kinds) {}

  /// Another root; labels that say no part are left out.
  void open(const std::vector<LabelledLeaves>& labels);
  /// Finds what the trim of a root is of. `standsAlone`: the reader will skip an instance, which is
  /// asked where whole() can be. Linear in the leaves; ends behind the last leaf.
  void settleTrim(const Scene& scene, const Root& root, CityFaces& faces,
                  const std::function<bool(const Instance&)>& standsAlone);
  /// Back to the first leaf.
  void begin();
  /// The part of the leaf that comes next.
  CityPart next(const Leaf& leaf);
  /// The part that an instance which comes next is of with all its leaves, if it is of one; of a
  /// labelled shape it has to be the whole.
  std::optional<CityPart> whole(uint32_t prototype);
  /// The instance that comes next was taken as a whole.
  void skip(uint32_t prototype) { at_ += kinds_.leafCount(prototype); }

 private:
  struct Label {
    uint64_t first = 0, end = 0;
    CityKind kind = CityKind::Unknown;
    uint32_t shape = 0;
  };
  class TrimRun;
  /// The label of the leaf that comes next, or null.
  const Label* label();
  /// What a leaf under a label is, or under none where that is null.
  CityPart partOf(const Leaf& leaf, const Label* label) const;
  /// What settleTrim() found of the leaf that comes next, or null.
  const CityPart* settled();

  const CityParts& kinds_;
  std::vector<Label> labels_;
  uint64_t at_ = 0;
  /// No label before it reaches as far as the next leaf.
  size_t near_ = 0;
  /// By leaf, ascending, and the first that is not before the next leaf.
  std::vector<std::pair<uint64_t, CityPart>> settled_;
  size_t nextSettled_ = 0;
};

}  // namespace gable
