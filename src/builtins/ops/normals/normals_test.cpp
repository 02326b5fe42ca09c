// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

TEST(ReverseNormals, turnsFacesAndKeepsFirstEdges) {
  FakeServices services;
  const Shape box = boxShape({2, 3, 4});
  const Shape s = Op("reverseNormals").on(box, services).shape;
  EXPECT_NEAR(enclosedVolume(*meshInScope(s)), -24, 1e-9);
  const Mesh before = *meshInScope(box), after = *meshInScope(s);
  for (size_t f = 0; f < 6; ++f) {
    const uint32_t c = before.loopsOf(f)[0].firstCorner;
    EXPECT_EQ(before.at(c), after.at(c + 1));
    EXPECT_EQ(before.at(c + 1), after.at(c));
  }
  const Shape twice = Op("reverseNormals").on(s, services).shape;
  EXPECT_EQ(meshInScope(twice)->contentHash(), before.contentHash());
}

TEST(ReverseNormals, edgesKeepTheirTagsAndCornersTheirUvs) {
  FakeServices services;
  Mesh m = makeQuadMesh(2, 3, QuadPlane::Xz, true);
  m.edgeTags = {1, 2, 3, 4};
  const Shape s = Op("reverseNormals").on(meshShape(m), services).shape;
  const Mesh r = *meshInScope(s);
  EXPECT_EQ(r.edgeTags, (std::vector<uint32_t>{1, 4, 3, 2}));
  for (uint32_t c = 0; c < 4; ++c) {
    for (uint32_t d = 0; d < 4; ++d) {
      if (m.at(d) == r.at(c)) {
        EXPECT_EQ(m.uvs[0][d], r.uvs[0][c]);
      }
    }
  }
}

TEST(SetNormals, softAndHard) {
  FakeServices services;
  const Shape box = boxShape({2, 2, 2});
  const Shape soft = Op("setNormals").args(word("soft")).on(box, services).shape;
  const Mesh m = *meshInScope(soft);
  ASSERT_EQ(m.normals.size(), 24u);
  EXPECT_NEAR(std::fabs(m.normals[0].x), std::fabs(m.normals[0].y), 1e-9);
  const Shape hard = Op("setNormals").args(word("hard")).on(soft, services).shape;
  EXPECT_TRUE(meshInScope(hard)->normals.empty());
  const Shape untouched = Op("setNormals").args(word("hard")).on(box, services).shape;
  EXPECT_EQ(untouched.geometry.kind, GeometryKind::Box);
  // A box has edges of 90 degrees, sharper than auto smooths.
  const Mesh autom = *meshInScope(Op("setNormals").args(word("auto")).on(box, services).shape);
  for (size_t f = 0; f < 6; ++f) {
    EXPECT_GT(dot(autom.normals[autom.loopsOf(f)[0].firstCorner], autom.normal(f)), 0.999);
  }
}

TEST(SoftenNormals, theAngleDecides) {
  FakeServices services;
  const Shape cylinder =
      Op("primitiveCylinder").args(8, 1, 1).on(emptyShape({1, 1, 1}), services).shape;
  const auto slant = [&](double angle) {
    const Mesh m = *meshInScope(Op("softenNormals").args(angle).on(cylinder, services).shape);
    if (m.normals.empty()) return 1.0;
    return dot(m.normals[m.loopsOf(2)[0].firstCorner], m.normal(2));
  };
  EXPECT_NEAR(slant(0), 1, 1e-9);
  EXPECT_NEAR(slant(44), 1, 1e-9);
  EXPECT_LT(slant(46), 0.95);
  EXPECT_FALSE(Op("softenNormals").args(std::nan("")).on(cylinder, services).status.ok());
}

TEST(SetNormals, conformMakesNeighboursAgreeAndLookOut) {
  FakeServices services;
  for (unsigned mask = 0; mask < 64; ++mask) {
    Mesh m = makeBoxMesh({2, 3, 4}, false);
    for (size_t f = 0; f < 6; ++f) {
      if (mask >> f & 1) reverseFace(m, f);
    }
    const Shape s = Op("setNormals").args(word("conform")).on(meshShape(m), services).shape;
    EXPECT_NEAR(enclosedVolume(*meshInScope(s)), 24, 1e-9) << mask;
  }
}

TEST(SetNormals, conformTurnsOpenSurfacesUp) {
  FakeServices services;
  const Shape down = Op("reverseNormals").on(quadShape(2, 3), services).shape;
  const Shape up = Op("setNormals").args(word("conform")).on(down, services).shape;
  EXPECT_GT(meshInScope(up)->normal(0).y, 0.9);
}

TEST(DeleteHoles, keepsOuterRings) {
  FakeServices services;
  const Shape s =
      polygonShape({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {6, 3}, {6, 6}, {3, 6}}});
  ASSERT_NEAR(meshInScope(s)->area(), 72, 1e-9);
  const Shape filled = Op("deleteHoles").on(s, services).shape;
  EXPECT_NEAR(meshInScope(filled)->area(), 81, 1e-9);
  EXPECT_EQ(countsOf(filled.geometry).vertices, 4u);
  EXPECT_TRUE(meshInScope(filled)->valid());
}

TEST(ResetGeometry, bringsTheInitialShapeBack) {
  FakeServices services;
  services.worldFrame = rotationXyz(0, 30, 0);
  services.worldFrame.origin = {3, 0, 1};
  services.initial.origin = rotationXyz(0, 60, 0);
  services.initial.origin.origin = {100, 2, 3};
  services.initial.shape = quadShape(7, 8);
  Shape s = boxShape({1, 1, 1});
  s.material = 5;
  s.scope.origin = {1, 2, 3};
  ShapeExtra extra;
  extra.trim.push_back({{0, 1, 0}, 0, false});
  UvProjection projection;
  projection.set = 2;
  extra.setProjection(projection);
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  const Shape r = Op("resetGeometry").on(s, services).shape;
  EXPECT_EQ(r.geometry.kind, GeometryKind::QuadXz);
  EXPECT_EQ(r.size, (Vec3{7, 0, 8}));
  EXPECT_EQ(r.material, 5u);
  EXPECT_TRUE(r.extra->trim.empty());
  EXPECT_TRUE(r.extra->projection(2));
  const Vec3 inWorld = services.worldFrame.point(r.scope.point({1, 0, 2}));
  const Vec3 expected = services.initial.origin.point({1, 0, 2});
  EXPECT_NEAR(length(inWorld - expected), 0, 1e-9);
}

}  // namespace
}  // namespace gable
