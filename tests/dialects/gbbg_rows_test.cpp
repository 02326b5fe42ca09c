// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Row by row what the original offers, each test named after its row. The tables of the six rules
// are in gbbg_table_test.cpp.

#include <filesystem>
#include <map>

#include "base/files.h"
#include "gbbg_run.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

double volumeOf(const TracedShape& s) { return s.size.x * s.size.y * s.size.z; }

std::string testBuilding() {
  return readFile(GABLE_SOURCE_DIR "/tests/dialects/data/test_building.gbbg").value();
}

std::array<Vec3, 2> boundsOf(const Model& model) {
  const BoundingBox box = model.statistics().bounds.value_or(BoundingBox{});
  return {Vec3{box.min[0], box.min[1], box.min[2]}, Vec3{box.max[0], box.max[1], box.max[2]}};
}

TEST(Gbbg, G1ScopesHaveTheirRootAtTheLeastCorner) {
  const Derivation run = derived("axiom A at (1, 2, 3) size (1, 1, 1)\nterminal A");
  const auto box = boundsOf(run.model);
  // The frame is mirrored: z 3..4 is z -4..-3.
  EXPECT_EQ(box[0], (Vec3{1, 2, -4}));
  EXPECT_EQ(box[1], (Vec3{2, 3, -3}));
}

TEST(Gbbg, G1ShapesAreOfThreeOrTwoDimensionsOrEmpty) {
  const Derivation run = derived(
      "axiom START size (4, 4, 4)\nterminal Flat 2D, Solid, Nothing Empty\n"
      "START -> Split(X, {1, 1, 1}) {Flat | Solid | Nothing | EMPTY}");
  ASSERT_EQ(run.leaves().size(), 2u);
  EXPECT_EQ(run.leaves("Flat")[0].size, (Vec3{1, 4, 0}));
  EXPECT_EQ(run.leaves("Solid")[0].size, (Vec3{1, 4, 4}));
  EXPECT_EQ(run.codes(), "");
}

TEST(Gbbg, G2TerminalsAreNotRewritten) {
  const Derivation run = derived(
      "axiom START size (4, 4, 4)\nterminal T\nterminal U\nSTART -> Scope() {T}\nT -> Scope() {U}");
  EXPECT_EQ(run.leaves().size(), 1u);
  EXPECT_EQ(run.leaves("T").size(), 1u);
  EXPECT_EQ(run.codes(), "gbbg-terminal-rule");
}

TEST(Gbbg, G2SymbolsAreAnyText) {
  const Derivation run = derived(
      "axiom \"my start\" size (4, 4, 4)\nterminal \"a b\" [1, 0, 0], split, \"9\", \"a-b\"\n"
      "\"my start\" -> Split(X, {1, 1, 1}) {\"a b\" | split | \"9\" | \"a-b\"}");
  EXPECT_EQ(run.codes(), "");
  std::string names;
  for (const TracedShape& s : run.leaves()) names += s.name + " ";
  EXPECT_EQ(names, "a_b split_ _9 a_b_ ");
  EXPECT_EQ(derived("axiom Axiom size (1, 1, 1)\nterminal Axiom").leaves("Axiom").size(), 1u);
}

TEST(Gbbg, G3ChancesAreNormalisedAndDrawnForEachPiece) {
  const Derivation run = derived(
      "axiom START size (300, 1, 100)\nterminal A [1, 1, 1], B\nSTART -> Grid(Y) {A 1, B 2}");
  const size_t a = run.leaves("A").size(), b = run.leaves("B").size();
  // Both are equally likely to be counted by: B is more likely, and has no preferred size.
  EXPECT_EQ(a + b, 1u);
  const Derivation many = derived(
      "axiom START size (300, 1, 100)\nterminal A [1, 1, 1], B [1, 1, 1]\n"
      "START -> Grid(Y) {A 1, B 2}");
  ASSERT_EQ(many.leaves().size(), 30000u);
  EXPECT_NEAR(static_cast<double>(many.leaves("A").size()) / 30000, 1.0 / 3, 0.01);
}

