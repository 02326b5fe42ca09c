// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Holes: the places in a unit where what portions of it made belongs, and what was taken over from
// the derivation before. A portion is handed over early; its place is known only when the worker
// gets there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/output.h"

namespace gable {

class Holes {
 public:
  void begin() {
    placed_.clear();
    pending_.clear();
    portions_ = 0;
  }
  /// The last children of the activation at this place on the stack become the unit `portion`. Of
  /// one activation the last children are handed over first.
  void leave(uint32_t activation, uint32_t portion) { pending_.push_back({activation, portion}); }
  /// Whether the activation, the innermost with children left, has handed some over.
  bool isPendingAt(uint32_t activation) const {
    return !pending_.empty() && pending_.back().activation == activation;
  }
  /// The activation's own children are done: those of others come here, in order. `messages`: so
  /// many were told before.
  void place(uint32_t activation, const Output::Mark& at, size_t messages) {
    while (isPendingAt(activation)) {
      placed_.push_back({pending_.back().portion, at, messages});
      pending_.pop_back();
      ++portions_;
    }
  }
  /// Here comes what was taken over, which must outlive the unit.
  void fill(const RecallPart& taken, const Output::Mark& at, size_t messages) {
    placed_.push_back({0, at, messages, &taken});
  }

  bool anyPending() const { return !pending_.empty(); }
  /// Whether a part of the unit is, or was, with another worker.
  bool any() const { return !pending_.empty() || portions_ > 0; }
  size_t placed() const { return placed_.size(); }
  /// Of these, those of portions.
  size_t portions() const { return portions_; }
  /// Those placed since begin(), in path order.
  std::vector<OutputHole> take() {
    portions_ = 0;
    return std::exchange(placed_, {});
  }

 private:
  struct Pending {
    uint32_t activation, portion;
  };
  std::vector<Pending> pending_;
  std::vector<OutputHole> placed_;
  size_t portions_ = 0;
};

}  // namespace gable
