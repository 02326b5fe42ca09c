// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/mesh/loft.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geom/mesh/topology.h"
#include "math/trig.h"

namespace gable {
namespace {

ClosedLine ring(int points, double radius, double y, double from = 0) {
  ClosedLine out;
  for (int i = 0; i < points; ++i) {
    const double a = from + 360.0 * i / points;
    out.push_back({radius * cosDeg(a), y, -radius * sinDeg(a)});
  }
  return out;
}

double volumeOf(const Mesh& m) {
  double sum = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const MeshLoop loop = m.loopsOf(f)[0];
    const Vec3 a = m.at(loop.firstCorner);
    for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
      sum += dot(a, cross(m.at(loop.firstCorner + i), m.at(loop.firstCorner + i + 1))) / 6;
    }
  }
  return sum;
}

TEST(Loft, isClosedWhateverTheCounts) {
  for (const int low : {3, 4, 7, 32}) {
    for (const int high : {3, 5, 8, 31}) {
      const Mesh m = loft({ring(low, 2, 0), ring(high, 1, 3, 17), ring(low, 1.5, 5)}, {});
      ASSERT_TRUE(m.valid());
      EXPECT_TRUE(Topology(m).closed()) << low << " " << high;
      EXPECT_GT(volumeOf(m), 0);
      EXPECT_EQ(m.positions.size(), static_cast<size_t>(2 * low + high));
    }
  }
}

TEST(Loft, beginningAndSenseDoNotMatter) {
  const double whole = volumeOf(loft({ring(12, 2, 0), ring(12, 2, 3)}, {}));
  for (int start = 0; start < 12; ++start) {
    ClosedLine high = ring(12, 2, 3);
    std::rotate(high.begin(), high.begin() + start, high.end());
    if (start % 2 == 1) std::reverse(high.begin(), high.end());
    EXPECT_NEAR(volumeOf(loft({ring(12, 2, 0), high}, {})), whole, 1e-9) << start;
  }
}

TEST(Loft, levelBridgesAreFacesOfFour) {
  EXPECT_EQ(loft({ring(6, 2, 0), ring(6, 1, 3)}, {}).faceCount(), 8u);
}

TEST(Loft, aroundHasNoEnds) {
  std::vector<ClosedLine> lines;
  for (int k = 0; k < 16; ++k) {
    ClosedLine line;
    for (int i = 0; i < 5; ++i) {
      const double r = 5 + cosDeg(72.0 * i), y = sinDeg(72.0 * i);
      line.push_back({r * cosDeg(22.5 * k), y, r * sinDeg(22.5 * k)});
    }
    lines.push_back(line);
  }
  LoftOptions o;
  o.around = true;
  const Mesh m = loft(lines, o);
  EXPECT_TRUE(Topology(m).closed());
  EXPECT_GT(std::abs(volumeOf(m)), 60);
}

TEST(Loft, ofOneLineIsNothing) { EXPECT_TRUE(loft({ring(5, 1, 0)}, {}).empty()); }

}  // namespace
}  // namespace gable
