// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// ContextQueries: what one worker does for rules that ask about other shapes. In the first pass of
// a derivation it collects occluders; in the second it answers from the index of all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/context.h"

namespace gable {

class ContextQueries {
 public:
  /// `index`: null in the first pass, and where no rule asks. Must outlive the queries.
  ContextQueries(bool collects, const OccluderIndex* index) : collects_(collects), index_(index) {}

  /// Where a shape stands: in the tree of its initial shape, and the frame that its own is given
  /// in.
  struct Place {
    uint32_t initialShape = 0;
    PlacePath path;
    const Frame& world;
    RoomCondition condition = kAlways;
  };

  bool collects() const { return collects_; }
  /// In the first pass. A shape without geometry occludes nothing. `label`: 0 for none.
  void add(StringId label, const Shape& s, const Place& at);
  std::vector<Occluder>& occluders() { return occluders_; }

  // Without an index: no, infinity, 0 and 0.
  bool test(ContextTest test, ContextScope scope, StringId label, const Shape& s,
            const Place& at) const;
  double distance(ContextScope scope, StringId label, const Shape& s, const Place& at) const;
  double count(ContextScope scope, StringId label, const Shape& s, const Place& at) const;
  double rank(ContextScope scope, StringId label, ContextOrder order, const Shape& s,
              const Place& at) const;

 private:
  const bool collects_;
  const OccluderIndex* const index_;
  std::vector<Occluder> occluders_;
};

}  // namespace gable
