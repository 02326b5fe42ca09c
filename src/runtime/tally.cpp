// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/tally.h"

#include <utility>

namespace gable {

std::optional<Usage::Excess> Tally::tell() {
  stepsTold_ += steps_;
  use_.steps = std::exchange(steps_, 0);
  use_.shapes = made_ - std::exchange(madeTold_, made_);
  return usage_.spend(std::exchange(use_, {}));
}

std::optional<Usage::Excess> Tally::look(uint64_t bytes) {
  if (auto excess = tell()) return excess;
  return lookAtMemory(bytes);
}

std::optional<Usage::Excess> Tally::lookAside(uint64_t bytes) {
  if (auto excess = usage_.lookAtClock()) return excess;
  return lookAtMemory(bytes);
}

std::optional<Usage::Excess> Tally::lookAtMemory(uint64_t bytes) {
  const auto now = std::chrono::steady_clock::now();
  if (bytes == 0 && now - memoryLooked_ < kBetweenMemory) return {};
  memoryLooked_ = now;
  return usage_.lookAtMemory(bytes);
}

}  // namespace gable
