// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/spare_threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

namespace gable {
namespace {

// A tree of three parts at each node.
uint64_t sumOf(SpareThreads& threads, uint64_t first, int depth) {
  if (depth == 0) return first;
  std::vector<uint64_t> sums(3);
  threads.run(3, [&](size_t i) { sums[i] = sumOf(threads, 3 * first + i, depth - 1); });
  return sums[0] + sums[1] + sums[2];
}

TEST(SpareThreads, aTreeComesToTheSameWithAnyNumberOfThem) {
  for (unsigned jobs : {0u, 1u, 2u, 3u, 8u}) {
    SpareThreads threads(jobs);
    // All numbers below 3^7.
    EXPECT_EQ(sumOf(threads, 0, 7), 2187u * 2186 / 2) << jobs;
  }
}

TEST(SpareThreads, everyIndexRunsOnce) {
  SpareThreads threads(3);
  for (size_t count : {size_t{0}, size_t{1}, size_t{5}, size_t{100}}) {
    std::vector<std::atomic<int>> hits(count);
    threads.run(count, [&](size_t i) { ++hits[i]; });
    for (const auto& h : hits) EXPECT_EQ(h.load(), 1);
  }
}

TEST(SpareThreads, oneJobRunsInOrderOnTheCaller) {
  SpareThreads threads(1);
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<size_t> order;
  threads.run(9, [&](size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(i);
  });
  for (size_t i = 0; i < 9; ++i) EXPECT_EQ(order[i], i);
}

// No more than there may be, and no fewer.
TEST(SpareThreads, twoJobsWorkAtATime) {
  SpareThreads threads(2);
  std::atomic<int> at{0}, most{0};
  threads.run(8, [&](size_t) {
    const int now = ++at;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    --at;
  });
  EXPECT_EQ(most, 2);
}

TEST(SpareThreads, throwsOnWhatATaskThrowsAndWorksOn) {
  SpareThreads threads(3);
  std::atomic<int> ran{0};
  EXPECT_THROW(threads.run(9,
                           [&](size_t i) {
                             ++ran;
                             if (i == 2) throw std::bad_alloc();
                           }),
               std::bad_alloc);
  EXPECT_EQ(ran, 9);
  EXPECT_EQ(sumOf(threads, 0, 3), 27u * 26 / 2);
}

}  // namespace
}  // namespace gable
