// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Shapes put together, and with attributes of their own.

#include <gtest/gtest.h>

#include "gable/gable.h"

namespace gable {
namespace {

const char* const kRules =
    "attr height = 4\nattr list = [0]\n@StartRule\nLot --> extrude(height)\n";

Rules rules() { return Rules::parse(kRules, "shapes.cga"); }

double height(const Model& model, size_t shape) {
  return std::get<double>(model.attributes(shape)[0].value.items[0]);
}

NamedValue number(const char* name, double value) { return {name, {{value}, std::nullopt}}; }

TEST(Shapes, joinedAreAllOfThemInOrder) {
  const Shapes two = Shapes::joined({Shapes::lot(1, 1), Shapes::lot(3, 1)});
  const Shapes five = Shapes::joined({two, Shapes::joined({}), two, Shapes::lot(5, 1)});
  ASSERT_EQ(5u, five.size());
  EXPECT_TRUE(five.ok());
  EXPECT_EQ(3, five.outline(3).area);
  EXPECT_EQ(5, five.outline(4).area);
}

TEST(Shapes, joinedKeepWhatWasToldOfThem) {
  const Shapes wrong = Shapes::polygon({{0, 0}, {1e300, 0}, {1, 1}});
  ASSERT_FALSE(wrong.ok());
  EXPECT_FALSE(Shapes::joined({Shapes::lot(1, 1), wrong}).ok());
}

TEST(Shapes, haveAttributesOfTheirOwn) {
  Shapes lots = Shapes::joined({Shapes::lot(1, 1), Shapes::lot(2, 1), Shapes::lot(3, 1)});
  lots = lots.withAttributes({{number("height", 1)}, {}, {number("height", 2)}, {number("x", 1)}});
  lots = lots.withAttributes({{number("height", 7)}});
  EXPECT_TRUE(lots.ok());
  const Model model = derive(rules(), lots);
  EXPECT_EQ(7, height(model, 0));
  EXPECT_EQ(4, height(model, 1));
  EXPECT_EQ(2, height(model, 2));
}

TEST(Shapes, linesOfAMapKeepTheWidthsOfTheirStreets) {
  const Rules rules = Rules::parse(
      "@StartRule\nLot --> streets(given, 60, 10) { roadway : Road | all : NIL }\n"
      "Road --> report(\"area\", geometry.area)\n",
      "streets.cga");
  const auto streets = [&](const std::string& properties) {
    const std::string map =
        R"({"type":"FeatureCollection","crs":{"properties":{"name":"x"}},"features":[)"
        R"({"type":"Feature","properties":)" +
        properties + R"(,"geometry":{"type":"LineString","coordinates":[[0,0],[100,0]]}}]})";
    const auto reports = derive(rules, Shapes::parse(map, "streets.geojson")).statistics().reports;
    return reports.size() == 1 && reports[0].numbers ? reports[0].numbers->sum : 0;
  };
  const double tenWide = streets("{}"), sixWide = streets(R"({"width":6})");
  EXPECT_GT(sixWide, 0);
  EXPECT_NEAR(sixWide / tenWide, 0.6, 0.05);
  EXPECT_EQ(streets(R"({"width":"6"})"), sixWide);
  EXPECT_EQ(streets(R"({"width":-6})"), tenWide);
}

TEST(Shapes, propertiesThatSetNothingAreToldWhereTheyLookLikeASlip) {
  const auto notes = [](const std::string& properties) {
    const std::string map =
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" + properties +
        R"(,"geometry":{"type":"Polygon","coordinates":[[[0,0],[1e-4,0],[1e-4,1e-4],[0,0]]]}}]})";
    std::string told;
    const Model model = derive(rules(), Shapes::parse(map, "lots.geojson"));
    for (const Diagnostic& d : model.diagnostics()) {
      told += d.code + " " + d.hint + "; ";
    }
    return told;
  };
  EXPECT_EQ(notes(R"({"hieght":3})"), "unused-property did you mean 'height'?; ");
  EXPECT_EQ(notes(R"({"Height":3})"), "unused-property did you mean 'height'?; ");
  EXPECT_EQ(notes(R"({"height":3,"HEIGHT":4})"), "unused-property did you mean 'height'?; ");
  // Nobody misses what another property sets, and most of a map means nothing to the rules.
  EXPECT_EQ(notes(R"({"height":3,"hieght":3,"name":"a","lis":1,"source":"survey"})"), "");
}

TEST(Shapes, valuesThatTheRulesDoNotExpectAreToldOnce) {
  const Rules bounded = Rules::parse(
      "@Enum(\"flat\", \"gable\") attr roof = \"flat\"\n@Range(1, 9) attr levels = 3\n"
      "Lot --> extrude(levels) print(roof) X.",
      "bounded.cga");
  std::string features;
  for (const char* properties :
       {R"({"roof":"gabel","levels":4})", R"({"roof":"hip","levels":12})", R"({"roof":"gable"})"}) {
    features +=
        (features.empty() ? "" : ",") +
        std::string(R"({"type":"Feature","id":"a)" + std::to_string(features.size()) +
                    R"(","properties":)") +
        properties +
        R"(,"geometry":{"type":"Polygon","coordinates":[[[0,0],[1e-4,0],[1e-4,1e-4],[0,0]]]}})";
  }
  const Model model =
      derive(bounded, Shapes::parse(R"({"type":"FeatureCollection","features":[)" + features + "]}",
                                    "lots.geojson"));
  EXPECT_TRUE(model.ok());
  ASSERT_EQ(model.diagnostics().size(), 2u);
  const Diagnostic &roof = model.diagnostics()[0], &levels = model.diagnostics()[1];
  EXPECT_EQ(roof.code, "attribute-value");
  EXPECT_EQ(roof.severity, Diagnostic::Severity::Warning);
  EXPECT_EQ(roof.message, "'roof' is one of: flat, gable, not gabel, in feature 1 (id a0) and one more");
  EXPECT_EQ(roof.hint, "did you mean 'gable'?");
  EXPECT_EQ(levels.code, "attribute-outside");
  EXPECT_EQ(levels.message.find("and"), std::string::npos) << levels.message;
}

TEST(Shapes, refuseValuesThatAreNone) {
  using Items = std::vector<RuleValue::Scalar>;
  const auto with = [](RuleValue value) {
    return Shapes::lot(1, 1).withAttributes({{{"list", std::move(value)}}});
  };
  EXPECT_TRUE(with({Items{1.0, 2.0}, RuleValue::Size{1, 2}}).ok());
  EXPECT_TRUE(with({Items{}, RuleValue::Size{0, 0}}).ok());
  const RuleValue wrong[] = {{Items{}, std::nullopt},
                             {Items{1.0, 2.0}, std::nullopt},
                             {Items{1.0}, RuleValue::Size{4000000000u, 4000000000u}},
                             {Items{1.0, true}, RuleValue::Size{1, 2}}};
  for (const RuleValue& value : wrong) {
    const Shapes shapes = with(value);
    ASSERT_FALSE(shapes.ok());
    EXPECT_EQ("attribute-value", shapes.diagnostics()[0].code);
    EXPECT_TRUE(derive(rules(), shapes).ok());
  }
}

}  // namespace
}  // namespace gable
