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
  // Words that mean nothing are for the analysis to report.
  EXPECT_EQ(modern("A --> peel(\"outer & front\", 1, \"smoth=2\") { strip : B }"),
            "A --> peel(outer && front, 1, smoth = 2) { strip : B }");
  EXPECT_EQ(modern("A --> place(\"centr\", \"cirle(2)\", \"under\") { B }"),
            "A --> place(centr, under = true) { cirle(2) B }");
  // A figure that no one takes is cut out all the same.
  EXPECT_EQ(modern("A --> grid(2, 2, 1, \"romb(3)\") { region : B }"),
            "A --> grid(2, 2, 1) { region : B | junction : rhombus(3) NIL }");
  EXPECT_EQ(modern("A --> place(centre, \"circle(2)\") {}"),
            "A --> place(centre) {circle(2) NIL }");
  EXPECT_EQ(modern("A --> joined(\"romb(3) rect(8, 2)\", free) B"),
            "A --> joined { rhombus(3, free) Part. | rect(8, 2, free) Part. } B");
  EXPECT_EQ(modern("A --> peel(\"W\", 1, smooth = none) { strip : B }"),
            "A --> peel(side(west), 1, smooth = none) { strip : B }");
  // What cannot be said exactly stays, and so do calls of the author's own rules.
  const char* const left[] = {"A --> peel(\"outer &\", 1) { strip : B }",
                              "A --> peel(\"outer\")\npeel(x) --> B",
                              "A --> romb(3) B\nromb(r) --> C",
                              "A --> grid(2, 2, 1, \"romb(3)\") { all : B }",
                              "A --> scatterCircles(2, \"3 a[-1,1]\") { B }",
                              "A --> grid(2, 2, 1, \"circle(2 3)\") { junction : B }",
                              "A --> grid(2, 2, 1, \"romb(3) | circle(2)\") "
                              "{ junction : 50% : B else : C }"};
  for (const char* text : left) EXPECT_EQ(modern(text), text);
}

TEST(OldRegions, ChoicesOfFiguresAreWrittenForEach) {
  const auto junction = [](const std::string& figures) {
    const std::string text =
        modern("A --> grid(2, 2, 1, \"" + figures + "\") { junction : B C | region : D }");
    const std::string head = "A --> grid(2, 2, 1) { junction : ", tail = " | region : D }";
    EXPECT_TRUE(text.starts_with(head) && text.ends_with(tail)) << text;
    return text.substr(head.size(), text.size() - head.size() - tail.size());
  };
  EXPECT_EQ(junction("30%: romb(3) | circle(2)"), "30% : rhombus(3) B C else : circle(2) B C");
  // Those without a chance share the rest; chances are shares of their sum.
  EXPECT_EQ(junction("40: romb(3) | circle(2) | none"),
            "40% : rhombus(3) B C 30% : circle(2) B C else : B C");
  EXPECT_EQ(junction("1: romb(3) | 3: circle(2)"), "25% : rhombus(3) B C else : circle(2) B C");
  EXPECT_EQ(junction("case ix == 0 && (by != 1): romb(3) | circle(2)"),
            "case region.ix == 0 && (region.by != 1) : rhombus(3) B C else : circle(2) B C");
  EXPECT_EQ(junction("case nx>2||iy<1: romb(3)"),
            "case region.nx>2||region.iy<1 : rhombus(3) B C else : B C");
}

}  // namespace
}  // namespace gable::lang
