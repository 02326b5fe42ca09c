// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>

#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"
#include "math/trig.h"

namespace gable {
namespace {

Ran comp(const Shape& s, const char* kind, std::vector<std::string> selectors) {
  FakeServices services;
  return Op("comp").args(word(kind)).select(std::move(selectors)).on(s, services);
}

// The box as the mesh it stands for.
Shape meshed(const Shape& s) {
  Shape m = s;
  Mesh mesh = *meshInScope(s);
  // A face more keeps it from becoming a box again; no selector of these tests means it.
  m.geometry = {GeometryKind::Mesh, false, s.size, makeRef<Mesh>(std::move(mesh))};
  return m;
}

TEST(Comp, boxFacesAreRectanglesInTheOrderOfTheBox) {
  for (const BoxOrder order : {BoxOrder::Cube, BoxOrder::Extruded}) {
    Shape s = boxShape({2, 3, 4});
    s.geometry.order = order;
    const MeshRef mesh = meshInScope(s);
    const Ran ran = comp(s, "f", {"all"});
    ASSERT_TRUE(ran.status.ok());
    ASSERT_EQ(ran.children.size(), 6u);
    for (size_t f = 0; f < 6; ++f) {
      const Shape& face = ran.children[f].shape;
      EXPECT_EQ(face.geometry.kind, GeometryKind::QuadXy);
      EXPECT_EQ(face.size.z, 0);
      // x along the first edge, z along the normal, origin at the first vertex.
      const MeshLoop& loop = mesh->loopsOf(f)[0];
      const Vec3 edge = mesh->at(loop.firstCorner + 1) - mesh->at(loop.firstCorner);
      EXPECT_EQ(face.scope.origin, mesh->at(loop.firstCorner));
      EXPECT_EQ(face.scope.x, normalized(edge));
      EXPECT_EQ(face.scope.z, mesh->normal(f));
      EXPECT_EQ(face.pivot, face.scope);
      EXPECT_EQ(face.size.x, length(edge));
    }
  }
}

TEST(Comp, boxWithAndWithoutMeshAgree) {
  for (const BoxOrder order : {BoxOrder::Cube, BoxOrder::Extruded}) {
    Shape s = boxShape({2, 3, 4});
    s.geometry.order = order;
    s.scope = Frame::moved({1, 2, 3}) * rotationXyz(0, 30, 0);
    const std::vector<std::string> selectors = {"front", "top || 3", "!(left) && side", "all"};
    const Ran fast = comp(s, "f", selectors), slow = comp(meshed(s), "f", selectors);
    ASSERT_EQ(fast.children.size(), 6u);
    ASSERT_EQ(slow.children.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
      const Shape &a = fast.children[i].shape, &b = slow.children[i].shape;
      EXPECT_EQ(fast.children[i].slot, slow.children[i].slot);
      EXPECT_EQ(a.path, b.path);
      EXPECT_EQ(a.geometry, b.geometry);
      EXPECT_EQ(a.size, b.size);
      EXPECT_LT(length(a.scope.origin - b.scope.origin), 1e-12);
      EXPECT_LT(length(a.scope.x - b.scope.x) + length(a.scope.z - b.scope.z), 1e-12);
      EXPECT_EQ(a.comp.index, b.comp.index);
      EXPECT_EQ(a.comp.total, b.comp.total);
      ASSERT_EQ(a.extra->trim.size(), b.extra->trim.size());
      for (size_t t = 0; t < a.extra->trim.size(); ++t) {
        EXPECT_LT(length(a.extra->trim[t].normal - b.extra->trim[t].normal), 1e-12);
        EXPECT_EQ(a.extra->trim[t].horizontal, b.extra->trim[t].horizontal);
      }
    }
  }
}

TEST(Comp, selectorsExcludeEachOtherFromLeftToRight) {
  FakeServices services;
  const Ran ran = Op("comp")
                      .args(word("f"))
                      .select({"front", "side", "all ="})
                      .on(boxShape({1, 1, 1}), services);
  ASSERT_EQ(ran.of(0).size(), 1u);
  ASSERT_EQ(ran.of(1).size(), 3u);
  ASSERT_EQ(ran.of(2).size(), 1u);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ran.of(1)[i].comp.index, i);
    EXPECT_EQ(ran.of(1)[i].comp.total, 3u);
    EXPECT_EQ(services.pool().text(ran.of(1)[i].compSelector), "side");
  }
  EXPECT_EQ(ran.of(2)[0].comp.total, 1u);
  EXPECT_EQ(countsOf(ran.of(2)[0].geometry).faces, 2u);
}