TEST(Gbbg, G3ASlotOfFourFacesIsDrawnFourTimes) {
  const Derivation run = derived(
      "axiom START size (100, 100, 1)\nterminal A, B\nshape Tower [1, 1, 1]\n"
      "START -> Grid(Z) {Tower}\nTower -> Component(Y, Sides) {A 1, B 3}");
  ASSERT_EQ(run.leaves().size(), 40000u);
  EXPECT_NEAR(static_cast<double>(run.leaves("A").size()) / 40000, 0.25, 0.01);
}

TEST(Gbbg, G5SizesOfZeroAndMoreChangeTheDimensions) {
  const auto size = [](const std::string& changes) {
    const Derivation run =
        derived("axiom START size (4, 5, 6)\nterminal Q\nshape P\nSTART -> " + changes);
    EXPECT_EQ(run.leaves().size(), 1u);
    return run.leaves()[0].size;
  };
  EXPECT_EQ(size("Scope(S(-1, -1, 0, Set)) {Q}"), (Vec3{4, 5, 0}));
  EXPECT_EQ(size("Scope(S(2, 2, 0, Relative)) {Q}"), (Vec3{8, 10, 0}));
  EXPECT_EQ(size("Scope(S(-1, -1, 0, Set)) {P}\nP -> Scope(S(-1, -1, 3, Set)) {Q}"),
            (Vec3{4, 5, 3}));
  EXPECT_EQ(size("Scope(S(-1, -1, 0, Set)) {P}\nP -> Scope(S(1, 1, 0, Add)) {Q}"), (Vec3{5, 6, 0}));
  // What is flat along x or y has that axis as its z.
  EXPECT_EQ(size("Scope(S(0, -1, -1, Set)) {Q}"), (Vec3{6, 5, 0}));
  EXPECT_EQ(size("Scope(S(-1, 0, -1, Set)) {Q}"), (Vec3{4, 6, 0}));
  EXPECT_EQ(size("Scope(S(-9, 0, -9, Add)) {Q}"), (Vec3{4, 5, 6}))
      << "two sizes of zero are refused";
}

TEST(Gbbg, G6SplitsFillTheirPredecessor) {
  for (const char* direction : {"FromRoot", "ToRoot"}) {
    const Derivation run =
        derived("axiom START size (30, 30, 30)\nterminal A, B\nSTART -> Split(Y, {7}, " +
                std::string(direction) + ") {A | B}");
    double sum = 0;
    for (const TracedShape& s : run.leaves()) sum += volumeOf(s);
    EXPECT_NEAR(sum, 27000, 1e-9);
    const bool far = std::string(direction) == "ToRoot";
    EXPECT_EQ(run.leaves("A")[0].scope.origin.y, far ? 23 : 0);
    EXPECT_EQ(run.leaves("B")[0].scope.origin.y, far ? 0 : 7);
    EXPECT_EQ(run.leaves("B")[0].size.y, 23);
  }
}

TEST(Gbbg, G7WidthsThatDoNotFitAreCutWithAWarning) {
  const Derivation run = derived(
      "axiom START size (30, 1, 1)\nterminal A, B, C\nSTART -> Split(X, {20, 20}) {A | B | C}");
  EXPECT_EQ(run.leaves("A")[0].size.x, 20);
  EXPECT_EQ(run.leaves("B")[0].size.x, 10);
  EXPECT_EQ(run.leaves("C").size(), 0u);
  EXPECT_EQ(run.codes(), "split-overflow");
}

TEST(Gbbg, G8RepeatsRoundHalvesToEven) {
  const auto tiles = [](double length, double preferred) {
    const Derivation run =
        derived("axiom START size (" + std::to_string(length) + ", 1, 1)\nterminal A [" +
                std::to_string(preferred) + ", 0, 0]\nSTART -> Repeat(X) {A}");
    for (const TracedShape& s : run.leaves()) {
      EXPECT_NEAR(s.size.x, length / static_cast<double>(run.leaves().size()), 1e-12);
    }
    return run.leaves().size();
  };
  EXPECT_EQ(tiles(30, 4), 8u);
  EXPECT_EQ(tiles(10, 4), 2u);
  EXPECT_EQ(tiles(14, 4), 4u);
  EXPECT_EQ(tiles(1, 4), 1u) << "never none";
  EXPECT_EQ(tiles(30, 0), 1u) << "no preference";
}

