// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

// The coordinates of the corner of a face at a place in the local frame.
Vec2 uvAt(const Shape& s, const Vec3& place, int set = 0) {
  const Mesh m = meshInLocal(s);
  for (uint32_t c = 0; c < m.corners.size(); ++c) {
    if (length(m.at(c) - place) < 1e-9) return m.uvs[static_cast<size_t>(set)][c];
  }
  ADD_FAILURE() << "no corner there";
  return {};
}

void expectNear(Vec2 a, Vec2 b) {
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
}

Shape projected(const Shape& s, FakeServices& services, const Op& setup, int set = 0) {
  const Ran prepared = setup.on(s, services);
  EXPECT_TRUE(prepared.status.ok()) << prepared.status.message();
  const Ran ran = Op("projectUV").args(set).on(prepared.shape, services);
  EXPECT_TRUE(ran.status.ok()) << ran.status.message();
  return ran.shape;
}

TEST(Projection, tilesHaveTheirSizeInMetres) {
  FakeServices services;
  const Shape s =
      projected(wallShape(6, 3), services, Op("setupProjection").args(0, word("scope.xy"), 2, 1.5));
  expectNear(uvAt(s, {0, 0, 0}), {0, 0});
  expectNear(uvAt(s, {6, 3, 0}), {3, 2});
}

TEST(Projection, floatingAndRelativeSizesFitTheScope) {
  FakeServices services;
  const Shape s =
      projected(wallShape(7, 3), services,
                Op("setupProjection").args(0, word("scope.xy"), floating(2), relative(0.5)));
  // 7 m in tiles of about 2 m: four of them.
  expectNear(uvAt(s, {7, 3, 0}), {4, 2});
}

TEST(Projection, negativeSizesMirrorAndOffsetsShift) {
  FakeServices services;
  const Shape s = projected(wallShape(6, 3), services,
                            Op("setupProjection").args(0, word("scope.xy"), -2, 3, 1, 1.5));
  expectNear(uvAt(s, {0, 0, 0}), {-0.5, 0.5});
  expectNear(uvAt(s, {6, 3, 0}), {-3.5, 1.5});
}

TEST(Projection, allPlanesNameTheirAxes) {
  FakeServices services;
  const Vec3 corner{2, 3, 5};
  for (const char* axes : {"xy", "xz", "yx", "yz", "zx", "zy"}) {
    const Shape s =
        projected(boxShape(corner), services,
                  Op("setupProjection").args(3, word(std::string("scope.") + axes), 1, 1), 3);
    expectNear(uvAt(s, corner, 3), {corner[static_cast<size_t>(axes[0] - 'x')],
                                    corner[static_cast<size_t>(axes[1] - 'x')]});
  }
}

TEST(Projection, depthCountsByItsFactor) {
  FakeServices services;
  const Shape s = projected(boxShape({2, 3, 5}), services,
                            Op("setupProjection").args(0, word("scope.xy"), 2, 3, 0, 0, 1));
  expectNear(uvAt(s, {2, 3, 5}), {1 + 2.5, 1});
}

TEST(Projection, worldProjectionsIgnoreTheScope) {
  FakeServices services;
  services.worldFrame = rotationXyz(0, 90, 0);
  services.worldFrame.origin = {100, 0, 0};
  Shape ground = quadShape(4, 6);
  ground.scope.origin = {1, 2, 3};
  const Shape s =
      projected(ground, services, Op("setupProjection").args(0, word("world.xz"), 10, 10));
  const Vec3 place = ground.scope.origin;
  const Vec3 world = services.worldFrame.point(place);
  expectNear(uvAt(s, place), {world.x / 10, world.z / 10});
}

TEST(Projection, partsKeepTheProjectionOfTheWhole) {
  FakeServices services;
  Shape s =
      Op("setupProjection").args(0, word("scope.xy"), 1, 1).on(wallShape(6, 3), services).shape;
  s.scope.origin = {2, 0, 0};
  s.size.x = 1;
  const Shape part = Op("projectUV").args(0).on(s, services).shape;
  expectNear(uvAt(part, {3, 3, 0}), {3, 3});
}

TEST(Projection, aRectangleThatIsSpannedStaysAPrimitive) {
  FakeServices services;
  for (const Shape& quad : {wallShape(6, 3), wallShape(0.3, 0.7)}) {
    const Shape s = projected(
        quad, services, Op("setupProjection").args(0, word("scope.xy"), quad.size.x, relative(1)));
    EXPECT_EQ(s.geometry.kind, GeometryKind::QuadXy);
    EXPECT_TRUE(s.geometry.uv);
  }
}

TEST(Projection, mistakesAreReported) {
  FakeServices services;
  const Shape s = wallShape(6, 3);
  const auto code = [&](const Op& op) { return std::string(op.on(s, services).status.code()); };
  EXPECT_EQ(code(Op("projectUV").args(0)), "no-projection");
  EXPECT_EQ(code(Op("projectUV").args(10)), "bad-argument");
  EXPECT_EQ(code(Op("setupProjection").args(0, word("scope.xx"), 1, 1)), "wrong-argument");
  EXPECT_EQ(code(Op("setupProjection").args(0, word("scope.xy"), 0, 1)), "bad-argument");
  EXPECT_EQ(code(Op("setupProjection").args(-1, word("scope.xy"), 1, 1)), "bad-argument");
}

