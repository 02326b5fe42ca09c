// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/shared/materials.h"
#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// A model of 2 x 4 x 8 metres that begins at (10, 20, 30).
struct WithModel {
  FakeServices services;
  WithModel() {
    Mesh m = makeBoxMesh({2, 4, 8}, true);
    for (Vec3& p : m.positions) p += {10, 20, 30};
    m.faces[3].materialSlot = 1;
    Material wood, glass;
    wood.name = "Wood";
    glass.name = "Glass";
    services.files.addModel("box.obj", m, {wood, glass});
    services.files.addModel("plain.obj", m);
  }
  Ran insert(const Vec3& size, const char* mode = "alignSizeAndPosition") {
    return Op("i").args("box.obj", word("yUp"), word(mode)).on(emptyShape(size), services);
  }
};

TEST(Insert, fitsTheModelToTheScope) {
  WithModel t;
  const Shape s = t.insert({1, 1, 1}).shape;
  EXPECT_EQ(meshInScope(s)->bounds().min, (Vec3{0, 0, 0}));
  expectNear(meshInScope(s)->bounds().max, {1, 1, 1});
  EXPECT_EQ(s.scope.origin, (Vec3{0, 0, 0}));
  EXPECT_TRUE(s.geometry.instanced);
}

TEST(Insert, sharesTheMeshOfTheModel) {
  WithModel t;
  const Shape a = t.insert({1, 1, 1}).shape, b = t.insert({5, 1, 2}).shape;
  EXPECT_EQ(a.geometry.mesh, b.geometry.mesh);
}

TEST(Insert, fillsZeroSizesFromTheModel) {
  WithModel t;
  const Shape all = t.insert({0, 0, 0}).shape;
  EXPECT_EQ(all.size, (Vec3{2, 4, 8}));
  EXPECT_EQ(all.scope.origin, (Vec3{10, 20, 30}));
  const Shape two = t.insert({0, 8, 0}).shape;
  EXPECT_EQ(two.size, (Vec3{4, 8, 16}));
  EXPECT_EQ(two.scope.origin, (Vec3{20, 0, 60}));
  const Shape one = t.insert({2, 8, 0}).shape;
  EXPECT_EQ(one.size, (Vec3{2, 8, 12}));
  EXPECT_EQ(one.scope.origin, (Vec3{0, 0, 0}));
}

TEST(Insert, modesKeepSizeAndPlace) {
  WithModel t;
  const Shape keep = t.insert({9, 9, 9}, "keepSizeAndPosition").shape;
  EXPECT_EQ(keep.size, (Vec3{2, 4, 8}));
  EXPECT_EQ(keep.scope.origin, (Vec3{10, 20, 30}));
  const Shape align = t.insert({10, 9, 10}, "keepSizeAlignPosition").shape;
  EXPECT_EQ(align.size, (Vec3{2, 4, 8}));
  EXPECT_EQ(align.scope.origin, (Vec3{4, 0, 1}));
}

TEST(Insert, zUpTurnsTheModel) {
  WithModel t;
  const Shape s = Op("i").args("box.obj", word("zUp")).on(emptyShape({0, 0, 0}), t.services).shape;
  expectNear(s.size, {2, 8, 4});
}

TEST(Insert, materialsGoToTheSlots) {
  WithModel t;
  const Shape s = t.insert({1, 1, 1}).shape;
  const MeshRef m = meshInScope(s);
  EXPECT_EQ(m->faces[0].materialSlot, 1);
  EXPECT_EQ(m->faces[3].materialSlot, 2);
  const auto& list = t.services.attributes().materials(s.assetMaterials);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(t.services.materials().get(list[1]).name, "Glass");
  const Shape plain = Op("i").args("plain.obj").on(s, t.services).shape;
  EXPECT_EQ(plain.assetMaterials, 0u);
  EXPECT_EQ(meshInScope(plain)->faces[0].materialSlot, 0);
}

TEST(Insert, mirroredScopesShowTheInside) {
  WithModel t;
  const Shape s = t.insert({-1, 1, 1}).shape;
  EXPECT_NEAR(enclosedVolume(meshInLocal(s)), -1, 1e-9);
}

