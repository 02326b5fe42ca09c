// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/connect.h"

#include <gtest/gtest.h>

#include "geom/mesh/topology.h"

namespace gable {
namespace {

// A plate from x to x + w, from z to z + d.
void addPlate(Mesh& m, double x, double z, double w, double d) {
  Frame f;
  f.origin = {x, 0, z};
  append(m, transformed(makeQuadMesh(w, d, QuadPlane::Xz, true), {1, 1, 1}, f));
}

TEST(Connect, facesThatTouchShareVerticesAndEdges) {
  Mesh m;
  addPlate(m, 0, 0, 1, 2);
  addPlate(m, 1, 0, 1, 1);
  addPlate(m, 1, 1, 1, 1);
  const Mesh c = connected(m);
  EXPECT_TRUE(c.valid());
  EXPECT_EQ(c.faceCount(), 3u);
  EXPECT_EQ(c.positions.size(), 8u);
  // The first one has a vertex where the others meet.
  EXPECT_EQ(c.corners.size(), 13u);
  EXPECT_NEAR(c.area(), 4, 1e-12);
  EXPECT_NEAR(boundaryLength(c), 8, 1e-12);
  EXPECT_EQ(Topology(c).componentCount(), 1u);
}

TEST(Connect, uvsOfNewVerticesLieBetweenTheirNeighbours) {
  Mesh m;
  addPlate(m, 0, 0, 1, 4);
  addPlate(m, 1, 0, 1, 1);
  const Mesh c = connected(m);
  ASSERT_TRUE(c.hasUv(0));
  size_t between = 0;
  for (const uint32_t k : {0u, 1u, 2u, 3u, 4u}) {
    if (!(c.at(k) == Vec3{1, 0, 1})) continue;
    ++between;
    EXPECT_NEAR(c.uvs[0][k].x, 1, 1e-12);
    EXPECT_NEAR(c.uvs[0][k].y, 0.75, 1e-12);
  }
  EXPECT_EQ(between, 1u);
}

TEST(Connect, aSplitBoxBecomesOneMesh) {
  Mesh m;
  for (int k = 0; k < 3; ++k) {
    Frame f;
    f.origin = {1.0 * k, 0, 0};
    append(m, transformed(makeBoxMesh({1, 1, 1}, true), {1, 1, 1}, f));
  }
  const Mesh c = connected(m);
  EXPECT_EQ(c.positions.size(), 16u);
  EXPECT_EQ(c.faceCount(), 18u);
}

TEST(Connect, edgesAndPointsStay) {
  MeshBuilder b;
  const uint32_t p = b.addPosition({0, 0, 0}), q = b.addPosition({2, 0, 0});
  const uint32_t r = b.addPosition({1, 0, 0});
  b.addPolygon(std::vector<uint32_t>{p, q});
  b.addPolygon(std::vector<uint32_t>{r});
  const Mesh c = connected(b.take());
  EXPECT_TRUE(c.valid());
  EXPECT_EQ(c.faceCount(), 2u);
  EXPECT_EQ(c.corners.size(), 3u);
}

}  // namespace
}  // namespace gable
