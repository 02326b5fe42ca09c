// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/cleanup.h"

#include <gtest/gtest.h>

#include "geom/mesh/extrude.h"
#include "geom/mesh/face_plane.h"
#include "geom/mesh/face_triangles.h"
#include "geom/mesh/topology.h"
#include "geom/mesh/uv.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

// The triangles of a mesh as faces with positions of their own, as a careless exporter writes them.
Mesh soup(const Mesh& m) {
  MeshBuilder b;
  std::vector<std::array<uint32_t, 3>> triangles;
  FaceTriangulator triangulator;
  for (size_t f = 0; f < m.faceCount(); ++f) triangulator.add(m, f, triangles);
  for (const auto& t : triangles) {
    b.beginFace();
    b.beginLoop();
    for (const uint32_t c : t) {
      const uint32_t corner = b.addCorner(b.addPosition(m.at(c)));
      if (m.hasUv(0)) b.setUv(corner, 0, m.uvs[0][c]);
    }
  }
  return b.take();
}

TEST(Cleanup, aTriangulatedBoxBecomesABox) {
  Mesh m = soup(makeBoxMesh({2, 3, 5}, true));
  ASSERT_EQ(m.faceCount(), 12u);
  const FaceSources sources = cleanup(m, {});
  EXPECT_EQ(m.faceCount(), 6u);
  EXPECT_EQ(m.positions.size(), 8u);
  EXPECT_TRUE(Topology(m).closed());
  EXPECT_DOUBLE_EQ(volume(m), 30);
  EXPECT_EQ(sources, (FaceSources{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(uvBounds(m, 0).max, (Vec2{1, 1}));
}

TEST(Cleanup, holesComeBack) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};
  Mesh m = soup(meshOf({p}, Frame()));
  cleanup(m, {});
  EXPECT_EQ(m.faceCount(), 1u);
  EXPECT_EQ(holeCount(m), 1u);
  EXPECT_DOUBLE_EQ(m.area(), 15);
}

TEST(Cleanup, uvJumpsTagsAndMaterialsKeepFacesApart) {
  const Mesh clean = soup(makeQuadMesh(1, 1, QuadPlane::Xy, true));
  Mesh jump = clean, bent = clean, tagged = clean, edge = clean, slot = clean;
  jump.uvs[0][3] = {5, 5};
  for (uint32_t c = 0; c < 6; ++c) {
    if (bent.at(c) == Vec3{0, 1, 0}) bent.uvs[0][c] = {0.3, 2};
  }
  tagged.faces[0].tags = 1;
  edge.edgeTags = {0, 0, 1, 0, 0, 0};
  slot.faces[1].materialSlot = 1;
  for (Mesh* m : {&jump, &bent, &tagged, &edge, &slot}) {
    cleanup(*m, {});
    EXPECT_EQ(m->faceCount(), 2u);
  }
  Mesh free = clean;
  cleanup(free, {});
  EXPECT_EQ(free.faceCount(), 1u);
}

TEST(Cleanup, collinearVerticesGoOnlyWhereAllFacesAgree) {
  MeshBuilder b;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 0}, Vec3{1, 1, 0},
                        Vec3{0, 1, 0}, Vec3{1, 2, 1}}) {
    b.addPosition(p);
  }
  const uint32_t low[] = {0, 1, 2, 3, 4, 5}, left[] = {5, 4, 6}, right[] = {4, 3, 6};
  b.addPolygon(low);
  b.addPolygon(left);
  b.addPolygon(right);
  Mesh m = b.take();
  removeCollinearVertices(m, 0);
  // Position 1 goes, position 4 is a corner of two other faces.
  EXPECT_EQ(m.loops[0].cornerCount, 5u);
  EXPECT_EQ(m.positions.size(), 6u);
}

TEST(Cleanup, aVertexStaysWhereUvOrTagsChange) {
  Mesh m = meshOf({{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}}, Frame());
  Mesh tagged = m;
  tagged.edgeTags = {1, 0, 0, 0, 0};
  removeCollinearVertices(tagged, 0);
  EXPECT_EQ(tagged.corners.size(), 5u);
  Mesh mapped = m;
  projectUv(mapped, 0, {}, {1, 0, 0}, {0, 1, 0});
  mapped.uvs[0][1].x = 0.2;
  removeCollinearVertices(mapped, 0);
  EXPECT_EQ(mapped.corners.size(), 5u);
  projectUv(mapped, 0, {}, {1, 0, 0}, {0, 1, 0});
  removeCollinearVertices(mapped, 0);
  EXPECT_EQ(mapped.corners.size(), 4u);
}

TEST(Cleanup, degenerateAndDuplicateFacesGo) {
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  append(m, makeBoxMesh({1, 1, 1}, false));
  append(m, meshOf({{{{0, 0}, {1, 0}, {2, 0}}, {}}}, Frame()));
  mergePositions(m, 0);
  dropDuplicateFaces(m);
  EXPECT_EQ(m.faceCount(), 7u);
  dropDegenerateFaces(m, 0);
  EXPECT_EQ(m.faceCount(), 6u);
  dropDegenerateFaces(m, 1);
  EXPECT_TRUE(m.empty());
}

TEST(Cleanup, nearPositionsMergeAndCollapsedEdgesGo) {
  Mesh m = meshOf({{{{0, 0}, {1, 0}, {1.0005, 0.0005}, {1, 1}, {0, 1}}, {}}}, Frame());
  mergePositions(m, 0.001);
  EXPECT_EQ(m.corners.size(), 4u);
  mergePositions(m, 5);
  EXPECT_TRUE(m.empty());
  EXPECT_TRUE(m.positions.empty());
}

TEST(Cleanup, farPositionsAreNoTrouble) {
  Mesh m = makeBoxMesh({1e300, 1e25, 1}, false);
  mergePositions(m, 0);
  EXPECT_EQ(m.positions.size(), 8u);
}

TEST(Cleanup, aRoundDrumKeepsItsSides) {
  Ring circle;
  for (int i = 0; i < 72; ++i) circle.push_back({cosDeg(i * 5.0), sinDeg(i * 5.0)});
  Mesh drum = extrude(meshOf({{circle, {}}}, Frame()), {ExtrudeMode::FaceNormal, 1, {}}).mesh;
  mergeCoplanarFaces(drum, 10);
  // At most five sides of 5 degrees each agree with their seed within 10 degrees.
  EXPECT_GE(drum.faceCount(), 2u + 72 / 5);
  EXPECT_TRUE(Topology(drum).closed());
}

TEST(Cleanup, corpusPrismsComeBackFromTriangleSoup) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus(4);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  size_t whole = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const Mesh solid = extrude(meshOf({p}, Frame()), {ExtrudeMode::FaceNormal, 3, {}}).mesh;
    Mesh m = soup(solid);
    cleanup(m, {});
    ASSERT_TRUE(m.valid()) << i;
    ASSERT_TRUE(Topology(m).closed()) << i;
    // Vertices within a thousandth of a degree of straight go.
    ASSERT_NEAR(volume(m), volume(solid), 1e-4 * volume(solid)) << i;
    whole += m.faceCount() <= solid.faceCount() ? 1 : 0;
  }
  // Slivers of rounding may keep a face in two.
  EXPECT_GE(whole * 100, cases.size() * 98);
}

}  // namespace
}  // namespace gable
