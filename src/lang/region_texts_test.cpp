// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/region_texts.h"

#include <gtest/gtest.h>

#include "lang/lexer.h"
#include "lang/old_regions.h"
#include "lang/parser.h"

namespace gable::lang {
namespace {

TEST(RegionTexts, SelectionsAreExpressions) {
  RegionTexts t;
  EXPECT_EQ(t.selection("OUTER_EDGE"), "outer");
  EXPECT_EQ(t.selection("outer & !W"), "outer && !side(west)");
  EXPECT_EQ(t.selection("PB - PI(1)"), "peeledBase - peeledInner(1)");
  // What binds less here keeps its brackets there.
  EXPECT_EQ(t.selection("outer & W - cut"), "(outer && side(west)) - cut");
  EXPECT_EQ(t.selection("W | N & outer"), "side(west) || side(north) && outer");
  EXPECT_EQ(t.selection("(W | N) & outer"), "(side(west) || side(north)) && outer");
  EXPECT_EQ(t.selection("[0,1][2,2.5]"), "range(0, 1) || range(2, 2.5)");
  EXPECT_EQ(t.selection("-1"), "edge(-1)");
  EXPECT_EQ(t.selection("len > 9"), "longer(9)");
  EXPECT_EQ(t.selection("outer(strict)"), "strictOuter");
  EXPECT_EQ(t.selection("grow(W, E; 10)"), "grow(west || east, 10)");
  EXPECT_EQ(t.selection("facing(world.E)"), "facing(world.east)");
  EXPECT_EQ(t.selection("sector(0, 90, whole)"), "sector(0, 90, whole)");
  EXPECT_EQ(t.selection("Outr"), "");
  EXPECT_EQ(t.word(), "outr");
  EXPECT_EQ(t.selection("side(Q)"), "");
  EXPECT_EQ(t.selection("outer &"), "");
}

TEST(RegionTexts, LinesPlacesAndSites) {
  RegionTexts t;
  EXPECT_EQ(t.lines("[0.02,1] [0, 1] [0,0.15] 0"),
            "edge(0, 0.02, 1) || edge(1, 0, 1) || edge(2, 0, 0.15)");
  EXPECT_EQ(t.lines("[] _; side(E)"), "edge(1) || side(east)");
  EXPECT_EQ(t.lines("{[0.1,0.3],[0.6,0.9]}"), "edge(0, 0.1, 0.3) || edge(0, 0.6, 0.9)");
  EXPECT_EQ(t.places("(0.2, 0.5) (0.8, 0.5)"), "at(0.2, 0.5) || at(0.8, 0.5)");
  EXPECT_EQ(t.places("corner(outer)"), "corner(outer)");
  EXPECT_EQ(t.places("CENTR"), "");
  EXPECT_EQ(t.sites("5 {[5-10]}").radius, "rand(5, 10)");
  EXPECT_EQ(t.sites("5 {[5-10]}").sites, "5");
  EXPECT_EQ(t.sites("(3, 4) (10, 4, 2)").sites, "point(3, 4) || point(10, 4, 2)");
  EXPECT_EQ(t.targets("entrances([0.5, 1.5])"), "entrance(0.5) || entrance(1.5)");
  EXPECT_EQ(t.smoothing("average(2, 0.5)"), "average(2, 0.5)");
  EXPECT_EQ(t.smoothing("2"), "2");
  EXPECT_EQ(t.profile("(0,0)(0,1)(1,0)"), "[0, 0; 0, 1; 1, 0]");
}

TEST(RegionTexts, SizesOfGrids) {
  RegionTexts t;
  RegionTexts::Dimension d = t.dimension("3 {[7,15]a[-15,15]}");
  EXPECT_TRUE(d.read);
  EXPECT_EQ(d.count, "3");
  EXPECT_EQ(d.sizes, "rand(7, 15)");
  EXPECT_EQ(d.angles, "rand(-15, 15)");
  d = t.dimension("{2, 6}");
  EXPECT_EQ(d.count + d.sizes, "[2, 6]");
  d = t.dimension("[2-4]");
  EXPECT_EQ(d.count, "rand(2, 4)");
  d = t.dimension("Columns a30");
  EXPECT_EQ(d.count, "Columns");
  EXPECT_EQ(d.angles, "30");
  EXPECT_FALSE(t.dimension("3 {").read);
}

std::string modern(const std::string& text) {
  Diagnostics diagnostics;
  const Tokens tokens = tokenize(text, 0, diagnostics);
  const Tree tree = parse(text, 0, tokens, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << text;
  return withModernRegions(tree, text).text;
}

TEST(OldRegions, CallsAreRewritten) {
  EXPECT_EQ(modern("A --> peel(\"outer & !W\", 1, \"orthogonal smooth=average(2)\") { strip : B }"),
            "A --> peel(outer && !side(west), 1, orthogonal = true, smooth = average(2)) "
            "{ strip : B }");
  EXPECT_EQ(modern("A --> grid(2, \"2 {6}\", 1, \"romb(3)\", \"fit=centre\") { junction : B }"),
            "A --> grid(2, 2, 1, heights = 6, fit = center) { junction : rhombus(3) B }");
  EXPECT_EQ(modern("A --> place(centre, \"circle(\" + r + \", 48)\") { B | otherwise : C }"),
            "A --> place(centre) { circle(r, 48) B | otherwise : C }");
  EXPECT_EQ(
      modern("A --> voronoi(\"\" + n + \" {[4,9]}\", w, \"none\", \"jitter=1\") { region : B }"),
      "A --> voronoi(n, w, none, radius = rand(4, 9), jitter = 1) { region : B }");
  EXPECT_EQ(modern("A --> distribute(\"PI\", \"[start : 3 : end]\", 0.5) { B }"),
            "A --> distribute(peeledInner, intervals = 3, start = true, end = true, inset = 0.5) "
            "{ B }");
  EXPECT_EQ(modern("A --> [ romb(r) B ] place(centre) { romb(2) C } romb"),
            "A --> [ rhombus(r) B ] place(centre) { rhombus(2) C } romb");
  // What cannot be said exactly stays, and so do calls of the author's own rules.
  const char* const left[] = {"A --> peel(\"nonsense\", 1) { strip : B }",
                              "A --> peel(\"outer\")\npeel(x) --> B",
                              "A --> romb(3) B\nromb(r) --> C",
                              "A --> grid(2, 2, 1, \"30%: romb(3) | circle(2)\") { junction : B }"};
  for (const char* text : left) EXPECT_EQ(modern(text), text);
}

}  // namespace
}  // namespace gable::lang