TEST(Comp, eachDirectionSelectsOneFaceOfABox) {
  for (const char* w : {"front", "back", "left", "right", "top", "bottom", "object.front",
                        "object.top", "world.south", "world.north", "world.west", "world.east",
                        "world.up", "world.down", "street.front"}) {
    EXPECT_EQ(comp(boxShape({1, 2, 3}), "f", {w}).children.size(), 1u) << w;
  }
  for (const char* w : {"side", "vertical", "object.side", "world.side", "street.side"}) {
    EXPECT_EQ(comp(boxShape({1, 2, 3}), "f", {w}).children.size(), 4u) << w;
  }
  EXPECT_EQ(comp(boxShape({1, 2, 3}), "f", {"horizontal"}).children.size(), 2u);
  EXPECT_EQ(comp(boxShape({1, 2, 3}), "f", {"inside"}).children.size(), 6u);
  EXPECT_EQ(comp(boxShape({1, 2, 3}), "f", {"border"}).children.size(), 0u);
  EXPECT_EQ(comp(wallShape(1, 2), "f", {"border"}).children.size(), 1u);
}

TEST(Comp, worldSelectorsFollowTheWorldAndScopeSelectorsDoNot) {
  FakeServices services;
  services.worldFrame = rotationXyz(0, 90, 0);
  const Shape s = boxShape({1, 1, 1});
  // After a quarter turn to the left, the scope's front (+z) looks east (+x).
  const Ran ran = Op("comp").args(word("f")).select({"world.east", "front"}).on(s, services);
  ASSERT_EQ(ran.children.size(), 1u);
  EXPECT_EQ(ran.children[0].shape.scope.z, (Vec3{0, 0, 1}));
}

// A pitched face at each angle to the ground plane.
TEST(Comp, steepnessClassesMeetAtTheDocumentedAngles) {
  struct Expected {
    double angle;
    const char* word;
  };
  const Expected cases[] = {{90, "horizontal"}, {78.76, "horizontal"},  {78.75, "aslant"},
                            {45, "aslant"},     {11.26, "aslant"},      {11.25, "vertical"},
                            {0, "vertical"},    {-11.24, "vertical"},   {-11.25, "nutant"},
                            {-78.74, "nutant"}, {-78.75, "horizontal"}, {-90, "horizontal"}};
  for (const Expected& e : cases) {
    // The face's normal is (0, sin, cos).
    MeshBuilder b;
    const Vec3 up{0, cosDeg(e.angle), -sinDeg(e.angle)};
    const uint32_t ring[] = {b.addPosition({0, 0, 0}), b.addPosition({1, 0, 0}),
                             b.addPosition(Vec3{1, 0, 0} + up), b.addPosition(up)};
    b.addPolygon(ring);
    Shape s;
    s.size = {1, 1, 1};
    setMesh(s, b.take(), ScopeFit::Keep);
    for (const char* w : {"horizontal", "vertical", "aslant", "nutant"}) {
      const size_t expected = std::string(w) == e.word ? 1 : 0;
      EXPECT_EQ(comp(s, "f", {w}).children.size(), expected) << e.angle << " " << w;
    }
  }
}

TEST(Comp, trimPlanesHalveTheAngleAndKnowTheirClass) {
  const Ran ran = comp(boxShape({10, 6, 4}), "f", {"front"});
  ASSERT_EQ(ran.children.size(), 1u);
  const Shape& s = ran.children[0].shape;
  ASSERT_TRUE(s.extra);
  ASSERT_EQ(s.extra->trim.size(), 4u);
  size_t horizontal = 0;
  for (const TrimPlane& t : s.extra->trim) {
    horizontal += t.horizontal;
    EXPECT_NEAR(std::fabs(t.normal.z), std::sqrt(0.5), 1e-12);
    // The middle of the face lies inside, a point behind the corner outside.
    EXPECT_LT(dot(t.normal, Vec3{5, 3, 4}), t.distance);
  }
  EXPECT_EQ(horizontal, 2u);
  EXPECT_FALSE(comp(boxShape({10, 6, 4}), "f", {"front ="}).children[0].shape.extra);
}

TEST(Comp, combinedFacesTakeTheAxesOfTheFirst) {
  const Ran ran = comp(boxShape({2, 3, 4}), "f", {"side ="});
  ASSERT_EQ(ran.children.size(), 1u);
  const Shape& s = ran.children[0].shape;
  EXPECT_EQ(countsOf(s.geometry).faces, 4u);
  EXPECT_EQ(s.scope.z, (Vec3{0, 0, 1}));
  EXPECT_NEAR(meshInLocal(s).area(), 2 * (2 + 4) * 3, 1e-9);
}

