// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which leaves of an initial shape are one element: a window of frame, bars and pane, a railing of
// posts. The derivation is the guide, as leaves come in path order. Leaves that follow each other
// and are of one part are a sequence, and those of a sequence that touch, or touch what lies
// between them in it, are one element. So are all leaves of one labelled shape. Trim is of the
// element that it touches. Nothing depends on what is shared, or on how the shape is turned: boxes
// lie along the axes of the first leaf of a sequence.
#pragma once

#include <cstdint>
#include <vector>

#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"

namespace gable {

class CityRuns {
 public:
  explicit CityRuns(CityFaces& faces) : faces_(faces) {}

  /// The next leaf. `said` is what it is if it touches nothing that says more; it differs from
  /// `part` where that is trim and a label says something else. O(kLookBack).
  void take(const CityPart& part, const CityPart& said, const Leaf& leaf, const Frame& world);
  /// So many leaves are an object by themselves, of one part.
  void skip(uint64_t count, const CityPart& part);
  /// What follows is of no element before it.
  void end();

  /// After end(), of a leaf by its number.
  const CityPart& part(uint64_t leaf) const { return parts_[leaf]; }
  bool begins(uint64_t leaf) const { return begins_[leaf]; }
  /// Leaves that follow each other are one element, and all of it.
  bool isOne(uint64_t first, uint64_t count) const;

 private:
  struct Run {
    uint64_t first = 0;
    CityPart part;
    /// Along axes_.
    Box3 box;
  };
  bool follows(const CityPart& part, uint32_t name) const;
  bool areOne(const Run& a, const Run& b) const;
  void join(Run& next);
  void settle(size_t run);

  CityFaces& faces_;
  std::vector<CityPart> parts_;
  std::vector<bool> begins_;
  // The sequence at hand: its elements so far, what it is of, the name of its last leaf, the way to
  // its axes, and the leaves that are trim.
  std::vector<Run> runs_;
  CityPart of_;
  uint32_t name_ = 0;
  Frame toAxes_;
  std::vector<uint64_t> trim_;
};

}  // namespace gable
