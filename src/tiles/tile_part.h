// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parts as files, by which one process hands on what has come of a unit to another. A part names
// the plan that it belongs to, and ends in a checksum: a file that is cut off, damaged or of
// another plan is no part.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tiles/tile_tree.h"

namespace gable {

std::string partBytes(const TilePart& part, uint64_t plan);

/// Absent where the bytes are no part of the plan.
std::optional<TilePart> partOf(std::string_view bytes, uint64_t plan);

/// The first of the files of a part that is not as it was written; empty where all are.
std::string damagedFile(const TilePart& part, const std::string& folder);

}  // namespace gable
