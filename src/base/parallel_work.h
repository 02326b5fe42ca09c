// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// parallelFor() for work that counts: what the threads do counts for the meter of the caller, whose
// limits end it.
#pragma once

#include <cstddef>
#include <optional>

#include "base/parallel.h"
#include "base/work.h"

namespace gable {

/// As parallelFor(). What a limit ends unwinds on the caller, once all workers stand.
template <class Task>
void parallelWork(size_t count, unsigned jobs, Task&& task) {
  WorkMeter* const meter = detail::workState.meter;
  parallelFor(count, jobs, [&](size_t i, unsigned worker) {
    std::optional<WorkScope> scope;
    if (meter) scope.emplace(*meter);
    task(i, worker);
  });
}

}  // namespace gable
