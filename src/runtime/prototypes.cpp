// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/prototypes.h"

namespace gable {

void Prototypes::beginUnit() {
  open_.clear();
  unit_ = output_.mark();
}

uint32_t Prototypes::endUnit(StringId name, uint64_t shapes, const ShareKey& key, bool whole) {
  const uint32_t number = output_.close(unit_, name, shapes, key);
  if (whole && key != ShareKey{}) numbers_.emplace(key, number);
  return number;
}

Output::Mark Prototypes::placeInUnit() const {
  Output::Mark m = output_.mark();
  m.leaves -= unit_.leaves;
  m.instances -= unit_.instances;
  m.events -= unit_.events;
  return m;
}

void Prototypes::begin(const ShareKey& key, StringId name, const Frame& frame,
                       uint64_t shapesBefore, uint32_t attributes) {
  open_.push_back({output_.mark(), key, name, frame, shapesBefore, attributes});
}

void Prototypes::end(uint64_t shapesNow, bool whole) {
  const Open open = open_.back();
  // Where memory is refused it stays open, and its unit ends it.
  const uint32_t number = output_.close(open.mark, open.name, shapesNow - open.shapesBefore,
                                        whole ? open.key : ShareKey{});
  output_.prototypes[number].attributes = open.attributes;
  open_.pop_back();
  place(number, open.frame);
  if (whole) numbers_.emplace(open.key, number);
}

void Prototypes::place(uint32_t prototype, const Frame& frame) {
  Instance i;
  i.frame = frame;
  i.prototype = prototype;
  i.leavesBefore = static_cast<uint32_t>(output_.openLeaves.size()) - around().leaves;
  output_.openInstances.push_back(i);
}

uint32_t Prototypes::placeAgain(const Vec3& origin) {
  Instance again = output_.openInstances.back();
  again.frame.origin = origin;
  output_.openInstances.push_back(again);
  return again.prototype;
}

uint32_t Prototypes::instancesAround() const {
  return static_cast<uint32_t>(output_.openInstances.size()) - around().instances;
}

}  // namespace gable
