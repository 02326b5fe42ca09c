// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WorkCount: counts the work() that is done on its thread as long as it lives. Unlike a clock it
// gives the same number each time. The meter around is told of the work as ever.
#pragma once

#include "base/work.h"

namespace gable {

class WorkCount final : private WorkMeter {
 public:
  WorkCount() : before_(detail::workState) { detail::workState = {kWorkBetweenLooks, this}; }
  ~WorkCount() {
    before_.left -= kWorkBetweenLooks - detail::workState.left;
    detail::workState = before_;
  }
  WorkCount(const WorkCount&) = delete;
  WorkCount& operator=(const WorkCount&) = delete;

  uint64_t units() const {
    return told_ + static_cast<uint64_t>(kWorkBetweenLooks - detail::workState.left);
  }

 private:
  bool look(uint64_t units, uint64_t bytes) override {
    told_ += units;
    return !before_.meter || before_.meter->look(units, bytes);
  }

  detail::WorkState before_;
  uint64_t told_ = 0;
};

}  // namespace gable
