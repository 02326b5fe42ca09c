// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parallel loops that can be stopped. The meter of work() belongs to one thread; tasks on other
// threads stop when one on the calling thread does.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <optional>

#include "base/parallel.h"
#include "base/work.h"

namespace gable {

namespace detail {

/// Says stop to other threads once a task has been left by an exception.
class SharedStop final : public WorkMeter {
 public:
  bool look(uint64_t, uint64_t) override { return !stopped_; }

  /// Notices that the task around it is left by an exception.
  class Watch {
   public:
    explicit Watch(SharedStop& stop) : stop_(stop) {}
    ~Watch() {
      if (std::uncaught_exceptions() > before_) stop_.stopped_ = true;
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    SharedStop& stop_;
    int before_ = std::uncaught_exceptions();
  };

 private:
  std::atomic<bool> stopped_{false};
};

/// The task as threads run it beside others that call work(). Worker 0 is the calling thread.
template <class Task>
auto stoppable(SharedStop& stop, Task& task) {
  return [&stop, &task](size_t i, unsigned worker) {
    std::optional<WorkScope> scope;
    if (worker != 0) scope.emplace(stop);
    const SharedStop::Watch watch(stop);
    task(i, worker);
  };
}

}  // namespace detail

/// parallelFor() for tasks that call work(). Where the calling thread's meter says stop, tasks on
/// all threads unwind soon. What others do is held against no limit.
template <class Task>
void parallelWork(size_t count, unsigned jobs, Task&& task) {
  detail::SharedStop stop;
  parallelFor(count, jobs, detail::stoppable(stop, task));
}

/// The same with threads that are there.
template <class Task>
void parallelWork(TaskPool& pool, size_t count, Task&& task) {
  detail::SharedStop stop;
  pool.run(count, detail::stoppable(stop, task));
}

}  // namespace gable