TEST(Insert, missingModelsAreTheirScope) {
  WithModel t;
  const Ran ran = Op("i").args("none.obj").on(emptyShape({1, 2, 3}), t.services);
  EXPECT_TRUE(ran.status.ok());
  ASSERT_EQ(t.services.warnings.size(), 1u);
  EXPECT_EQ(t.services.warnings[0].code, "missing-asset");
  EXPECT_NE(t.services.warnings[0].message.find("none.obj"), std::string::npos);
  EXPECT_EQ(ran.shape.geometry.kind, GeometryKind::Box);
  EXPECT_EQ(ran.shape.size, (Vec3{1, 2, 3}));
  const auto kindOf = [&](const Vec3& size) {
    return Op("i").args("none.obj").on(emptyShape(size), t.services).shape.geometry.kind;
  };
  EXPECT_EQ(kindOf({1, 2, 0}), GeometryKind::QuadXy);
  EXPECT_EQ(kindOf({1, 0, 2}), GeometryKind::QuadXz);
  EXPECT_EQ(kindOf({1, 0, 0}), GeometryKind::None);
}

TEST(Insert, groupsAreComponents) {
  FakeServices services;
  AssetModel model;
  model.mesh = makeRef<Mesh>(makeBoxMesh({1, 1, 1}, false));
  Mesh mesh = *model.mesh;
  for (size_t f = 0; f < 6; ++f) mesh.faces[f].materialSlot = f < 4 ? 0 : 1;
  model.mesh = makeRef<Mesh>(std::move(mesh));
  model.materials.resize(2);
  model.groups = {"Body", "Lid"};
  fitModel(model);
  services.files.models["g.obj"] = makeRef<AssetModel>(std::move(model));
  const Shape s = Op("i").args("g.obj").on(boxShape({1, 1, 1}), services).shape;
  EXPECT_EQ(callText("geometry.groups", {}, services, s), "(2)[Body,Lid]");
  const Ran split = Op("comp").args(word("g")).select({"1", "all"}).on(s, services);
  ASSERT_EQ(split.children.size(), 2u);
  EXPECT_EQ(countsOf(split.of(0)[0].geometry).faces, 2u);
  EXPECT_EQ(countsOf(split.of(1)[0].geometry).faces, 4u);
  // Both slots have the same material, which is one component.
  EXPECT_EQ(Op("comp").args(word("m")).select({"all"}).on(s, services).children.size(), 1u);
}

TEST(Insert, builtinModelsAreOneMetreLarge) {
  FakeServices services;
  for (const char* name : {"builtin:cube", "builtin:cube:notex", "builtin:cylinder",
                           "builtin:sphere", "builtin:cone", "builtin:disk", "builtin:quad"}) {
    const Ran ran = Op("i").args(name).on(emptyShape({0, 0, 0}), services);
    ASSERT_TRUE(ran.status.ok()) << name;
    const Box3 box = meshInLocal(ran.shape).bounds();
    EXPECT_NEAR(box.size().x, 1, 1e-9) << name;
    EXPECT_NEAR(box.min.x, 0, 1e-9) << name;
  }
  EXPECT_EQ(Op("i").args("builtin:cube").on(emptyShape({1, 1, 1}), services).shape.geometry.kind,
            GeometryKind::Box);
  const Ran moon = Op("i").args("builtin:moon").on(emptyShape({1, 1, 1}), services);
  EXPECT_EQ(moon.shape.geometry.kind, GeometryKind::Box);
  ASSERT_EQ(services.warnings.size(), 1u);
  EXPECT_EQ(services.warnings[0].code, "missing-asset");
}

// Half of the scope lies beyond a trim plane at 45 degrees.
Shape trimmed(bool horizontal) {
  Shape s = emptyShape({2, 2, 2});
  s.scope = rotationXyz(0, 90, 0);
  s.scope.origin = {5, 0, 0};
  ShapeExtra extra;
  // Through the axis of the scope's box, along its diagonal plane.
  const Vec3 n = s.scope.direction(normalized(Vec3{1, 0, -1}));
  extra.trim.push_back({n, dot(n, s.scope.point({1, 1, 1})), horizontal});
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  return s;
}

TEST(Trim, activePlanesCutAndClose) {
  WithModel t;
  for (const char* name : {"i", "primitiveCube", "primitiveCylinder"}) {
    Op op(name);
    if (*name == 'i') op.args("box.obj");
    const Shape whole = op.on(trimmed(true), t.services).shape;
    const Shape cut = op.on(trimmed(false), t.services).shape;
    const double volume = enclosedVolume(meshInLocal(whole));
    EXPECT_NEAR(enclosedVolume(meshInLocal(cut)), volume / 2, 1e-6) << name;
    EXPECT_EQ(cut.size, whole.size);
    EXPECT_FALSE(cut.geometry.instanced);
    Shape on = trimmed(true);
    on.trimHorizontal = true;
    EXPECT_NEAR(enclosedVolume(meshInLocal(op.on(on, t.services).shape)), volume / 2, 1e-6) << name;
    Shape off = trimmed(false);
    off.trimVertical = false;
    EXPECT_NEAR(enclosedVolume(meshInLocal(op.on(off, t.services).shape)), volume, 1e-6) << name;
  }
}

