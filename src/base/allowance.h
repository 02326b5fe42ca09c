// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Allowance: the meter of what is no derivation, such as reading a file, analysing rules, writing
// or drawing a model. It holds the clock, the growth of memory and a wish to stop against limits.
//
//   Allowance allowance({20.0, 1u << 30});
//   const WorkScope scope(allowance);
//   const Status status = guarded([&] { return readAll(); });
//   if (allowance.reached()) ... allowance.reason("reading 'a.glb'") ...
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/result.h"
#include "base/work.h"

namespace gable {

class Allowance final : public WorkMeter {
 public:
  struct Most {
    /// Of wall-clock time.
    std::optional<double> seconds;
    /// By which the process may grow.
    std::optional<uint64_t> bytes;
    /// May be null.
    const std::atomic<bool>* cancel = nullptr;
  };
  /// The clock starts.
  explicit Allowance(const Most& most);

  /// Any thread may call. Once false, always false.
  bool look(uint64_t units, uint64_t bytes) override;
  bool reached() const { return reached_.load(std::memory_order_relaxed) != Reached::No; }
  /// What was reached, of what is called "reading 'a.glb'". Codes: out-of-time, out-of-memory,
  /// was-cancelled.
  Error reason(const std::string& what) const;

 private:
  enum class Reached : uint8_t { No, Time, Memory, Cancel };
  Reached find(uint64_t bytes);

  const Most most_;
  const std::chrono::steady_clock::time_point start_;
  const uint64_t bytesBefore_;
  /// When memory was looked at, in nanoseconds of the clock.
  std::atomic<int64_t> memoryLooked_{0};
  std::atomic<Reached> reached_{Reached::No};
};

/// While it lives, work is not counted by the meter of the thread, which still says when to stop:
/// for what is done once and kept, by whoever comes first.
class UncountedWork final : private WorkMeter {
 public:
  UncountedWork();

 private:
  bool look(uint64_t units, uint64_t bytes) override;

  WorkMeter* const outer_;
  std::optional<WorkScope> scope_;
};

/// For who calls guarded() below another: goes on unwinding where a meter said stop.
void unwindIfStopped(const Status& status);

}  // namespace gable
