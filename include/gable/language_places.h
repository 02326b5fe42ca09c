// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Places in a text, as editors count them.
#pragma once

#include <cstdint>

namespace gable::language {

/// As editors count: lines from 0, characters from 0 in units of UTF-16.
struct Position {
  uint32_t line = 0, character = 0;
  bool operator==(const Position&) const = default;
};

struct Range {
  Position begin, end;
  bool operator==(const Range&) const = default;
};

}  // namespace gable::language
