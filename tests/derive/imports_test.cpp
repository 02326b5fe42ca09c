// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules that import files of other notations: one derivation runs all of them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gable/gable.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

class Imports : public testing::Test {
 protected:
  Imports()
      : folder_(fs::path(testing::TempDir()) / ("gable-imports-" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "rules");
  }
  ~Imports() override { fs::remove_all(folder_); }

  std::string put(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / "rules" / name;
    std::ofstream(path) << text;
    return path.string();
  }

  static size_t count(const std::string& text, const std::string& word) {
    size_t n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  }

 private:
  fs::path folder_;
};

TEST_F(Imports, pathsThatAreMisspeltAreMended) {
  put("tower.cga", "Tower --> X.\n");
  const Rules rules = Rules::load(
      put("main.cga", "import a : \"towr.cga\"\nimport b : \"else.cga\"\nLot --> X.\n"));
  const DiagnosticList& told = rules.diagnostics();
  ASSERT_EQ(told.size(), 2u);
  ASSERT_TRUE(told[0].fix);
  EXPECT_TRUE(told[0].fix->text.ends_with("tower.cga")) << told[0].fix->text;
  EXPECT_TRUE(told[0].hint.starts_with("did you mean")) << told[0].hint;
  EXPECT_FALSE(told[1].fix);
}

TEST_F(Imports, grammarsOfOtherNotationsAreDerivedTogether) {
  put("tower.grammar", "Tower -> S ( 2 3 2 ) I ( Cube 1 ) [ T ( 0 1 0 ) I ( Cube 2 ) ]\n");
  put("wall.gbbg", "terminal Brick\nSTART -> Split(X, {1, 1}, FromRoot) {Brick | Brick | Brick}\n");
  const Rules rules =
      Rules::load(put("main.cga",
                      "import tower : \"tower.grammar\"\n"
                      "import wall : \"wall.gbbg\"\n"
                      "@StartRule\n"
                      "Lot --> extrude(2) split(x) { 4 : tower.Tower | ~1 : wall.START }\n"));
  ASSERT_TRUE(rules.ok()) << (rules.diagnostics().empty() ? "" : rules.diagnostics()[0].message);
  const Model model = derive(rules, Shapes::lot(8, 4), {});
  ASSERT_TRUE(model.ok());
  const std::string dump = model.dump();
  EXPECT_EQ(count(dump, "Brick"), 3u) << dump;
  EXPECT_EQ(count(dump, "Tower"), 2u) << dump;
}

// A call that looks the same each time is not, where the import draws or asks where it stands.
TEST_F(Imports, housesOfADynamicImportThatDrawForThemselvesDiffer) {
  for (const char* own : {"rand(1, 5)", "world.x / 10", "grown", "2 * grown"}) {
    put("house.cga",
        std::string("import more : \"more.cga\"\nattr grown = rand(1, 5)\nattr own = ") + own +
            "\nLot --> extrude(own) comp(f) { front : Window }\n"
            "Window --> s(1, '1, 0.1) primitiveCube() comp(f) { all : Wood. }\n");
    put("more.cga", "attr other = rand(1, 2)\nMore --> extrude(other) comp(f) { all : X. }\n");
    const Rules rules = Rules::load(put("main.cga",
                                        "import house : \"house.cga\" ()\n"
                                        "import more : \"more.cga\" ()\n"
                                        "@StartRule\n"
                                        "Lot --> split(x) { { ~5 : House }* | 2 : more().More }\n"
                                        "House --> house().Lot\n"));
    ASSERT_TRUE(rules.ok()) << rules.diagnostics()[0].rendered;
    DeriveSettings settings;
    const Model model = derive(rules, Shapes::lot(40, 8), settings);
    settings.sharing = false;
    EXPECT_EQ(model.dump(), derive(rules, Shapes::lot(40, 8), settings).dump()) << own;
  }
}

TEST_F(Imports, mistakesInThemAreReportedAtTheirPlace) {
  put("tower.grammar", "Tower -> S ( 2 3 2 ) I ( Cube 1\n");
  const Rules rules =
      Rules::load(put("main.cga", "import t : \"tower.grammar\"\nLot --> t.Tower\n"));
  ASSERT_FALSE(rules.diagnostics().empty());
  bool told = false;
  for (const Diagnostic& m : rules.diagnostics())
    told |= m.range->file.find("tower.grammar") != std::string::npos;
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace gable
