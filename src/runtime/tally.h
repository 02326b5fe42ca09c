// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tally: what one worker does, counted where it costs a few instructions, and told to the Usage of
// all workers every so often.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "runtime/usage.h"

namespace gable {

class Tally {
 public:
  /// Must outlive the tally.
  explicit Tally(Usage& usage) : usage_(usage) {}

  void countShape() { countShapes(1); }
  /// Shapes that were made here.
  void countShapes(uint64_t count) {
    made_ += count;
    expanded_ += count;
  }
  /// Shapes that stand in a prototype which was there already.
  void countExpanded(uint64_t count) { expanded_ += count; }
  /// Shapes that were taken over from elsewhere.
  void countTaken(uint64_t made, uint64_t expanded) {
    made_ += made;
    expanded_ += expanded;
  }
  void countVertices(uint64_t count) { use_.vertices += count; }
  /// A turn of a loop, or a rule run in place.
  void countTurn() { ++use_.turns; }
  void countSteps(uint64_t steps) { steps_ += steps; }
  /// What work() counts, which is smaller than a step.
  void countWork(uint64_t units) { steps_ += units / kUnitsPerStep; }

  /// All shapes so far: those made here, and with instances expanded.
  uint64_t made() const { return made_; }
  uint64_t expanded() const { return expanded_; }
  uint64_t steps() const { return stepsTold_ + steps_; }

  bool isLookDue() const { return steps_ >= kStepsBetweenLooks; }
  /// Tells what has not been told; the first limit that is exceeded then, if any.
  std::optional<Usage::Excess> tell();
  /// The same, and looks at the memory that the process holds, where it has not done so just now.
  /// `bytes`: so many are about to be taken.
  std::optional<Usage::Excess> look(uint64_t bytes);
  /// Looks at the clock and at memory alone. What has been counted stays to be told at its own
  /// place, so that limits on counts are reached where they are reached without this look.
  std::optional<Usage::Excess> lookAside(uint64_t bytes);

  /// For what is tried and given up.
  struct Mark {
    uint64_t made, expanded, steps;
  };
  Mark mark() const { return {made_, expanded_, steps_}; }
  /// Nothing must have been told since.
  void goBack(const Mark& to) {
    made_ = to.made;
    expanded_ = to.expanded;
    steps_ = to.steps;
  }

  static constexpr uint64_t kStepsBetweenLooks = 1024;
  static constexpr uint64_t kUnitsPerStep = 16;

 private:
  std::optional<Usage::Excess> lookAtMemory(uint64_t bytes);

  /// A look at memory takes microseconds.
  static constexpr std::chrono::milliseconds kBetweenMemory{2};

  Usage& usage_;
  uint64_t made_ = 0, madeTold_ = 0, expanded_ = 0;
  /// Since it was told, and before.
  uint64_t steps_ = 0, stepsTold_ = 0;
  /// Vertices and turns since it was told.
  Usage::Use use_;
  std::chrono::steady_clock::time_point memoryLooked_{};
};

}  // namespace gable
