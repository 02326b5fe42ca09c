// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/sampler.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace gable::rt {
namespace {

/// Whether each cell of each division of the square into as many equal ones as there are points, a
/// power of 2, has one of them.
bool isNet(const std::vector<Vec2f>& points) {
  for (size_t across = 1; across <= points.size(); across *= 2) {
    const size_t down = points.size() / across;
    std::set<std::pair<size_t, size_t>> cells;
    for (const Vec2f& p : points) {
      cells.emplace(static_cast<size_t>(p.x * static_cast<float>(across)),
                    static_cast<size_t>(p.y * static_cast<float>(down)));
    }
    if (cells.size() != points.size()) return false;
  }
  return true;
}

TEST(Sampler, samplesOfAPixelAreNets) {
  for (const uint32_t count : {2u, 4u, 16u}) {
    std::vector<Vec2f> points;
    for (uint32_t s = 0; s < count; ++s) points.push_back(Sampler(5, 7, s, 1).point(3));
    EXPECT_TRUE(isNet(points)) << count;
  }
}

TEST(Sampler, pointsOfABlockAreNetsAcrossPixelsAndSamples) {
  for (const uint32_t seed : {1u, 2u, 77u}) {
    std::vector<Vec2f> block, all;
    for (uint32_t s = 0; s < 4; ++s) {
      block.clear();
      for (uint32_t k = 0; k < 16; ++k)
        block.push_back(pointOfBlock(8 + k % 4, 4 + k / 4, s, seed));
      EXPECT_TRUE(isNet(block)) << s;
      EXPECT_TRUE(isNet({block[2], block[3], block[6], block[7]})) << "the square at its right";
      all.insert(all.end(), block.begin(), block.end());
    }
    EXPECT_TRUE(isNet(all));
    EXPECT_TRUE(isNet({all[5], all[21], all[37], all[53]})) << "the samples of a pixel";
  }
}

}  // namespace
}  // namespace gable::rt
