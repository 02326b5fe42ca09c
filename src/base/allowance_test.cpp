// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/allowance.h"

#include <gtest/gtest.h>

#include <vector>

namespace gable {
namespace {

constexpr uint64_t kALot = uint64_t{1} << 40;

// How work under an allowance ends.
Status worked(Allowance& allowance, uint64_t units) {
  const WorkScope scope(allowance);
  return guarded([&] {
    for (uint64_t i = 0; i < units; ++i) work();
    return Status();
  });
}

TEST(Allowance, endsWhenItsTimeIsOver) {
  Allowance allowance({0.05, {}});
  EXPECT_EQ(worked(allowance, kALot).code(), kWorkStopped);
  EXPECT_TRUE(allowance.reached());
  const Error why = allowance.reason("reading 'a.obj'");
  EXPECT_EQ(why.code, "out-of-time");
  EXPECT_EQ(why.message, "reading 'a.obj' takes longer than 0.05 seconds");
  EXPECT_FALSE(worked(allowance, 2 * kWorkBetweenLooks).ok());
}

TEST(Allowance, endsBeforeMemoryIsTaken) {
  Allowance allowance({{}, uint64_t{100} << 20});
  const WorkScope scope(allowance);
  std::vector<int> numbers;
  EXPECT_TRUE(guarded([&] {
                reserveWork(numbers, 1e6);
                return Status();
              }).ok());
  EXPECT_FALSE(guarded([&] {
                 reserveWork(numbers, 1e9);
                 return Status();
               }).ok());
  EXPECT_EQ(allowance.reason("reading 'a.obj'").code, "out-of-memory");
}

TEST(Allowance, endsWhenItIsCancelled) {
  std::atomic<bool> cancel{true};
  Allowance allowance({{}, {}, &cancel});
  EXPECT_FALSE(worked(allowance, 2 * kWorkBetweenLooks).ok());
  EXPECT_EQ(allowance.reason("reading 'a.obj'").code, "was-cancelled");
}

TEST(Allowance, letsWorkWithoutLimits) {
  Allowance allowance({});
  EXPECT_TRUE(worked(allowance, 1'000'000).ok());
  EXPECT_FALSE(allowance.reached());
}

class Counter final : public WorkMeter {
 public:
  bool look(uint64_t units, uint64_t) override {
    done += units;
    ++looks;
    return looks < most;
  }
  bool lookAside(uint64_t) override { return ++asides < most; }
  uint64_t done = 0, looks = 0, asides = 0, most = 1000;
};

TEST(UncountedWork, isNotCountedAndStillStops) {
  Counter meter;
  const WorkScope scope(meter);
  const auto uncounted = [](uint64_t units) {
    return guarded([&] {
      const UncountedWork hidden;
      work(units);
      return Status();
    });
  };
  EXPECT_TRUE(uncounted(100 * kWorkBetweenLooks).ok());
  EXPECT_EQ(meter.done, 0u);
  EXPECT_EQ(meter.looks, 0u);
  EXPECT_EQ(meter.asides, 1u);
  meter.most = 0;
  EXPECT_EQ(uncounted(100 * kWorkBetweenLooks).code(), kWorkStopped);
}

TEST(UnwindIfStopped, goesOnForMetersAlone) {
  unwindIfStopped(Status());
  unwindIfStopped(Status::failure("no-area", "there is none"));
  EXPECT_THROW(unwindIfStopped(Status::failure(kWorkStopped, {})), Unwinding);
}

}  // namespace
}  // namespace gable
