// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Usage: what all workers of a derivation have used up together, held against its limits.
//
// Limits on counts (shapes, steps, vertices, turns) are reached at the same place whenever the same
// work is done in the same order. Several workers at once do some work twice, so they never use up
// less than one: what one worker may do alone decides, see derive(). Limits on time, on memory and
// on the room in the tables are reached where they are reached.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace gable {

struct Limits;

class Usage {
 public:
  /// All must outlive the usage. `cancel` may be null.
  Usage(const Limits& limits, const std::atomic<bool>* cancel);

  /// What one worker did since it told the last time.
  struct Use {
    uint64_t shapes = 0, steps = 0, vertices = 0;
    /// Turns of `repeat` and rules run in place.
    uint64_t turns = 0;
  };
  /// A limit that has been reached, as a message tells it.
  struct Excess {
    const char* code;
    std::string message, hint;
  };

  /// Adds to what has been used; the first limit that is exceeded then, if any. Any thread may
  /// call.
  std::optional<Excess> spend(const Use& use);
  /// The same of time alone.
  std::optional<Excess> lookAtClock();
  /// The same of memory, which costs microseconds to find out.
  /// `bytes`: so many are about to be taken.
  std::optional<Excess> lookAtMemory(uint64_t bytes = 0);
  /// A table has no room for something new.
  Excess tablesAreFull();
  bool cancelled() const;

  /// Nobody begins anything any more.
  void exhaust() { exhausted_.store(true, std::memory_order_relaxed); }
  /// A limit has been reached by all together.
  bool exhausted() const { return exhausted_.load(std::memory_order_relaxed); }
  /// One on counts was among them.
  bool exhaustedByCount() const { return byCount_.load(std::memory_order_relaxed); }
  /// All counts begin anew. The clock goes on.
  void startAgain();

 private:
  Excess exceed(const char* code, std::string message, std::string hint);
  Excess exceedCount(const char* code, std::string message, std::string hint);

  const Limits& limits_;
  const std::atomic<bool>* cancel_;
  const std::chrono::steady_clock::time_point start_;
  /// What the process held before.
  const uint64_t bytesBefore_;
  std::atomic<uint64_t> shapes_{0}, steps_{0}, vertices_{0}, turns_{0};
  std::atomic<bool> exhausted_{false}, byCount_{false};
};

}  // namespace gable
