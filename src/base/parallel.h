// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A small task pool. No result may depend on which worker runs what, or when: a task writes only to
// places of its own index (or to per-worker state that is merged by index afterwards).
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace gable {

/// The number of jobs that `--jobs 0` means: the processors of this machine, at least 1.
unsigned defaultJobs();

/// Keeps its threads between calls. One call runs at a time; a task must not call the same pool.
class TaskPool {
 public:
  /// `jobs` counts the caller: 1 makes no thread, 0 means defaultJobs().
  explicit TaskPool(unsigned jobs);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  unsigned jobs() const;

  /// Calls task(index, worker) once for every index under `count`, worker under jobs(), and returns
  /// when all are done. Indices are handed out in ascending order, `grain` at a time. The writes of
  /// tasks are visible after the call. What a task throws ends the call, once all workers stand; of
  /// several exceptions one is thrown on.
  template <class Task>
  void run(size_t count, Task&& task, size_t grain = 1) {
    using Plain = std::remove_reference_t<Task>;
    runErased(
        count, grain ? grain : 1,
        [](void* context, size_t begin, size_t end, unsigned worker) {
          auto& call = *static_cast<Plain*>(context);
          for (size_t i = begin; i < end; ++i) call(i, worker);
        },
        const_cast<std::remove_const_t<Plain>*>(&task));
  }

 private:
  using Body = void (*)(void* context, size_t begin, size_t end, unsigned worker);
  void runErased(size_t count, size_t grain, Body body, void* context);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One parallel loop with threads of its own; with one job or one index it runs inline.
template <class Task>
void parallelFor(size_t count, unsigned jobs, Task&& task, size_t grain = 1) {
  const size_t wanted = jobs ? jobs : defaultJobs();
  TaskPool pool(static_cast<unsigned>(wanted < count ? wanted : (count ? count : 1)));
  pool.run(count, task, grain);
}

}  // namespace gable
