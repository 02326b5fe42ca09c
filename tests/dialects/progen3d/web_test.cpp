// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grammars of ProGen3d's web language, construct by construct.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "drawn.h"

namespace gable::progen3d_test {
namespace {

const std::string kCube = " I ( Cube grayStone 0.5 )";

Vec3 middle(const Body& b) { return (b.box.min + b.box.max) * 0.5; }
Vec3 size(const Body& b) { return b.box.max - b.box.min; }

void expectPlace(const Body& b, const Vec3& at) {
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(middle(b)[k], at[k], 1e-9) << k;
}
void expectSize(const Body& b, const Vec3& wanted) {
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(size(b)[k], wanted[k], 1e-9) << k;
}

// The bodies of a grammar without a message.
std::vector<Body> bodiesOf(const std::string& grammar, double seed = 1) {
  DrawOptions options;
  options.seed = seed;
  const Drawn d = draw(grammar, options);
  EXPECT_TRUE(d.model.ok());
  EXPECT_EQ(d.codes(), std::vector<std::string>{}) << grammar;
  return d.bodies;
}

// Where the only body of a grammar stands.
void expectOne(const std::string& grammar, const Vec3& at) {
  const std::vector<Body> bodies = bodiesOf(grammar);
  ASSERT_EQ(bodies.size(), 1u) << grammar;
  expectPlace(bodies[0], at);
}

// --- Rules and calls ---

TEST(Web, callsHandArgumentsToParameters) {
  expectOne("Start -> Pair( 1 2 )\nPair( a b ) -> T ( a b 0 )" + kCube + "\n", {1, 2, 0});
  expectOne("Start -> Pair( 1, 2+1 )\nPair( a, b ) -> T ( a b 0 )" + kCube + "\n", {1, 3, 0});
}

TEST(Web, whatARuleDoesToThePlaceEndsWithIt) {
  const auto b = bodiesOf("Start -> Far( 5 )" + kCube + "\nFar( d ) -> T ( d 0 0 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 2u);
  expectPlace(b[0], {5, 0, 0});
  expectPlace(b[1], {0, 0, 0});
}

TEST(Web, allThatIsCalledSeesTheVariablesOfItsCaller) {
  expectOne("Start -> Outer( 3 )\nOuter( h ) -> Inner\nInner -> T ( 0 h 0 )" + kCube + "\n",
            {0, 3, 0});
  // And changes none of them.
  expectOne(
      "Start -> R h ( 2 2 ) Inner ?( h == 2 ) Body\nInner -> R h ( 9 9 )\nBody -> T ( 0 h 0 )" +
          kCube + "\n",
      {0, 2, 0});
}

TEST(Web, aRuleThatCallsItselfEnds) {
  const auto b = bodiesOf("Start -> Tower( 4 )\nTower( n ) ->" + kCube +
                          " T ( 0 1 0 ) ?( n > 1 ) Tower( n-1 )\n");
  ASSERT_EQ(b.size(), 4u);
  expectPlace(b[3], {0, 3, 0});
}

TEST(Web, theFirstRuleMayBeCalledAgain) {
  const auto b = bodiesOf("Start -> R n ( 1 1 )" + kCube + " T ( 2 0 0 ) ?( 0 ) Start\n");
  EXPECT_EQ(b.size(), 1u);
}

// --- Turns ---

TEST(Web, allSectionsRunInEachTurnAndThePlaceGoesOn) {
  const auto b = bodiesOf("Start 3 -> T ( 1 0 0 ) |" + kCube + " | T ( 0 2 0 ) ?( 0 ) X\nX ->\n");
  ASSERT_EQ(b.size(), 3u);
  for (size_t k = 0; k < 3; ++k) {
    expectPlace(b[k], {1 + static_cast<double>(k), 2 * static_cast<double>(k), 0});
  }
}

TEST(Web, turnsHaveAnIndex) {
  const auto b =
      bodiesOf("Start -> Row( 3 )\nRow( n ) n -> [ T ( 10*ri repeatIndex 0 )" + kCube + " ]\n");
  ASSERT_EQ(b.size(), 3u);
  for (size_t k = 0; k < 3; ++k) {
    expectPlace(b[k], {10 * static_cast<double>(k), static_cast<double>(k), 0});
  }
  // Seen within conditions, too, and 0 outside of turns.
  EXPECT_EQ(bodiesOf("Start 5 -> ?( ri > 2 ) Body\nBody -> T ( ri 0 0 )" + kCube + "\n").size(),
            2u);
}

TEST(Web, turnsAreTruncated) {
  EXPECT_EQ(bodiesOf("Start -> Part( 2.9 )\nPart( n ) n ->" + kCube + "\n").size(), 2u);
  EXPECT_EQ(bodiesOf("Start -> Part( -3 )\nPart( n ) n ->" + kCube + "\n").size(), 0u);
}

// --- Variants ---

TEST(Web, rulesOfANameAreVariantsByWeight) {
  const auto b = bodiesOf(
      "Start 2000 -> One( 0 )\nOne( a ) ; 3 -> I ( Cube brick 0.5 )\n"
      "One( b ) ; 1 -> I ( Cube oak 0.5 )\n");
  ASSERT_EQ(b.size(), 2000u);
  int bricks = 0;
  for (const Body& each : b) bricks += each.texture == 2;
  EXPECT_NEAR(bricks, 1500, 80);
}

TEST(Web, weightsMayBeCalculated) {
  const std::string text =
      "Start -> R w ( 0 0 ) One( 0 )\nOne( a ) ; w -> I ( Cube brick 0.5 )\n"
      "One( a ) -> I ( Cube oak 0.5 )\n";
  for (double seed = 0; seed < 5; ++seed) EXPECT_EQ(bodiesOf(text, seed)[0].texture, 3);
  // Where all weigh nothing it is the first.
  const std::string none =
      "Start -> One( 0 )\nOne( a ) ; 0 -> I ( Cube brick 0.5 )\n"
      "One( a ) ; 0 -> I ( Cube oak 0.5 )\n";
  for (double seed = 0; seed < 5; ++seed) EXPECT_EQ(bodiesOf(none, seed)[0].texture, 2);
}

// --- Conditions ---

TEST(Web, conditionsCallOneRule) {
  const auto b = bodiesOf("Start -> ?( 1 ) Tall" + kCube + "\nTall -> T ( 0 2 0 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 2u);
  expectPlace(b[0], {0, 2, 0});
  expectPlace(b[1], {0, 0, 0});
}

TEST(Web, conditionsWithAColonTakeTheRestOfTheSequence) {
  expectOne("Start -> ?( 2 > 1 ) T ( 1 0 0 )" + kCube + " : T ( 9 0 0 )" + kCube + "\n", {1, 0, 0});
  expectOne("Start -> ?( 2 < 1 ) T ( 1 0 0 )" + kCube + " : T ( 9 0 0 )" + kCube + "\n", {9, 0, 0});
}

TEST(Web, conditionsNest) {
  const std::string text = "Start -> Part( 2 )\nPart( n ) -> ?( n == 1 ) T ( 1 0 0 )" + kCube +
                           " : ?( n == 2 ) T ( 2 0 0 )" + kCube + " : T ( 3 0 0 )" + kCube + "\n";
  expectOne(text, {2, 0, 0});
}

TEST(Web, whatAConditionDoesToThePlaceStays) {
  expectOne("Start -> [ ?( 1 ) T ( 3 0 0 ) : T ( 4 0 0 ) ] ?( 1 ) T ( 1 0 0 )" + kCube + "\n",
            {1, 0, 0});
  expectOne("Start 1 -> ?( 1 ) T ( 1 0 0 ) : T ( 2 0 0 ) |" + kCube + "\n", {1, 0, 0});
}

TEST(Web, conditionsSpanLines) {
  expectOne(
      "Start -> ?(\n  1 +\n  1\n  ==\n  2\n) T ( 4 0 0 )" + kCube + " : T ( 9 0 0 )" + kCube + "\n",
      {4, 0, 0});
}

// --- Places ---

TEST(Web, bracketsKeepThePlace) {
  const auto b = bodiesOf("Start -> [ S ( 2 3 4 ) I ( CubeZ brick 0.5 ) ] [" + kCube + " ]\n");
  ASSERT_EQ(b.size(), 2u);
  expectSize(b[0], {2, 3, 4});
  expectSize(b[1], {1, 1, 1});
}

TEST(Web, aMoveBeforeAScaleIsNotScaled) {
  expectOne("Start -> T ( 0 1 0 ) S ( 2 2 2 )" + kCube + " ?( 0 ) Start\n", {0, 1, 0});
}

TEST(Web, turnsAboutAnAxisAreAOrR) {
  for (const char* word : {"A", "R"}) {
    expectOne(std::string("Start -> ") + word + " ( 90 1 ) T ( 2 0 0 )" + kCube + " ?( 0 ) Start\n",
              {0, 0, -2});
  }
}

TEST(Web, aMinusBehindABlankBeginsAnArgument) {
  expectOne("Start -> T ( 1 -2 -3 )" + kCube + " ?( 0 ) Start\n", {1, -2, -3});
  expectOne("Start -> T ( 1 - 2 3-4 )" + kCube + " ?( 0 ) Start\n", {1, -2, -1});
  expectOne("Start -> T ( (1 - 2) 3 0 )" + kCube + " ?( 0 ) Start\n", {-1, 3, 0});
}

TEST(Web, aBracketBehindANameBeginsAnArgument) {
  const auto b = bodiesOf(
      "Start -> R d ( 2 2 ) R h ( 3 3 )\n"
      "S ( ( d * 1.2 ) + 0.8 h(( d * 1.2 ) + 0.8) )" +
      kCube + " ?( 0 ) Start\n");
  ASSERT_EQ(b.size(), 1u);
  expectSize(b[0], {3.2, 3, 3.2});
}

// --- Bodies ---

TEST(Web, bodiesReachAlongTheirAxisAndMoveThePlace) {
  const auto b = bodiesOf(
      "Start -> I ( CubeX brick 0.5 ) I ( CubeX brick 0.5 ) I ( CubeY brick 0.5 )"
      " I ( CubeZ brick 0.5 ) I ( Cube brick 0.5 ) I ( Cube brick 0.5 )\n");
  ASSERT_EQ(b.size(), 6u);
  expectPlace(b[0], {0.5, 0, 0});
  expectPlace(b[1], {1.5, 0, 0});
  expectPlace(b[2], {2, 0.5, 0});
  expectPlace(b[3], {2, 1, 0.5});
  expectPlace(b[4], {2, 1, 1});
  expectPlace(b[5], {2, 1, 1});
}

TEST(Web, sidesAreScaledAndMoved) {
  // The far side of x, then of y, then of z; the near ones stay.
  const auto b = bodiesOf("Start -> DSX ( 2 1 1 ) DTY ( 0 0.5 0 ) DSZ ( 1 1 4 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 1u);
  EXPECT_TRUE(near(b[0].box, {{-0.5, -0.5, -0.5}, {1, 1, 2}})) << text(b[0].box);
  // They end with their bracket.
  const auto c = bodiesOf("Start -> [ DTX ( 3 0 0 )" + kCube + " ]" + kCube + "\n");
  ASSERT_EQ(c.size(), 2u);
  expectSize(c[0], {4, 1, 1});
  expectSize(c[1], {1, 1, 1});
}

TEST(Web, theSidesOfTheReferenceAreClosed) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw(
      "Start -> DSX ( 1.22 1 1 ) DTX ( 0.14 0 0 ) DSY ( 1 0.84 1 ) DTY ( 0 0.18 0 ) "
      "DSZ ( 1 1 1.16 ) DTZ ( 0 0 0.22 ) I ( CubeZ brushedAluminum 0.52 )\n",
      options);
  ASSERT_EQ(d.bodies.size(), 1u);
  EXPECT_TRUE(d.bodies[0].closed);
  EXPECT_TRUE(near(d.bodies[0].box, {{-0.5, -0.5, 0}, {0.75, 0.6, 1.38}})) << text(d.bodies[0].box);
}

TEST(Web, severalBodiesAreDeformedTogether) {
  // The common box of the two is -0.5 to 3.5 along x, its middle 1.5.
  const auto b = bodiesOf("Start -> [ GDSX ( 2 1 1 )" + kCube + " T ( 3 0 0 )" + kCube +
                          " ] T ( 0 5 0 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 3u);
  EXPECT_TRUE(near(b[0].box, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}})) << text(b[0].box);
  EXPECT_TRUE(near(b[1].box, {{3.5, -0.5, -0.5}, {5.5, 0.5, 0.5}})) << text(b[1].box);
  EXPECT_TRUE(near(b[2].box, {{-0.5, 4.5, -0.5}, {0.5, 5.5, 0.5}})) << text(b[2].box);
}

TEST(Web, bracketsAreDeformedEachByItself) {
  const auto b = bodiesOf("Start -> [ GDTX ( 0.25 0 0 )" + kCube +
                          " ] T ( 3 0 0 ) [ GDTX ( 0.25 0 0 )" + kCube + " ]\n");
  ASSERT_EQ(b.size(), 2u);
  EXPECT_NEAR(b[0].box.max.x, 0.625, 1e-9);
  EXPECT_NEAR(b[1].box.max.x, 3.625, 1e-9);
}

TEST(Web, theTurnsOfARuleAreDeformedTogether) {
  const auto b =
      bodiesOf("Start -> Row\nRow 4 -> GDSY ( 1 3 1 ) [ S ( 1 2 1 )" + kCube + " ] T ( 0 2 0 )\n");
  ASSERT_EQ(b.size(), 4u);
  EXPECT_NEAR(b[0].box.min.y, -1, 1e-9);
  EXPECT_NEAR(b[1].box.max.y, 3, 1e-9);
  EXPECT_NEAR(b[3].box.max.y, 15, 1e-9);
}

// --- Variables ---

TEST(Web, variablesAreDrawnWhereTheyStand) {
  const std::string text = "Start 200 -> R h ( 2 4 ) R* n ( 1 3 ) T ( h n 0 )" + kCube +
                           " T ( -h 0-n 0 ) ?( 0 ) Start\n";
  std::map<double, int> whole;
  for (const Body& b : bodiesOf(text)) {
    EXPECT_GE(middle(b).x, 2);
    EXPECT_LT(middle(b).x, 4);
    ++whole[std::round(middle(b).y * 1e6) / 1e6];
  }
  ASSERT_EQ(whole.size(), 3u);
  for (const auto& [value, count] : whole) EXPECT_GT(count, 40) << value;
}

TEST(Web, rangesMayBeCalculated) {
  expectOne("Start -> Part( 3 )\nPart( n ) -> R h ( n n+0 ) T ( 0 h 0 )" + kCube + "\n", {0, 3, 0});
  expectOne("Start -> Part( 3 )\nPart( n ) -> R* h ( n-0.5 n+0.5 ) T ( 0 h 0 )" + kCube + "\n",
            {0, 3, 0});
}

TEST(Web, variablesAreDrawnAnew) {
  expectOne("Start -> R h ( 3 3 ) R h T ( 0 h 0 )" + kCube + "\n", {0, 3, 0});
  expectOne("Start -> R h ( 2 2 ) T ( 0 rand( h ) 0 ) T ( 0 h 0 )" + kCube + "\n", {0, 4, 0});
  const auto b =
      bodiesOf("Start -> R h ( 0 9 ) [ T ( 0 h 0 )" + kCube + " ] R h T ( 0 h 0 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 2u);
  EXPECT_NE(middle(b[0]).y, middle(b[1]).y);
}

TEST(Web, aDrawWithinAStatementCountsFromLeftToRight) {
  const auto b = bodiesOf("Start -> R h ( 0 9 ) [ T ( h 0 0 )" + kCube +
                          " ] [ T ( h rand( h ) h )" + kCube + " ] T ( h 0 0 )" + kCube + "\n");
  ASSERT_EQ(b.size(), 3u);
  EXPECT_EQ(middle(b[1]).x, middle(b[0]).x);
  EXPECT_NE(middle(b[1]).y, middle(b[1]).x);
  EXPECT_EQ(middle(b[1]).z, middle(b[1]).y);
}

TEST(Web, calculations) {
  const std::vector<std::pair<std::string, double>> all = {
      {"int( 1.9 )", 1},   {"int( -1.9 )", -1},    {"float( 2 )", 2},   {"abs( -3 )", 3},
      {"sqrt( 9 )", 3},    {"sqrt( -9 )", 0},      {"floor( 2.7 )", 2}, {"ceil( 2.1 )", 3},
      {"min( 3 1 2 )", 1}, {"max( 3, 1, 2 )", 3},  {"2^3^2", 512},      {"-2^2", 4},
      {"7/0", 0},          {"(2 > 1)+(1 > 2)", 1}, {"2*(3 <= 3)", 2},   {"(1 != 1)", 0},
      {"sin( pi/2 )", 1},  {"cos( 0 )", 1},        {"tan( pi/4 )", 1},  {"rand( 4 4 )", 4},
      {"e-e+1", 1},        {"1+2*3-4/2", 5},       {"10-2-3", 5}};
  for (const auto& [text, value] : all) {
    expectOne("Start -> Part( 0 )\nPart( b ) -> T ( " + text + " 0 0 )" + kCube + "\n",
              {value, 0, 0});
  }
}

// --- Textures ---

TEST(Web, texturesHaveNames) {
  const auto b = bodiesOf(
      "Start -> I ( Cube redBrickWall 0.35 ) I ( Cube oakPlanks 0.5 ) "
      "I ( Cube roughblueshinysemitransparentmetal 0.35 ) I ( Cube clearGlass 0.1 )\n");
  ASSERT_EQ(b.size(), 4u);
  EXPECT_EQ(b[0].texture, 2);
  EXPECT_NEAR(b[0].scale, 0.35, 1e-9);
  EXPECT_EQ(b[2].texture, 11);
  EXPECT_EQ(b[3].texture, 22);
}

TEST(Web, allPresetsAreKnown) {
  const char* all[] = {
      "roughConcrete",    "smoothConcrete",   "crackedAsphalt",     "redBrickWall",
      "whiteTiles",       "blueCeramicTile",  "shinySteel",         "brushedAluminum",
      "oxidizedCopper",   "agedBronze",       "shinyGold",          "tarnishedSilver",
      "rawIron",          "polishedTitanium", "clearGlass",         "frostedGlass",
      "tintedGreenGlass", "stainedBlueGlass", "glossyWhitePlastic", "matteBlackPlastic",
      "redABS",           "bluePVC",          "translucentPoly",    "freshGrass",
      "dryGrass",         "desertSand",       "muddySoil",          "grayStone",
      "darkBasalt",       "whiteMarble",      "greenMarble",        "oakPlanks",
      "darkWalnut",       "pineWood",         "mahoganyWood",       "cherryWood",
      "mapleWood",        "iceBlock",         "moltenLava",         "deepWater",
      "snowPowder",       "fluffyCloud",      "mossPatch",          "claySoil",
      "rustyMetal",       "carbonFiber",      "circuitBoard",       "glowingPanel",
      "hazardStripe",     "steelGrid",        "chromeSurface"};
  std::string text = "Start ->";
  for (const char* name : all) text += std::string(" I ( CubeX ") + name + " 0.5 )";
  EXPECT_EQ(bodiesOf(text + "\n").size(), std::size(all));
}

// --- Mistakes ---

TEST(Web, mistakesAreTold) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"Start -> Tall( 1 )\nTall( a b ) -> T ( a b 0 )", "wrong-argument-count 1:10"},
      {"Start -> Tal( 1 )\nTall( a b ) -> T ( a b 0 )", "unknown-rule 1:10"},
      {"Start -> ?( h > 1 ) Start", "unknown-variable 1:13"},
      {"Start -> ?( 1 ) R h", "unknown-variable 1:19"},
      {"Start -> ?( 1 ) I ( Cubez brick 1 )", "unknown-primitive 1:21"},
      {"Start -> ?( 1 ) I ( Cube brik 1 )", "unknown-texture 1:26"},
      {"Start -> ?( 1 ) I ( Cube 3 1 )", "missing-arguments 1:26"},
      {"Start -> ?( 1 ) T ( w - 1 0 )", "unknown-variable 1:21"},
      {"Start -> DSX ( 1 2 )", "wrong-argument-count 1:10"},
      {"Start -> ?( 1 ) DSX", "missing-arguments 1:17"},
      {"Start -> ?( sine( 1 ) ) Start", "unknown-function 1:13"},
      {"Start -> ?( sin( 1 2 ) ) Start", "wrong-argument-count 1:13"},
      {"Start -> ?( rand( 1 ) ) Start", "wrong-argument-count 1:13"},
      {"Start( w ) -> ?( w ) Start( 1 )", "wrong-argument-count 1:1"},
      {"Start -> ?( 1 )", "missing-arguments 1:10"},
      {"Start -> ?( 1 ) A ( 90 3 )", "bad-axis 1:24"},
      {"Start -> ?( 1 ) [ T ( 1 0 0 )", "unclosed-bracket 1:17"},
      {"Start -> ?( 1 ) R h ( 5 2 )", "reversed-range 1:17"},
      {"Start -> ?( 1 ) R h ( 5 )", "wrong-argument-count 1:17"},
      {"Start -> ?( 1 ) [ R h ( 1 2 ) ] T ( h 0 0 )", "drawn-in-brackets 1:37"},
      {"Start -> ?( 1 ) R pi ( 1 2 )", "reserved-name 1:19"},
      {"Start -> I ( Cube brick 0.5 ) GDSX ( 2 1 1 )", "late-deformation 1:31"},
      {"Start -> Part( 1 )\nPart( a a ) ->", "duplicate-parameter 2:9"},
      {"Start ; 2 -> I ( CubeZ brick 1 )", "bad-probability 1:9"},
      {"Start -> I ( CubeZ brick 1 )\nOther -> I ( CubeZ brick 1 )", "unused-rule 2:1"},
      {"Start -> a | b | c | d | ?( 1 ) Start", "too-many-sections 1:20"},
  };
  for (const auto& [text, code] : all) {
    const std::vector<std::string> codes = draw(text + "\n").codes();
    EXPECT_TRUE(std::find(codes.begin(), codes.end(), code) != codes.end())
        << text << ": " << code << " is not among " << testing::PrintToString(codes);
  }
}

// As in other notations, a rule that is missing draws nothing, and the rest is drawn.
TEST(Web, missingRulesLeaveTheRest) {
  const Drawn d = draw("Start -> Nothing( 1 ) I ( CubeZ brick 1 )\n");
  EXPECT_TRUE(d.model.ok());
  EXPECT_EQ(d.bodies.size(), 1u);
}

TEST(Web, recursionWithoutEndIsTold) {
  const Drawn d = draw("Start -> Again( 1 )\nAgain( n ) -> I ( Cube brick 0.5 ) Again( n+1 )\n");
  EXPECT_TRUE(d.has("recursion-too-deep"));
  EXPECT_GT(d.bodies.size(), 10u);
}

TEST(Web, brokenTextsEnd) {
  for (const char* text :
       {"?( (", "A( -> ?(", "A ( a b ) -> ?( 1 ) : : : ]", "A -> ?( 1 ) [ [ [ : ] | ]",
        "A -> I ( CubeZ", "A -> DSX ( ( ( (", "A -> R ( 1", "A -> R x R y R* ?( rand( ) )",
        "Part( a b ) a ; ; -> T ( , , , )", "A -> ?( < ) CubeZ ( == )"}) {
    draw(text);
  }
  std::string deep = "Start -> CubeZ ";
  for (int k = 0; k < 5000; ++k) deep += "[ ?( ( 1";
  draw(deep);
  std::string many = "Start -> ";
  for (int k = 0; k < 50000; ++k) many += "?( 1 ) X ";
  draw(many);
}

// --- As a whole ---

const std::string kHouse =
    "Start -> Row( 3 6 )\n"
    "Row( n w ) n -> House( w ri ) | T ( w+2 0 0 )\n"
    "House( w i ) ; 2 -> R h ( 3 5 ) [ S ( w h 6 ) I ( CubeY redBrickWall 0.5 ) Roof( h ) ]\n"
    "House( w i ) ; 1 -> R* n ( 2 4 ) [ GDSY ( 0.7 1 0.7 ) Storeys( n ) ]\n"
    "Storeys( n ) n -> [ S ( w 3 6 ) I ( CubeY whiteTiles 0.5 ) ] T ( 0 3 0 )\n"
    "Roof( h ) -> ?( h > 4 ) S ( 1 0.5 1 ) DSY ( 1 1 0.1 ) I ( CubeY redABS 0.5 ) : Flat\n"
    "Flat -> S ( 1.1 0.1 1.1 ) I ( CubeY grayStone rand( 0.1 0.5 ) )\n";

TEST(Web, sharingChangesNothing) {
  for (double seed = 0; seed < 4; ++seed) {
    DrawOptions shared, apart;
    shared.seed = apart.seed = seed;
    apart.sharing = false;
    const Drawn a = draw(kHouse, shared), b = draw(kHouse, apart);
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    for (size_t k = 0; k < a.bodies.size(); ++k)
      EXPECT_TRUE(near(a.bodies[k].box, b.bodies[k].box));
  }
}

TEST(Web, convertedTextDrawsTheSame) {
  const Converted text = convert(kHouse, "house.grammar");
  const Drawn a = draw(kHouse), b = drawConverted(text.text);
  EXPECT_TRUE(b.model.ok()) << text.text;
  ASSERT_EQ(a.bodies.size(), b.bodies.size()) << text.text;
  for (size_t k = 0; k < a.bodies.size(); ++k) {
    EXPECT_TRUE(near(a.bodies[k].box, b.bodies[k].box)) << k;
    EXPECT_EQ(a.bodies[k].texture, b.bodies[k].texture) << k;
  }
}

TEST(Web, theOtherNotationStaysWhatItIs) {
  for (const char* text :
       {"X -> I ( CubeY concrete 0 1 )\n", "X -> R h ( 1 2 ) Y\nY 1 h -> S ( 1 h 1 ) I ( Cube )\n",
        "X 3 ; 0.5 -> I ( Cube brick 1 ) | T ( 1 0 0 )\n", "City -> [ A ( 30 1 ) I ( Cube ) ]\n"}) {
    const Drawn d = draw(text);
    // Boxes stand on their base there, or CubeY reaches forward.
    for (const Body& b : d.bodies) EXPECT_GE(b.box.min.y, -1e-9) << text;
  }
}

}  // namespace
}  // namespace gable::progen3d_test
