// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Long work runs on a thread of its own without Python's lock, while the calling thread waits for
// it and sees to Ctrl-C and the progress function.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <utility>

#include "bindings.h"

namespace gable::python {

inline constexpr std::chrono::milliseconds kBetweenLooks{50};

/// What the calling thread sees of work that goes on.
struct Watched {
  std::atomic<bool> cancel{false};
  std::atomic<size_t> done{0}, total{0};
};

/// Runs `work` beside, and what Python wants meanwhile. Ctrl-C and an exception of the progress
/// function end the work; they are raised when it has ended.
template <class Work>
auto watch(Watched& watched, const py::object& progress, Work&& work) {
  auto result = std::async(std::launch::async, std::forward<Work>(work));
  std::pair<size_t, size_t> told{0, 0};
  const auto tell = [&] {
    const std::pair<size_t, size_t> now{watched.done, watched.total};
    if (progress.is_none() || now == told || now.second == 0) return;
    told = now;
    progress(now.first, now.second);
  };
  try {
    for (;;) {
      std::future_status status;
      {
        const py::gil_scoped_release released;
        status = result.wait_for(kBetweenLooks);
      }
      if (status == std::future_status::ready) break;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell();
    }
    tell();
  } catch (...) {
    watched.cancel = true;
    const py::gil_scoped_release released;
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace gable::python
