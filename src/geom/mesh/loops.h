// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Loops of points in a common plane: helpers of the mesh algorithms that take faces apart and put
// them together again. Loops are lists of indices into points of the caller.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "math/vec.h"

namespace gable {

using IndexLoop = std::vector<uint32_t>;
/// The outer loop first, holes after it.
using LoopFace = std::vector<IndexLoop>;

/// Newell's normal of a loop, times twice its area.
Vec3 loopNormal(const IndexLoop& loop, const std::function<Vec3(uint32_t)>& point);

/// Makes faces of loops: those that run counter-clockwise seen from `normal` are outer, the others
/// holes of the smallest outer loop around them; a hole without one is dropped. Loops with less
/// than `leastArea` are dropped. Order follows the outer loops. O(holes * corners).
std::vector<LoopFace> facesOfLoops(std::vector<IndexLoop> loops, const Vec3& normal,
                                   double leastArea, const std::function<Vec3(uint32_t)>& point);

}  // namespace gable
