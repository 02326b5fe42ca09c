// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The park notation beyond the rows: parameters, functions, other blocks, and what single
// operations can be told.

#include <tuple>

#include "dialects/dialect.h"
#include "dialects/park/meanings.h"
#include "dialects/park/operations.h"
#include "dialects/park/park.h"
#include "park_testing.h"

namespace gable {
namespace {

using namespace park_testing;

TEST(ParkNotation, MistakesInConditionsAreReportedOnce) {
  const Made m = run("R -> case w + foo > 3 : A else : B", kLot);
  EXPECT_TRUE(m.has("bad-expression"));
  EXPECT_FALSE(m.has("type-mismatch"));
}

TEST(ParkNotation, OperationsAndPointsAreNoLeaves) {
  EXPECT_TRUE(run("R -> Circle", kLot).has("wrong-argument-count"));
  EXPECT_TRUE(run("R -> Peel(OUTER, 1) { A | romb }", kLot).has("wrong-argument-count"));
  EXPECT_TRUE(run("R -> Corner(Region)", kLot).has("unknown-operation"));
  EXPECT_TRUE(run("R -> Peel(OUTER, 1) { A | Corners(Region) }", kLot).has("unknown-operation"));
  EXPECT_FALSE(run("R -> Circle\nCircle -> A", kLot).has("wrong-argument-count"));
}

TEST(ParkNotation, LaterThingsKeepClearOfEarlierOnes) {
  // The pond reaches two of the beds.
  Made m =
      run("R -> Place((0.3, 0.5)) { Circle(4) Pond } "
          "Place((0.12, 0.5), (0.5, 0.5), (0.8, 0.2)) { Circle(2) Bed }",
          kLot);
  EXPECT_EQ(m.count["Pond"], 1);
  EXPECT_EQ(m.count["Bed"], 1);
  EXPECT_TRUE(m.has("place-occupied"));
  EXPECT_NEAR(m.whole, 400, 1e-6);
  // What only touches the other, or the border of the plot, stays.
  m =
      run("R -> Place((0.5, 0.5)) { Square(4) Pond } "
          "Place((0.3, 0.5), (0.7, 0.5), (0.05, 0.1)) { Square(4) Bed }",
          kLot);
  EXPECT_EQ(m.count["Bed"], 3);
  EXPECT_NEAR(m.area["Bed"], 16 + 16 + 12, 1e-6);
  // The pond reaches the border, and cuts the region instead of making a hole in it.
  m =
      run("R -> Place((0.1, 0.5)) { Circle(4) Pond } "
          "Place((0.35, 0.5), (0.6, 0.5)) { Square(4) Bed }",
          kLot);
  EXPECT_EQ(m.count["Bed"], 1);
}

TEST(ParkNotation, ReportsWhatItCannotRead) {
  EXPECT_TRUE(run("", kLot).has("no-rules"));
  EXPECT_TRUE(run("R -> Grid(2, 2) { A } )", kLot).has("unexpected-text"));
  EXPECT_TRUE(run("R -> Nonsense(2) { A }", kLot).has("unknown-operation"));
  EXPECT_TRUE(run("R -> A\nR -> B", kLot).has("duplicate-rule"));
  EXPECT_TRUE(run("P = x + \nR -> A", kLot).has("bad-constant"));
  EXPECT_TRUE(run("R -> case (w == ) : A else : B", kLot).has("bad-expression"));
  EXPECT_TRUE(run("R -> Grid(2,2) {A}{B}{C}{D}", kLot).has("too-many-blocks"));
  EXPECT_TRUE(run("R -> A(1)\nA(x, y) -> B", kLot).has("wrong-argument-count"));
  EXPECT_TRUE(run("R -> F\nfun F -> F", kLot).has("nesting-too-deep"));
  EXPECT_TRUE(run("R -> F(1)\nfun F(x) -> F(x+x) F(x+x) F(x+x)", kLot).has("nesting-too-deep"));
  // What doubles with each function: calls, and the text of an argument.
  std::string calls = "R -> F0(1)\n", texts = calls;
  for (int i = 0; i < 30; ++i) {
    const std::string f = "fun F" + std::to_string(i) + "(x) -> F" + std::to_string(i + 1);
    calls += f + "(x) F" + std::to_string(i + 1) + "(x)\n";
    texts += f + "(x+x)\n";
  }
  EXPECT_TRUE(run(calls + "fun F30(x) -> Extrude(x)", kLot).has("nesting-too-deep"));
  EXPECT_TRUE(run(texts + "fun F30(x) -> Extrude(x)", kLot).has("nesting-too-deep"));
  EXPECT_TRUE(run("R -> Select { A }", kLot).has("bad-argument"));
}

TEST(ParkNotation, BeginsWithTheFirstRuleThatIsNoFunction) {
  const auto made = run("fun Box(d) -> Circle(d) Extrude(1)\nRegion -> Box(2)", kLot);
  EXPECT_FALSE(made.has("unused-rule"));
  EXPECT_TRUE(run("R -> A\nfun Box(d) -> Circle(d)", kLot).has("unused-rule"));
}

TEST(ParkNotation, SlipsAreFound) {
  const std::pair<const char*, const char*> slips[] = {
      {"R -> Contrct(2) A", "unknown-operation"},
      {"R -> Extrud(2)", "unknown-operation"},
      {"R -> YELOW A", "unknown-colour"},
      {"R -> Circle() A", "wrong-argument-count"},
      {"R -> Place(CENTRE) { Square() A }", "wrong-argument-count"},
      {"R -> Quartr\nQuarter -> A", "undefined-rule"},
      {"PathWidht = 2\nR -> Grid(2, 2) { A }", "unused-rule"},
      {"R -> Grid(2, 2) { regoin: A }", "unknown-selector"},
      {"R -> Grid(2, 2) { A } { B } { Romp(3) C }", "unknown-operation"},
      {"R -> Contract(1, centr) A", "bad-argument"},
      {"R -> F(2, 3)\nfun F(d) -> Contract(d)", "wrong-argument-count"},
      {"R -> Sweep(F(2, 3), width=1) { H }\nfun F(d) -> Parametrise([0, 1]) { Contract(d) }",
       "wrong-argument-count"},
      {"R -> Distribute(W: 1, [from : 3]) { A }", "bad-argument"},
      {"R -> Distribute(W: 1, [0 : 3 : 1]) { A }", "bad-argument"},
      {"R -> Distribute(W: 1, [start : 3 : end : 2]) { A }", "bad-argument"},
      {"R -> Peel(OUTER) { A | B }", "wrong-argument-count"},
      {"R -> Peel(Outr, 1) { A | B }", "bad-selection"},
      {"R -> Distribute(side(Q), 2) { A }", "bad-selection"},
      {"R -> Grid(2, 2, pattrn=pair) { A }", "bad-argument"},
      {"R -> Grid(2, 2, pattern=par) { A }", "unknown-selector"},
      {"R -> Grid(2, x) { A }", "bad-expression"},
      {"R -> Place(CENTR) { A }", "bad-selection"},
      {"R -> Sweep(Q(1)) { A }", "bad-selection"},
      {"R -> VoronoiRegions(3 {2}, averag) { A }", "bad-selection"},
      {"R -> A\nB -> C", "unused-rule"}};
  for (const auto& [text, code] : slips) EXPECT_TRUE(run(text, kLot).has(code)) << text;
}

// What would be dropped in silence is told.
TEST(ParkNotation, WhatAnOperationDoesNotTakeIsFound) {
  const std::pair<const char*, const char*> slips[] = {
      {"R -> Extrude(2, 5)", "wrong-argument-count"},
      {"R -> Extrude()", "wrong-argument-count"},
      {"R -> Color(\"#aabbcc\", 3)", "wrong-argument-count"},
      {"R -> loadModel()", "wrong-argument-count"},
      {"R -> loadModel(\"bench\", \"lamp\")", "wrong-argument-count"},
      {"R -> Insert(1, 2)", "wrong-argument-count"},
      {"R -> QuadMap(2, 2, 3) { A }", "wrong-argument-count"},
      {"R -> Contract() A", "wrong-argument-count"},
      {"R -> NoHoles(3) A", "wrong-argument-count"},
      {"R -> Choose(3) { A, B }", "wrong-argument-count"},
      {"R -> Select(3) { outer : A }", "wrong-argument-count"},
      {"R -> joined(3) { A B }", "wrong-argument-count"},
      {"R -> Contract(1) { A }", "too-many-blocks"},
      {"R -> Extrude(1) { A }", "too-many-blocks"},
      {"R -> Circle(1) { A }", "too-many-blocks"},
      {"R -> Place(CENTRE) { Circle(1) { A } }", "too-many-blocks"},
      {"R -> B { A }\nB -> C", "too-many-blocks"},
      {"R -> Place(CENTRE) { A | B }", "too-many-blocks"},
      {"R -> Scatter(2 {1}) { A } { B }", "too-many-blocks"},
      {"R -> Place(CENTRE) { foo : A }", "unknown-selector"},
      {"R -> Extrude(1) else { A }", "unexpected-text"},
      {"R -> Grid(2, 2) { A | B\nA -> C", "unclosed-block"},
      {"R -> Extrude[1 A\nA -> C", "unclosed-bracket"},
      {"R(a -> Extrude(1) A", "unclosed-bracket"},
      {"R -> Scatter(3 {1} 2) { A }", "bad-argument"},
      {"R -> Choose { A, 130%: B }", "weights-over-100"},
      {"R -> Choose { A, x%: B }", "bad-argument"},
      {"R -> Choose { }", "bad-argument"},
      {"R -> Grid(2, 2) { A } { B } { Choose { Circle(1) P, x%: Romb(1) P } }", "bad-argument"},
      {"R -> case (ix == 1): A", "missing-else"},
      {"R -> RED(3)", "undefined-rule"},
      {"R -> Foo(3)", "undefined-rule"},
      {"R(x) -> Contract(x) A", "wrong-argument-count"}};
  for (const auto& [text, code] : slips) EXPECT_TRUE(run(text, kLot).has(code)) << text;
  for (const char* right :
       {"R -> Insert(1) { A } Extrude(2)", "R -> Contract(2) else { A } NoHoles",
        "R -> ParkPath(..)", "R -> Choose { 30%: A, 30%: B, C }", "R -> Choose { 50: A, 50: B }",
        "R -> Extrude(w / 2)", "R -> Sweep(outer, width=1, joins=round) { Hedge } else { A }",
        "R -> Place(CENTRE) { Circle(2) A } QuadMap(2, 2) { A | B } else { C }"}) {
    const Made m = run(right, kLot);
    EXPECT_TRUE(m.diagnostics.empty()) << right << render(m.diagnostics);
  }
}

// The leaves of a grammar on the lot, with their colours.
std::string leavesOf(const std::string& text) {
  return derive(Rules::parse(text, "a.park"), Shapes::lot(20, 20), {}).dump();
}

TEST(ParkNotation, ColoursAndPicturesStay) {
  for (const char* text : {"R -> Color(\"#ff0000\")", "R -> Color(\"#ff0000\") Lawn",
                           "R -> Red()\nfun Red() -> Colour(\"#ff0000\")",
                           "R -> Color(\"#ff0000\") Contract(1) Extrude(2)",
                           "R -> Color(\"#ff0000\") Place(CENTRE) { A }"}) {
    const std::string leaves = leavesOf(text);
    EXPECT_NE(leaves.find("color #ff0000"), std::string::npos) << text << leaves;
  }
  const std::string pictured = leavesOf("R -> Texture(\"gravel.jpg\")");
  EXPECT_EQ(pictured.find("color"), std::string::npos) << pictured;
  // What an operation makes has colours of its own.
  const std::string cells = leavesOf("R -> Color(\"#ff0000\") Grid(2, 2) { Lawn }");
  EXPECT_EQ(cells.find("color #ff0000"), std::string::npos) << cells;
}

// line:column of the first message with that code.
std::string placeOf(const Made& made, const std::string& code) {
  for (const Diagnostic& m : made.diagnostics) {
    if (m.code != code || !m.range) continue;
    return std::to_string(m.range->line) + ":" + std::to_string(m.range->column);
  }
  return "none";
}

TEST(ParkNotation, MistakesAreToldWhereTheyStand) {
  const std::tuple<const char*, const char*, const char*> mistakes[] = {
      {"R -> Peel(outer & Outr, 1) { A | B }", "bad-selection", "1:19"},
      {"R -> Grid(2, x + 1) { A }", "bad-expression", "1:14"},
      {"R -> Contract(1 + nothing) A", "bad-expression", "1:19"},
      {"R -> case (w == 2 && hh > 3) : A else : B", "bad-expression", "1:22"},
      {"R -> Distribute(outer & side(Q), 2) { A }", "bad-selection", "1:30"},
      {"R -> Sweep(outer, width=1, joins=foo) { A }", "unknown-selector", "1:34"},
      {"R -> Scatter(2 {1}) { A } { B }", "too-many-blocks", "1:29"},
      {"R -> A Contrct(2)", "unknown-operation", "1:8"}};
  for (const auto& [text, code, place] : mistakes) {
    EXPECT_EQ(placeOf(run(text, kLot), code), place) << text;
  }
}

TEST(ParkNotation, HintsSpellAsTheNotationDoes) {
  for (const Diagnostic& m : run("R - A", kLot).diagnostics) {
    if (m.code == "unexpected-text") {
      EXPECT_NE(m.hint.find("'Name -> operations'"), std::string::npos);
    }
  }
  for (const Diagnostic& m : run("R -> Voronoii(5) { A } { B }", kLot).diagnostics) {
    if (m.code == "unknown-operation") {
      EXPECT_EQ(m.hint, "did you mean 'Voronoi'?");
    }
  }
  for (const Diagnostic& m : run("R -> Grid(2, 2, fit=centr) { A }", kLot).diagnostics) {
    if (m.code == "unknown-selector") {
      EXPECT_EQ(m.hint, "did you mean 'center'?");
    }
  }
  EXPECT_TRUE(run("R -> Grid(2, 2, fit=centr) { A }", kLot).has("unknown-selector"));
  EXPECT_TRUE(run("R -> Voronoii(5) { A } { B }", kLot).has("unknown-operation"));
  EXPECT_FALSE(run("R -> Voronoi(5) { A } { B }", kLot).has("unknown-operation"));
}

TEST(ParkNotation, wordsOfCgaAreToldTheirOwnWord) {
  const std::pair<const char*, const char*> slips[] = {
      {"R -> offset(2, inside)", "Contract(2)"},
      {"R -> split(x) { A }", "Grid(3, 2) { A }"},
      {"R -> i(\"tree.obj\")", "loadModel(\"tree\")"}};
  for (const auto& [text, own] : slips) {
    const auto made = run(text, kLot);
    ASSERT_TRUE(made.has("unknown-operation")) << text;
    for (const Diagnostic& m : made.diagnostics) {
      if (m.code == "unknown-operation") {
        EXPECT_NE(m.hint.find(own), std::string::npos) << m.hint;
      }
    }
  }
  EXPECT_FALSE(run("R -> extrude(3)", kLot).has("unknown-operation"));
}

TEST(ParkNotation, TheGuideAndEditorsKnowAllOperations) {
  const std::string guide = readFile(std::string(GABLE_SOURCE_DIR) + "/docs/guide/park.md").value();
  std::set<park::Operation> proposed;
  for (const DialectWord& w : park::words()) proposed.insert(park::operationNamed(w.name));
  for (const park::OperationName& n : park::operationNames()) {
    const std::string written = "`" + std::string(n.name);
    const bool named = guide.find(written + "(") != std::string::npos ||
                       guide.find(written + " ") != std::string::npos ||
                       guide.find(written + "`") != std::string::npos;
    EXPECT_TRUE(named) << n.name << " is missing in docs/guide/park.md";
    EXPECT_TRUE(proposed.count(n.operation)) << n.name << " is missing in words.cpp";
  }
  for (const std::string_view word : park::colourWords()) {
    std::string upper(word);
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    EXPECT_NE(guide.find("`" + upper + "`"), std::string::npos) << upper << " is missing";
  }
}

// Partitions and placements never change the area.
TEST(ParkNotation, FiguresAreMadeOnce) {
  const Shapes plot = Shapes::polygon({{0, 0}, {60, 0}, {60, 25}, {35, 25}, {35, 50}, {0, 50}});
  const Made grid =
      run("PathWidth = 2\nR -> Grid(4, 3) { Cell } { Way } { Circle(2) Plaza }", plot);
  EXPECT_NEAR(grid.whole, 2375, 0.01);
  EXPECT_EQ(grid.count.count("Centre"), 0u);
  const Made corners = run("R -> Place(CORNER(OUTER)) { Circle(1) A } Lawn", plot);
  EXPECT_NEAR(corners.whole, 2375, 0.01);
  const Made byRule = run("R -> Place(CORNER(OUTER)) { Bed } Lawn\nBed -> Circle(1) A", plot);
  EXPECT_NEAR(byRule.whole, 2375, 0.01);
  // What stands on it needs the ground beneath.
  const Made model =
      run("R -> Grid(2, 2) { A } { B } { Circle(2) M }\nM -> loadModel(\"x\")", kLot);
  EXPECT_EQ(model.count.at("Centre"), 1);
}

TEST(ParkNotation, FlatThingsCutTheirGround) {
  EXPECT_NEAR(run("R -> Scatter(3 {1.2}) { Pond } Lawn", kLot).whole, 400, 1e-3);
  EXPECT_NEAR(run("R -> Sweep(W, width=1) { Bed } Lawn\nBed -> SOIL", kLot).whole, 400, 1e-3);
  EXPECT_GT(run("R -> Scatter(3 {1.2}, over) { Pond } Lawn", kLot).whole, 410);
}

TEST(ParkNotation, TooSmallForAGridGoesToElse) {
  const Shapes small = Shapes::lot(0.4, 0.25);
  EXPECT_EQ(run("R -> Grid(7, 5) { A } else { B }", small).count.at("B"), 1);
  const Made m = run("R -> Grid(7, 5, minarea=15) { A } {}", kLot);
  EXPECT_LT(m.count.at("A"), 30);
  EXPECT_NEAR(m.whole, 400, 1e-3);
}

TEST(ParkNotation, PlacesAlongEdgesRunClockwise) {
  const Made m = run("R -> Distribute(W : 1, [0.2, 0.3]) { T } Lawn", kLot);
  ASSERT_EQ(m.count.at("T"), 2);
  for (const Vec3& at : m.places.at("T")) EXPECT_GT(at.z, -7);
  const Made first = run("R -> Distribute(W : 1, [start : 2]) { T } Lawn", kLot);
  ASSERT_EQ(first.count.at("T"), 2);
  double south = -20;
  for (const Vec3& at : first.places.at("T")) south = std::max(south, at.z);
  EXPECT_NEAR(south, 0, 1e-6);
}

// Lines around a figure leave the region as it is.
TEST(ParkNotation, LinesMayRunAroundAFigure) {
  const char* const both[] = {
      "R -> Sweep(F(0), width=0.5) { Kerb } Lawn\nKerb -> STONE Extrude(1)\n"
      "fun F(d) -> Parametrise(_ _ _ _, Square(10)) { Contract(d) }",
      "R -> Parametrise(_ _ _ _, Square(10)) { Kerb } Lawn\nKerb -> STONE"};
  for (const char* text : both) {
    const Made m = run(text, kLot);
    EXPECT_NEAR(m.area.at("Lawn"), 400, 1e-6) << text;
    for (const Vec3& at : m.places.at("Kerb")) EXPECT_LT(std::fabs(at.x - 10), 5.1) << text;
  }
}

TEST(ParkNotation, RulesTakeParameters) {
  const Made m =
      run("Width = 9\nR -> Strip(2, 0.5)\n"
          "Strip(Width, r) -> Peel(all, Width) { Edge(Width * 2) | Disc(r) }\n"
          "Edge(a) -> case (a == 4): Right else: Wrong\n"
          "Disc(r) -> Circle(r * 4)",
          kLot);
  EXPECT_EQ(m.count.at("Right"), 1);
  EXPECT_NEAR(m.area.at("Right"), 400 - 256, 1e-3);
  // A disc of 24 sides.
  EXPECT_NEAR(m.area.at("Disc"), 12 * 4 * std::sin(kPi / 12), 1e-3);
  // In texts as well: the spacing of trees, and the figure that is cut out.
  const Made t = run("R -> Trees(5, 1)\nTrees(d, r) -> Distribute(S : r, [: d : ]) { Circle(r) T }",
                     Shapes::lot(20, 10));
  EXPECT_EQ(t.count.at("T"), 4);
}

TEST(ParkNotation, FunctionsAreFilledIn) {
  const Made m = run("R -> Bordered(2) Lawn\nfun Bordered(d) -> Contract(d)", kLot);
  EXPECT_NEAR(m.area.at("Lawn"), 256, 1e-3);
  const Made lines =
      run("R -> Sweep(Around(3), width=0.5) { Hedge }\n"
          "fun Around(d) -> Parametrise(_ _ _ _) { Contract(d) }",
          kLot);
  EXPECT_EQ(lines.count.at("Hedge"), 1);
}

TEST(ParkNotation, OtherwiseIsDoneWhenNothingElseIs) {
  EXPECT_NEAR(run("R -> Contract(30) { } else { B }", kLot).area.at("B"), 400, 1e-6);
  EXPECT_NEAR(run("R -> Contract(30) else { B } A", kLot).whole, 400, 1e-6);
  EXPECT_EQ(run("R -> Contract(1) else { B } A", kLot).count.count("B"), 0u);
  EXPECT_EQ(run("R -> Place((2, 2)) { Circle(1) } else { B } A", kLot).count.at("B"), 1);
  EXPECT_EQ(run("R -> Distribute(pathside, 2) { T } else { B } A", kLot).count.at("B"), 1);
  EXPECT_EQ(run("R -> ScatterCircles(3 {50}) { T } else { B } A", kLot).count.at("B"), 1);
  EXPECT_EQ(run("R -> Sweep(pathside) { T } else { B } A", kLot).count.at("B"), 1);
  const Made done = run("R -> Place(CENTRE) { Circle(1) T } else { B } A", kLot);
  EXPECT_EQ(done.count.count("B"), 0u);
  EXPECT_NEAR(done.whole, 400, 1e-3);
}

TEST(ParkNotation, SelectTakesTheFirstSelectionThatMeansAnEdge) {
  const std::string cells =
      "R -> Grid(3, 3) { C } {}\nC -> Select { W & outer : Left | outer : "
      "Side } else { Middle }";
  const Made m = run(cells, Shapes::lot(30, 30));
  EXPECT_EQ(m.count.at("Middle"), 1);
  EXPECT_EQ(m.count.at("Left") + m.count.at("Side"), 8);
}

TEST(ParkNotation, InsertCutsTheOuterCorners) {
  const Made m = run("R -> Insert(2) Lawn", kLot);
  const double quarter = 12 * 4 * std::sin(kPi / 12) / 4;
  EXPECT_NEAR(m.area.at("Lawn"), 400 - 4 * quarter, 1e-3);
  // Of a cell only the corner that is the park's own.
  const Made cells = run("R -> Grid(2, 2) { Insert(2) C } {}", kLot);
  EXPECT_NEAR(cells.area.at("C"), 400 - 4 * quarter, 1e-3);
}

TEST(ParkNotation, JoinedUnitesFigures) {
  const Made m = run("R -> joined { Rect(10, 2) Rect(2, 10) Cross }", kLot);
  EXPECT_EQ(m.count.at("Cross"), 1);
  EXPECT_NEAR(m.area.at("Cross"), 36, 1e-3);
}

TEST(ParkNotation, JunctionsAreChosen) {
  const std::string drawn =
      "PathWidth = 2\nR -> Grid(5, 5) { A } { B } { Choose { 50%: Romb(3) Stone, Circle(2) Basin } "
      "}";
  const Made m = run(drawn, Shapes::lot(100, 100));
  EXPECT_EQ(m.count.at("Stone") + m.count.at("Basin"), 16);
  EXPECT_GT(m.count.at("Stone"), 0);
  EXPECT_GT(m.count.at("Basin"), 0);
  const std::string placed =
      "PathWidth = 2\nR -> Grid(4, 4) { A } { B } { J }\n"
      "J -> case (bx == 1 && by == 1): Circle(4) Pond else: Romb(2) Plaza";
  const Made p = run(placed, Shapes::lot(100, 100));
  EXPECT_EQ(p.count.at("Pond"), 1);
  EXPECT_EQ(p.count.at("Plaza"), 8);
  EXPECT_NEAR(p.whole, 10000, 0.01);
}

TEST(ParkNotation, EntrancesArePlacesAlongTheOutline) {
  const Made m =
      run("PathWidth = 1\nR -> CastRays(CENTRE, Entrances([0.5, 1.5, 2.5])) { A } { B }", kLot);
  EXPECT_EQ(m.count.at("B"), 3);
  for (const Vec3& at : m.places.at("B")) {
    EXPECT_TRUE(std::fabs(at.x - 10) < 0.01 || std::fabs(at.z + 10) < 0.01);
  }
}

TEST(ParkNotation, MapsAreCellsBetweenTheSides) {
  const Made m = run("R -> QuadMap(4, 3) { C | Rest }", Shapes::lot(40, 30));
  EXPECT_EQ(m.count.at("C"), 12);
  EXPECT_NEAR(m.area.at("C"), 1200, 1e-2);
  const Shapes bent =
      Shapes::polygon({{0, 0}, {20, -4}, {40, 0}, {44, 15}, {40, 30}, {20, 34}, {0, 30}, {-4, 15}});
  const Made b = run("R -> QuadMap(4, 3) { C | Rest }", bent);
  EXPECT_NEAR(b.whole, 40 * 30 + 4 * 0.5 * (40 * 4 + 30 * 4) / 2, 0.1);
  EXPECT_EQ(b.count.at("C"), 12);
}

TEST(ParkNotation, VoronoiPathsAreSections) {
  const std::string sites = "\nS -> ScatterCircles(12 {2})";
  const Made m = run("R -> VoronoiRegions(S, none) { A | path: P | junction: J }" + sites,
                     Shapes::lot(80, 60));
  EXPECT_GT(m.count.at("P"), 12);
  EXPECT_GT(m.count.at("J"), 8);
  EXPECT_NEAR(m.whole, 4800, 0.01);
  // With no word for junctions they are path.
  const Made p = run("R -> VoronoiRegions(S, none) { A } { P }" + sites, Shapes::lot(80, 60));
  EXPECT_EQ(p.count.at("P"), m.count.at("P") + m.count.at("J"));
}

TEST(ParkNotation, VoronoiBordersMayBend) {
  const std::string sites = "\nS -> ScatterCircles(9 {2})";
  for (const char* more : {"none, jitter(2)", "bezier, jitter(1)", "bezier", "chaikin(3)"}) {
    const std::string text = std::string("R -> VoronoiRegions(S, ") + more + ") { A } { P }";
    const Made m = run(text + sites, Shapes::lot(80, 60));
    EXPECT_NEAR(m.whole, 4800, 0.02) << more;
    EXPECT_GE(m.count.at("A"), 9) << more;
  }
  const std::string dry = "PathWidth = 0\nR -> VoronoiRegions(S, none, jitter(2)) { A } {}";
  EXPECT_NEAR(run(dry + sites, Shapes::lot(80, 60)).area.at("A"), 4800, 0.02);
}

TEST(ParkNotation, VoronoiTakesHundredsOfSites) {
  const Made m =
      rules("Lot --> voronoi(400, 0, none, radius = 0.5) { region : A }", Shapes::lot(200, 150));
  EXPECT_EQ(m.count.at("A"), 400);
  EXPECT_NEAR(m.whole, 30000, 0.05);
}

TEST(ParkNotation, CellsCountTheWayToTheBoundary) {
  const Made m = rules(
      "Lot --> voronoi(60, 0, none, radius = 1) { region : Cell }\n"
      "Cell --> case region.bx == 0 : Outer. case region.bx == 1 : Second. else : Inner.",
      Shapes::lot(100, 100));
  EXPECT_GT(m.count.at("Outer"), 12);
  EXPECT_GT(m.count.at("Second"), 6);
  EXPECT_GT(m.count.at("Inner"), 3);
}

TEST(ParkNotation, PeelsTakeDistancesOfTheirOwn) {
  const Made m = run("R -> Peel({W: 2, N: 4}) { A | B }", Shapes::lot(20, 10));
  EXPECT_NEAR(m.area.at("B"), 18 * 6, 1e-3);
  EXPECT_NEAR(m.whole, 200, 1e-3);
}

TEST(ParkNotation, PeelsAreSmoothedOnBothSides) {
  const std::string text = "R -> Peel(all, 4, smooth=average(3)) { A | B }";
  const Made m = run(text, cShape());
  EXPECT_NEAR(m.whole, 620, 0.01);
  const Made sharp = run("R -> Peel(all, 4) { A | B }", cShape());
  EXPECT_LT(m.area.at("B"), sharp.area.at("B"));
  const Made one = run("R -> Peel(W | N, 4, smooth=bezier) { A | B }", Shapes::lot(40, 30));
  EXPECT_NEAR(one.whole, 1200, 0.01);
  EXPECT_EQ(one.count.at("B"), 1);
}

TEST(ParkNotation, SelectionsOfVertexNeighbours) {
  const Shapes lot = Shapes::lot(20, 10);
  EXPECT_NEAR(selectedLength("touches(W)", lot), 40, 1e-9);
  EXPECT_NEAR(selectedLength("all - touches(W) - W", lot), 10, 1e-9);
  EXPECT_NEAR(selectedLength("corners", lot), 60, 1e-9);
  // The ends of a strip lie between vertices of the border.
  const std::string strip = "peel(side(west), 2) { strip : R | rest : NIL }";
  EXPECT_NEAR(selectedLength("outer", lot, strip), 10 + 2 * 2, 1e-3);
  EXPECT_NEAR(selectedLength("outer(strict)", lot, strip), 2 * 10 + 2 * 2, 1e-3);
}

TEST(ParkNotation, PlacesAlignAndSplit) {
  const Made m = run("R -> Place(CENTRE, split) { Square(2) Bed } Lawn", kLot);
  EXPECT_NEAR(m.whole, 400, 1e-3);
  const Made list = run("R -> Place((0.2, 0.2) (0.8, 0.8)) { Circle(1) T } L", kLot);
  EXPECT_EQ(list.count.at("T"), 2);
  const Made crowded = run("R -> Place((0.5, 0.5) (0.52, 0.5)) { Circle(1) T } L", kLot);
  EXPECT_EQ(crowded.count.at("T"), 1);
  EXPECT_TRUE(crowded.has("place-occupied"));
}

TEST(ParkNotation, SweepsEndAsTold) {
  const auto ribbon = [](const std::string& options) {
    const Made m =
        rules("Lot --> contract(10) sweep(edge(0, 0.2, 0.8), 1, 2, " + options + ") { H. } NIL",
              Shapes::lot(50, 50));
    return m.area.at("H");
  };
  const double butt = ribbon("ends = butt");
  EXPECT_NEAR(ribbon("ends = square"), butt + 1, 1e-2);
  EXPECT_GT(ribbon("ends = round"), butt + 0.7);
}

TEST(ParkNotation, TooManyRangesAreReported) {
  EXPECT_TRUE(run("R -> Parametrise(_ _ _ _ _)", kLot).has("range-beyond"));
  EXPECT_FALSE(run("R -> Parametrise(_ _ _ _)", kLot).has("range-beyond"));
}

TEST(ParkNotation, ConvertedTextMakesTheSameModel) {
  const char* grammars[] = {
      "R -> Grid(3, 3) { A(1) } { B } { Choose { Romb(1) C, 20%: Circle(1) D } }\n"
      "A(d) -> Contract(d) else { E } Place((0.3, 0.3)) { Circle(d / 4) T }",
      "R -> Select { len > 50 : A | outer : Peel({W: 2, E: 1}) { B | C } } else { D }",
      "R -> VoronoiRegions(6 {2}, bezier, jitter=1) { A | path: B | junction: C }",
      "R -> Grid(2, 2, dominance=split) { joined { A B } } { P }\nA -> Contract(4)\nB -> Rect(12, "
      "1)",
      "R -> Insert(3) { A } Sweep(F(2), width=0.5, profile=(0,0)(0,1)(1,0)) { H }\n"
      "fun F(d) -> Parametrise([0, 1] _ , facing(S)) { Contract(d) }",
      "R -> CastRays(Points((9, 9), (30, 30)) [Square(2)], Directions(10, 100, 190), "
      "connect=thin(1)) "
      "{ A } { B }",
      "R -> Circle(50, free) Square(2) else { A } Place(corners) { P }"};
  for (const char* text : grammars) {
    const Rules park = Rules::parse(text, "a.park");
    ASSERT_FALSE(hasErrors(park.diagnostics())) << text;
    const Rules cga = Rules::parse(convert(text, "a.park").text, "a.cga");
    ASSERT_FALSE(hasErrors(cga.diagnostics())) << convert(text, "a.park").text;
    const Shapes lot = Shapes::lot(40, 40);
    EXPECT_EQ(derive(park, lot, {}).dump(), derive(cga, lot, {}).dump()) << text;
  }
}

TEST(ParkNotation, ElseStandsBehindFiguresAndLines) {
  EXPECT_EQ(run("R -> Contract(1) Circle(1) else { B } A", kLot).count.at("A"), 1);
  const Shapes sliver = Shapes::lot(10, 0.01);
  EXPECT_EQ(run("R -> Parametrise(pathside) { Contract(1) } else { B }", sliver).count.at("B"), 1);
  EXPECT_TRUE(run("R -> InnerRect(edge) { A | B } else { C }", kLot).has("unexpected-text"));
}

TEST(ParkNotation, WordsThatNobodyKnowsAreErrors) {
  for (const char* text :
       {"R -> Peel(OUTER, 1, CornersSquare) { A | B }", "R -> Place(CENTRE, under) { Circle(1) A }",
        "R -> Distribute(OUTER, 2, cot) { A }", "R -> Sweep(OUTER, breadth=2) { A }",
        "R -> InnerRect(box) { A | B }"}) {
    EXPECT_TRUE(run(text, kLot).has("bad-argument")) << text;
  }
}

TEST(ParkNotation, EmptyBracesMakeNothing) {
  const Made m = run("PathWidth = 2\nR -> Grid(2, 2) { } { B }", kLot);
  EXPECT_EQ(m.count.at("B"), 5);
  EXPECT_EQ(m.count.size(), 1u);
  EXPECT_NEAR(run("R -> Peel(all, 1) { A | }", kLot).whole, 76, 1e-3);
  EXPECT_NEAR(run("PathWidth = 2\nR -> Grid(2, 2) { A } { B } { }", kLot).whole, 396, 1e-3);
  EXPECT_EQ(run("R -> CastRays(CENTRE, 3) { A } { }", kLot).count.size(), 1u);
}

TEST(ParkNotation, RangesInListsAndInPlace) {
  EXPECT_NEAR(run("R -> Parametrise([[0.1, 0.3], [0.6, 0.9]] [0, 0.5])", kLot).length.at("Line"),
              20, 1e-6);
  EXPECT_NEAR(
      run("R -> Sweep(Parametrise([0, 1] [0, 1]), width=1) { A }\nA -> GREEN", kLot).area.at("A"),
      19.75, 0.1);
}

TEST(ParkNotation, PointsAndDirections) {
  const Made places = run("R -> Place((0.25, 0.5), (0.75, 0.5)) { A }\n", kLot);
  EXPECT_EQ(places.count.at("A"), 2);
  EXPECT_EQ(run("R -> Place([(0.25, 0.5), (0.75, 0.5)]) { A }\n", kLot).count.at("A"), 2);
  const Made rays = run(
      "PathWidth = 1\nR -> CastRays(Middle [Square(4)], Ways) { centre: C | region: A | path: B }\n"
      "Middle -> Points((10, 8))\nWays -> Directions(0, 90, 180, 270)",
      kLot);
  EXPECT_EQ(rays.count.at("A"), 4);
  EXPECT_NEAR(rays.area.at("C"), 16, 1e-3);
  EXPECT_NEAR(rays.places.at("C")[0].z, -8, 1e-6);
  const Made ends = run(
      "PathWidth = 1\nR -> CastRays(CENTRE, Points((0, 0), (20, 0), (20, 20))) { A } { B }", kLot);
  EXPECT_EQ(ends.count.at("B"), 3);
  const Made cells = run(
      "R -> VoronoiRegions(Points((4, 4), (16, 4, 2), (10, 16)), none) { A } { B } { C }", kLot);
  EXPECT_EQ(cells.count.at("A"), 3);
  EXPECT_EQ(cells.count.at("C"), 1);
}

TEST(ParkNotation, CentresJoinedInPart) {
  const Made m =
      run("PathWidth = 1\nR -> CastRays(Points((10, 10), (30, 10), (30, 30), (10, 30)), "
          "Corners(Region), connect=thin(1)) { A } { B }",
          Shapes::lot(40, 40));
  EXPECT_EQ(m.count.at("B"), 9);
  EXPECT_NEAR(m.whole, 1600, 0.01);
}

TEST(ParkNotation, FiguresMayReachBeyond) {
  EXPECT_NEAR(run("R -> Circle(15, free) A", kLot).area.at("A"), 698.8, 0.1);
  EXPECT_NEAR(run("R -> Square(30) A", kLot).area.at("A"), 400, 1e-6);
}

TEST(ParkNotation, WhatIsCutOffCornersMayBeUsed) {
  const Made m = run("R -> Insert(2) { Bed }", kLot);
  EXPECT_EQ(m.count.at("Bed"), 4);
  EXPECT_NEAR(m.whole, 400, 1e-3);
}

TEST(ParkNotation, HedgesHaveCrossSections) {
  const Made m = run(
      "R -> Hedges(0.5) Lawn\nHedges(w) -> Sweep(Around(w * 2), width=w, height=1.2, profile=dome) "
      "{ Hedge }\nfun Around(d) -> Parametrise(_ _ [0, 0.5]) { Contract(d) }",
      kLot);
  for (const Diagnostic& x : m.diagnostics) ADD_FAILURE() << x.message;
  EXPECT_EQ(m.count.at("Hedge"), 1);
  EXPECT_TRUE(m.closed.at("Hedge"));
  EXPECT_TRUE(run("R -> Sweep(OUTER, profile=wave) { Hedge }", kLot).has("unknown-selector"));
  EXPECT_TRUE(
      run("R -> Sweep(OUTER, profile=(0, 0) (0, 1) (1, 0)) { Hedge }", kLot).diagnostics.empty());
  EXPECT_TRUE(run("R -> Sweep(OUTER, width=0) { L }", kLot).count.count("L"));
}

TEST(ParkNotation, LinesOfRangesAndSelections) {
  const Made m = run("R -> Parametrise([0, 0.5] _ , facing(E))", kLot);
  EXPECT_NEAR(m.length.at("Line"), 10 + 20 + 20, 1e-6);
  const Made f =
      run("R -> Sweep(Sides(outer & W, 2), width=1) { Strip }\nStrip -> GREEN\n"
          "fun Sides(sel, d) -> Parametrise([] [0.25, 0.75], sel) { Contract(d) }",
          kLot);
  for (const Diagnostic& x : f.diagnostics) ADD_FAILURE() << x.message;
  EXPECT_NEAR(f.area.at("Strip"), 8 + 20, 1);
  EXPECT_EQ(f.count.at("Strip"), 2);
}

TEST(ParkNotation, JoinsWhatRulesMakeLater) {
  const std::string text =
      "PathWidth = 2\nR -> Grid(2, 2) { joined { Lawn Bed } } { Way }\n"
      "Lawn -> Peel(all, 1) { Edge | Inner }\nEdge -> GREEN\n"
      "Inner -> NIL_REGION Place(CENTRE, over) { Circle(1) Round }\nRound -> BLUE\n"
      "Bed -> Rect(12, 1, free)";
  const Made shared = run(text, kLot, 1, "a.park", true),
             apart = run(text, kLot, 1, "a.park", false);
  EXPECT_EQ(shared.count, apart.count);
  EXPECT_EQ(shared.whole, apart.whole);
  EXPECT_EQ(shared.count.at("R"), 4);
  EXPECT_EQ(shared.count.count("Edge"), 0u);
  // A quarter of nine metres, and what the bar of twelve has beyond it.
  EXPECT_NEAR(shared.area.at("R"), 4 * (81 + 3), 1e-3);
  EXPECT_TRUE(run("R -> joined { }", kLot).has("bad-argument"));
}

}  // namespace
}  // namespace gable