TEST(Gbbg, G9GridsFitBothAxes) {
  const Derivation flat =
      derived("axiom START size (23, 23, 0)\nterminal A [4, 4, 4]\nSTART -> Grid(Y) {A}");
  EXPECT_EQ(flat.leaves().size(), 36u);
  const Derivation solid =
      derived("axiom START size (23, 5, 12)\nterminal A [4, 4, 0]\nSTART -> Grid(Y) {A}");
  EXPECT_EQ(solid.leaves().size(), 6u) << "z has no preference";
  EXPECT_EQ(solid.leaves()[0].size.z, 12);
}

TEST(Gbbg, G10MarginsAreAbsoluteRelativeOrAutomatic) {
  const auto pieces = [](const std::string& parameters) {
    const Derivation run =
        derived("axiom START size (30, 10, 20)\nterminal C [8, 9, 3], E, X\nSTART -> Margin(" +
                parameters + ") {C | E | X}");
    double sum = 0;
    for (const TracedShape& s : run.leaves()) sum += volumeOf(s);
    EXPECT_NEAR(sum, 6000, 1e-9) << parameters;
    return std::make_tuple(run.leaves("C").size(), run.leaves("E").size(), run.leaves("X").size(),
                           run.leaves("C")[0].size);
  };
  EXPECT_EQ(pieces("Y, Absolute, 7"), std::make_tuple(4u, 4u, 1u, Vec3{7, 10, 7}));
  EXPECT_EQ(pieces("Y, Relative, 0.1"), std::make_tuple(4u, 4u, 1u, Vec3{3, 10, 2}));
  EXPECT_EQ(pieces("Y, Relative, 0.5"), std::make_tuple(4u, 0u, 0u, Vec3{15, 10, 10}));
  EXPECT_EQ(pieces("Y, 0"), std::make_tuple(4u, 4u, 1u, Vec3{8, 10, 3}));
}

TEST(Gbbg, G10TooWideAMarginIsCutWithAWarning) {
  const Derivation run = derived(
      "axiom START size (30, 10, 20)\nterminal C, E, X\nSTART -> Margin(Y, Absolute, 12) {C | E | "
      "X}");
  EXPECT_EQ(run.codes(), "margin-too-wide");
  EXPECT_EQ(run.leaves("C").size(), 4u);
  EXPECT_EQ(run.leaves("E").size(), 2u);
}

TEST(Gbbg, G11OrientationLeavesTheBoxesInPlace) {
  const auto boxes = [](const std::string& orientation) {
    const Derivation run =
        derived("axiom START size (30, 10, 20)\nterminal C, E\nSTART -> Margin(Y, 4, " +
                orientation + ", NoCenter) {C | E}");
    std::vector<std::array<double, 6>> out;
    for (const TracedShape& s : run.leaves()) {
      const Vec3 a = s.scope.point({}), b = s.scope.point(s.size);
      std::array<double, 6> box;
      for (size_t i = 0; i < 3; ++i) {
        box[i] = std::round(std::min(a[i], b[i]) * 1e6);
        box[i + 3] = std::round(std::max(a[i], b[i]) * 1e6);
      }
      out.push_back(box);
    }
    return out;
  };
  EXPECT_EQ(boxes("FacingOut"), boxes("Default"));
  EXPECT_EQ(boxes("FacingIn"), boxes("Default"));
}

TEST(Gbbg, G13DerivationIsDepthFirstAndTakesTheFirstRule) {
  const Derivation run = derived(testBuilding());
  std::string log;
  std::string last;
  for (const TracedShape& s : run.shapes) {
    if (s.name == "Axiom" || s.name == last) continue;
    log += s.name + " ";
    last = s.name;
  }
  const std::string edge = "ROOFEDGE RoofEdgeSegment ", side = "FootingEdge FootingEdgeSegment ";
  const std::string roof = "ROOFCORNER " + edge + "ROOFCORNER " + edge +
                           "ROOFCENTER RoofTop RoofTop_A RoofTopSegment " + edge + "ROOFCORNER " +
                           edge + "ROOFCORNER ";
  const std::string footing = "FootingCorner " + side + "FootingCorner " + side + side +
                              "FootingCorner " + side + "FootingCorner ";
  std::string floors;
  for (int i = 0; i < 3; ++i) {
    floors += "Floor ";
    for (int k = 0; k < 4; ++k) floors += "Facade FacadeSegment ";
  }
  EXPECT_EQ(log, "START ROOF " + roof + "BODY FOOTING FOOTING_B " + footing + "FLOORS " + floors);

  const Derivation two = derived(
      "axiom START size (1, 1, 1)\nterminal A, B\nSTART -> Scope() {A}\nSTART -> Scope() {B}");
  EXPECT_EQ(two.leaves()[0].name, "A");
  EXPECT_EQ(two.codes(), "duplicate-rule");
}

