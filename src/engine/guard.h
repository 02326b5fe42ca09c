// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The wall between exceptions and callers: no exception leaves the public interface. What the
// standard library throws inside, above all for want of memory, becomes a diagnostic of a result
// without content. What reads, analyses, writes or draws is a Task besides, with a meter.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/allowance.h"
#include "gable/diagnostic.h"
#include "gable/limits.h"

namespace gable {

/// Something done with a file, within limits. Diagnostics call it by both words: "reading 'a.glb'".
/// Making one needs no memory, of which there may be none.
class Task {
 public:
  /// `object` may be empty; it must outlive the task.
  Task(const char* doing, std::string_view object, const FileLimits& limits);

  Allowance& allowance() { return allowance_; }
  /// The diagnostic for the exception that is being handled.
  Diagnostic diagnosticOfException() const;
  /// The warning for a limit that has ended a part of it.
  Diagnostic warning() const;

 private:
  std::string what() const;

  const char* doing_;
  std::string_view object_;
  Allowance allowance_;
};

/// What is done may ask for its task.
template <class Work>
auto runIn([[maybe_unused]] Task& task, Work&& work) {
  if constexpr (std::is_invocable_v<Work, Task&>) {
    return work(task);
  } else {
    return work();
  }
}

/// The diagnostic for the exception that is being handled. Code: out-of-memory or internal-error.
Diagnostic diagnosticOfException();

/// The result of `work`, or an empty Impl with the reason.
template <class Impl, class Work>
std::shared_ptr<const Impl> guarded(Work&& work) {
  try {
    return work();
  } catch (...) {
    // What `work` held is free again, so this little finds room.
    auto impl = std::make_shared<Impl>();
    impl->diagnostics.push_back(diagnosticOfException());
    return impl;
  }
}

template <class Impl, class Work>
std::shared_ptr<const Impl> guarded(Task&& task, Work&& work) {
  try {
    const WorkScope scope(task.allowance());
    return runIn(task, work);
  } catch (...) {
    auto impl = std::make_shared<Impl>();
    impl->diagnostics.push_back(task.diagnosticOfException());
    return impl;
  }
}

/// The result of `work`, or an empty result with the reason among its diagnostics.
template <class Result, class Work>
Result guardedResult(Work&& work) {
  try {
    return work();
  } catch (...) {
    Result out;
    out.diagnostics.push_back(diagnosticOfException());
    return out;
  }
}

template <class Result, class Work>
Result guardedResult(Task&& task, Work&& work) {
  try {
    const WorkScope scope(task.allowance());
    return runIn(task, work);
  } catch (...) {
    Result out;
    out.diagnostics.push_back(task.diagnosticOfException());
    return out;
  }
}

/// The value of `work`, or an empty one.
template <class Value, class Work>
Value guardedValue(Work&& work) {
  try {
    return work();
  } catch (...) {
    return Value{};
  }
}

}  // namespace gable
