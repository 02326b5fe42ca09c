// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geom/mesh/topology.h"
#include "geom/primitive/solids.h"

namespace gable {
namespace {

/// A sheet of n x n squares over [0, n], with heights and uvs.
template <class Height>
Mesh sheet(int n, Height height) {
  MeshBuilder b;
  const auto at = [&](int x, int y) { return static_cast<uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      b.addPosition({double(x), height(double(x), double(y)), -double(y)});
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const uint32_t ring[] = {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
      b.beginFace();
      b.beginLoop();
      for (const uint32_t p : ring) {
        const uint32_t corner = b.addCorner(p);
        b.setUv(corner, 0, {b.mesh().positions[p].x, -b.mesh().positions[p].z});
      }
    }
  }
  return b.take();
}

size_t usedVertices(const Mesh& m) {
  std::vector<char> used(m.positions.size(), 0);
  for (const uint32_t c : m.corners) used[c] = 1;
  return static_cast<size_t>(std::count(used.begin(), used.end(), 1));
}

TEST(Simplify, aFlatSheetKeepsItsOutlineAndUvs) {
  const Mesh m = sheet(10, [](double, double) { return 0.0; });
  const Mesh s = simplified(m, 0.9);
  EXPECT_TRUE(s.valid());
  EXPECT_LE(usedVertices(s), 16u);
  EXPECT_NEAR(s.area(), 100, 1e-9);
  for (size_t c = 0; c < s.corners.size(); ++c) {
    EXPECT_EQ(s.uvs[0][c], (Vec2{s.positions[s.corners[c]].x, -s.positions[s.corners[c]].z}));
  }
}

TEST(Simplify, theShareOfVerticesGoes) {
  const auto bumps = [](double x, double y) { return 0.1 * (x - 5) * (x - 5) + 0.05 * x * y; };
  const Mesh m = sheet(20, bumps);
  for (const double share : {0.0, 0.2, 0.5, 0.8}) {
    const Mesh s = simplified(m, share);
    EXPECT_TRUE(s.valid());
    EXPECT_EQ(usedVertices(s), static_cast<size_t>(std::ceil(441 * (1 - share)))) << share;
    EXPECT_NEAR(s.area(), m.area(), 0.01 * m.area()) << share;
  }
  EXPECT_EQ(simplified(m, 0).faceCount(), m.faceCount());
}

TEST(Simplify, closedMeshesStayClosedAndWhole) {
  const Mesh round = makeSphere(32, 16), box = makeBoxMesh({2, 3, 4}, true);
  for (const Mesh* m : {&round, &box}) {
    for (const double share : {0.0, 0.3, 0.8, 1.0}) {
      const Mesh s = simplified(*m, share);
      EXPECT_TRUE(s.valid());
      EXPECT_GE(s.faceCount(), 4u);
      EXPECT_TRUE(Topology(s).closed()) << share;
      EXPECT_GT(volume(s), 0.8 * volume(*m) * (share < 1 ? 1 : 0)) << share;
    }
  }
}

TEST(Simplify, materialsKeepTheirBorder) {
  Mesh m = sheet(8, [](double, double) { return 0.0; });
  for (size_t f = 0; f < m.faceCount(); ++f) m.faces[f].materialSlot = f % 8 < 4 ? 0 : 1;
  const Mesh s = simplified(m, 0.85);
  double one = 0;
  for (size_t f = 0; f < s.faceCount(); ++f) {
    if (s.faces[f].materialSlot == 1) one += s.area(f);
  }
  EXPECT_NEAR(one, 32, 1e-9);
  EXPECT_NEAR(s.area(), 64, 1e-9);
}

}  // namespace
}  // namespace gable
