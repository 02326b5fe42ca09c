// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What users of the notation are told, in its own words.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "gable/gable.h"

namespace gable {
namespace {

constexpr const char* kBoxes =
    "axiom START size (4, 4, 4)\nterminal A, B\nSTART -> Split(X, {1}, ToRoot) {A | B}\n";

Rules read(const std::string& text) { return Rules::parse(text, "test.gbbg"); }

std::string codes(const DiagnosticList& messages) {
  std::string out;
  for (const Diagnostic& m : messages) out += m.code + " ";
  return out;
}

Model derivedWith(const Rules& rules, double seed) {
  DeriveSettings settings;
  settings.jobs = 1;
  settings.seed = seed;
  return derive(rules, Shapes::lot(10, 10), settings);
}

TEST(GbbgWords, assetsThatAreMissingAreFoundByTheCheck) {
  const Rules rules = read(std::string(kBoxes) + "postprocess {\n  A : \"nowhere.glb\"\n}\n");
  EXPECT_EQ(codes(rules.diagnostics()), "missing-file ");
  EXPECT_EQ(rules.diagnostics()[0].range->line, 5u);
}

TEST(GbbgWords, seedsAreSignedWholeNumbers) {
  const Rules rules = read(kBoxes);
  for (const double right : {0.0, -1.0, 2147483647.0, -2147483648.0}) {
    EXPECT_TRUE(derivedWith(rules, right).ok()) << right;
  }
  for (const double wrong : {2147483648.0, 1.5, 999999999.5e20, -2147483649.0}) {
    EXPECT_EQ(codes(derivedWith(rules, wrong).diagnostics()), "bad-seed ") << wrong;
  }
  EXPECT_TRUE(derivedWith(Rules::parse("Lot --> X.", "a.cga"), 1.5).ok());
}

TEST(GbbgWords, aRuleSaysWhatItNeeds) {
  const Rules rules =
      read("axiom START size (4, 4, 4)\nSTART -> Split(X, {1, 2}, ToRoot) {A | B}\nterminal A, B");
  ASSERT_FALSE(rules.diagnostics().empty());
  EXPECT_EQ(rules.diagnostics()[0].message, "this Split needs 3 successors, not 2");
}

TEST(GbbgWords, recursionIsMendedInTheNotation) {
  const Rules rules = read("axiom START size (4, 4, 4)\nSTART -> Repeat(X) {START}");
  const Model model = derivedWith(rules, 0);
  ASSERT_EQ(codes(model.diagnostics()), "recursion-too-deep ");
  EXPECT_EQ(model.diagnostics()[0].hint, "let one of the shapes be terminal: 'terminal NAME'");
}

TEST(GbbgWords, symbolsWithoutAssetsHaveColoursOfTheirOwn) {
  const std::string dump = derivedWith(read(kBoxes), 0).dump();
  std::set<std::string> colours;
  for (size_t at = dump.find(" color #"); at != dump.npos; at = dump.find(" color #", at + 1)) {
    colours.insert(dump.substr(at + 7, 7));
  }
  EXPECT_EQ(colours.size(), 2u) << dump;
}

}  // namespace
}  // namespace gable
