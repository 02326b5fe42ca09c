// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The wall between exceptions and callers: no exception leaves the public interface. What the
// standard library throws inside, above all for want of memory, becomes a diagnostic of a result
// without content.
#pragma once

#include <memory>
#include <utility>

#include "gable/diagnostic.h"

namespace gable {

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
