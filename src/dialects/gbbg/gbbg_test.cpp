// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The notation itself: what is read, what is reported and where, what the formatter writes.

#include "dialects/gbbg/gbbg.h"

#include <gtest/gtest.h>

#include <random>

#include "dialects/gbbg/check.h"
#include "dialects/gbbg/parser.h"
#include "dialects/gbbg/print.h"

namespace gable::gbbg {
namespace {

struct Read {
  Sources sources;
  Diagnostics diagnostics;
  Grammar grammar;

  explicit Read(const std::string& text) {
    const uint32_t file = sources.add("test.gbbg", text);
    grammar = parse(sources.text(file), file, diagnostics);
    checked(grammar, diagnostics);
  }
  std::string problems() {
    diagnostics.sortByPlace();
    std::string out;
    for (const Diagnostics::Entry& d : diagnostics.all()) {
      if (d.span.valid()) {
        const LineColumn at = sources.locate(d.span.file, d.span.begin);
        out += std::to_string(at.line) + ":" + std::to_string(at.column) + " ";
      }
      out += d.code + (d.severity == Severity::Warning ? " (warning)\n" : "\n");
    }
    return out;
  }
  std::string hint(size_t i) const { return diagnostics.all()[i].hint; }
};

// Formats, and holds the result to its promises.
std::string formatted(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  const uint32_t file = sources.add("test.gbbg", text);
  const std::string once = kGbbgDialect.format(sources, file, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors());
  const uint32_t second = sources.add("again.gbbg", once);
  EXPECT_EQ(kGbbgDialect.format(sources, second, diagnostics), once);
  return once;
}

const std::string kStart = "axiom START size (1, 1, 1)\nterminal A, B, C\n";

TEST(GbbgNotation, allOfItIsRead) {
  Read read(R"(# comment
axiom START at (1, 2, 3) rotate (0, 90, 0) size (4, 5, 6), "other start" on footprint height 12
use "common.gbbg" /* another */
select weighted
shape P [4, 0, 0], Q 3D
terminal T, U 2D [1, 2, 3], V Empty
"a name" START -> Scope(T(1, -2, .5, Set), Rotate(0, 0, 90, World), S(2, 2, 1e1, Relative, Off)) {P}
P -> Split(x, {1, 2.5}, ToRoot) {T 1, EMPTY 0.2 | U | Q} weight 3
Q -> Margin(Z, Relative, 0.25, FacingIn, NoCenter) {T | U}
"other start" ->> Component(Y, TopPlusBottom) {T | U}
postprocess {
  T : "assets/t.glb"
  # of the second
  U : "u.glb" fit bounds
})");
  EXPECT_EQ(read.problems(), "");
  const auto& s = read.grammar.statements;
  ASSERT_EQ(s.size(), 10u);
  EXPECT_EQ(s[0].starts[0].rotate, (Triple{0, 90, 0}));
  EXPECT_TRUE(s[0].starts[1].onFootprint);
  EXPECT_EQ(s[0].starts[1].height, 12);
  EXPECT_EQ(s[1].path, "common.gbbg");
  EXPECT_EQ(s[4].shapes[1].dimensions, Dimensions::Two);
  EXPECT_EQ(s[4].shapes[1].preferred, (Triple{1, 2, 3}));
  const Rule& scope = s[5].rule;
  EXPECT_EQ(scope.title, "a name");
  EXPECT_EQ(scope.translate.value, (Triple{1, -2, 0.5}));
  EXPECT_TRUE(scope.translate.set);
  EXPECT_TRUE(scope.rotate.world);
  EXPECT_TRUE(scope.scale.relative);
  EXPECT_FALSE(scope.scale.on);
  const Rule& split = s[6].rule;
  EXPECT_EQ(split.axis, Axis::X);
  EXPECT_EQ(split.points, (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(split.toRoot);
  EXPECT_EQ(split.weight, 3);
  EXPECT_EQ(split.slots[0].possibilities[1].symbol.text, "EMPTY");
  EXPECT_EQ(split.slots[0].possibilities[1].chance, 0.2);
  EXPECT_TRUE(s[7].rule.relativeMargin);
  EXPECT_EQ(s[7].rule.orientation, Orientation::FacingIn);
  EXPECT_TRUE(s[9].assets[1].fitBounds);
}

TEST(GbbgNotation, G21EachWrongGrammarGetsItsWord) {
  const std::pair<std::string, std::string> cases[] = {
      {"D -> Repeat(X) {A}", "3:1 gbbg-unknown-predecessor (warning)\n"},
      {"START -> Repeat(X) {D}", "3:21 gbbg-no-rule (warning)\n"},
      {"START -> Scope() {A 0, B 1}", "3:21 gbbg-chance (warning)\n"},
      {"START -> Scope() {A 0}", "3:19 gbbg-chance\n3:21 gbbg-chance (warning)\n"},
      {"START -> Scope() {A -1}", "3:21 gbbg-chance\n"},
      {"START -> Split(X, {1, 2}) {A | B}", "3:27 gbbg-successor-count\n"},
      {"START -> Split(X, {}) {A | B}", "3:23 gbbg-successor-count\n"},
      {"START -> Split(X, {-1}) {A | B}", "3:20 gbbg-size\n"},
      {"START -> Repeat(X) {A | B}", "3:20 gbbg-successor-count\n"},
      {"START -> Margin(Y, 1) {A | B}", "3:23 gbbg-successor-count\n"},
      {"START -> Margin(Y, 1, NoCenter) {A | B | C}", "3:33 gbbg-successor-count\n"},
      {"START -> Margin(Y, -1) {A | B | C}", "3:20 gbbg-size\n"},
      {"START -> Margin(Y, Relative, 0.6) {A | B | C}", "3:18 gbbg-size (warning)\n"},
      {"START -> Margin(Y, 1, 2) {A | B | C}", "3:23 gbbg-word\n"},
      {"START -> Margin(Y, Outward) {A | B | C}", "3:20 gbbg-word\n"},
      {"START -> Component(Y, Side) {A}", "3:23 gbbg-word\n"},
      {"START -> Component(Q, Sides) {A}", "3:20 gbbg-word\n"},
      {"START -> Component(Y, Top) {A | B}", "3:28 gbbg-successor-count\n"},
      {"START -> Scope(T(1, 2), S(1, 1, 1)) {A}", "3:22 unexpected-token\n"},
      {"START -> Scope(T(1, 2, 3), T(1, 2, 3)) {A}", "3:28 gbbg-word\n"},
      {"START -> Scope(S(1, 2, 3, Local)) {A}", "3:27 gbbg-word\n"},
      {"START -> Slice(X) {A}", "3:10 gbbg-word\n"},
      {"START -> Repeat(X) {A", "3:20 unclosed-block\n"},
      {"START -> Repeat(X {A}", "3:19 unexpected-token\n"},
      {"START -> Repeat(X", "3:16 unclosed-bracket\n"},
      {"START -> Repeat(X) {A}\nSTART -> Grid(Y) {B}", "4:1 duplicate-rule (warning)\n"},
      {"A -> Grid(Y) {B}", "3:1 gbbg-terminal-rule (warning)\n"},
      {"terminal A", "3:10 gbbg-duplicate-shape (warning)\n"},
      {"terminal Z [1, -2, 0]", "3:16 gbbg-size\n"},
      {"axiom A size (0, 0, 1)", "3:14 gbbg-size\n"},
      {"axiom A size (1, -1, 1)", "3:14 gbbg-size\n"},
      {"axiom A on footprint height -3", "3:29 gbbg-size\n"},
      {"postprocess { D : \"d.glb\" }", "3:15 gbbg-unknown-symbol (warning)\n"},
      {"postprocess { START : \"d.glb\" }", "3:15 gbbg-not-terminal (warning)\n"},
      {"postprocess { A : \"a.glb\" A : \"b.glb\" }", "3:27 gbbg-duplicate-asset (warning)\n"},
      {"postprocess { A : a }", "3:19 unexpected-token\n"},
      {"select best", "3:8 gbbg-word\n"},
      {"terminal \"D", "3:10 unterminated-string\n"},
      {"/* open", "3:1 unterminated-comment\n"},
      {"terminal D [1e999, 0, 0]", "3:13 bad-number\n"},
      {"terminal @ D", "3:10 unexpected-character\n"}};
  for (const auto& [text, expected] : cases) {
    std::string problems = Read(kStart + text).problems();
    // Where START has no rule a warning says so; it is not what these are about.
    const std::string own = "1:7 gbbg-no-rule (warning)\n";
    if (problems.starts_with(own)) problems.erase(0, own.size());
    EXPECT_EQ(problems, expected) << text;
  }
}

TEST(GbbgNotation, allMistakesAreReportedInOneRun) {
  Read read(kStart +
            "START -> Splitt(X) {A}\nfoo bar\nP -> Grid(W) {A}\nQ -> Repeat(Y) {A}\n)\nsahpe X\n");
  EXPECT_EQ(read.problems(),
            "3:10 gbbg-word\n4:1 unexpected-token\n5:11 gbbg-word\n7:1 unexpected-token\n"
            "8:1 unexpected-token\n");
  EXPECT_EQ(read.hint(0), "did you mean 'Split'?");
  EXPECT_EQ(read.hint(4), "did you mean 'shape'?");
}

TEST(GbbgNotation, aSlipInASymbolNamesTheOneThatIsMeant) {
  Read slip(kStart + "terminal wall\nSTART -> Split(X, {1}) {wall | wal}\n");
  EXPECT_EQ(slip.problems(), "4:32 gbbg-no-rule (warning)\n");
  EXPECT_EQ(slip.hint(0), "did you mean 'wall'?");
}

TEST(GbbgNotation, aGrammarNeedsAStart) {
  EXPECT_EQ(Read("A -> Grid(Y) {B}\nterminal B").problems(),
            "1:1 gbbg-no-start\n1:1 gbbg-unknown-predecessor (warning)\n");
  EXPECT_EQ(Read("START -> Grid(Y) {B}\nterminal B").problems(), "");
  EXPECT_EQ(Read("").problems(), "1:1 gbbg-no-start\n");
}

TEST(GbbgNotation, G22FormattingTwiceGivesTheSameBytes) {
  EXPECT_EQ(
      formatted(
          "axiom START size(1,2,3)#end\n\n\n\n# above\nSTART->Split(X,{1,  2}){A|B 2,C|\"d e\"}\n"
          "terminal A,B [1,2,3], C 2D,\"d e\" Empty\n#last"),
      R"(axiom START size (1, 2, 3)  #end

# above
START -> Split(X, {1, 2}, FromRoot) {A | B 2, C | "d e"}
terminal A, B [1, 2, 3], C 2D, "d e" Empty

#last
)");
  EXPECT_EQ(formatted("P->Scope(/* why */R(1,2,3,World),T(0,0,1)){A}\nselect  random\nuse \"x\"\n"
                      "postprocess{A:\"a\" Bcd:\"b\" fit bounds}"),
            R"(/* why */
P -> Scope(T(0, 0, 1, Add, Local), R(1, 2, 3, Add, World)) {A}
select random
use "x"
postprocess {
  A   : "a"
  Bcd : "b" fit bounds
}
)");
}

TEST(GbbgNotation, longRulesBreakBeforeTheirSuccessors) {
  const std::string text = formatted(
      "Predecessor -> Split(Y, {1.25, 2.5, 3.75, 4.125}, ToRoot) {GroundFloor | Mezzanine | "
      "PianoNobile | Attic | RoofTerrace} weight 2");
  EXPECT_EQ(text,
            "Predecessor -> Split(Y, {1.25, 2.5, 3.75, 4.125}, ToRoot)\n"
            "    {GroundFloor | Mezzanine | PianoNobile | Attic | RoofTerrace} weight 2\n");
}

TEST(GbbgNotation, textWithMistakesIsLeftAsItIs) {
  Sources sources;
  Diagnostics diagnostics;
  const std::string text = "START ->   Grid(Y) {";
  EXPECT_EQ(kGbbgDialect.format(sources, sources.add("x.gbbg", text), diagnostics), text);
  EXPECT_TRUE(diagnostics.hasErrors());
}

// Rules made at random survive printing and reading.
TEST(GbbgNotation, whatIsPrintedReadsAsTheSame) {
  std::mt19937 random(7);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < 500; ++i) {
    Rule r;
    r.predecessor.text = pick(2) ? "A" : "a-b c";
    r.op = static_cast<Operator>(pick(6));
    r.axis = static_cast<Axis>(pick(3));
    for (Change* c : {&r.translate, &r.rotate, &r.scale}) {
      if (r.op != Operator::Scope || pick(2)) continue;
      *c = {true, pick(2) > 0, {pick(9) / 4.0, -pick(9) / 7.0, 1e-7}, pick(2) > 0, false, false};
    }
    if (r.op == Operator::Split) r.points.assign(static_cast<size_t>(pick(4)), 0.1 * pick(50));
    r.toRoot = r.op == Operator::Split && pick(2);
    if (r.op == Operator::Margin) {
      r.margin = pick(5) / 10.0;
      r.relativeMargin = pick(2);
      r.orientation = static_cast<Orientation>(pick(3));
      r.center = pick(2);
    }
    if (r.op == Operator::Component) r.faces = static_cast<Faces>(pick(7));
    if (pick(3) == 0) r.weight = pick(4);
    for (size_t k = 0; k < slotCount(r); ++k) {
      Slot s;
      s.possibilities.push_back({{"B", {}}, 1, false});
      if (pick(2)) s.possibilities.push_back({{"EMPTY", {}}, 0.5, true});
      r.slots.push_back(s);
    }
    const std::string text = printRule(r);
    Sources sources;
    Diagnostics diagnostics;
    const uint32_t file = sources.add("x.gbbg", text);
    const Grammar back = parse(sources.text(file), file, diagnostics);
    ASSERT_EQ(back.statements.size(), 1u) << text << format(diagnostics.all()[0], sources);
    EXPECT_EQ(printRule(back.statements[0].rule), text);
  }
}

}  // namespace
}  // namespace gable::gbbg
