// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/topology.h"

#include <gtest/gtest.h>

#include "geom/mesh/face_plane.h"

namespace gable {
namespace {

TEST(Topology, boxIsClosedAndConvex) {
  const Mesh m = makeBoxMesh({2, 3, 5}, false);
  const Topology t(m);
  EXPECT_EQ(t.edgeCount(), 12u);
  EXPECT_TRUE(t.closed());
  EXPECT_EQ(t.componentCount(), 1u);
  EXPECT_TRUE(t.componentEncloses(0));
  for (uint32_t e = 0; e < 12; ++e) {
    EXPECT_DOUBLE_EQ(t.dihedralAngle(e), 90);
    const uint32_t c = t.usesOf(e)[0];
    EXPECT_EQ(t.twin(t.twin(c)), c);
    EXPECT_NE(t.faceOf(c), t.faceOf(t.twin(c)));
    EXPECT_EQ(t.previous(t.next(c)), c);
  }
  EXPECT_DOUBLE_EQ(volume(m), 30);
  EXPECT_DOUBLE_EQ(boundaryLength(m), 0);
}

TEST(Topology, turningTheBoxInsideOutMakesEdgesConcave) {
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  for (size_t f = 0; f < 6; ++f) reverseFace(m, f);
  EXPECT_DOUBLE_EQ(Topology(m).dihedralAngle(0), -90);
  EXPECT_DOUBLE_EQ(volume(m), -1);
}

TEST(Topology, boundariesAndComponents) {
  Mesh m = makeQuadMesh(2, 3, QuadPlane::Xy, false);
  append(m, makeBoxMesh({1, 1, 1}, false));
  const Topology t(m);
  EXPECT_FALSE(t.closed());
  ASSERT_EQ(t.componentCount(), 2u);
  EXPECT_FALSE(t.componentEncloses(0));
  EXPECT_TRUE(t.componentEncloses(1));
  EXPECT_TRUE(t.isBoundary(t.edgeOf(0)));
  EXPECT_DOUBLE_EQ(boundaryLength(m), 10);
}

TEST(Topology, threeFacesAtAnEdgeHaveNoTwins) {
  MeshBuilder b;
  for (const Vec3& p :
       {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
    b.addPosition(p);
  }
  const uint32_t faces[3][3] = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  for (const auto& f : faces) b.addPolygon(f);
  const Mesh m = b.take();
  const Topology t(m);
  EXPECT_EQ(t.usesOf(t.edgeOf(0)).size(), 3u);
  EXPECT_EQ(t.twin(0), Topology::kNone);
}

TEST(Measures, concavePlanarRectangular) {
  const Mesh box = makeBoxMesh({1, 2, 3}, false);
  EXPECT_FALSE(isConcave(box));
  EXPECT_TRUE(isPlanar(box, 0.25));
  EXPECT_TRUE(isRectangular(box, 1));
  const Mesh dart = meshOf({{{{0, 0}, {4, 0}, {1, 1}, {0, 4}}, {}}}, Frame());
  EXPECT_TRUE(isConcave(dart));
  EXPECT_FALSE(isRectangular(dart, 1));
  const Polygon holed{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};
  const Mesh withHole = meshOf({holed}, Frame());
  EXPECT_TRUE(isConcave(withHole));
  EXPECT_EQ(holeCount(withHole), 1u);
  EXPECT_TRUE(isPlanar(withHole, 0.25));
  Mesh warped = makeQuadMesh(1, 1, QuadPlane::Xy, false);
  warped.positions[2].z = 0.1;
  EXPECT_FALSE(isPlanar(warped, 0.25));
  EXPECT_TRUE(isPlanar(warped, 15));
  EXPECT_FALSE(isPlanar(Mesh(), 1));
}

TEST(Measures, vertexNormalsOfABoxPointToItsCorners) {
  const Mesh m = makeBoxMesh({1, 1, 1}, false);
  const std::vector<Vec3> n = vertexNormals(m);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(length(n[i] - normalized(m.positions[i] - Vec3{0.5, 0.5, 0.5})), 0, 1e-12);
  }
}

TEST(Measures, softenNormalsKeepsEdgesThatAreSharpEnough) {
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  softenNormals(m, 30);
  EXPECT_EQ(m.normals[0], (Vec3{0, -1, 0}));
  softenNormals(m, 180);
  EXPECT_NEAR(length(m.normals[0] - normalized(Vec3{-1, -1, -1})), 0, 1e-12);
}

}  // namespace
}  // namespace gable
