// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What `gable convert` writes of other notations: text that can be read, with the same model and
// the author's comments.

#include <gtest/gtest.h>

#include <string>

#include "gable/gable.h"

namespace gable {
namespace {

std::string converted(const std::string& text, const std::string& path) {
  const Converted c = convert(text, path);
  EXPECT_FALSE(hasErrors(c.diagnostics)) << render(c.diagnostics);
  return c.text;
}

std::string modelOf(const std::string& text, const std::string& path) {
  const Rules rules = Rules::parse(text, path);
  EXPECT_TRUE(rules.ok()) << render(rules.diagnostics()) << text;
  DeriveSettings settings;
  settings.jobs = 1;
  return derive(rules, Shapes::lot(20, 20), settings).dump();
}

void expectSameModel(const std::string& text, const std::string& path) {
  const std::string model = modelOf(text, path);
  EXPECT_FALSE(model.empty());
  EXPECT_EQ(modelOf(converted(text, path), path + ".cga"), model);
}

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Convert, keepsOperationsBehindAChoiceOutOfIt) {
  expectSameModel("Lot -> Choose { A, B } Extrude(3)\nA -> LAWN\nB -> GRAVEL", "a.park");
  expectSameModel("Lot -> Select { outer & W : A | len > 5 : B } else { C } Extrude(3)", "a.park");
}

TEST(Convert, keepsCommentsOfEitherKind) {
  for (const char* sign : {"//", "#"}) {
    const std::string remark = sign + std::string(" words \"of\" ours\n");
    const std::string text = remark + "Lot -> Color(\"#5d7440\") LAWN " + remark;
    const std::string out = converted(text, "a.park");
    EXPECT_EQ(count(out, "// words \"of\" ours"), 2u) << out;
    EXPECT_EQ(count(out, "#5d7440"), 1u) << out;
  }
}

TEST(Convert, keepsChoicesWithinBranchesApart) {
  expectSameModel(
      "Lot -> case (border): Contract(1) Select { facing(world.N) : B } else { A }\n"
      "  else: A\nA -> LAWN",
      "a.park");
  expectSameModel(
      "Lot -> case (!border): LAWN else: Insert(2) Choose { 12%: A, 30%: Contract(2) B }",
      "a.park");
}

TEST(Convert, writesChancesWhoseSumIsNoNumber) {
  const std::string text =
      "axiom START size (4, 4, 4)\nterminal A, B, C\n"
      "START -> Repeat(X) {A 1e308, B 1e308, C 1.5e308}";
  expectSameModel(text, "a.gbbg");
  EXPECT_EQ(count(converted(text, "a.gbbg"), "inf"), 0u);
}

TEST(Convert, asksForTheFileOfAModelInOnePlace) {
  const std::string text = converted(
      "Lot -> Grid(2, 1) { Tree }\nTree -> Choose { Oak, Elm, Ash }\nOak -> loadModel(\"oak\")\n"
      "Elm -> loadModel(\"elm\")\nAsh -> loadModel(\"ash.obj\")",
      "a.park");
  EXPECT_EQ(count(text, "fileExists("), 7u) << text;
}

TEST(Convert, refusesWhatCannotBeDerived) {
  const Converted c = convert("Region -> Contract(-45.5) { A }", "a.park");
  EXPECT_TRUE(hasErrors(c.diagnostics));
  EXPECT_TRUE(c.text.empty());
}

TEST(Convert, keepsComments) {
  const std::string text = converted(
      "// Head.\nLot -> Choose { A, B } // Behind.\n/* Before A,\n   long. */\nA -> LAWN\n"
      "B -> GRAVEL\n// End.",
      "a.park");
  const size_t head = text.find("// Head."), behind = text.find("// Behind."),
               lot = text.find("Lot -->"), before = text.find("/* Before A,\n   long. */"),
               a = text.find("\nA -->"), end = text.find("// End.");
  EXPECT_NE(end, text.npos) << text;
  EXPECT_TRUE(head < behind && behind < lot && lot < before && before < a && a < end) << text;
  EXPECT_EQ(converted("# A box.\nX -> R h ( 1 2 ) # drawn\n  S ( 1 h 1 ) I ( Cube )", "a.grammar")
                .rfind("attr h", 0),
            0u);
  EXPECT_EQ(
      count(converted("# A box.\nX -> R h ( 1 2 ) # drawn\n  S ( 1 h 1 ) I ( Cube )", "a.grammar"),
            "// A box.\n// drawn\n"),
      1u);
  EXPECT_EQ(count(converted("# Boxes.\naxiom START size (4, 4, 4) // one\nterminal A, \"# b\"\n"
                            "START -> Split(X, {1}, ToRoot) {A | \"# b\"}  # two",
                            "a.gbbg"),
                  "//"),
            3u);
}

}  // namespace
}  // namespace gable
