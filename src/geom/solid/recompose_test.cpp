// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/recompose.h"

#include <gtest/gtest.h>

#include "geom/mesh/clip.h"
#include "geom/mesh/origins.h"
#include "geom/mesh/topology.h"

namespace gable {
namespace {

// A face of a box as a part of its own, moved.
Mesh faceOf(const Mesh& box, size_t face, uint32_t component, const Vec3& by) {
  MeshBuilder b;
  std::vector<uint32_t> map;
  b.copyFace(box, face, map);
  Mesh m = b.take();
  noteOrigins(m, component + 1);
  for (Vec3& p : m.positions) p += by;
  return m;
}

Mesh without(const Mesh& box, size_t face) {
  MeshBuilder b;
  std::vector<uint32_t> map;
  for (size_t f = 0; f < box.faceCount(); ++f) {
    if (f != face) b.copyFace(box, f, map);
  }
  return b.take();
}

size_t topOf(const Mesh& box) {
  for (size_t f = 0; f < box.faceCount(); ++f) {
    if (box.normal(f).y > 0.5) return f;
  }
  return 0;
}

TEST(Recompose, aMovedFaceTakesItsNeighboursAlong) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  const size_t top = topOf(box);
  const Mesh out =
      recomposed(without(box, top), {faceOf(box, top, 0, {0, 2, 0})}, LooseParts::Move);
  EXPECT_EQ(out.faceCount(), 6u);
  EXPECT_EQ(out.positions.size(), 8u);
  EXPECT_TRUE(Topology(out).closed());
  EXPECT_EQ(out.bounds().size(), (Vec3{4, 5, 2}));
  EXPECT_EQ(originLevels(out), 0u);
}

TEST(Recompose, movesOfDifferentComponentsAddUp) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  std::vector<Mesh> parts;
  for (uint32_t f = 0; f < 6; ++f) parts.push_back(faceOf(box, f, f, {0, 1, 0}));
  const Mesh out = recomposed({}, parts, LooseParts::Move);
  ASSERT_EQ(out.positions.size(), 8u);
  EXPECT_EQ(out.bounds().min.y, 3);
  EXPECT_EQ(out.bounds().max.y, 6);
}

TEST(Recompose, movesThatPartsOfOneComponentShareCountOnce) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  const Mesh out = recomposed(
      {},
      {faceOf(box, 0, 7, {1, 0, 0}), faceOf(box, 1, 7, {1, 0, 0}), faceOf(box, 2, 7, {1, 0, 0})},
      LooseParts::Move);
  for (const Vec3& p : out.positions) EXPECT_TRUE(p.x == 1 || p.x == 5);
}

TEST(Recompose, partsOfACutFaceStayGluedToTheirNeighbours) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  const size_t top = topOf(box);
  std::vector<Mesh> parts;
  const std::vector<double> cuts{1, 3};
  for (MeshPart& p : sliceAxis(faceOf(box, top, 0, {}), 0, cuts)) {
    parts.push_back(std::move(p.mesh));
  }
  ASSERT_EQ(parts.size(), 3u);
  for (Vec3& p : parts[2].positions) p.y += 2;
  const Mesh out = recomposed(without(box, top), parts, LooseParts::Move);
  EXPECT_EQ(out.faceCount(), 8u);
  EXPECT_EQ(out.positions.size(), 12u);
  EXPECT_TRUE(Topology(out).closed());
  EXPECT_EQ(out.bounds().max.y, 5);
}

TEST(Recompose, deletedPartsMoveWhatTheyTouched) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  const size_t top = topOf(box);
  Mesh lid = faceOf(box, top, 0, {0, 2, 0});
  markDeleted(lid);
  EXPECT_TRUE(isDeleted(lid));
  const Mesh out = recomposed(without(box, top), {lid}, LooseParts::Move);
  EXPECT_EQ(out.faceCount(), 5u);
  EXPECT_EQ(out.bounds().max.y, 5);
}

