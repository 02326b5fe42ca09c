// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/worlds.h"

namespace gable {

void Worlds::begin(const Frame& outermost) {
  calls_.assign(1, outermost);
  gathered_.clear();
  gathers_.clear();
  leaves_ = &calls_;
}

void Worlds::open(const Frame& frame) {
  calls_.emplace_back();
  const Frame& outer = calls_.end()[-2];
  Frame& inner = calls_.back();
  if (outer.turned && !frame.turned) {
    inner = outer;
    inner.origin = outer.point(frame.origin);
  } else {
    inner = outer * frame;
  }
  if (!gathers_.empty()) gathered_.push_back(gathered_.back() * frame);
}

void Worlds::close() {
  calls_.pop_back();
  if (!gathers_.empty()) gathered_.pop_back();
}

void Worlds::beginGather() {
  gathers_.push_back(gathered_.size());
  gathered_.emplace_back();
  leaves_ = &gathered_;
}

void Worlds::endGather() {
  gathered_.resize(gathers_.back());
  gathers_.pop_back();
  if (gathers_.empty()) leaves_ = &calls_;
}

}  // namespace gable
