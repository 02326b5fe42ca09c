// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/spare_threads.h"

#include <exception>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace gable {

SpareThreads::SpareThreads(unsigned jobs)
    : idle_(static_cast<int>(jobs ? jobs : defaultJobs()) - 1) {}

bool SpareThreads::take() {
  int idle = idle_.load();
  while (idle > 0) {
    if (idle_.compare_exchange_weak(idle, idle - 1)) return true;
  }
  return false;
}

void SpareThreads::run(size_t count, const std::function<void(size_t)>& task) {
  std::vector<std::exception_ptr> thrown(count);
  const auto attempt = [&](size_t i) noexcept {
    try {
      task(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  };
  std::vector<std::thread> helpers;
  helpers.reserve(count);
  const auto help = [&](size_t i) {
    if (i + 1 == count || !take()) return false;
    try {
      helpers.emplace_back([&, i] {
        attempt(i);
        ++idle_;
      });
    } catch (const std::system_error&) {
      // The machine gives no more threads: those that there are do the work.
      ++idle_;
      return false;
    }
    return true;
  };
  for (size_t i = 0; i < count; ++i) {
    if (!help(i)) attempt(i);
  }
  // Who waits is idle, too.
  if (!helpers.empty()) {
    ++idle_;
    for (std::thread& h : helpers) h.join();
    --idle_;
  }
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace gable
