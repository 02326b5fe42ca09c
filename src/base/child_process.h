// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Another program as a function from bytes to bytes: it gets its input, and what it writes comes
// back. It cannot hold us up: its time and its output are limited, and whatever becomes of it ends
// in a result. The program limits its own memory.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace gable {

struct ChildLimits {
  double seconds = 60;
  size_t outputBytes = size_t{1} << 29;
};

/// A program of ours: beside the running one, beside the library, or on the PATH. Empty where there
/// is none.
std::string programBeside(const std::string& name);

/// Runs `program` with arguments; its diagnostics are lost. Codes: child-missing (it cannot be
/// started), child-failed (it ended with an error, or broke off), child-limit (of time or output).
/// An Unwinding of work() ends it as well.
Result<std::string> runChild(const std::string& program, const std::vector<std::string>& arguments,
                             std::string_view input, const ChildLimits& limits);

}  // namespace gable
