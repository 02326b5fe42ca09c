// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>

#include "render/render.h"

namespace gable::rt {

/// Tells how far a picture is that several threads make, and whether it is to end.
class Reporting {
 public:
  /// `total`: of what add() counts. Keeps a reference to the options.
  Reporting(const RenderOptions& options, double total) : options_(options), total_(total) {}

  /// So many more are done. False where the picture is to end. What RenderOptions::progress throws
  /// is thrown on.
  bool add(size_t more) {
    const std::lock_guard lock(mutex_);
    done_ += more;
    const double share = static_cast<double>(done_) / total_;
    if (options_.progress && !options_.progress(share)) ended_ = true;
    return !ended_;
  }
  bool ended() const { return ended_.load(std::memory_order_relaxed); }

 private:
  const RenderOptions& options_;
  double total_;
  std::mutex mutex_;
  size_t done_ = 0;
  std::atomic<bool> ended_{false};
};

}  // namespace gable::rt