TEST(Trim, planesThatMeetNothingLeavePrimitives) {
  FakeServices services;
  Shape s = trimmed(false);
  s.scope.origin = {5, 0, 20};
  s.size = {0.5, 0.5, 0.5};
  const Vec3 n = s.extra->trim[0].normal;
  ShapeExtra extra;
  extra.trim.push_back({n, dot(n, s.scope.point({0.5, 0, 0})) + 1e-12, false});
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  EXPECT_EQ(Op("primitiveCube").on(s, services).shape.geometry.kind, GeometryKind::Box);
}

TEST(Trim, beyondAPlaneNothingIsLeft) {
  FakeServices services;
  Shape s = trimmed(false);
  ShapeExtra extra;
  extra.trim.push_back({{0, 1, 0}, -1, false});
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  EXPECT_EQ(Op("primitiveCube").on(s, services).shape.geometry.kind, GeometryKind::None);
}

TEST(InsertAlongUv, oneCopyFillsTheUnitSquare) {
  WithModel t;
  Shape s = quadShape(6, 3);
  s.geometry.uv = true;
  const Ran ran = Op("insertAlongUV").args(0, "box.obj", 2).on(s, t.services);
  ASSERT_TRUE(ran.status.ok()) << ran.status.message();
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_NEAR(enclosedVolume(m), 6 * 3 * 2, 1e-6);
  expectNear(m.bounds().min, {0, 0, 0}, 1e-6);
  expectNear(m.bounds().max, {6, 2, 3}, 1e-6);
  EXPECT_EQ(t.services.attributes().materials(ran.shape.assetMaterials).size(), 4u);
}

TEST(InsertAlongUv, copiesRepeatWithTheCoordinates) {
  WithModel t;
  Shape s = quadShape(6, 3);
  s.geometry.uv = true;
  s = Op("scaleUV").args(0, 2, -3).on(s, t.services).shape;
  const Ran ran = Op("insertAlongUV").args(0, "plain.obj", 2).on(s, t.services);
  ASSERT_TRUE(ran.status.ok());
  const Mesh m = meshInLocal(ran.shape);
  EXPECT_NEAR(enclosedVolume(m), 36, 1e-6);
  EXPECT_NEAR(m.bounds().size().x, 6, 1e-6);
}

TEST(InsertAlongUv, heightFollowsVertexNormalsAndPosition) {
  WithModel t;
  Shape s = Op("primitiveCylinder").args(16, 5, 4).on(emptyShape({1, 1, 1}), t.services).shape;
  s = Op("deleteUV").args(1).on(s, t.services).shape;
  const Ran ran = Op("insertAlongUV")
                      .args(0, "plain.obj", 1, word("vertex.normal"), word("alignPosition"))
                      .on(s, t.services);
  ASSERT_TRUE(ran.status.ok());
  const Vec3 size = ran.shape.size;
  EXPECT_GT(size.x, 10.5);
  EXPECT_LT(size.x, 12.1);
  Shape q = quadShape(6, 3);
  q.geometry.uv = true;
  const Shape kept = Op("insertAlongUV")
                         .args(0, "plain.obj", 2, word("scope.y"), word("keepPosition"))
                         .on(q, t.services)
                         .shape;
  // The model begins at a height of 20 of its own 4 metres, so at 10 of the 2 asked for.
  EXPECT_NEAR(kept.scope.origin.y, 10, 1e-9);
}

TEST(InsertAlongUv, mistakesAreReported) {
  WithModel t;
  Shape s = quadShape(6, 3);
  const auto code = [&](const Op& op) { return std::string(op.on(s, t.services).status.code()); };
  EXPECT_EQ(code(Op("insertAlongUV").args(0, "box.obj", 2)), "no-uv");
  s.geometry.uv = true;
  EXPECT_EQ(code(Op("insertAlongUV").args(12, "box.obj", 2)), "bad-argument");
  s = Op("scaleUV").args(0, 1e9, 1e9).on(s, t.services).shape;
  EXPECT_EQ(code(Op("insertAlongUV").args(0, "box.obj", 2)), "too-much-geometry");
}

}  // namespace
}  // namespace gable
