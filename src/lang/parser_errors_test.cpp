// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Mistakes: what is reported, where, and that what stands around them is still read.

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "lang/lexer.h"
#include "lang/testing.h"

namespace gable::lang {
namespace {

// The names of all declarations, separated by blanks.
std::string declarations(const Tree& tree) {
  std::string out;
  for (const NodeId id : tree.children(tree.root())) {
    out += (out.empty() ? "" : " ") + std::string(tree.text(id));
  }
  return out;
}

TEST(ParserErrors, forgottenParenthesisEndsAtTheNextWord) {
  Parsed p("A --> extrude(10\n  comp(f) { top : B }\nC --> D");
  EXPECT_EQ(p.problems(), "1:14 unclosed-bracket\n");
  EXPECT_EQ(dump(p.tree),
            "file\n  rule A\n    extrude(10)\n    comp(f)\n      block\n        item top :\n"
            "          B\n  rule C\n    D\n");
}

TEST(ParserErrors, forgottenBraceEndsAtTheNextRule) {
  Parsed p("A --> split(x) { 1 : B | { 2 : C\nD --> E\nattr h = 1");
  EXPECT_EQ(p.problems(), "1:26 unclosed-block\n");
  EXPECT_EQ(declarations(p.tree), "A D h");
}

TEST(ParserErrors, forgottenPushBracketEndsAtTheNextRule) {
  Parsed p("A --> [ t(1,0,0) B\nD --> E");
  EXPECT_EQ(p.problems(), "1:7 unclosed-bracket\n");
  EXPECT_EQ(declarations(p.tree), "A D");
}

TEST(ParserErrors, superfluousClosersArePassedOver) {
  Parsed p("A --> split(x) { 1 : B } } C\nD --> s(1,1,1)) E ] F");
  EXPECT_EQ(p.problems(), "1:26 unexpected-token\n2:15 unexpected-token\n2:19 unexpected-token\n");
  EXPECT_EQ(dump(p.tree),
            "file\n  rule A\n    split(x)\n      block\n        item 1 :\n          B\n    C\n"
            "  rule D\n    s(1, 1, 1)\n    E\n    F\n");
}

TEST(ParserErrors, missingBarIsNamed) {
  Parsed p("A --> comp(f) { front : B back : C | top = D side = E }");
  EXPECT_EQ(p.problems(), "1:27 missing-separator\n1:46 missing-separator\n");
  EXPECT_EQ(p.diagnostics.all()[0].message, "'|' is missing before 'back'");
  Parsed q("A --> split(x) { 1 : B 2 : C ~1 : D }");
  EXPECT_EQ(q.problems(), "1:24 missing-separator\n1:30 missing-separator\n");
}

TEST(ParserErrors, semicolonsGetAHint) {
  Parsed p("attr a = 5;\nA --> extrude(a); B;\nC --> D");
  EXPECT_EQ(p.problems(), "1:11 unexpected-token\n2:17 unexpected-token\n2:20 unexpected-token\n");
  EXPECT_EQ(p.diagnostics.all()[0].hint, "statements need no separator; remove it");
  EXPECT_EQ(declarations(p.tree), "a A C");
}

TEST(ParserErrors, allMistakesOfAFileComeInOneRun) {
  Parsed p(R"(attr a = 1 +
attr b = (2
A --> extrude() s(1,,2) case x : B
C --> 30 : D
f(x = 3
E --> else : F t(1 2)
@ G --> "text" 3
H --> I)");
  EXPECT_EQ(p.problems(),
            "2:1 unexpected-token\n"
            "3:1 unexpected-token\n"
            "3:21 unexpected-token\n"
            "3:25 choice-not-first (warning)\n"
            "3:25 missing-else\n"
            "4:10 unexpected-token\n"
            "5:2 unclosed-bracket\n"
            "6:7 unexpected-token\n"
            "6:20 unexpected-token\n"
            "7:5 unexpected-token\n")
      << p.messages();
  EXPECT_EQ(declarations(p.tree), "a b A C x E G H");
}

TEST(ParserErrors, textThatIsNoRuleFileIsReportedOnce) {
  Parsed p("<html><body>Not found</body></html>");
  EXPECT_EQ(p.problems(), "1:1 unexpected-token\n");
}

TEST(ParserErrors, missingElseIsAnError) {
  Parsed p("f(x) = case x : 1\nA --> case a : B case b : C\nD --> E");
  EXPECT_EQ(p.problems(), "1:8 missing-else\n2:7 missing-else\n");
  EXPECT_EQ(declarations(p.tree), "f A D");
}

TEST(ParserErrors, unitsAreOneMistakeEach) {
  Parsed p(
      "A --> extrude(10 m) split(y) { 6.5m : B | ~6.5 m : C | '2 cm : D }\nE --> s(1, 2 ft, 3) F");
  EXPECT_EQ(p.problems(),
            "1:18 unexpected-token\n1:35 unexpected-token\n1:48 unexpected-token\n"
            "1:59 unexpected-token\n2:14 unexpected-token\n")
      << p.messages();
  EXPECT_EQ(p.diagnostics.all()[0].hint, "remove it: lengths are in metres, angles in degrees");
  Parsed values("attr h = 9 m\nattr w = 2 cm // wide\nA --> extrude(h m) s(w ft, 1, 1) B");
  EXPECT_EQ(values.problems(),
            "1:12 unexpected-token\n2:12 unexpected-token\n3:17 unexpected-token\n"
            "3:24 unexpected-token\n")
      << values.messages();
  // Names, where a number ends and something else begins.
  Parsed names(
      "attr a = 3\nm --> B\nC --> 30% : m else : cm\nD --> extrude(a) m\nattr b = a\nft --> B");
  EXPECT_EQ(names.problems(), "") << names.messages();
}

TEST(ParserErrors, aCommaBetweenPartsIsOneMistake) {
  Parsed p("A --> split(x) { 2 : B, ~1 : C , '0.5 : D, { ~1 : E }* }");
  EXPECT_EQ(p.problems(),
            "1:23 missing-separator\n1:32 missing-separator\n1:42 missing-separator\n")
      << p.messages();
  EXPECT_EQ(p.diagnostics.all()[0].message, "the parts of a block have '|' between them");
}

TEST(ParserErrors, emptyItemsWarn) {
  Parsed p("A --> comp(f) { | top : B | | side : C | }");
  EXPECT_EQ(p.problems(),
            "1:17 empty-item (warning)\n1:29 empty-item (warning)\n1:42 empty-item (warning)\n");
}

TEST(ParserErrors, partsWithoutABodyWarn) {
  Parsed p("A --> split(x) { 1 : | 2 : B } comp(f) { top : }");
  EXPECT_EQ(p.problems(), "1:21 empty-item (warning)\n1:47 empty-item (warning)\n");
}

TEST(ParserErrors, keywordBeforeARuleWarns) {
  Parsed p("attr A --> B const C(x) --> D");
  EXPECT_EQ(p.problems(), "1:6 keyword-on-rule (warning)\n1:20 keyword-on-rule (warning)\n");
  EXPECT_EQ(dump(p.tree), "file\n  rule A\n    B\n  rule C(x)\n    D\n");
}

// --- Hostile texts ---

std::string repeated(const std::string& s, size_t n) {
  std::string out;
  for (size_t i = 0; i < n; ++i) out += s;
  return out;
}

TEST(ParserErrors, deepNestingIsReportedNotCrashed) {
  for (const char* const open :
       {"(",           "[",   "{",    "f(",       "a[",         "-",       "!",     "comp(f){all:",
        "split(x){1:", "{{",  "[[",   "case a:",  "else:",      "inline ", "case ", "~",
        "'",           "1%:", "f(a=", "imp(A-->", "x{1:case a:"}) {
    for (const char* head : {"x = ", "A --> ", "@Handle(", "import a:\"b\"("}) {
      Parsed p(head + repeated(open, 10000) + "\nB --> C");
      EXPECT_GE(p.diagnostics.all().size(), 1u) << head << open;
      EXPECT_LE(p.diagnostics.all().size(), 2 * kMaxSyntaxErrors + 2) << head << open;
    }
  }
}

TEST(ParserErrors, readingGoesOnBehindDeepNesting) {
  Parsed p("A --> B(" + repeated("(", 10000) + "1" + repeated(")", 10000) + ")\nC --> D");
  EXPECT_EQ(p.problems(), "1:407 nesting-too-deep\n");
  EXPECT_EQ(declarations(p.tree), "A C");
}

TEST(ParserErrors, longChainsOfOperatorsAreBounded) {
  Parsed fits("x = 1" + repeated("+1", 900));
  EXPECT_EQ(fits.problems(), "");
  Parsed p("x = 1" + repeated("+1", 100000) + "\nC --> D");
  EXPECT_EQ(p.problems(), "1:5 nesting-too-deep\n");
  EXPECT_EQ(declarations(p.tree), "x C");
}

TEST(ParserErrors, errorsAreCapped) {
  Parsed p("A --> " + repeated("; B ", 5000));
  EXPECT_EQ(p.diagnostics.errorCount(), kMaxSyntaxErrors + 1);
  EXPECT_EQ(p.diagnostics.all().back().code, "too-many-errors");
}

TEST(ParserErrors, oneLineOfManyMegabytesTakesLinearTime) {
  const auto seconds = [](const std::string& text) {
    const auto start = std::chrono::steady_clock::now();
    const Parsed p(text);
    EXPECT_LT(p.diagnostics.all().size(), 210u);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  // Quadratic time would take hours; the bound leaves room for busy machines.
  size_t bytes = 20'000'000;
  for (const char* const piece :
       {"A --> s(1,1,1) comp(f) { all : X } ", "(", "{ a ", "x", "\"", "1 ", "a(", "{1:", "|",
        "split(x){1:A|~1:B}* ", "f(x)=x*2 ", "[1,2;3]", "//", "/*", "case a:", "50%:A else:"}) {
    std::string text = "R --> ";
    while (text.size() < bytes) text += piece;
    EXPECT_LT(seconds(text), 20) << piece;
    bytes = 3'000'000;
  }
}

// Valid pieces from which mutations are made.
const char* const kSeed = R"(version "2025.1"
import a(s) : "a.cga" ( h = 3, Roof(x) --> roofHip(x) )
@Group("G", 1) @Range(min=0, max=[1,2]) attr h = case a > 1 : 2 else : [1:2:9][0]
const c with ( x := 1 y := x ) = comp(f) { front = 1 | all : 30% : 2 else : 3 }[0,1]
start Lot(p) with ( q := p ) --> extrude(world.up, '1 + ~2) [ t(0,'-0.5,0) A. ]
  split(x, noAdjust) { ~1 : B | { '0.5 : C | 1 : 2 : D }* }* { remainder : E }
  comp(f) { top =: inline(recompose) F | isTagged("x", e) && !side = imp(h = 2).G(1) | 3 : H }
  union { A | B } subtract(swap) C
A --> 30% : B 20.5% : case x .== 2 : C case y : D else : E else : NIL
style S extends T
attr h = -0.5e3 # comment
)";

TEST(ParserErrors, mutatedTextsNeverCrash) {
  std::mt19937 random(7);
  const std::string seed = kSeed;
  const std::string signs =
      "()[]{}|:=.,;'~@#%*\"/-+!<>&$ \n\\\x80"
      "aA1";
  const auto pick = [&](size_t n) { return static_cast<size_t>(random() % n); };
  ASSERT_EQ(Parsed(seed).problems(), "") << Parsed(seed).messages();
  for (int round = 0; round < 4000; ++round) {
    std::string text = seed;
    const size_t changes = 1 + pick(12);
    for (size_t i = 0; i < changes && !text.empty(); ++i) {
      const size_t at = pick(text.size());
      const size_t length = std::min(pick(30), text.size() - at);
      switch (pick(5)) {
        case 0: text.erase(at, length); break;
        case 1: text.insert(at, 1, signs[pick(signs.size())]); break;
        case 2: text[at] = signs[pick(signs.size())]; break;
        case 3: text.insert(at, text.substr(pick(text.size()), length)); break;
        default: text.resize(at); break;
      }
    }
    Parsed p(text);
    // The dump walks all nodes, and each place must lie within the text.
    EXPECT_FALSE(dump(p.tree).empty());
    for (const Diagnostics::Entry& d : p.diagnostics.all()) {
      ASSERT_LE(d.span.begin, text.size());
      ASSERT_FALSE(d.message.empty());
    }
    for (NodeId id = 1; id < p.tree.size(); ++id) {
      ASSERT_LE(p.tree[id].begin, p.tree[id].end);
      ASSERT_LE(p.tree[id].end, text.size());
    }
  }
}

}  // namespace
}  // namespace gable::lang