Shape withUv() {
  Shape s = wallShape(6, 3);
  s.geometry.uv = true;
  return s;
}

TEST(UvEdits, scaleShiftAndTurn) {
  FakeServices services;
  Shape s = Op("scaleUV").args(0, 2, -3).on(withUv(), services).shape;
  expectNear(uvAt(s, {6, 3, 0}), {2, -3});
  s = Op("translateUV").args(0, 0.5, 1).on(s, services).shape;
  expectNear(uvAt(s, {6, 3, 0}), {2.5, -2});
  s = Op("rotateUV").args(0, 90).on(s, services).shape;
  expectNear(uvAt(s, {6, 3, 0}), {2, 2.5});
  expectNear(uvAt(Op("offsetUV").args(0, 1, 1).on(withUv(), services).shape, {0, 0, 0}), {1, 1});
}

TEST(UvEdits, keepTheGeometryAtAnyScale) {
  FakeServices services;
  Shape s = meshShape(makeBoxMesh({1, 1, 1}, true));
  s.size = {2, -3, 4};
  const Shape t = Op("scaleUV").args(0, 2, 2).on(s, services).shape;
  EXPECT_EQ(t.size, s.size);
  EXPECT_NEAR(enclosedVolume(meshInLocal(t)), enclosedVolume(meshInLocal(s)), 1e-9);
  EXPECT_EQ(t.geometry.refSize, s.geometry.refSize);
}

TEST(UvEdits, normalizeFillsTheUnitSquare) {
  FakeServices services;
  Shape s = Op("scaleUV").args(0, 4, 2).on(withUv(), services).shape;
  s = Op("translateUV").args(0, -1, 7).on(s, services).shape;
  const auto corner = [&](const char* mode) {
    const Shape n =
        Op("normalizeUV").args(0, word(mode), word("collectiveAllFaces")).on(s, services).shape;
    return std::make_pair(uvAt(n, {0, 0, 0}), uvAt(n, {6, 3, 0}));
  };
  expectNear(corner("uv").first, {0, 0});
  expectNear(corner("uv").second, {1, 1});
  expectNear(corner("uvUniform").second, {1, 0.5});
  expectNear(corner("u").first, {0, 7});
  expectNear(corner("u").second, {1, 9});
  expectNear(corner("v").first, {-1, 0});
  expectNear(corner("v").second, {3, 1});
}

TEST(UvEdits, normalizeSeparatesFacesWhenAsked) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s = projected(s, services, Op("setupProjection").args(0, word("scope.xy"), 1, 1));
  s = Op("normalizeUV").args(0, word("uv"), word("separatePerFace")).on(s, services).shape;
  const MeshRef m = meshInScope(s);
  for (size_t f = 0; f < m->faceCount(); ++f) {
    Box2 box;
    for (uint32_t i = 0; i < 4; ++i) box.include(m->uvs[0][m->loopsOf(f)[0].firstCorner + i]);
    EXPECT_EQ(box.min, (Vec2{0, 0}));
    EXPECT_LE(box.max.x, 1);
    // Faces seen edge-on have no extent in one direction, and none is made up.
    EXPECT_TRUE(box.max.x == 1 || box.max.x == 0);
  }
}

TEST(UvEdits, tilesGetTheirRealSize) {
  FakeServices services;
  const auto tiled = [&](const Arg& w, const Arg& h) {
    return uvAt(Op("tileUV").args(0, w, h).on(withUv(), services).shape, {6, 3, 0});
  };
  expectNear(tiled(2, 1), {3, 3});
  expectNear(tiled(floating(2.5), relative(0.5)), {2, 2});
  expectNear(tiled(0, 1), {1, 3});
}

TEST(UvEdits, deleteAndCopy) {
  FakeServices services;
  Shape s = Op("deleteUV").args(0).on(withUv(), services).shape;
  EXPECT_EQ(s.geometry.kind, GeometryKind::QuadXy);
  EXPECT_FALSE(s.geometry.uv);
  s = Op("copyUV").args(0, 5).on(withUv(), services).shape;
  expectNear(uvAt(s, {6, 3, 0}, 5), {1, 1});
  s = Op("deleteUV").args(0).on(s, services).shape;
  EXPECT_FALSE(meshInScope(s)->hasUv(0));
  EXPECT_TRUE(meshInScope(s)->hasUv(5));
  EXPECT_FALSE(Op("copyUV").args(0, 11).on(withUv(), services).status.ok());
}

TEST(UvEdits, withoutCoordinatesNothingHappens) {
  FakeServices services;
  const Shape s = wallShape(2, 2);
  for (const Ran& ran :
       {Op("scaleUV").args(0, 2, 2).on(s, services), Op("rotateUV").args(3, 2).on(s, services),
        Op("tileUV").args(0, 2, 2).on(s, services)}) {
    EXPECT_TRUE(ran.status.ok());
    EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::QuadXy);
  }
}

}  // namespace
}  // namespace gable
