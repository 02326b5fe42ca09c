// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/primitive/solids.h"

#include <gtest/gtest.h>

#include "geom/mesh/topology.h"
#include "math/trig.h"

namespace gable {
namespace {

double polygonArea(uint32_t sides) { return sides / 2.0 * sinDeg(360.0 / sides); }

// Corner normals look to the same side as their face.
bool normalsAgree(const Mesh& m) {
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const Vec3 normal = m.normal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const Vec3& n = m.normals[loop.firstCorner + i];
        if (std::fabs(length(n) - 1) > 1e-12 || dot(n, normal) < 0.4) return false;
      }
    }
  }
  return true;
}

TEST(Solids, areClosedOutwardAndSmooth) {
  for (const uint32_t sides : {3u, 4u, 7u, 16u}) {
    for (const Mesh& m :
         {makeCylinder(sides), makeCone(sides), makeSphere(sides, 2), makeSphere(sides, 5)}) {
      ASSERT_TRUE(m.valid());
      EXPECT_TRUE(Topology(m).closed());
      EXPECT_GT(volume(m), 0);
      EXPECT_TRUE(normalsAgree(m));
      EXPECT_EQ(m.uvs[0].size(), m.corners.size());
    }
  }
}

TEST(Solids, countsAndVolumes) {
  EXPECT_EQ(makeCylinder(16).faceCount(), 18u);
  EXPECT_EQ(makeCylinder(16).positions.size(), 32u);
  EXPECT_NEAR(volume(makeCylinder(16)), polygonArea(16), 1e-12);
  EXPECT_EQ(makeCone(8).faceCount(), 9u);
  EXPECT_NEAR(volume(makeCone(8)), polygonArea(8) / 3, 1e-12);
  EXPECT_EQ(makeSphere(16, 16).faceCount(), 256u);
  EXPECT_EQ(makeSphere(16, 16).positions.size(), 242u);
  EXPECT_NEAR(volume(makeSphere(200, 200)), 4 * kPi / 3, 0.002);
  EXPECT_EQ(makeDisk(16).faceCount(), 1u);
  EXPECT_EQ(makeDisk(16).normal(0), (Vec3{0, 1, 0}));
}

TEST(Solids, polesAreTriangles) {
  const Mesh m = makeSphere(8, 4);
  size_t triangles = 0;
  for (const MeshLoop& loop : m.loops) triangles += loop.cornerCount == 3 ? 1 : 0;
  EXPECT_EQ(triangles, 16u);
}

TEST(Solids, uRunsToTheRightAndVUpSeenFromOutside) {
  for (const Mesh& m : {makeCylinder(8), makeSphere(8, 6)}) {
    for (size_t f = 0; f < m.faceCount(); ++f) {
      const MeshLoop& loop = m.loopsOf(f)[0];
      const Vec3 normal = m.normal(f);
      if (loop.cornerCount != 4 || std::fabs(normal.y) > 0.9) continue;
      const uint32_t c = loop.firstCorner;
      EXPECT_GT(m.uvs[0][c + 1].x, m.uvs[0][c].x);
      EXPECT_GT(m.uvs[0][c + 3].y, m.uvs[0][c].y);
      EXPECT_GT(dot(cross(m.at(c + 1) - m.at(c), Vec3{0, 1, 0}), normal), 0);
    }
  }
}

}  // namespace
}  // namespace gable
