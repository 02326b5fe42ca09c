// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Work: how long loops stop when their time is over.
//
// A loop whose length a rule can choose calls work(), and who makes room for a number that a rule
// chose asks workMemory() before. Where a WorkMeter is installed on the thread, both look at its
// limits every so often, and unwind by an Unwinding when one of them is reached. Where none is
// installed they cost next to nothing and never stop.
//
//   for (const Edge& e : edges) {
//     work();
//     ...
//   }
//
// The Unwinding is caught by guarded(), which turns it into a Status, and by nothing else. So what
// calls work() must be written such that it can be left at any time: what it owns, objects own.
// Neither is called in a destructor, in a function that is noexcept, or under a lock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "base/status.h"

namespace gable {

/// Who knows the limits of what a thread is at.
class WorkMeter {
 public:
  /// Called about every kWorkBetweenLooks units of work, with the units since the call before, and
  /// before so many bytes are taken. False when it is time to stop.
  virtual bool look(uint64_t units, uint64_t bytes) = 0;
  /// The same for work that does not count: nothing that is counted may change by it, nor be held
  /// against a limit.
  virtual bool lookAside(uint64_t bytes) { return look(0, bytes); }

 protected:
  ~WorkMeter() = default;
};

/// A unit is a pass through a small loop: some nanoseconds, a microsecond at most.
constexpr int64_t kWorkBetweenLooks = 4096;

/// What unwinds the stack from within a geometric kernel or an operation, up to guarded().
class Unwinding {
 public:
  explicit Unwinding(Status why) : why_(std::move(why)) {}
  const Status& why() const { return why_; }

 private:
  Status why_;
};

/// The code of the Status that guarded() returns when a meter said stop. It is no diagnostic: who
/// installed the meter knows the reason.
extern const char* const kWorkStopped;

/// Ends what is being done: it cannot be done. For kernels whose results have no room for a Status.
[[noreturn]] void giveUp(const char* code, std::string message, std::string hint = {});

namespace detail {

struct WorkState {
  /// Units until the next look.
  int64_t left = std::numeric_limits<int64_t>::max();
  WorkMeter* meter = nullptr;
};
inline constinit thread_local WorkState workState;

void lookAtLimits(uint64_t bytes);
Status statusOfException();

}  // namespace detail

/// Counts work; see above.
inline void work(size_t units = 1) {
  detail::workState.left -= static_cast<int64_t>(units);
  if (detail::workState.left < 0) [[unlikely]] {
    detail::lookAtLimits(0);
  }
}

/// Tells that so many bytes are about to be taken. Unwinds when there is no room for them.
inline void workMemory(uint64_t bytes) {
  constexpr uint64_t kLittle = uint64_t{1} << 16;
  if (bytes >= kLittle) detail::lookAtLimits(bytes);
}

/// Room for `count` elements more in a vector, by a number that a rule chose.
template <class Vector>
void reserveWork(Vector& v, double count) {
  constexpr double kMost = 1e15;
  using Element = typename Vector::value_type;
  const double bytes = count * static_cast<double>(sizeof(Element));
  if (!(bytes <= kMost)) workMemory(std::numeric_limits<uint64_t>::max() / 2);
  if (!(count > 0)) return;
  workMemory(static_cast<uint64_t>(bytes));
  v.reserve(v.size() + static_cast<size_t>(count));
}

/// Connects work() on this thread to a meter as long as it lives. Scopes nest.
class WorkScope {
 public:
  explicit WorkScope(WorkMeter& meter) : before_(detail::workState) {
    detail::workState = {kWorkBetweenLooks, &meter};
  }
  ~WorkScope() { detail::workState = before_; }
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  detail::WorkState before_;
};

/// The door: runs what may unwind, and returns how it ended. Memory that the system refuses and
/// exceptions of libraries become a Status as well.
template <class Body>
Status guarded(Body&& body) {
  try {
    return body();
  } catch (...) {
    return detail::statusOfException();
  }
}

}  // namespace gable
