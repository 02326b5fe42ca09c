// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations on regions whose arguments are texts, as they were once: what `check` says of each,
// and what `format` makes of it. Where a hint says that format rewrites the file, it does, and what
// it writes passes the check.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "gable/gable.h"
#include "lang/old_regions.h"

namespace gable {
namespace {

struct OldCall {
  std::string_view operation;
  const char* rule;
};

// Every kind of text that an operation took.
constexpr OldCall kCalls[] = {
    {"grid", R"~(grid("3 {2, 6, 2}", "{[1.5,4]}", 2) { region : A. })~"},
    {"grid", R"~(grid("2 {[7,15]a[-15,15]}", "[2-4] a[-5,5]", 2) { region : A. })~"},
    {"grid", R"~(grid(2, 2, 2, "romb(3)") { region : A. | junction : B. })~"},
    {"grid", R"~(grid(2, 2, 2, "rect(3, 2)") { region : A. })~"},
    {"grid", R"~(grid(2, 2, 2, "30%: romb(3) | circle(2) | none") { junction : B. })~"},
    {"grid", R"~(grid(2, 2, 2, "case ix == 0: romb(3) | square(2)") { junction : B. })~"},
    {"grid",
     R"~(grid(2, 2, 2, "none", "fit=center template=obb pattern=pair dominance=split symxy lines sliver=0.1 minarea=2") { region : A. })~"},
    {"voronoi",
     R"~(voronoi("5 {[5,10]}", 2, "average(2, 0.3)", "borderpath=none orphans=own jitter=1") { region : A. })~"},
    {"voronoi", R"~(voronoi("(3, 4) (10, 4, 2)", 2, "chaikin(2)") { region : A. })~"},
    {"voronoi", R"~(voronoi(4, 2, "round(1)", "borderpath=half") { region : A. })~"},
    {"castRays",
     R"~(castRays("centre", "corners", 2, "square(4)", "hidden=stop connect=loop") { centre : A. })~"},
    {"castRays",
     R"~(castRays("1 {15}", "directions(0, 90)", 2, 3) { region : A. | centre : B. })~"},
    {"castRays",
     R"~(castRays("(3, 4) (10, 4)", "entrances(0.5, 2.5)", 2, 2, "connect=thin(0.5)") { path : A. })~"},
    {"peel", R"~(peel("outer & !side(W)", 1, "orthogonal smooth=average(2)") { strip : A. })~"},
    {"peel", R"~(peel("{side(W): 2, side(N): 4}") { strip : A. })~"},
    {"peel",
     R"~(peel("PB - PI(1) | [0,1][2,2.5] | len > 9 | grow(W, E; 10)", '0.5) { strip : A. })~"},
    {"place", R"~(place("corner(outer & W)", "circle(1)", "over align") { A. })~"},
    {"place",
     R"~(place("(0.2, 0.5) (0.8, 0.5)", "polygon(6, 2)", "split") { A. | otherwise : B. })~"},
    {"place", R"~(place("points((3, 4) (9, 4))", "rect(2, 1)") { otherwise : B. })~"},
    {"distribute", R"~(distribute("PI", "[start : 3 : end]", 0.5, "circle(1)", "chain") { A. })~"},
    {"distribute", R"~(distribute("all", "[0.2, 0.8]") { A. })~"},
    {"distribute", R"~(distribute("all", "[:2.5]", 1) { A. })~"},
    {"scatterCircles", R"~(scatterCircles(0, "[2,4]", "gap=1 edge=2") { A. })~"},
    {"sweep",
     R"~(sweep("[0.02,1] [0,1] [0,0.15] 0", 1, 1, "height=1.2 profile=dome joins=miter ends=square") { A. })~"},
    {"sweep", R"~(sweep("side(E); _", 1, 0, "round profile=(0,0)(0,1)(1,0.6)(1,0)") { A. })~"},
    {"parametrise", R"~(parametrise("[] _ ; longest", 1) { A. })~"},
    {"joined", R"~(joined("romb(3) rect(8, 2)", free) A.)~"},
    {"joined", R"~(joined("romb(3), circle(2)") A.)~"},
    {"region.selects", R"~(case region.selects("outer & W") : A. else : B.)~"},
};

bool promisesFormat(const std::string& text) {
  bool found = false;
  const Rules rules = Rules::parse(text, "old.cga");
  for (const Diagnostic& d : rules.diagnostics()) {
    const bool says = d.hint.find("'gable format' rewrite") != std::string::npos;
    EXPECT_TRUE(!says || d.severity == Diagnostic::Severity::Error) << render({d});
    found = found || says;
  }
  return found;
}

TEST(OldCalls, AllThatCheckRefusesFormatRewrites) {
  std::set<std::string_view> covered;
  for (const OldCall& c : kCalls) {
    covered.insert(c.operation);
    const std::string text = "Lot --> " + std::string(c.rule) + "\n";
    EXPECT_TRUE(promisesFormat(text)) << text;
    const Formatted f = format(text, "old.cga");
    EXPECT_TRUE(f.diagnostics.empty()) << text << render(f.diagnostics);
    const Rules now = Rules::parse(f.text, "new.cga");
    EXPECT_TRUE(now.ok()) << text << f.text << render(now.diagnostics());
  }
  const auto operations = lang::oldRegionOperations();
  EXPECT_EQ(covered, std::set<std::string_view>(operations.begin(), operations.end()));
}

TEST(OldCalls, FormerNamesAreRewrittenWhereverTheyAreRefused) {
  for (const char* text : {"Lot --> romb(3) A.", "Lot --> romb { A. }", "Lot --> romb(3) { A. }"}) {
    EXPECT_TRUE(promisesFormat(text)) << text;
    EXPECT_EQ(format(text, "old.cga").text.find("romb("), std::string::npos) << text;
    EXPECT_FALSE(promisesFormat(format(text, "old.cga").text)) << text;
  }
}

// A call among the arguments of another.
TEST(OldCalls, CallsWithinCallsAreRewritten) {
  const std::string text =
      "Lot --> peel(\"W\", case region.selects(\"N\") : 1 else : 2) { strip : A. }\n";
  EXPECT_EQ(format(text, "old.cga").text,
            "Lot --> peel(side(west), case region.selects(side(north)): 1 else: 2) "
            "{ strip : A. }\n");
}

// Where nobody can say what is meant, nobody promises to write it.
TEST(OldCalls, WhatFormatLeavesIsNotPromised) {
  for (const char* call :
       {"grid(\"3 {\", 1) { region : A. }", "peel(\"outer &\", 1) { strip : A. }",
        "distribute(\"all\", \"[\" + k + \"]\") { A. }",
        "peel(outer, 1, \"smooth=(((\") { strip : A. }"}) {
    const std::string text = "attr k = 3\nLot --> " + std::string(call);
    EXPECT_FALSE(Rules::parse(text, "old.cga").ok()) << text;
    EXPECT_FALSE(promisesFormat(text)) << text;
    EXPECT_FALSE(format(text, "old.cga").diagnostics.empty()) << text;
  }
}

// Words that the operation does not know are found in what format wrote, by their name.
TEST(OldCalls, UnknownWordsAreNamed) {
  const std::string text = "Lot --> peel(\"outer & sunny\", 1) { strip : A. }";
  const Rules now = Rules::parse(format(text, "old.cga").text, "new.cga");
  ASSERT_EQ(now.diagnostics().size(), 1u) << render(now.diagnostics());
  EXPECT_NE(now.diagnostics()[0].message.find("'sunny'"), std::string::npos);
}

}  // namespace
}  // namespace gable