TEST(Gbbg, G13RulesCanBeDrawnEvenlyOrByWeight) {
  const std::string rest =
      "axiom START size (100, 1, 100)\nterminal A, B\nshape P [1, 0, 1]\nSTART -> Grid(Y) {P}\n"
      "P -> Scope() {A}\nP -> Scope() {B} weight 3\n";
  const Derivation even = derived("select random\n" + rest);
  EXPECT_NEAR(static_cast<double>(even.leaves("A").size()) / 10000, 0.5, 0.02);
  const Derivation weighted = derived("select weighted\n" + rest);
  EXPECT_NEAR(static_cast<double>(weighted.leaves("A").size()) / 10000, 0.25, 0.02);
  EXPECT_EQ(weighted.codes(), "");
}

TEST(Gbbg, G14WhatHasNoRuleIsReportedAndStays) {
  const Derivation run = derived(
      "axiom START size (4, 4, 4)\nSTART -> Split(X, {1}) {Wall | Window}\nterminal Window");
  EXPECT_EQ(run.codes(), "gbbg-no-rule");
  EXPECT_EQ(run.leaves("Wall").size(), 1u);
}

TEST(Gbbg, G14RecursionEndsAtTheLimit) {
  // Not traced: no reader of JSON likes a thousand levels.
  const Rules rules = Rules::parse("axiom A size (4, 4, 4)\nA -> Scope() {A}", "test.gbbg");
  const Model model = derive(rules, Shapes::lot(20, 20), {});
  ASSERT_EQ(model.diagnostics().size(), 1u);
  EXPECT_EQ(model.diagnostics()[0].code, "recursion-too-deep");
  EXPECT_EQ(model.end(), End::LimitReached);
  EXPECT_NE(model.diagnostics()[0].message.find("'A'"), std::string::npos)
      << model.diagnostics()[0].message;
}

// A box of a size as a model, with a mark that reaches beyond it where `overhang` says.
fs::path assetFolder() {
  const fs::path folder = fs::temp_directory_path() / ("gable-gbbg-" + std::to_string(getpid()));
  fs::create_directories(folder / "assets");
  return folder;
}

