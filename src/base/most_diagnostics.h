// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How many diagnostics are told at once.
#pragma once

#include <cstddef>

namespace gable {

/// So many errors, and as many warnings, of one analysis, one derivation or one file that is read:
/// a reader needs no more, and memory stays bounded. The first are kept, by place or in path order.
inline constexpr size_t kMostDiagnostics = 1000;

}  // namespace gable
