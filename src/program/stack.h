// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What compiler and machine agree on about the stack of values.
#pragma once

#include <cstdint>

namespace gable {

/// Values that the code of one rule or function may have on the stack at once. The compiler holds
/// code to it, and the machine keeps as much room free.
inline constexpr uint32_t kMostOnStack = 1u << 17;

}  // namespace gable