TEST(Comp, connectedSetsAreOneShapeEach) {
  // The four sides hang together; without the front the others still do; top and bottom do not.
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "f", {"side =:"}).children.size(), 1u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "f", {"horizontal =:"}).children.size(), 2u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "f", {"front || back =:"}).children.size(), 2u);
}

TEST(Comp, withoutAlignmentAxesAndPivotStay) {
  FakeServices services;
  Shape s = boxShape({2, 3, 4});
  s.pivot = Frame::moved({9, 9, 9});
  const Ran ran = Op("comp").args(word("f"), word("noAlign")).select({"right"}).on(s, services);
  ASSERT_EQ(ran.children.size(), 1u);
  const Shape& face = ran.children[0].shape;
  EXPECT_EQ(face.pivot, s.pivot);
  EXPECT_EQ(face.scope.x, s.scope.x);
  EXPECT_EQ(face.size, (Vec3{0, 3, 4}));
  EXPECT_EQ(face.scope.origin, (Vec3{2, 0, 0}));
}

TEST(Comp, edgesAreCountedOnceAndFaceEdgesForEachFace) {
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "e", {"all"}).children.size(), 12u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "fe", {"all"}).children.size(), 24u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "v", {"all"}).children.size(), 8u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "fv", {"all"}).children.size(), 24u);
  EXPECT_EQ(comp(wallShape(2, 3), "e", {"border"}).children.size(), 4u);
  EXPECT_EQ(comp(boxShape({2, 3, 4}), "e", {"inside"}).children.size(), 12u);
}

TEST(Comp, edgesLieAlongTheirX) {
  const Ran ran = comp(boxShape({2, 3, 4}), "e", {"all"});
  for (const BlockChild& c : ran.children) {
    const Shape& s = c.shape;
    EXPECT_EQ(s.size.y, 0);
    EXPECT_EQ(s.size.z, 0);
    EXPECT_GT(s.size.x, 1.9);
    const Mesh m = meshInLocal(s);
    ASSERT_EQ(m.corners.size(), 2u);
    EXPECT_LT(length(m.at(1) - m.at(0) - s.scope.x * s.size.x), 1e-12);
    // z halves the right angle between the faces.
    const double most =
        std::max({std::fabs(s.scope.z.x), std::fabs(s.scope.z.y), std::fabs(s.scope.z.z)});
    EXPECT_NEAR(most, std::sqrt(0.5), 1e-12);
  }
}

TEST(Comp, faceEdgesLookOutOfTheirFace) {
  const Ran ran = comp(quadShape(4, 2), "fe", {"front", "right", "all"});
  ASSERT_EQ(ran.of(0).size(), 1u);
  EXPECT_EQ(ran.of(0)[0].scope.z, (Vec3{0, 0, 1}));
  EXPECT_EQ(ran.of(0)[0].scope.x, (Vec3{1, 0, 0}));
  EXPECT_EQ(ran.of(0)[0].size.x, 4);
  ASSERT_EQ(ran.of(1).size(), 1u);
  EXPECT_EQ(ran.of(1)[0].scope.z, (Vec3{1, 0, 0}));
  EXPECT_EQ(ran.of(2).size(), 2u);
}

TEST(Comp, verticesArePoints) {
  const Ran ran = comp(boxShape({2, 3, 4}), "v", {"all"});
  for (const BlockChild& c : ran.children) {
    EXPECT_EQ(c.shape.size, Vec3{});
    EXPECT_NEAR(std::fabs(c.shape.scope.z.y), std::sqrt(1. / 3), 1e-12);
  }
  const Ran corners = comp(quadShape(2, 2), "fv", {"all"});
  ASSERT_EQ(corners.children.size(), 4u);
  for (const BlockChild& c : corners.children) {
    EXPECT_NEAR(std::fabs(c.shape.scope.z.x), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(c.shape.scope.y.y, 1, 1e-12);
  }
}

TEST(Comp, holesBecomeFaces) {
  const Shape s =
      polygonShape({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {6, 3}, {6, 5}, {3, 5}}});
  const Ran ran = comp(s, "h", {"all"});
  ASSERT_EQ(ran.children.size(), 1u);
  const Mesh m = meshInLocal(ran.children[0].shape);
  EXPECT_NEAR(m.area(), 6, 1e-9);
  EXPECT_NEAR(m.normal(0).y, 1, 1e-12);
}

