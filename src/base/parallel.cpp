// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The caller is worker 0 and works along. A call publishes its body under the lock and raises the
// generation; each thread joins a generation once, takes ranges from a shared counter until it is
// empty and signs off. The caller waits for all sign-offs, so the body outlives every use of it.
#include "base/parallel.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace gable {

unsigned defaultJobs() {
  const unsigned n = std::thread::hardware_concurrency();
  return n ? n : 1;
}

struct TaskPool::Impl {
  std::vector<std::thread> threads;
  std::mutex mutex;
  std::condition_variable wake, done;
  uint64_t generation = 0;
  unsigned working = 0;
  bool stop = false;
  std::exception_ptr thrown;

  size_t count = 0, grain = 1;
  Body body = nullptr;
  void* context = nullptr;
  // A line of its own: every worker writes it.
  alignas(64) std::atomic<size_t> next{0};

  void work(unsigned worker) noexcept {
    try {
      for (;;) {
        const size_t begin = next.fetch_add(grain, std::memory_order_relaxed);
        if (begin >= count) return;
        body(context, begin, begin + grain < count ? begin + grain : count, worker);
      }
    } catch (...) {
      // The others find nothing more to do.
      next.store(count, std::memory_order_relaxed);
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  }

  void threadMain(unsigned worker) {
    uint64_t seen = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return stop || generation != seen; });
        if (stop) return;
        seen = generation;
      }
      work(worker);
      const std::lock_guard lock(mutex);
      if (--working == 0) done.notify_one();
    }
  }
};

TaskPool::TaskPool(unsigned jobs) : impl_(std::make_unique<Impl>()) {
  const unsigned wanted = jobs ? jobs : defaultJobs();
  impl_->threads.reserve(wanted);
  try {
    for (unsigned w = 1; w < wanted; ++w) {
      impl_->threads.emplace_back([impl = impl_.get(), w] { impl->threadMain(w); });
    }
  } catch (const std::system_error&) {
    // The machine gives no more threads: those that there are do the work.
  }
}

TaskPool::~TaskPool() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->stop = true;
  }
  impl_->wake.notify_all();
  for (std::thread& t : impl_->threads) t.join();
}

unsigned TaskPool::jobs() const { return static_cast<unsigned>(impl_->threads.size()) + 1; }

void TaskPool::runErased(size_t count, size_t grain, Body body, void* context) {
  if (impl_->threads.empty() || count <= grain) {
    if (count) body(context, 0, count, 0);
    return;
  }
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->count = count;
    impl_->grain = grain;
    impl_->body = body;
    impl_->context = context;
    impl_->next.store(0, std::memory_order_relaxed);
    impl_->working = static_cast<unsigned>(impl_->threads.size());
    ++impl_->generation;
  }
  impl_->wake.notify_all();
  impl_->work(0);
  std::unique_lock lock(impl_->mutex);
  impl_->done.wait(lock, [&] { return impl_->working == 0; });
  if (std::exception_ptr thrown = std::exchange(impl_->thrown, nullptr)) {
    std::rethrow_exception(thrown);
  }
}

}  // namespace gable
