// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <set>

#include "builtins/catalogue.h"
#include "builtins/shared/materials.h"
#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

const Material& own(const Shape& s, const FakeServices& services) {
  return services.materials().get(s.material);
}

TEST(Color, takesHexAndComponents) {
  FakeServices services;
  const Shape box = boxShape({1, 1, 1});
  const auto color = [&](auto&&... args) {
    return own(Op("color").args(args...).on(box, services).shape, services);
  };
  EXPECT_EQ(color("#ff0000").color, (Vec3{1, 0, 0}));
  EXPECT_EQ(color("#ff0000").opacity, 1);
  EXPECT_NEAR(color("#0000FF80").opacity, 128 / 255.0, 1e-12);
  EXPECT_EQ(color(0.25, 2, -1).color, (Vec3{0.25, 1, 0}));
  EXPECT_EQ(color(0, 0, 0, 0.5).opacity, 0.5);
}

TEST(Color, sameColourIsTheSameMaterial) {
  FakeServices services;
  const Shape a = Op("color").args("#ff0000").on(boxShape({1, 1, 1}), services).shape;
  const Shape b = Op("color").args(1, 0, 0).on(boxShape({1, 1, 1}), services).shape;
  EXPECT_EQ(a.material, b.material);
  EXPECT_NE(a.material, 0u);
}

TEST(Color, whatIsNoColourIsReported) {
  FakeServices services;
  const Ran ran = Op("color").args("red").on(boxShape({1, 1, 1}), services);
  EXPECT_STREQ(ran.status.code(), "bad-argument");
  EXPECT_EQ(ran.shape.material, 0u);
}

TEST(Texture, setsTheOpacityMapOnlyWithAlpha) {
  FakeServices services;
  services.files.addImage("leaf.png", 16, 16, true);
  services.files.addImage("brick.jpg", 16, 16, false);
  Shape s = Op("texture").args("leaf.png").on(boxShape({1, 1, 1}), services).shape;
  EXPECT_EQ(own(s, services).map(TextureLayer::Opacity).path, "leaf.png");
  s = Op("texture").args("brick.jpg").on(s, services).shape;
  EXPECT_EQ(own(s, services).map(TextureLayer::Color).path, "brick.jpg");
  EXPECT_EQ(own(s, services).map(TextureLayer::Opacity).path, "");
  EXPECT_TRUE(services.warnings.empty());
  Op("texture").args("none.png").on(s, services);
  ASSERT_EQ(services.warnings.size(), 1u);
  EXPECT_EQ(services.warnings[0].code, "missing-texture");
  Op("texture").args("builtin:uvtest.png").on(s, services);
  EXPECT_EQ(services.warnings.size(), 1u);
}

TEST(MaterialAttributes, everyFieldIsReadAsItWasSet) {
  FakeServices services;
  services.files.addImage("a.png", 1, 1);
  std::set<std::string> seen;
  for (const MaterialField& f : materialFields()) {
    ASSERT_TRUE(seen.insert(f.name).second) << f.name;
    ASSERT_NE(builtinCatalogue().attribute(f.name), nullptr) << f.name;
    const std::string name = f.name;
    const Arg value = f.type == ValueType::Float           ? Arg(0.375)
                      : f.type == ValueType::Bool          ? Arg(true)
                      : name == "material.color.rgb"       ? Arg("#102030")
                      : name == "material.opacitymap.mode" ? Arg("mask")
                                                           : Arg("a.png");
    Shape s = boxShape({1, 1, 1});
    ASSERT_TRUE(setAttribute(f.name, value, s, services).ok()) << f.name;
    EXPECT_EQ(getAttribute(f.name, s, services), value.value(services.pool())) << f.name;
    EXPECT_EQ(s.material == 0, own(s, services) == Material()) << f.name;
  }
  EXPECT_EQ(seen.size(), 103u);
}

TEST(MaterialAttributes, wrongTextsAreReported) {
  FakeServices services;
  Shape s = boxShape({1, 1, 1});
  EXPECT_FALSE(setAttribute("material.color.rgb", "blue", s, services).ok());
  EXPECT_FALSE(setAttribute("material.opacitymap.mode", "half", s, services).ok());
  EXPECT_FALSE(setAttribute("material.opacity", std::nan(""), s, services).ok());
  EXPECT_EQ(s.material, 0u);
}

TEST(SetMaterial, setsPairsAndNothingAfterAMistake) {
  FakeServices services;
  const Shape box = boxShape({1, 1, 1});
  const Shape s = Op("setMaterial")
                      .args(strings({"color.r", "0.5", "name", "Brick", "doubleSided", "true",
                                     "roughness", "0.25"}))
                      .on(box, services)
                      .shape;
  EXPECT_EQ(own(s, services).color.x, 0.5);
  EXPECT_EQ(own(s, services).name, "Brick");
  EXPECT_TRUE(own(s, services).doubleSided);
  const Ran bad =
      Op("setMaterial").args(strings({"color.r", "0.5", "colour", "1"})).on(box, services);
  EXPECT_STREQ(bad.status.code(), "unknown-attribute");
  EXPECT_EQ(bad.shape.material, box.material);
  EXPECT_FALSE(Op("setMaterial").args(strings({"color.r"})).on(box, services).status.ok());
  EXPECT_FALSE(Op("setMaterial").args(strings({"color.r", "x"})).on(box, services).status.ok());
}