std::string boxObj(double x, double y, double z, double overhang = 0) {
  std::string out;
  for (int i = 0; i < 8; ++i) {
    out += "v " + std::to_string(i & 1 ? x + overhang : 0) + " " + std::to_string(i & 2 ? y : 0) +
           " " + std::to_string(i & 4 ? z : 0) + "\n";
  }
  return out + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

// Prepares a box of 8 by 9 by 8 as an asset of that volume; returns the project.
fs::path preparedCorner(double overhang = 0) {
  const fs::path folder = assetFolder();
  EXPECT_TRUE(writeFile((folder / "model.obj").string(), boxObj(8, 9, 8, overhang)).ok());
  PrepareSettings s;
  s.volume = {8, 9, 8};
  s.name = "RoofCorner";
  const Model asset = Model::load((folder / "model.obj").string()).prepared(s);
  EXPECT_TRUE(asset.ok());
  EXPECT_TRUE(asset.write((folder / "assets/corner.glb").string(), {}).ok);
  return folder;
}

TEST(Gbbg, G15AssetsFillTheirScopes) {
  const fs::path folder = preparedCorner();
  const std::string path = (folder / "test.gbbg").string();
  const std::string table = "terminal C\npostprocess { C : \"assets/corner.glb\" }\n";
  const Derivation solid =
      derived("axiom C at (1, 2, 3) size (7, 7, 7)\n" + table, {}, Shapes::lot(20, 20), path);
  EXPECT_EQ(solid.codes(), "");
  auto box = boundsOf(solid.model);
  EXPECT_NEAR(length(box[0] - Vec3{1, 2, -10}), 0, 1e-5);
  EXPECT_NEAR(length(box[1] - Vec3{8, 9, -3}), 0, 1e-5);

  // A face has its asset behind it, one deep.
  const Derivation flat =
      derived("axiom C size (7, 6, 0)\n" + table, {}, Shapes::lot(20, 20), path);
  box = boundsOf(flat.model);
  EXPECT_NEAR(length(box[0] - Vec3{0, 0, -1}), 0, 1e-5);
  EXPECT_NEAR(length(box[1] - Vec3{7, 6, 0}), 0, 1e-5);

  DeriveSettings off;
  off.attributes.emplace_back("postProcess", "false");
  const Derivation without =
      derived("axiom C size (7, 7, 7)\n" + table, off, Shapes::lot(20, 20), path);
  EXPECT_EQ(without.leaves("C").size(), 1u);
  EXPECT_EQ(without.model.statistics().faces, 6u);
  fs::remove_all(folder);
}

TEST(Gbbg, G15TheDeclaredVolumeOrTheBoundsAreFitted) {
  const fs::path folder = preparedCorner(2);
  const std::string path = (folder / "test.gbbg").string();
  const std::string start = "axiom C size (8, 9, 8)\nterminal C\npostprocess { C : ";
  const Derivation volume =
      derived(start + "\"assets/corner.glb\" fit volume }", {}, Shapes::lot(20, 20), path);
  EXPECT_NEAR(boundsOf(volume.model)[1].x, 10, 1e-5);
  const Derivation bounds =
      derived(start + "\"assets/corner.glb\" fit bounds }", {}, Shapes::lot(20, 20), path);
  EXPECT_NEAR(boundsOf(bounds.model)[1].x, 8, 1e-5);
  fs::remove_all(folder);
}

TEST(Gbbg, G16APreparedModelFillsAScopeExactly) {
  const fs::path folder = assetFolder();
  ASSERT_TRUE(writeFile((folder / "model.obj").string(), boxObj(9, 8, 8)).ok());
  const Model model = Model::load((folder / "model.obj").string());
  PrepareSettings s;
  // Turned so that 8 by 9 by 8 stands on the pivot.
  s.pivot = {0, 8, 0};
  s.rotate[2] = 90;
  s.volume = {8, 9, 8};
  const auto isUnitCube = [](const std::optional<BoundingBox>& box) {
    ASSERT_TRUE(box.has_value());
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(box->min[i], 0, 1e-9);
      EXPECT_NEAR(box->max[i], 1, 1e-9);
    }
  };
  isUnitCube(model.prepared(s).bounds());
  // Without a volume it is the model's own; a flat one has a metre.
  isUnitCube(model.prepared({}).bounds());
  s.volume = {8, 0, 8};
  EXPECT_FALSE(model.prepared(s).ok());
  fs::remove_all(folder);
}

TEST(Gbbg, G17SeedsAreSignedIntegers) {
  const std::string grammar =
      "axiom START size (40, 1, 1)\nterminal A [1, 0, 0], B [1, 0, 0]\nSTART -> Repeat(X) {A, B}";
  const auto names = [&](double seed) {
    DeriveSettings s;
    s.seed = seed;
    std::string out;
    for (const TracedShape& leaf : derived(grammar, s).leaves()) out += leaf.name;
    return out;
  };
  EXPECT_EQ(names(654163516), names(654163516));
  EXPECT_EQ(names(-2147483648.0), names(-2147483648.0));
  EXPECT_NE(names(2147483647), names(-2147483648.0));
  EXPECT_NE(names(1), names(2));
}

TEST(Gbbg, G18TheAxiomIsAListOfShapes) {
  const std::string rules = "\nterminal A [1, 0, 0], B [1, 0, 0]\nSTART -> Repeat(X) {A, B}\n";
  const Derivation both =
      derived("axiom START size (40, 1, 1), START at (0, 5, 0) size (30, 1, 1)" + rules);
  EXPECT_EQ(both.leaves().size(), 70u);
  std::string first, second;
  for (const TracedShape& s : both.leaves()) {
    if (first.size() < 30 && s.scope.origin.y < 1) first += s.name;
    if (s.scope.origin.y > 1) second += s.name;
  }
  EXPECT_NE(first, second) << "each start shape draws for itself";
  // Lines add up.
  EXPECT_EQ(derived("axiom START size (40, 1, 1)\naxiom START at (0, 5, 0) size (30, 1, 1)" + rules)
                .leaves()
                .size(),
            70u);
}

