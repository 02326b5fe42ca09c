// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/mesh.h"

#include <gtest/gtest.h>

#include "geom/mesh/untagged_hash.h"

namespace gable {
namespace {

TEST(Mesh, boxHasTheMeasuredRingsAndOutwardFaces) {
  const Mesh m = makeBoxMesh({2, 3, 5}, true);
  ASSERT_TRUE(m.valid());
  const std::vector<uint32_t> corners = {0, 1, 2, 3, 7, 6, 5, 4, 3, 2, 6, 7,
                                         2, 1, 5, 6, 1, 0, 4, 5, 0, 3, 7, 4};
  EXPECT_EQ(m.corners, corners);
  EXPECT_EQ(m.positions.size(), 8u);
  const std::vector<Vec3> normals = {{0, -1, 0}, {0, 1, 0},  {0, 0, 1},
                                     {1, 0, 0},  {0, 0, -1}, {-1, 0, 0}};
  for (size_t f = 0; f < 6; ++f) EXPECT_EQ(m.normal(f), normals[f]) << f;
  EXPECT_DOUBLE_EQ(m.area(), 2 * (2 * 3 + 3 * 5 + 2 * 5));
}

TEST(Mesh, boxSidesStandUprightInUv) {
  const Mesh m = makeBoxMesh({2, 3, 5}, true);
  for (size_t f = 2; f < 6; ++f) {
    const uint32_t c = m.loopsOf(f)[0].firstCorner;
    const Vec3 u = m.at(c + 1) - m.at(c), v = m.at(c + 3) - m.at(c);
    EXPECT_EQ(m.uvs[0][c], (Vec2{0, 0}));
    EXPECT_EQ(m.uvs[0][c + 1], (Vec2{1, 0}));
    EXPECT_EQ(m.uvs[0][c + 3], (Vec2{0, 1}));
    EXPECT_EQ(v, (Vec3{0, 3, 0}));
    EXPECT_EQ(normalized(cross(u, v)), m.normal(f));
  }
}

TEST(Mesh, quadsFaceFrontAndUp) {
  const Mesh front = makeQuadMesh(2, 3, QuadPlane::Xy, true);
  EXPECT_EQ(front.normal(0), (Vec3{0, 0, 1}));
  EXPECT_EQ(front.positions[0], (Vec3{0, 0, 0}));
  const Mesh lot = makeQuadMesh(2, 3, QuadPlane::Xz, true);
  EXPECT_EQ(lot.normal(0), (Vec3{0, 1, 0}));
  const std::vector<Vec3> ring = {{0, 0, 3}, {2, 0, 3}, {2, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(lot.positions, ring);
  EXPECT_DOUBLE_EQ(lot.area(), 6);
}

// A unit frame with a square hole, an edge tag on each side of the outer ring.
Mesh quadWithHole() {
  MeshBuilder b;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{3, 3, 0}, Vec3{0, 3, 0}, Vec3{1, 1, 0},
                        Vec3{1, 2, 0}, Vec3{2, 2, 0}, Vec3{2, 1, 0}}) {
    b.addPosition(p);
  }
  b.beginFace(2, 7);
  b.beginLoop();
  for (uint32_t i = 0; i < 4; ++i) b.setNormal(b.addCorner(i, 10 + i), {0, 0, 1});
  b.beginLoop();
  for (uint32_t i = 4; i < 8; ++i) b.addCorner(i);
  return b.take();
}

TEST(Mesh, holesReduceTheArea) {
  const Mesh m = quadWithHole();
  ASSERT_TRUE(m.valid());
  EXPECT_DOUBLE_EQ(m.area(0), 8);
  EXPECT_EQ(m.edgeTags, (std::vector<uint32_t>{10, 11, 12, 13, 0, 0, 0, 0}));
}

TEST(Mesh, mirroringTurnsFacesRoundAndKeepsTagsOnTheirEdges) {
  const Mesh m = quadWithHole();
  const Mesh t = transformed(m, {-1, 1, 1}, Frame());
  ASSERT_TRUE(t.valid());
  EXPECT_EQ(t.normal(0), (Vec3{0, 0, 1}));
  EXPECT_EQ(t.normals[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(t.corners[0], m.corners[0]);
  // The bottom edge from 0 to 1 carries tag 10 before and after.
  EXPECT_EQ(t.corners[3], 1u);
  EXPECT_EQ(t.edgeTags[3], 10u);
  EXPECT_DOUBLE_EQ(t.area(), m.area());
}

TEST(Mesh, normalsFollowTheInverseTranspose) {
  Mesh m = quadWithHole();
  for (Vec3& n : m.normals) n = normalized(Vec3{1, 0, 1});
  const Mesh t = transformed(m, {2, 1, 1}, Frame());
  EXPECT_NEAR(t.normals[0].x / t.normals[0].z, 0.5, 1e-12);
  const Mesh flat = transformed(m, {1, 1, 0}, Frame());
  EXPECT_EQ(flat.normals[0], (Vec3{0, 0, 1}));
}

TEST(Mesh, reversingTwiceIsTheSame) {
  Mesh m = quadWithHole();
  const uint64_t before = m.contentHash();
  reverseFace(m, 0);
  EXPECT_EQ(m.normal(0), (Vec3{0, 0, -1}));
  EXPECT_NE(m.contentHash(), before);
  reverseFace(m, 0);
  EXPECT_EQ(m.contentHash(), before);
}

TEST(Mesh, appendShiftsSlotsAndFillsMissingAttributes) {
  Mesh a = makeBoxMesh({1, 1, 1}, true);
  append(a, quadWithHole(), 5);
  ASSERT_TRUE(a.valid());
  EXPECT_EQ(a.faceCount(), 7u);
  EXPECT_EQ(a.faces[6].materialSlot, 7);
  EXPECT_EQ(a.edgeTags[24], 10u);
  EXPECT_EQ(a.uvs[0].size(), a.corners.size());
  EXPECT_DOUBLE_EQ(a.area(), 6 + 8);
}

TEST(Mesh, builderCopiesFacesReversed) {
  const Mesh m = quadWithHole();
  MeshBuilder b;
  std::vector<uint32_t> map;
  b.copyFace(m, 0, map, true);
  Mesh back = b.take();
  ASSERT_TRUE(back.valid());
  EXPECT_EQ(back.normal(0), (Vec3{0, 0, -1}));
  EXPECT_EQ(back.faces[0].tags, 7u);
  EXPECT_EQ(back.positions.size(), 8u);
  reverseFace(back, 0);
  EXPECT_EQ(back.edgeTags, m.edgeTags);
}

TEST(Mesh, verticesKeepTheirTags) {
  Mesh m = quadWithHole();
  m.vertexTags = {0, 5};
  ASSERT_TRUE(m.valid());
  Mesh box = makeBoxMesh({1, 1, 1}, false);
  append(box, m);
  ASSERT_TRUE(box.valid());
  EXPECT_EQ(box.vertexTagsAt(9), 5u);
  EXPECT_EQ(box.vertexTagsAt(1), 0u);
  MeshBuilder b;
  std::vector<uint32_t> map;
  b.copyFace(box, 6, map, true);
  const Mesh copy = b.take();
  ASSERT_TRUE(copy.valid());
  for (uint32_t p = 0; p < copy.positions.size(); ++p) {
    EXPECT_EQ(copy.vertexTagsAt(p), copy.positions[p] == m.positions[1] ? 5u : 0u);
  }
}

TEST(Mesh, hashSeesEveryField) {
  const Mesh m = quadWithHole();
  const uint64_t h = m.contentHash();
  Mesh a = m, b = m, c = m, d = m, e = m, f = m;
  f.vertexTags = {4};
  a.positions[0].x = 0.1;
  b.faces[0].tags = 8;
  c.edgeTags[1] = 0;
  d.uvs[3].resize(d.corners.size());
  e.normals[2] = {};
  for (const Mesh* changed : {&a, &b, &c, &d, &e, &f}) EXPECT_NE(changed->contentHash(), h);
  EXPECT_EQ(Mesh(m).contentHash(), h);
}

TEST(Mesh, untaggedHashSeesAllButTags) {
  const Mesh m = quadWithHole();
  Mesh a = m, b = m, c = m, bare = m;
  a.faces[0].tags = 8;
  b.edgeTags[1] = 0;
  c.vertexTags = {4};
  bare.faces[0].tags = 0;
  bare.edgeTags.clear();
  for (const Mesh* retagged : {&a, &b, &c, &bare}) {
    EXPECT_NE(retagged->sharedHash(), m.sharedHash());
    EXPECT_EQ(untaggedHash(*retagged), untaggedHash(m));
  }
  EXPECT_EQ(untaggedHash(bare), bare.sharedHash());
  Mesh moved = a;
  moved.positions[0].x = 0.1;
  EXPECT_NE(untaggedHash(moved), untaggedHash(m));
}

TEST(Mesh, validRejectsBrokenMeshes) {
  Mesh m = quadWithHole();
  m.corners[0] = 99;
  EXPECT_FALSE(m.valid());
  m = quadWithHole();
  m.positions[0].y = std::nan("");
  EXPECT_FALSE(m.valid());
  m = quadWithHole();
  m.edgeTags.pop_back();
  EXPECT_FALSE(m.valid());
  m = quadWithHole();
  m.vertexTags.resize(m.positions.size() + 1);
  EXPECT_FALSE(m.valid());
}

}  // namespace
}  // namespace gable
