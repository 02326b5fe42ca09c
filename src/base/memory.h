// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How much memory the program holds at the moment, for limits that watch its growth.
#pragma once

#include <cstdint>

namespace gable {

/// Bytes of memory that the process holds (its resident set), or 0 where the system does not tell.
/// Takes a few microseconds.
uint64_t residentBytes();

}  // namespace gable