TEST(SetMaterial, takesBackWhatGetMaterialGave) {
  FakeServices services;
  Shape s = boxShape({1, 1, 1});
  ASSERT_TRUE(setAttribute("material.color.rgb", "#804020", s, services).ok());
  ASSERT_TRUE(setAttribute("material.opacitymap.mode", "mask", s, services).ok());
  ASSERT_TRUE(setAttribute("material.colormap.su", 2, s, services).ok());
  ASSERT_TRUE(setAttribute("material.colormap", "builtin:default", s, services).ok());
  for (const char* mode : {"changed", "all"}) {
    const Value table = callFunction("getMaterial", {word("used"), word(mode)}, services, s);
    const Array& a = services.pool().array(table);
    EXPECT_EQ(a.columns, 2u);
    EXPECT_EQ(a.strings.size(), a.rows * 2u);
    Arg again(ValueType::StringArray, a.rows, 2);
    for (StringId id : a.strings) again.strings.emplace_back(services.pool().text(id));
    const Ran ran = Op("setMaterial").args(again).on(boxShape({1, 1, 1}), services);
    ASSERT_TRUE(ran.status.ok()) << ran.status.message();
    EXPECT_EQ(own(ran.shape, services).opacityMode, OpacityMode::Mask);
    EXPECT_NEAR(own(ran.shape, services).color.x, 128 / 255.0, 1e-6);
    EXPECT_EQ(own(ran.shape, services).map(TextureLayer::Color).su, 2);
  }
}

// A shape whose only face uses the second of two materials that a model brought.
Shape modelled(FakeServices& services) {
  MeshBuilder b;
  const uint32_t ring[] = {b.addPosition({0, 0, 0}), b.addPosition({1, 0, 0}),
                           b.addPosition({0, 1, 0})};
  b.addPolygon(ring, 2);
  Shape s = meshShape(b.take());
  Material bark, leaf;
  bark.name = "Bark";
  leaf.name = "Leaf";
  leaf.color = {0, 1, 0};
  AssetModel model;
  model.materials = {bark, leaf};
  setModelMaterials(s, model, services);
  return s;
}

TEST(ModelMaterials, settingOneSetsAllSlots) {
  FakeServices services;
  Shape s = modelled(services);
  s = Op("color").args(0, 0, 1).on(s, services).shape;
  const auto& list = services.attributes().materials(s.assetMaterials);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(services.materials().get(list[0]).color, (Vec3{0, 0, 1}));
  EXPECT_EQ(services.materials().get(list[1]).color, (Vec3{0, 0, 1}));
  EXPECT_EQ(services.materials().get(list[1]).name, "Leaf");
  EXPECT_EQ(services.pool().text(getAttribute("material.name", s, services).id), "Leaf");
}

TEST(ModelMaterials, resetBringsTheModelsMaterialsBack) {
  FakeServices services;
  const Shape fresh = modelled(services);
  const Shape s = Op("color").args(0, 0, 1).on(fresh, services).shape;
  const auto colorOf = [&](const Shape& a) {
    return services.pool().str(getAttribute("material.color.rgb", a, services));
  };
  const auto reset = [&](const char* target) {
    return Op("resetMaterial").args(word(target)).on(s, services).shape;
  };
  EXPECT_EQ(colorOf(Op("resetMaterial").on(s, services).shape), "#00ff00");
  EXPECT_EQ(colorOf(reset("shape")), "#00ff00");
  EXPECT_EQ(reset("shape").assetMaterials, fresh.assetMaterials);
  EXPECT_EQ(colorOf(reset("geometry")), "#0000ff");
  EXPECT_EQ(colorOf(reset("all")), "#ffffff");
}

TEST(ModelMaterials, changesMadeBeforeLieOverTheModels) {
  FakeServices services;
  Shape s = boxShape({1, 1, 1});
  s.material = Op("color").args(1, 0, 0).on(s, services).shape.material;
  Material leaf;
  leaf.name = "Leaf";
  leaf.color = {0, 1, 0};
  AssetModel model;
  model.materials = {leaf};
  setModelMaterials(s, model, services);
  const Material& m =
      services.materials().get(services.attributes().materials(s.assetMaterials)[0]);
  EXPECT_EQ(m.color.x, 1);
  EXPECT_EQ(m.name, "Leaf");
}

TEST(Set, reachesAttributesByName) {
  FakeServices services;
  const Shape box = boxShape({1, 1, 1});
  EXPECT_EQ(Op("set").args(word("scope.sx"), 4).on(box, services).shape.size.x, 4);
  EXPECT_TRUE(Op("set").args(word("trim.horizontal"), true).on(box, services).shape.trimHorizontal);
  const auto code = [&](const char* name, const Arg& value) {
    return std::string(Op("set").args(word(name), value).on(box, services).status.code());
  };
  EXPECT_EQ(code("scope.w", 1), "unknown-attribute");
  EXPECT_EQ(code("split.index", 1), "read-only-attribute");
  EXPECT_EQ(code("scope.sx", "wide"), "type-mismatch");
}

}  // namespace
}  // namespace gable
