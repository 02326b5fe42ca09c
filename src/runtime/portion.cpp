// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/portion.h"

namespace gable {

uint32_t PortionQueue::push(std::unique_ptr<Portion> portion) {
  uint32_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    portion->unit = &units_.emplace_back();
    portion->unit->number = number = static_cast<uint32_t>(units_.size() - 1);
    waiting_.push_back(std::move(portion));
    ++open_;
    --hungry_;
  }
  changed_.notify_one();
  return number;
}

std::unique_ptr<Portion> PortionQueue::take() {
  std::unique_lock lock(mutex_);
  ++hungry_;
  changed_.wait(lock, [&] { return !waiting_.empty() || open_ == 0; });
  if (waiting_.empty()) return nullptr;
  std::unique_ptr<Portion> portion = std::move(waiting_.front());
  waiting_.pop_front();
  return portion;
}

void PortionQueue::done() {
  const std::lock_guard lock(mutex_);
  if (--open_ == 0) changed_.notify_all();
}

}  // namespace gable
