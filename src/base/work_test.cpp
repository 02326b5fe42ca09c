// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/work.h"
#include "base/work_count.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace gable {
namespace {

class Allowance : public WorkMeter {
 public:
  explicit Allowance(uint64_t units, uint64_t bytes = 0) : units_(units), bytes_(bytes) {}
  bool look(uint64_t units, uint64_t bytes) override {
    ++looks;
    done += units;
    return done <= units_ && bytes <= bytes_;
  }
  uint64_t done = 0, looks = 0;

 private:
  uint64_t units_, bytes_;
};

Status workFor(uint64_t units) {
  return guarded([&] {
    for (uint64_t i = 0; i < units; ++i) work();
    return Status();
  });
}

TEST(Work, NeverStopsWithoutAMeter) {
  EXPECT_TRUE(workFor(100'000).ok());
  EXPECT_TRUE(guarded([] {
                workMemory(uint64_t{1} << 60);
                return Status();
              }).ok());
}

TEST(Work, StopsWhenTheMeterSaysSo) {
  Allowance meter(100'000);
  const WorkScope scope(meter);
  EXPECT_TRUE(workFor(90'000).ok());
  const Status stopped = workFor(1'000'000);
  EXPECT_EQ(stopped.code(), kWorkStopped);
  EXPECT_LE(meter.done, 100'000u + 2 * kWorkBetweenLooks);
}

TEST(Work, LooksSeldomAndCountsAll) {
  Allowance meter(uint64_t{1} << 40);
  const WorkScope scope(meter);
  work(10 * kWorkBetweenLooks);
  work(1);
  EXPECT_TRUE(workFor(100 * kWorkBetweenLooks).ok());
  EXPECT_LE(meter.looks, 102u);
  EXPECT_GE(meter.done, 109u * kWorkBetweenLooks);
}

TEST(Work, AsksBeforeMemoryIsTaken) {
  Allowance meter(1000, uint64_t{1} << 20);
  const WorkScope scope(meter);
  const auto reserved = [](double count) {
    return guarded([&] {
      std::vector<double> v;
      reserveWork(v, count);
      return Status();
    });
  };
  EXPECT_TRUE(reserved(1000).ok());
  EXPECT_TRUE(reserved(100'000).ok());
  EXPECT_EQ(reserved(1e6).code(), kWorkStopped);
  EXPECT_EQ(reserved(1e300).code(), kWorkStopped);
}

TEST(Work, ScopesNest) {
  Allowance outer(uint64_t{1} << 40), inner(0);
  const WorkScope a(outer);
  {
    const WorkScope b(inner);
    EXPECT_FALSE(workFor(2 * kWorkBetweenLooks).ok());
  }
  EXPECT_TRUE(workFor(2 * kWorkBetweenLooks).ok());
}

TEST(Work, CountsToTheUnit) {
  Allowance meter(uint64_t{1} << 40);
  const WorkScope scope(meter);
  work(1000);
  for (const uint64_t units : {uint64_t{0}, uint64_t{1}, uint64_t{5000}, uint64_t{123'457}}) {
    const WorkCount count;
    EXPECT_TRUE(workFor(units).ok());
    EXPECT_EQ(count.units(), units);
  }
  // The meter around has been told all but what comes before its next look.
  work(kWorkBetweenLooks);
  EXPECT_GE(meter.done, 1000 + 5001 + 123'457u);
}

TEST(Work, WhatIsCountedStopsWithTheMeterAround) {
  Allowance meter(100'000);
  const WorkScope scope(meter);
  const WorkCount count;
  EXPECT_EQ(workFor(1'000'000).code(), kWorkStopped);
  EXPECT_LE(count.units(), 100'000u + 2 * kWorkBetweenLooks);
}

TEST(Work, CountsWithoutAMeter) {
  const WorkCount count;
  EXPECT_TRUE(workFor(20'000).ok());
  EXPECT_EQ(count.units(), 20'000u);
}

TEST(Work, TheDoorTakesWhateverComes) {
  const Status memory = guarded([]() -> Status { throw std::bad_alloc(); });
  EXPECT_STREQ(memory.code(), "out-of-memory");
  const Status length = guarded([]() -> Status {
    std::vector<double> v;
    v.reserve(v.max_size() + 1);
    return {};
  });
  EXPECT_STREQ(length.code(), "out-of-memory");
  const Status library = guarded([]() -> Status { throw std::runtime_error("no"); });
  EXPECT_STREQ(library.code(), "cannot-be-done");
  const Status kernel = guarded([]() -> Status { giveUp("too-large", "it is too large"); });
  EXPECT_STREQ(kernel.code(), "too-large");
  EXPECT_EQ(kernel.message(), "it is too large");
}

}  // namespace
}  // namespace gable
