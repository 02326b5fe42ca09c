// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Threads for work that divides again and again: each part that divides asks for helpers, and gets
// those that are idle at that time. A part that finds none does all of its work itself, so uneven
// trees keep all processors at work.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace gable {

class SpareThreads {
 public:
  /// `jobs` counts the caller: 1 makes no thread, 0 means defaultJobs().
  explicit SpareThreads(unsigned jobs);
  SpareThreads(const SpareThreads&) = delete;
  SpareThreads& operator=(const SpareThreads&) = delete;

  /// Calls task(index) once for every index under `count`, and returns when all are done. Tasks may
  /// call this as well. No result may depend on which thread runs what, or when. The writes of
  /// tasks are visible after the call. Of what tasks throw one is thrown on, once all have ended.
  void run(size_t count, const std::function<void(size_t)>& task);

 private:
  bool take();

  std::atomic<int> idle_;
};

}  // namespace gable