TEST(Recompose, edgesMoveTheFacesBesideThem) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  MeshBuilder b;
  b.addPolygon(std::vector<uint32_t>{b.addPosition({0, 3, 0}), b.addPosition({4, 3, 0})});
  Mesh edge = b.take();
  noteOrigins(edge, 1);
  for (Vec3& p : edge.positions) p.y += 1;
  const Mesh out = recomposed(box, {edge}, LooseParts::Move);
  EXPECT_EQ(out.faceCount(), 6u);
  EXPECT_TRUE(Topology(out).closed());
  EXPECT_EQ(out.bounds().max.y, 4);
  EXPECT_EQ(out.positions.size(), 8u);
}

TEST(Recompose, geometryWithoutOriginsIsTakenAsItIs) {
  const Mesh box = makeBoxMesh({4, 3, 2}, false);
  const Mesh out = recomposed(box, {makeBoxMesh({1, 1, 1}, false)}, LooseParts::Move);
  EXPECT_EQ(out.faceCount(), 12u);
  EXPECT_EQ(out.positions.size(), 16u);
}

TEST(Recompose, edgesAndPointsStayWhereTheyAreTheResult) {
  MeshBuilder b;
  const uint32_t p = b.addPosition({0, 0, 0}), q = b.addPosition({2, 0, 0});
  b.addPolygon(std::vector<uint32_t>{p, q});
  b.addPolygon(std::vector<uint32_t>{p});
  Mesh m = b.take();
  noteOrigins(m, 1);
  const Mesh out = recomposed({}, {m}, LooseParts::Stay);
  EXPECT_TRUE(out.valid());
  EXPECT_EQ(out.faceCount(), 2u);
  EXPECT_EQ(out.corners.size(), 3u);
  EXPECT_EQ(out.positions.size(), 2u);
}

TEST(Recompose, outerLevelsOfOriginsStay) {
  Mesh box = makeBoxMesh({4, 3, 2}, false);
  noteOrigins(box, 1);
  const size_t top = topOf(box);
  const Mesh out =
      recomposed(without(box, top), {faceOf(box, top, 0, {0, 2, 0})}, LooseParts::Move);
  ASSERT_EQ(originLevels(out), 1u);
  const Origins origins(out, 0);
  for (uint32_t c = 0; c < out.corners.size(); ++c) {
    EXPECT_LE(origins.origin(c).y, 3);
    EXPECT_TRUE(out.at(c).y == 0 || out.at(c).y == 5);
  }
}

TEST(Recompose, capsOfCutSolidsHaveOrigins) {
  Mesh box = makeBoxMesh({4, 4, 4}, false);
  noteOrigins(box, 1);
  const std::vector<double> cuts{2};
  for (const MeshPart& part : sliceAxis(box, 1, cuts)) {
    const Origins origins(part.mesh, 0);
    for (uint32_t c = 0; c < part.mesh.corners.size(); ++c) {
      EXPECT_TRUE(origins.known(c));
      EXPECT_EQ(origins.origin(c), part.mesh.at(c));
    }
  }
}

TEST(Origins, aVertexMadeBesideTheOneThatStayedHasItsOriginThere) {
  Mesh m = makeQuadMesh(1, 1, QuadPlane::Xz, false);
  noteOrigins(m, 1);
  Mesh raised = m;
  for (Vec3& p : raised.positions) p.y += 1;
  append(m, raised);
  const Handover from(m, Frame());
  EXPECT_TRUE(from.moved());
  from.begin(m, Frame(), 2);
  const Origins origins(m, 0);
  for (uint32_t c = 0; c < m.corners.size(); ++c) {
    EXPECT_EQ(origins.origin(c), m.at(c));
    EXPECT_EQ(origins.begin(c), m.at(c));
    EXPECT_EQ(origins.shape(c), 2);
  }
}

}  // namespace
}  // namespace gable