TEST(Comp, materialsAreDividedByTheirSlots) {
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  for (size_t f = 0; f < 6; ++f) m.faces[f].materialSlot = f < 2 ? 1 : 3;
  FakeServices services;
  Shape s = meshShape(m);
  const MaterialId own = services.materials().intern({});
  Material red;
  red.color = {1, 0, 0};
  const MaterialId other = services.materials().intern(red);
  s.assetMaterials = services.attributes().internMaterials({own, own, other, own, own, other}, {});
  const Ran ran = Op("comp").args(word("m")).select({"all"}).on(s, services);
  ASSERT_EQ(ran.children.size(), 2u);
  EXPECT_EQ(countsOf(ran.children[0].shape.geometry).faces, 2u);
  EXPECT_EQ(countsOf(ran.children[1].shape.geometry).faces, 4u);
}

TEST(Comp, tagsSelectWithParentsWildcardsAndSubcomponents) {
  FakeServices services;
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  m.faces[0].tags = services.tags().of("wall.ground.low");
  m.faces[1].tags = services.tags().of("wall.top");
  const Shape s = meshShape(m);
  const auto count = [&](const char* kind, const char* selector) {
    return Op("comp").args(word(kind)).select({selector}).on(s, services).children.size();
  };
  EXPECT_EQ(count("f", "isTagged(wall)"), 2u);
  EXPECT_EQ(count("f", "isTagged(wall.ground)"), 1u);
  EXPECT_EQ(count("f", "isTagged(wall.gro)"), 0u);
  EXPECT_EQ(count("f", "isTagged(?.ground)"), 1u);
  EXPECT_EQ(count("f", "isTagged(wall.*.low)"), 1u);
  EXPECT_EQ(count("f", "isTagged(*.low)"), 1u);
  EXPECT_EQ(count("f", "isTagged(?.low)"), 0u);
  EXPECT_EQ(count("f", "!isTagged(wall)"), 4u);
  EXPECT_EQ(count("f", "isTagged(wall.top, e)"), 5u);
  EXPECT_EQ(count("f", "isTagged(wall.top, v)"), 5u);
  EXPECT_EQ(count("e", "isTagged(wall.top, v)"), 8u);
  EXPECT_EQ(count("e", "isTagged(wall.top)"), 4u);
  EXPECT_EQ(count("v", "isTagged(wall.top)"), 4u);
}

TEST(Comp, roofEdgesAreToldApart) {
  // A hip roof over an L: all pitches 45 degrees, one valley.
  MeshBuilder b;
  const auto p = [&](double x, double y, double h) { return b.addPosition({x, h, -y}); };
  const uint32_t a0 = p(0, 0, 0), a1 = p(8, 0, 0), a2 = p(8, 4, 0), a3 = p(4, 4, 0),
                 a4 = p(4, 8, 0), a5 = p(0, 8, 0);
  const uint32_t r0 = p(2, 2, 2), r1 = p(6, 2, 2), r2 = p(2, 6, 2);
  for (const std::vector<uint32_t>& ring :
       std::vector<std::vector<uint32_t>>{{a5, a4, a3, a2, a1, a0},
                                          {a0, a1, r1, r0},
                                          {a1, a2, r1},
                                          {a2, a3, r0, r1},
                                          {a3, a4, r2, r0},
                                          {a4, a5, r2},
                                          {a5, a0, r0, r2}}) {
    b.addPolygon(ring);
  }
  const Shape s = meshShape(b.take());
  EXPECT_EQ(comp(s, "e", {"eave"}).children.size(), 6u);
  EXPECT_EQ(comp(s, "e", {"valley"}).children.size(), 1u);
  EXPECT_EQ(comp(s, "e", {"hip"}).children.size(), 5u);
  EXPECT_EQ(comp(s, "e", {"ridge"}).children.size(), 2u);
  for (const BlockChild& c : comp(s, "e", {"hip", "valley"}).children) {
    EXPECT_GT(c.shape.scope.x.y, 0);
  }
}

TEST(Comp, unknownKindsAreAFailure) {
  EXPECT_STREQ(comp(boxShape({1, 1, 1}), "q", {"all"}).status.code(), "wrong-argument");
}

TEST(Comp, facesOfHostilePolygonsKeepTheirAreaInAScopeOfTheirOwn) {
  const std::vector<TestPolygon> polygons = hostilePolygons(4, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    const Shape s = polygonShape(p.rings);
    const double extent = std::max(s.size.x, s.size.z);
    for (const BlockChild& c : comp(s, "f", {"all"}).children) {
      EXPECT_NEAR(meshInLocal(c.shape).area(), meshInLocal(s).area(), 1e-6 * extent * extent);
      EXPECT_EQ(c.shape.size.z, 0) << p.number;
      EXPECT_NEAR(c.shape.scope.z.y, 1, 1e-9);
    }
    size_t edges = 0;
    for (const auto& ring : p.rings) edges += ring.size();
    EXPECT_EQ(comp(s, "fe", {"all"}).children.size(), edges) << p.number;
  }
}

}  // namespace
}  // namespace gable
