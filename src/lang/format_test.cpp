// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/format.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "lang/testing.h"

namespace gable::lang {
namespace {

// Formats, and holds the result to the promises of the header.
std::string formatted(const std::string& text) {
  const Parsed before(text);
  Diagnostics diagnostics;
  const std::string out = format(before.sources, 0, diagnostics);
  if (diagnostics.hasErrors()) {
    EXPECT_EQ(out, text);
    return "errors";
  }
  const Parsed after(out);
  EXPECT_TRUE(sameTree(before.tree, after.tree)) << text << "\n---\n" << out;
  EXPECT_EQ(format(after.sources, 0, diagnostics), out) << text;
  return out;
}

TEST(Format, shortDeclarationsStayOnOneLine) {
  EXPECT_EQ(formatted("attr   h=10\nconst c =h*2+ -1\n\n\nf( a,b )=a-b*-c\nA-->B  C(1 ,2) X."),
            "attr h = 10\nconst c = h * 2 + -1\n\nf(a, b) = a - b * -c\nA --> B C(1, 2) X.\n");
}

TEST(Format, stringsOverLinesStayAsTheyAre) {
  EXPECT_EQ(formatted("attr a   = \"one \n\n\n   two\"\nA --> print( \"x\n  y\" ) [ B\n C ]"),
            "attr a = \"one \n\n\n   two\"\nA --> print(\"x\n  y\") [ B\n    C ]\n");
}

TEST(Format, linesBeginWhereTheAuthorBeganThem) {
  EXPECT_EQ(
      formatted("attr h = 1\nA --> s('1,' -0.5,0) t(0,1,0) X.\nB -->\nC\n  [D\n E]\n\n\nF --> G"),
      R"(attr h = 1
A --> s('1, '-0.5, 0) t(0, 1, 0) X.
B -->
  C
  [ D
    E ]

F --> G
)");
  EXPECT_EQ(formatted("Facade --> split(y) {\n3 : Ground |\n{ ~h : Floor }* | 1 : Top\n}"),
            R"(Facade --> split(y) {
      3 : Ground
    | { ~h : Floor }* | 1 : Top
  }
)");
}

TEST(Format, successorsThatDoNotFitBeginALine) {
  EXPECT_EQ(
      formatted("A --> translate(rel, scope, 0, 1.25, 0) [ primitiveCube() Column(0.25, "
                "\"sandstone\", true) ] scatter(surface, 12, uniform) { Lamp } NIL"),
      R"(A --> translate(rel, scope, 0, 1.25, 0) [ primitiveCube() Column(0.25, "sandstone", true) ]
  scatter(surface, 12, uniform) { Lamp } NIL
)");
}

TEST(Format, blocksBreakWhenTheyDoNotFit) {
  EXPECT_EQ(
      formatted("Facade --> split(y) { groundFloorHeight : GroundFloor | { ~floorHeight : Floor "
                "}* | corniceHeight : Cornice(1) Cornice(2) Cornice(3) | ~1 : Attic }"),
      R"(Facade -->
  split(y) { groundFloorHeight : GroundFloor | { ~floorHeight : Floor }*
    | corniceHeight : Cornice(1) Cornice(2) Cornice(3) | ~1 : Attic }
)");
  EXPECT_EQ(formatted("A --> comp(f) { top = Roof | side : Wall }"),
            "A --> comp(f) { top = Roof | side : Wall }\n");
  EXPECT_EQ(
      formatted("A --> splitAndSetbackPerimeter('0.1){~30:rand(3,15):Yellow}*{remainder:Grey}"),
      "A --> splitAndSetbackPerimeter('0.1) { ~30 : rand(3, 15) : Yellow }* "
      "{ remainder : Grey }\n");
}

TEST(Format, choicesOfARuleGetALineForEachBranch) {
  EXPECT_EQ(formatted("A --> case a>1 : B C case(b) : [D] else : 30% : E else : NIL\n"
                      "f(x) = case x : 1 else : 2"),
            R"(A -->
  case a > 1: B C
  case (b): [ D ]
  else: 30%: E else: NIL
f(x) = case x: 1 else: 2
)");
}

TEST(Format, aGroupStandsAboveWhatItSpeaksFor) {
  EXPECT_EQ(formatted("@Group(\"A\",1) @Order( 2 ) @Range(min=0,max =1) attr h=1\n"
                      "@Handle(shape=A^2,slip={a,b})\nattr i = 1"),
            "@Group(\"A\", 1)\n@Order(2) @Range(min=0, max=1) attr h = 1\n"
            "@Handle(shape=A^2, slip={a, b})\nattr i = 1\n");
}

TEST(Format, importsAndLocals) {
  EXPECT_EQ(formatted("import a:\"a.cga\"(h=2,Roof(x)-->roofHip(x))\nL with(a:=1 b:=a)-->extrude(b)"
                      " D --> imp( h=1 ).Lot X(3). Y"),
            "import a : \"a.cga\" (h = 2, Roof(x) --> roofHip(x))\n"
            "L with (a := 1 b := a) --> extrude(b)\nD --> imp(h = 1).Lot X(3). Y\n");
}

TEST(Format, arraysRangesAndIndices) {
  EXPECT_EQ(formatted("f = a [ 1,0 : 2:9 ].+[ 1,2;3 ,4 ]\nA --> primitiveCube [ B ] [C]"),
            "f = a[1, 0:2:9] .+ [1, 2; 3, 4]\nA --> primitiveCube [ B ] [ C ]\n");
}

TEST(Format, commentsStayWhereTheyAre) {
  EXPECT_EQ(formatted(R"(/* head
   of the file */
attr a = 1   // one
# own line

// before A


A --> // after the arrow
   B /* inside */ C   # end of C
   // last in A
D --> comp(f) { // first
  top : E // roof
  // sides
  | side : F }
// end)"),
            R"(/* head
   of the file */
attr a = 1 // one
# own line

// before A

A --> // after the arrow
  B /* inside */ C # end of C
// last in A
D --> comp(f) { // first
      top : E // roof
    // sides
    | side : F }
// end
)");
}

TEST(Format, longExpressionsBreakAfterCommasAndBeforeOperators) {
  const std::string out = formatted(
      "const total = firstVeryLongName + secondVeryLongName * thirdVeryLongName + "
      "fourthVeryLongName + fifthVeryLongName + sixthVeryLongName\n"
      "const l = listItem(\"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\", "
      "\"bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb\", \"cccccccccccccccccccc\")");
  EXPECT_EQ(
      out,
      R"(const total = firstVeryLongName + secondVeryLongName * thirdVeryLongName + fourthVeryLongName + fifthVeryLongName
    + sixthVeryLongName
const l = listItem("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb",
    "cccccccccccccccccccc")
)");
}

TEST(Format, filesWithErrorsHaveNoLayout) {
  EXPECT_EQ(formatted("A --> split(x) { 1 : B"), "errors");
}

TEST(Format, emptyAndOddFiles) {
  EXPECT_EQ(formatted(""), "");
  EXPECT_EQ(formatted("\r\n\r\n"), "");
  EXPECT_EQ(formatted("// only this"), "// only this\n");
  EXPECT_EQ(formatted("\xef\xbb\xbf"
                      "A --> B\r\nC --> D\r\n"),
            "A --> B\nC --> D\n");
  EXPECT_EQ(formatted("A -->"), "A -->\n");
}

// Comments and line breaks at random between the words of a text change nothing.
TEST(Format, holdsItsPromisesForAnyWhiteSpace) {
  std::vector<std::string> words = {"version \"2025.1\""};
  std::istringstream others(R"(
    import a ( s ) : "a.cga" ( h = 3 , Roof ( x ) --> roofHip ( x ) ) @Group("G",1) @Order(2)
    attr h = case a > 1 : [ 1 ; - 2 ] else : [ 1 : 9 ] [ 0 ] start Lot ( p ) with ( q := p r :=
    2 ) --> extrude ( world.up , ' 1 ) [ t ( 0 , - - 1 , ! a ) A . ] split ( x ) { ~ 1 : B | { '
    0.5 : C | 1 : 2 : D } * } * inline ( unify ) comp ( f ) { top =: F | ! side = imp ( h = 2 )
    .G } A --> 30 % : B 20 % : case x .== 2 : C else : E else : NIL)");
  for (std::string word; others >> word;) words.push_back(word);
  const char* const spaces[] = {
      " ",       " ",         " ",           "\n", "\n\n\n",          " // c\n",
      "\n# d\n", " /* e */ ", "\n/* f */\n", "\t", "\n// g\n\n// h\n"};
  std::mt19937 random(3);
  for (int round = 0; round < 400; ++round) {
    const size_t kinds = round % 3 == 0 ? std::size(spaces) : 5;
    std::string text;
    for (const std::string& word : words) {
      text += word;
      // ".G" is the member of a run-time import only right behind the bracket.
      const bool glued = word == ")" && text.size() > 3;
      text += glued ? "" : random() % 2 ? " " : spaces[random() % kinds];
    }
    ASSERT_NE(formatted(text), "errors") << text;
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace gable::lang
