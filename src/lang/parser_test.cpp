// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is written against the tree it gives, as text.

#include "lang/parser.h"

#include <gtest/gtest.h>

#include "lang/testing.h"

namespace gable::lang {
namespace {

// Problems first, then the dump without its first line and one level of indent.
std::string tree(const std::string& text) {
  Parsed p(text);
  std::string out = p.messages();
  const std::string all = dump(p.tree);
  size_t at = all.find('\n') + 1;
  while (at < all.size()) {
    const size_t end = all.find('\n', at);
    out += all.substr(at + 2, end + 1 - at - 2);
    at = end + 1;
  }
  return out;
}

// The tree of one expression.
std::string expression(const std::string& text) {
  const std::string all = tree("x = " + text);
  constexpr std::string_view kHead = "function x = ";
  return all.rfind(kHead, 0) == 0 ? all.substr(kHead.size(), all.size() - kHead.size() - 1) : all;
}

// The tree of a rule's body.
std::string body(const std::string& text) {
  const std::string all = tree("A --> " + text);
  if (all.rfind("rule A\n", 0) != 0) return all;
  std::string out;
  for (size_t at = 7; at < all.size();) {
    const size_t end = all.find('\n', at);
    out += all.substr(at + 2, end + 1 - at - 2);
    at = end + 1;
  }
  return out;
}

// --- Declarations ---

TEST(Parser, readsEveryKindOfDeclaration) {
  EXPECT_EQ(tree("version \"2025.1\"\nattr h = 10 const c = h*2 f(a, b) = a+b g = 3\n"
                 "Lot --> extrude(h) Mass\nstyle S extends Base attr h = 20"),
            R"(version "2025.1"
attr h = 10
const c = (h * 2)
function f(a, b) = (a + b)
function g = 3
rule Lot
  extrude(h)
  Mass
style S extends Base
attr h = 20
)");
}

TEST(Parser, lineBreaksMeanNothing) {
  EXPECT_EQ(tree("A --> s(1,1,1) B C --> D"), tree("A\n-->\ns(1,\n1,1)\nB\n\nC\n--> D\n"));
  EXPECT_EQ(tree("A --> B f(x) = x A --> C"), "rule A\n  B\nfunction f(x) = x\nrule A\n  C\n");
  EXPECT_EQ(tree("A --> B\r\nC --> D\r\n"), "rule A\n  B\nrule C\n  D\n");
}

TEST(Parser, rulesTakeParametersAndKeywords) {
  EXPECT_EQ(
      tree("A(x, t) --> B(x) start Init --> A(1,2) extension Roof(a) --> roofHip(a) E() --> X."),
      R"(rule A(x, t)
  B(x)
rule Init start
  A(1, 2)
rule Roof(a) extension
  roofHip(a)
rule E()
  X.
)");
}

TEST(Parser, keywordsAreNamesElsewhere) {
  EXPECT_EQ(tree("start Init --> start(20) Main --> rule.start start --> X. f(style) = style"),
            R"(rule Init start
  start(20)
rule Main
  rule.start
rule start
  X.
function f(style) = style
)");
}

TEST(Parser, bodiesMayBeEmpty) { EXPECT_EQ(tree("A --> B --> C"), "rule A\nrule B\n  C\n"); }

TEST(Parser, withBindsLocalVariables) {
  EXPECT_EQ(tree("attr a with ( x := \"e\" ) = x\nconst b with (x := [0,1,2] y := 0) = x[y]\n"
                 "f(a) with ( x := a y := x ) = y\nLot with ( x := f(1) ) --> extrude(x)\n"
                 "R(p) with( a := p ) --> X."),
            R"(attr a with (x := "e") = x
const b with (x := [0, 1, 2], y := 0) = x[y]
function f(a) with (x := a, y := x) = y
rule Lot with (x := f(1))
  extrude(x)
rule R(p) with (a := p)
  X.
)");
}

TEST(Parser, importsTakeStylesProtectionAndOverrides) {
  EXPECT_EQ(tree(R"(import a : "a.cga" import b (s1, s2) : "b.cga" import c : "c.cga" ( )
import d : "d.cga" ( h, w ) import e:"e.cga"( height = 20, Roof(x) --> roofHip(x) color(1,0,0),
  Column --> F.start, n ) import f : "f.cga" (a = 1
  b = 2) a.Lot --> a.Mass)"),
            R"(import a : "a.cga"
import b(s1, s2) : "b.cga"
import c : "c.cga" overrides
import d : "d.cga" overrides
  h
  w
import e : "e.cga" overrides
  height = 20
  rule Roof(x)
    roofHip(x)
    color(1, 0, 0)
  rule Column
    F.start
  n
import f : "f.cga" overrides
  a = 1
  b = 2
rule a.Lot
  a.Mass
)");
}

TEST(Parser, severalImportsAfterOneKeywordAreLegacy) {
  Parsed p("import a : \"a.cga\"\n@Hidden\nb : \"b.cga\" Lot --> a.X");
  EXPECT_EQ(p.problems(), "3:1 import-without-keyword (warning)\n");
  EXPECT_EQ(
      dump(p.tree),
      "file\n  import a : \"a.cga\"\n  import b : \"b.cga\" @Hidden()\n  rule Lot\n    a.X\n");
}

TEST(Parser, dynamicImportsAreSuccessors) {
  EXPECT_EQ(body("imp( height = h + rand(10), Roof --> X. ).Lot(3) imp( ).Lot B(2). C"),
            R"(imp(height = (h + rand(10)), Roof --> ...).Lot(3)
imp().Lot
B(2).
C
)");
  EXPECT_EQ(expression("imp(a = 1).f(2) + 1"), "(imp(a = 1).f(2) + 1)");
}

// --- Annotations ---

TEST(Parser, annotationsStandBeforeDeclarations) {
  EXPECT_EQ(tree(R"(@RuleFileDescription("A house") version "2020.0" @Hidden import a : "a.cga"
@Group("A","B",1) @Order(2) @Range(0, 10) attr a = 1 @Range("x","y") attr b = "x"
@Range(min=-1, max=1, stepsize=0.5, restricted=false) attr c = 0
@StartRule @Description("d") Lot --> X. @Hidden(p, q) style S)"),
            R"(@RuleFileDescription("A house")
version "2020.0"
import a : "a.cga" @Hidden()
attr a = 1 @Group("A", "B", 1) @Order(2) @Range(0, 10)
attr b = "x" @Range("x", "y")
attr c = 0 @Range(min = -(1), max = 1, stepsize = 0.5, restricted = false)
rule Lot @StartRule() @Description("d")
  X.
style S @Hidden(p, q)
)");
}

TEST(Parser, handlesTakeListsAndIndices) {
  EXPECT_EQ(tree("@Handle(shape=Solid^2, align=right, slip={inside, h}, translate={0,-1,0}, "
                 "color=\"#ff\") attr a = 1"),
            "attr a = 1 @Handle(shape = Solid[2], align = right, slip = {inside, h}, "
            "translate = {0, -(1), 0}, color = \"#ff\")\n");
}

TEST(Parser, malformedAnnotationsWarnOnly) {
  Parsed p("@Range(min= ,) @Order(1 2) @Color( attr a = 1 A --> X.");
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 3u) << p.messages();
  EXPECT_EQ(p.tree.children(p.tree.root()).size(), 2u);
}

// --- Successors ---

TEST(Parser, successorsAreASequence) {
  EXPECT_EQ(body("primitiveCube() Cube. [ t(0,'1,0) X. [ Y ] ] innerRect NIL primitiveCube [ Z ]"),
            R"(primitiveCube()
Cube.
push
  t(0, '(1), 0)
  X.
  push
    Y
innerRect
NIL
primitiveCube
push
  Z
)");
}

TEST(Parser, splitItemsHaveSizesGroupsAndRepeats) {
  EXPECT_EQ(body("split(x) { 1 : A | { ~2*w : B | '0.1 : C }* | ~a + b : D E. | { 3 : F } }* G"),
            R"(split(x)
  block *
    item 1 :
      A
    block *
      item ~((2 * w)) :
        B
      item '(0.1) :
        C
    item ~((a + b)) :
      D
      E.
    block
      item 3 :
        F
G
)");
}

TEST(Parser, relativeSizesTakeTheWholeExpression) {
  EXPECT_EQ(body("split(y) { '1/Resolution : Slice }* s('1, ' -0.5, 0)"),
            R"(split(y)
  block *
    item '((1 / Resolution)) :
      Slice
s('(1), '(-(0.5)), 0)
)");
}

TEST(Parser, compItemsHaveSelectorsAndOperators) {
  EXPECT_EQ(body("comp(f, noAlign) { front : A | back = B | top =: C. | 5 : D | world.up = NIL "
                 "| left || right : E | isTagged(\"x\", e) && !inside : F | all : G }"),
            R"(comp(f, noAlign)
  block
    item front :
      A
    item back =
      B
    item top =:
      C.
    item 5 :
      D
    item world.up =
      NIL
    item (left || right) :
      E
    item (isTagged("x", e) && !(inside)) :
      F
    item all :
      G
)");
}

TEST(Parser, perimeterItemsHaveTwoSizes) {
  EXPECT_EQ(body("splitAndSetbackPerimeter('0.1) { ~30 : rand(3, 15) : extrude(2) Y | '0.5 : 0 : "
                 "NIL }* { remainder : G }"),
            R"(splitAndSetbackPerimeter('(0.1))
  block *
    item ~(30) : rand(3, 15) :
      extrude(2)
      Y
    item '(0.5) : 0 :
      NIL
  block
    item remainder :
      G
)");
}

TEST(Parser, blocksOfOperationsHaveNoHeads) {
  EXPECT_EQ(body("scatter(surface, 10, uniform) { Leaf } union { A B | t(1,1,1) C } "
                 "inline { X Y } scatter(scope, 1, uniform) { case a : X else : Y }"),
            R"(scatter(surface, 10, uniform)
  block
    item
      Leaf
union
  block
    item
      A
      B
    item
      t(1, 1, 1)
      C
inline
  block
    item
      X
      Y
scatter(scope, 1, uniform)
  block
    item
      case
        a:
          X
        else:
          Y
)");
}

TEST(Parser, inlineAndBooleansTakeOneSuccessor) {
  EXPECT_EQ(body("inline Volumes Colorize inline(recompose) split(x) { 1 : A }* union B "
                 "subtract(swap) C(1) inline inline D"),
            R"(inline operand
  block
    item
      Volumes
Colorize
inline(recompose) operand
  block
    item
      split(x)
        block *
          item 1 :
            A
union operand
  block
    item
      B
subtract(swap) operand
  block
    item
      C(1)
inline operand
  block
    item
      inline operand
        block
          item
            D
)");
  // A rule of the file with that name is an ordinary rule.
  EXPECT_EQ(tree("A --> union B union --> X."), "rule A\n  union\n  B\nrule union\n  X.\n");
}

TEST(Parser, casesNest) {
  EXPECT_EQ(body("case a > 1 : X case b : case c : Y else : Z else : W V"),
            R"(case
  (a > 1):
    X
  b:
    case
      c:
        Y
      else:
        Z
  else:
    W
    V
)");
  EXPECT_EQ(body("case(scope.sx > a) : X else: case b : Y else : NIL"),
            R"(case
  (scope.sx > a):
    X
  else:
    case
      b:
        Y
      else:
        NIL
)");
}

TEST(Parser, weightsNest) {
  EXPECT_EQ(body("30% : A 20.5% : case x : B else : C p % : 50% : D else : E else : F"),
            R"(percent
  30:
    A
  20.5:
    case
      x:
        B
      else:
        C
  p:
    percent
      50:
        D
      else:
        E
  else:
    F
)");
  EXPECT_EQ(body("(1-q)*100% : A f(x)% : B 100*q % : C else : D"),
            R"(percent
  ((1 - q) * 100):
    A
  f(x):
    B
  (100 * q):
    C
  else:
    D
)");
}

TEST(Parser, choicesStandInBracketsAndBlocks) {
  EXPECT_EQ(body("s(1,1,1) [ case a : X else : Y ] split(x) { 1 : 50% : P else : Q | 2 : R }"),
            R"(s(1, 1, 1)
push
  case
    a:
      X
    else:
      Y
split(x)
  block
    item 1 :
      percent
        50:
          P
        else:
          Q
    item 2 :
      R
)");
}

TEST(Parser, choiceBehindOperationsWarns) {
  Parsed p("A --> s(1,1,1) case a : X else : Y");
  EXPECT_EQ(p.problems(), "1:16 choice-not-first (warning)\n");
}

TEST(Parser, casesOnOneLineEndWhereTheNextBegins) {
  EXPECT_EQ(tree("f(a,b) = case a : 1 case b : 2 else : 3 g = 4 A --> case a: X case b: Y else: Z"
                 " B --> C"),
            R"(function f(a, b) = case{a: 1 | b: 2 | else: 3}
function g = 4
rule A
  case
    a:
      X
    b:
      Y
    else:
      Z
rule B
  C
)");
}

// --- Expressions ---

TEST(Parser, operatorsBindAsUsual) {
  EXPECT_EQ(expression("a || b && c == d < e + f * g"), "(a || (b && (c == (d < (e + (f * g))))))");
  EXPECT_EQ(expression("a - b - c / d % e"), "((a - b) - ((c / d) % e))");
  EXPECT_EQ(expression("-a * !b + +c"), "((-(a) * !(b)) + +(c))");
  EXPECT_EQ(expression("(a + b) * c"), "((a + b) * c)");
  EXPECT_EQ(expression("a <= b != c >= d"), "((a <= b) != (c >= d))");
}

TEST(Parser, elementwiseOperatorsBindAsTheirPlainOnes) {
  EXPECT_EQ(expression("a .+ b .* c .== d .&& .!e"), "(((a .+ (b .* c)) .== d) .&& .!(e))");
  EXPECT_EQ(expression("a[ a .> 1 .&& a .<[2,3] ]"), "a[((a .> 1) .&& (a .< [2, 3]))]");
  EXPECT_EQ(expression("1.==x"), "(1 .== x)");
}

TEST(Parser, arraysRangesAndIndices) {
  EXPECT_EQ(expression("[1,2;3,4]"), "[1, 2; 3, 4]");
  EXPECT_EQ(expression("[0:2 ; 3, 3, 3]"), "[0:2; 3, 3, 3]");
  EXPECT_EQ(expression("[1 : 2 : 9]"), "[1:2:9]");
  EXPECT_EQ(expression("array2d[ 0:2 , [0,2] ][3]"), "array2d[0:2, [0, 2]][3]");
  EXPECT_EQ(expression("cells[[0;3]] + f(x)[n-1]"), "(cells[[0; 3]] + f(x)[(n - 1)])");
  EXPECT_EQ(expression("table[0 : nRows(table)-1, 0]"), "table[0:(nRows(table) - 1), 0]");
}

TEST(Parser, functionsMayChoose) {
  EXPECT_EQ(expression("case i == size(a) : x else : case a[i] > 1 : f(i+1) else : g(i)"),
            "case{(i == size(a)): x | else: case{(a[i] > 1): f((i + 1)) | else: g(i)}}");
  EXPECT_EQ(expression("33% : \"a\" 33% : \"b\" else : \"c\""),
            "percent{33: \"a\" | 33: \"b\" | else: \"c\"}");
  EXPECT_EQ(expression("50% : 1 50% : 2"), "percent{50: 1 | 50: 2}");
  EXPECT_EQ(expression("f(case a : 1 else : 2, 50% : 1 else : 3) + (case b : 1 else : 2)"),
            "(f(case{a: 1 | else: 2}, percent{50: 1 | else: 3}) + case{b: 1 | else: 2})");
  EXPECT_EQ(expression("a % 2"), "(a % 2)");
}

TEST(Parser, compIsAFunctionToo) {
  EXPECT_EQ(expression("comp(fe) { inside = 0 | front : case comp.index == 0 : 4 else : 5 | "
                       "back = str(comp.index) }[0]"),
            "comp(fe){inside = 0 | front : case{(comp.index == 0): 4 | else: 5} | "
            "back = str(comp.index)}[0]");
  EXPECT_EQ(body("setback( comp(fe) { front=w | left=v } ) { shape = X. }"),
            "setback(comp(fe){front = w | left = v})\n  block\n    item shape =\n      X.\n");
}

TEST(Parser, parametersOfSizeInCallsKeepTheirPrefix) {
  EXPECT_EQ(body("setupProjection(0, scope.xy, ~2, '1, 0, '-0.5) tileUV(0, ~w+1, 0)"),
            "setupProjection(0, scope.xy, ~(2), '(1), 0, '(-(0.5)))\ntileUV(0, ~((w + 1)), 0)\n");
}

// --- Forms of old files ---

TEST(Parser, takesOldForms) {
  EXPECT_EQ(tree(R"(# comment
attr streetWidth(edge) = 0
Lot --> innerRect extrude(world.y, 10) alignScopeToGeometry(zUp, auto) setback(2) {
  streetSide : A | noStreetSide = B } i("builtin:cube:notex") offsetUV(0, 1, 1) setupUV(0, 1)
  set(material.color.a, 0.3) Facade
Facade --> case geometry.isOriented(front) : comp(f){ top=roofHip(30) | side=Facade }
  else : i(fileRandom("*.obj"))
i --> x("a")
x(a) --> t(1,2,3))"),
            R"(attr streetWidth(edge) = 0
rule Lot
  innerRect
  extrude(world.y, 10)
  alignScopeToGeometry(zUp, auto)
  setback(2)
    block
      item streetSide :
        A
      item noStreetSide =
        B
  i("builtin:cube:notex")
  offsetUV(0, 1, 1)
  setupUV(0, 1)
  set(material.color.a, 0.3)
  Facade
rule Facade
  case
    geometry.isOriented(front):
      comp(f)
        block
          item top =
            roofHip(30)
          item side =
            Facade
    else:
      i(fileRandom("*.obj"))
rule i
  x("a")
rule x(a)
  t(1, 2, 3)
)");
}

}  // namespace
}  // namespace gable::lang
