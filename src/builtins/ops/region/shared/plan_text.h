// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands at the crossings of a grid, as a text of alternatives:
//
//   romb(3)                                  at all
//   30%: romb(3) | circle(2) | none          drawn for each; what has no share shares the rest
//   case ix == 0 && by != 1: romb(3) | circle(2)   by place, else drawn from the others
//
// Conditions compare ix, iy, nx, ny (crossings, not cells), bx and by with numbers, joined by &&
// and
// ||, which binds less.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geom/region/grid_partition.h"
#include "geom/region/smooth.h"

namespace gable {

/// False when the text cannot be read; `problem` says why.
bool readJunctions(std::string_view text, std::vector<JunctionChoice>& out, std::string& problem);

/// Smoothing by a text: none, average(2, 0.33), chaikin(2), bezier, round(1).
bool readSmoothing(std::string_view text, Smoothing& out);

}  // namespace gable
