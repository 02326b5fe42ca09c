// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/allowance.h"

#include "base/memory.h"
#include "base/number.h"

namespace gable {

namespace {

// To find out how much memory is held takes microseconds.
constexpr int64_t kBetweenMemory = 5'000'000;

int64_t nanoseconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(d).count();
}

}  // namespace

Allowance::Allowance(const Most& most)
    : most_(most), start_(std::chrono::steady_clock::now()), bytesBefore_(residentBytes()) {}

Allowance::Reached Allowance::find(uint64_t bytes) {
  if (most_.cancel && most_.cancel->load(std::memory_order_relaxed)) return Reached::Cancel;
  const auto spent = std::chrono::steady_clock::now() - start_;
  if (most_.seconds && std::chrono::duration<double>(spent).count() > *most_.seconds) {
    return Reached::Time;
  }
  if (!most_.bytes) return Reached::No;
  const int64_t now = nanoseconds(spent);
  if (bytes == 0 && now - memoryLooked_.load(std::memory_order_relaxed) < kBetweenMemory) {
    return Reached::No;
  }
  memoryLooked_.store(now, std::memory_order_relaxed);
  const uint64_t held = residentBytes(), most = bytesBefore_ + *most_.bytes;
  return held <= most && bytes <= most - held ? Reached::No : Reached::Memory;
}

bool Allowance::look(uint64_t, uint64_t bytes) {
  if (reached()) return false;
  const Reached now = find(bytes);
  if (now == Reached::No) return true;
  reached_.store(now, std::memory_order_relaxed);
  return false;
}

Error Allowance::reason(const std::string& what) const {
  switch (reached_.load(std::memory_order_relaxed)) {
    case Reached::Time:
      return {"out-of-time",
              what + " takes longer than " + shortestText(*most_.seconds) + " seconds",
              "raise the limit on seconds (--max-seconds), or give it less at a time"};
    case Reached::Memory:
      return {"out-of-memory",
              what + " takes more than " + std::to_string(*most_.bytes >> 20) + " megabytes",
              "raise the limit on memory (--max-memory), or give it less at a time"};
    case Reached::Cancel:
    case Reached::No: break;
  }
  return {"was-cancelled", what + " was cancelled", "start it again"};
}

UncountedWork::UncountedWork() : outer_(detail::workState.meter) {
  if (outer_) scope_.emplace(static_cast<WorkMeter&>(*this));
}

bool UncountedWork::look(uint64_t, uint64_t bytes) { return outer_->lookAside(bytes); }

void unwindIfStopped(const Status& status) {
  if (!status.ok() && std::string_view(status.code()) == kWorkStopped) throw Unwinding(status);
}

}  // namespace gable
