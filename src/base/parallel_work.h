// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parallel loops for work that counts: what the threads do counts for the meter of the caller,
// whose limits end it.
#pragma once

#include <cstddef>
#include <optional>

#include "base/parallel.h"
#include "base/work.h"

namespace gable {

/// As TaskPool::run(). What a limit ends unwinds on the caller, once all workers stand.
template <class Task>
void parallelWork(TaskPool& pool, size_t count, Task&& task) {
  WorkMeter* const meter = detail::workState.meter;
  pool.run(count, [&](size_t i, unsigned worker) {
    std::optional<WorkScope> scope;
    if (meter) scope.emplace(*meter);
    task(i, worker);
  });
}

/// The same with threads of its own, as parallelFor().
template <class Task>
void parallelWork(size_t count, unsigned jobs, Task&& task) {
  const size_t wanted = jobs ? jobs : defaultJobs();
  TaskPool pool(static_cast<unsigned>(wanted < count ? wanted : (count ? count : 1)));
  parallelWork(pool, count, task);
}

}  // namespace gable
