// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/extrude.h"

#include <gtest/gtest.h>

#include "geom/mesh/face_plane.h"
#include "geom/mesh/topology.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

const Frame kGround = Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});

TEST(Extrude, quadWithTriangularHole) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 8}, {8, 8}}}};
  const ExtrudeResult r = extrude(meshOf({p}, kGround), {ExtrudeMode::FaceNormal, 10, {}});
  ASSERT_TRUE(r.mesh.valid());
  EXPECT_EQ(r.mesh.positions.size(), 14u);
  EXPECT_EQ(r.mesh.faceCount(), 9u);
  EXPECT_EQ(holeCount(r.mesh), 2u);
  EXPECT_TRUE(Topology(r.mesh).closed());
  EXPECT_DOUBLE_EQ(volume(r.mesh), (100 - 18) * 10);
  EXPECT_EQ(r.roles.front(), ExtrudeRole::Bottom);
  EXPECT_EQ(r.roles.back(), ExtrudeRole::Top);
  EXPECT_EQ(std::count(r.roles.begin(), r.roles.end(), ExtrudeRole::SideOuter), 4);
  EXPECT_EQ(std::count(r.roles.begin(), r.roles.end(), ExtrudeRole::SideInner), 3);
  EXPECT_EQ(r.mesh.normal(0), (Vec3{0, -1, 0}));
  EXPECT_EQ(r.mesh.normal(8), (Vec3{0, 1, 0}));
}

TEST(Extrude, sidesStartAtTheLowerLeft) {
  const Mesh lot = makeQuadMesh(4, 3, QuadPlane::Xz, true);
  const ExtrudeResult r = extrude(lot, {ExtrudeMode::Along, 5, {0, 1, 0}});
  // The first side is the front.
  const uint32_t c = r.mesh.loopsOf(1)[0].firstCorner;
  EXPECT_EQ(r.mesh.normal(1), (Vec3{0, 0, 1}));
  EXPECT_EQ(r.mesh.at(c), (Vec3{0, 0, 3}));
  EXPECT_EQ(r.mesh.at(c + 1), (Vec3{4, 0, 3}));
  EXPECT_EQ(r.mesh.at(c + 2), (Vec3{4, 5, 3}));
}

TEST(Extrude, negativeDistanceStaysOutward) {
  const Mesh lot = makeQuadMesh(4, 3, QuadPlane::Xz, false);
  const ExtrudeResult r = extrude(lot, {ExtrudeMode::FaceNormal, -5, {}});
  EXPECT_TRUE(Topology(r.mesh).closed());
  EXPECT_DOUBLE_EQ(volume(r.mesh), 60);
  EXPECT_EQ(r.mesh.normal(0), (Vec3{0, 1, 0}));
  EXPECT_DOUBLE_EQ(r.mesh.bounds().min.y, -5);
}

// Two rectangles that share an edge; the second one is folded up by `rise`.
Mesh folded(double rise) {
  MeshBuilder b;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 0, -3}, Vec3{0, 0, -3},
                        Vec3{4, rise, 0}, Vec3{4, rise, -3}}) {
    b.addPosition(p);
  }
  const uint32_t left[] = {0, 1, 2, 3}, right[] = {1, 4, 5, 2};
  b.addPolygon(left);
  b.addPolygon(right);
  return b.take();
}

TEST(Extrude, coplanarNeighboursBecomeOneSolid) {
  const ExtrudeResult r = extrude(folded(0), {ExtrudeMode::FaceNormal, 2, {}});
  EXPECT_EQ(r.mesh.faceCount(), 2u * 2 + 6);
  EXPECT_TRUE(Topology(r.mesh).closed());
  EXPECT_DOUBLE_EQ(volume(r.mesh), 24);
}

TEST(Extrude, foldedFacesBecomeSolidsOfTheirOwnOrStayTogether) {
  const ExtrudeResult own = extrude(folded(1), {ExtrudeMode::FaceNormal, 2, {}});
  EXPECT_EQ(own.mesh.faceCount(), 12u);
  EXPECT_TRUE(Topology(own.mesh).closed());
  EXPECT_EQ(Topology(own.mesh).componentCount(), 2u);
  for (const ExtrudeMode mode : {ExtrudeMode::VertexNormal, ExtrudeMode::Along}) {
    const ExtrudeResult r = extrude(folded(1), {mode, 2, {0, 1, 0}});
    EXPECT_EQ(r.mesh.faceCount(), 10u);
    EXPECT_TRUE(Topology(r.mesh).closed());
  }
}

TEST(Extrude, flatTopReachesOneHeight) {
  const Vec3 up{0, 1, 0};
  const ExtrudeResult high = extrude(folded(1), {ExtrudeMode::FlatTop, 5, up});
  EXPECT_TRUE(Topology(high.mesh).closed());
  EXPECT_DOUBLE_EQ(volume(high.mesh), 2 * 3 * 5 + 2 * 3 * 4.5);
  const ExtrudeResult least = extrude(folded(1), {ExtrudeMode::FlatTop, 0, up});
  EXPECT_TRUE(Topology(least.mesh).closed());
  EXPECT_DOUBLE_EQ(volume(least.mesh), 2 * 3 * 1 + 2 * 3 * 0.5);
  const ExtrudeResult down = extrude(folded(1), {ExtrudeMode::FlatTop, -5, up});
  EXPECT_DOUBLE_EQ(down.mesh.bounds().min.y, -4);
  EXPECT_DOUBLE_EQ(volume(down.mesh), 2 * 3 * 4 + 2 * 3 * 4.5);
}

TEST(Extrude, edgesBecomeFaces) {
  MeshBuilder b;
  const uint32_t edge[] = {b.addPosition({0, 0, 0}), b.addPosition({3, 0, 0})};
  b.addPolygon(edge);
  const ExtrudeResult r = extrude(b.take(), {ExtrudeMode::Along, 2, {0, 1, 0}});
  ASSERT_EQ(r.mesh.faceCount(), 1u);
  EXPECT_EQ(r.mesh.normal(0), (Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(r.mesh.area(), 6);
}

TEST(Extrude, edgeTagsGoToBothEndsOfTheSides) {
  Mesh lot = makeQuadMesh(4, 3, QuadPlane::Xz, true);
  lot.edgeTags = {1, 2, 3, 4};
  const ExtrudeResult r = extrude(lot, {ExtrudeMode::FaceNormal, 2, {}});
  for (size_t f = 1; f < 5; ++f) {
    const uint32_t c = r.mesh.loopsOf(f)[0].firstCorner;
    EXPECT_EQ(r.mesh.edgeTags[c], f);
    EXPECT_EQ(r.mesh.edgeTags[c + 2], f);
    EXPECT_EQ(r.mesh.edgeTags[c + 1], 0u);
  }
}

TEST(Extrude, corpusWithHolesEnclosesAreaTimesHeight) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const double height = i % 2 ? 3 : -3;
    const ExtrudeResult r = extrude(meshOf({p}, kGround), {ExtrudeMode::FaceNormal, height, {}});
    ASSERT_TRUE(r.mesh.valid()) << i;
    ASSERT_TRUE(Topology(r.mesh).closed()) << i;
    ASSERT_NEAR(volume(r.mesh), 3 * area(p), 1e-7 * area(p)) << i;
  }
}

}  // namespace
}  // namespace gable