TEST(Gbbg, G19StepsReplayFromTheTree) {
  const Derivation run = derived(
      "axiom START size (8, 8, 8)\nterminal T\nshape P [2, 2, 2]\nSTART -> Grid(Y) {P}\n"
      "P -> Split(Y, {3}) {T | T}");
  // The nodes in order are the rule applications in order: after k of them the shapes that are
  // there fill what the first one filled.
  std::vector<TracedShape> active = {run.shapes[1]};
  size_t steps = 0;
  for (size_t i = 1; i < run.shapes.size(); ++i) {
    std::vector<TracedShape> children;
    for (size_t k = i + 1; k < run.shapes.size() && run.shapes[k].depth > run.shapes[i].depth;
         ++k) {
      if (run.shapes[k].depth == run.shapes[i].depth + 1) children.push_back(run.shapes[k]);
    }
    if (children.empty()) continue;
    const auto at = std::find_if(active.begin(), active.end(), [&](const TracedShape& s) {
      return differenceOf(s, run.shapes[i]) < 1e-9;
    });
    ASSERT_NE(at, active.end());
    active.erase(at);
    active.insert(active.end(), children.begin(), children.end());
    double sum = 0;
    for (const TracedShape& s : active) sum += volumeOf(s);
    EXPECT_NEAR(sum, 512, 1e-9) << "after step " << ++steps;
  }
  EXPECT_EQ(active.size(), run.leaves().size());
}

TEST(Gbbg, G22RulesAreSharedBetweenGrammars) {
  const fs::path folder = assetFolder();
  ASSERT_TRUE(writeFile((folder / "roof.gbbg").string(),
                        "terminal Tile [2, 2, 0]\nROOF -> Component(Y, Top) {Slab}\n"
                        "Slab -> Grid(Y) {Tile}\nuse \"roof.gbbg\"\n")
                  .ok());
  const std::string main =
      "use \"roof.gbbg\"\naxiom START size (8, 3, 8)\nterminal Body\n"
      "START -> Split(Y, {1}, ToRoot) {ROOF | Body}\n";
  const Derivation run = derived(main, {}, Shapes::lot(20, 20), (folder / "main.gbbg").string());
  EXPECT_EQ(run.codes(), "");
  EXPECT_EQ(run.leaves("Tile").size(), 16u);

  ASSERT_TRUE(writeFile((folder / "bad.gbbg").string(), "A -> Grid(Y) {B\n").ok());
  const Rules bad = Rules::parse("use \"bad.gbbg\"\nuse \"none.gbbg\"\naxiom B size (1, 1, 1)\n",
                                 (folder / "main.gbbg").string(), {folder.string(), {}, {}});
  ASSERT_GE(bad.diagnostics().size(), 2u);
  EXPECT_EQ(bad.diagnostics()[0].range->line, 1u);
  EXPECT_NE(bad.diagnostics()[0].message.find("bad.gbbg:1:14"), std::string::npos);
  EXPECT_EQ(bad.diagnostics()[1].code, "gbbg-use");
  EXPECT_EQ(bad.diagnostics()[1].range->line, 2u);
  fs::remove_all(folder);
}

