// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Prototypes: the cache of what equal calls have in common. It knows the finished prototypes of one
// worker by their keys, and those that are open: calls of shared rules within calls of shared
// rules, and around them all the unit of work, an initial shape or a portion of one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/output.h"

namespace gable {

class Prototypes {
 public:
  /// What is made lies in the output, which must outlive the cache.
  explicit Prototypes(Output& output) : output_(output) {}

  /// A unit of work begins here.
  void beginUnit();
  /// What lies open becomes the unit's prototype. `shapes`: so many are in it. `whole`: nothing of
  /// it is elsewhere, so find() may give it to an equal unit; `key` is none where there can be
  /// none.
  uint32_t endUnit(StringId name, uint64_t shapes, const ShareKey& key = {}, bool whole = false);
  /// Where the unit began.
  const Output::Mark& unitMark() const { return unit_; }
  /// The present place, counted from there.
  Output::Mark placeInUnit() const;

  /// The finished prototype of a call, if there is one.
  std::optional<uint32_t> find(const ShareKey& key) const {
    const uint32_t* const number = numbers_.find(key);
    return number ? std::optional(*number) : std::nullopt;
  }
  /// A call begins whose result is to be a prototype, placed in `frame`; before it so many shapes
  /// were made. `attributes`: the set of its shape.
  void begin(const ShareKey& key, StringId name, const Frame& frame, uint64_t shapesBefore,
             uint32_t attributes = 0);
  /// The innermost open one ends, and is placed. One that a limit cut short (not `whole`) is kept,
  /// but never given to another call.
  void end(uint64_t shapesNow, bool whole);
  bool anyOpen() const { return !open_.empty(); }

  /// An instance in the innermost open prototype, or in the unit.
  void place(uint32_t prototype, const Frame& frame);
  /// The instance placed last, once more with its axes at another place. Gives its prototype.
  uint32_t placeAgain(const Vec3& origin);
  /// How many instances that has by now.
  uint32_t instancesAround() const;

  /// Drops the output and all that is known of it.
  void forget() {
    output_.drop();
    numbers_.clear();
  }

  const OutputPrototype& finished(uint32_t number) const { return output_.prototypes[number]; }
  /// By key, for who finishes prototypes by other means.
  KeyNumbers& numbers() { return numbers_; }

 private:
  struct Open {
    Output::Mark mark;
    ShareKey key;
    StringId name;
    Frame frame;
    uint64_t shapesBefore;
    uint32_t attributes;
  };
  const Output::Mark& around() const { return open_.empty() ? unit_ : open_.back().mark; }

  Output& output_;
  Output::Mark unit_;
  std::vector<Open> open_;
  KeyNumbers numbers_;
};

}  // namespace gable
