// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <numeric>
#include <vector>

namespace gable {
namespace {

TEST(Parallel, everyIndexRunsOnceForAnyNumberOfJobs) {
  for (unsigned jobs : {0u, 1u, 2u, 3u, 8u}) {
    for (size_t count : {size_t{0}, size_t{1}, size_t{7}, size_t{1000}}) {
      for (size_t grain : {size_t{1}, size_t{16}}) {
        std::vector<int> hits(count, 0);
        std::atomic<bool> badWorker{false};
        parallelFor(
            count, jobs,
            [&](size_t i, unsigned worker) {
              ++hits[i];
              if (jobs && worker >= jobs) badWorker = true;
            },
            grain);
        EXPECT_EQ(std::accumulate(hits.begin(), hits.end(), size_t{0}), count);
        for (int h : hits) EXPECT_EQ(h, 1);
        EXPECT_FALSE(badWorker);
      }
    }
  }
}

TEST(Parallel, onePoolRunsManyLoops) {
  TaskPool pool(3);
  EXPECT_EQ(pool.jobs(), 3u);
  std::vector<size_t> sums(pool.jobs());
  for (int round = 0; round < 2000; ++round) {
    pool.run(5, [&](size_t i, unsigned worker) { sums[worker] += i; });
  }
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), size_t{0}), 2000u * 10);
}

TEST(Parallel, oneJobRunsInOrderOnTheCaller) {
  std::vector<size_t> order;
  parallelFor(50, 1, [&](size_t i, unsigned worker) {
    EXPECT_EQ(worker, 0u);
    order.push_back(i);
  });
  for (size_t i = 0; i < 50; ++i) EXPECT_EQ(order[i], i);
}

TEST(TaskPool, throwsOnWhatATaskThrowsAndWorksOn) {
  TaskPool pool(3);
  for (int round = 0; round < 20; ++round) {
    EXPECT_THROW(pool.run(1000,
                          [](size_t i, unsigned) {
                            if (i == 500) throw std::bad_alloc();
                          }),
                 std::bad_alloc);
    std::atomic<size_t> done{0};
    pool.run(1000, [&](size_t, unsigned) { ++done; });
    EXPECT_EQ(done.load(), 1000u);
  }
}

}  // namespace
}  // namespace gable
