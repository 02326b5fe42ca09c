// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Chunks of a scene that is drawn: runs of leaves in path order, each with a hash of all that is
// drawn of it and where it stands.
#pragma once

#include <cstdint>
#include <vector>

#include "io/exporters/draw_plan.h"

namespace gable {

struct DrawChunk {
  uint64_t key = 0;
  uint32_t leaves = 0;
};

/// All leaves of the plan's scene. Visits what is stored, and of what is flattened only what is
/// larger than a chunk.
std::vector<DrawChunk> chunksOf(const DrawPlan& plan, unsigned jobs);

}  // namespace gable
