// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How much memory the program holds at the moment, for limits that watch its growth; and pages of
// memory before they are written.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gable {

/// Bytes of memory that the process holds (its resident set), or 0 where the system does not tell.
/// Takes a few microseconds.
uint64_t residentBytes();

/// Has the system give out the pages of [begin, begin + bytes) now instead of when each is first
/// written, and leaves what is written there as it is, so other threads may write meanwhile. False
/// where the system cannot; nothing else differs then.
bool populate(void* begin, size_t bytes);

}  // namespace gable
