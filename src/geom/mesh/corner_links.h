// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The face of each corner of a mesh, and the corners before and after it in its loop.
#pragma once

#include <cstdint>
#include <vector>

#include "base/work.h"
#include "geom/mesh/mesh.h"

namespace gable {

/// What a corner has that no loop holds.
constexpr uint32_t kNoCornerLink = 0xffffffff;

/// Fills in all three by corner. O(corners).
inline void linkCorners(const Mesh& m, std::vector<uint32_t>& face, std::vector<uint32_t>& next,
                        std::vector<uint32_t>& previous) {
  for (std::vector<uint32_t>* list : {&face, &next, &previous}) {
    list->assign(m.corners.size(), kNoCornerLink);
  }
  for (uint32_t f = 0; f < m.faceCount(); ++f) {
    for (const MeshLoop& loop : m.loopsOf(f)) {
      work(4 * loop.cornerCount);
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const uint32_t c = loop.firstCorner + i;
        const uint32_t after = loop.firstCorner + (i + 1) % loop.cornerCount;
        face[c] = f;
        next[c] = after;
        previous[after] = c;
      }
    }
  }
}

}  // namespace gable