TEST(Gbbg, G23TestBuilding) {
  const Derivation run = derived(testBuilding());
  EXPECT_EQ(run.codes(), "");
  const std::map<std::string, size_t> counts = {{"Floor", 3},
                                                {"Facade", 12},
                                                {"FacadeSegment", 96},
                                                {"ROOFCORNER", 4},
                                                {"ROOFEDGE", 4},
                                                {"RoofEdgeSegment", 16},
                                                {"ROOFCENTER", 1},
                                                {"RoofTopSegment", 36},
                                                {"FootingCorner", 4},
                                                {"FootingEdge", 4},
                                                {"FootingEdgeSegment", 24}};
  for (const auto& [name, count] : counts) EXPECT_EQ(run.count(name), count) << name;
  EXPECT_EQ(run.leaves().size(), 180u);
  const std::map<std::string, Vec3> sizes = {
      {"FacadeSegment", {3.75, 7, 0}}, {"ROOFCORNER", {7, 7, 7}},
      {"RoofEdgeSegment", {4, 7, 7}},  {"RoofTopSegment", {23.0 / 6, 23.0 / 6, 0}},
      {"FootingCorner", {4, 2, 4}},    {"FootingEdgeSegment", {4, 2, 4}}};
  for (const auto& [name, size] : sizes) {
    for (const TracedShape& s : run.leaves(name)) {
      EXPECT_NEAR(length(s.size - size), 0, 1e-9) << name;
    }
  }
  const auto box = boundsOf(run.model);
  EXPECT_EQ(box[0], (Vec3{-1, 0, -31}));
  EXPECT_EQ(box[1], (Vec3{31, 30, 1}));
}

TEST(Gbbg, G23WithTheEmptyOptionFloorsAreDrawn) {
  std::string text = testBuilding();
  text.replace(text.find("{Floor}"), 7, "{Floor 1, EMPTY 0.2}");
  double floors = 0;
  for (int seed = 0; seed < 300; ++seed) {
    DeriveSettings s;
    s.seed = seed;
    const size_t n = derived(text, s).count("Floor");
    ASSERT_LE(n, 3u);
    floors += static_cast<double>(n);
  }
  EXPECT_NEAR(floors / 900, 1 / 1.2, 0.04);
}

// Converted to Gable's own language a grammar gives the same model, draw by draw.
void expectSameConverted(const std::string& grammar, const std::string& project = {}) {
  const std::string path = (project.empty() ? "" : project + "/") + "test.gbbg";
  const LoadSettings options{project, {}, {}};
  const Converted converted = convert(grammar, path, options);
  ASSERT_FALSE(hasErrors(converted.diagnostics));
  const Rules before = Rules::parse(grammar, path, options);
  const Rules after = Rules::parse(converted.text, path + ".cga", options);
  for (const Diagnostic& m : after.diagnostics()) ADD_FAILURE() << m.rendered;
  for (const double seed : {0.0, 7.0}) {
    DeriveSettings settings;
    settings.seed = seed;
    const Model a = derive(before, Shapes::lot(20, 30), settings);
    const Model b = derive(after, Shapes::lot(20, 30), settings);
    EXPECT_FALSE(a.dump().empty());
    EXPECT_EQ(a.dump(), b.dump()) << converted.text;
  }
}

TEST(Gbbg, ConvertedGrammarsGiveTheSameModel) {
  expectSameConverted(testBuilding());
  expectSameConverted(
      "select weighted\nterminal A [1, 1, 0], B 2D, \"c d\" Empty, E [2, 0, 0]\n"
      "START -> Margin(X, Relative, 0.3, FacingIn) {A | B 1, EMPTY 2, \"c d\" 0.1 | P}\n"
      "P -> Component(Z, TopPlusBottom) {A | B}\nP -> Split(Z, {1.25}, ToRoot) {Q 1, A 3 | R}\n"
      "Q -> Scope(T(1, 2, 3, Set), R(10, -20, 30, World), S(2, -1, 0, Set)) {A 1, B 1} weight 2\n"
      "R -> Repeat(X) {E 1, A 2}\n");
  const std::string folder = GABLE_SOURCE_DIR "/examples/gbbg";
  expectSameConverted(readFile(folder + "/gbbg.gbbg").value(), folder);
}

TEST(Gbbg, FootprintsAreStartShapesToo) {
  const std::string rules =
      "\nterminal F\nshape B\nSTART -> Split(Y, {3}) {F | B}\nB -> Scope() {F}";
  const Derivation run =
      derived("axiom START on footprint height 12" + rules, {}, Shapes::lot(30, 20));
  EXPECT_EQ(run.leaves()[0].size, (Vec3{30, 3, 20}));
  EXPECT_EQ(run.leaves()[1].size, (Vec3{30, 9, 20}));
  DeriveSettings tall;
  tall.attributes.emplace_back("height", "33");
  EXPECT_EQ(derived(rules, tall, Shapes::lot(30, 20)).leaves()[1].size, (Vec3{30, 30, 20}));
}

}  // namespace
}  // namespace gable
