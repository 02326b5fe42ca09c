// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/sema/analyse.h"

#include <gtest/gtest.h>

#include "lang/sema/testing_analysed.h"

namespace gable::lang {
namespace {

#define EXPECT_CLEAN(a) EXPECT_EQ((a).problems(), "") << (a).messages()

// --- Names ---

TEST(Analyse, tellsOperationsRulesAndLeavesApart) {
  const Analysed a(
      "Lot --> extrude(3) Mass Mass(2) Gone. NIL\nMass --> X.\nMass(h) --> extrude(h)");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("extrude"), "op:extrude/0 op:extrude/0");
  EXPECT_EQ(a.meaning("Mass"), "rule:Mass@0 rule:Mass@0");
  EXPECT_EQ(a.meaning("Gone"), "leaf");
  EXPECT_EQ(a.meaning("NIL"), "op:NIL/0");
  EXPECT_EQ(a.program.startRule, a.rule("Lot").id);
}

TEST(Analyse, undefinedNamesAreLeavesUnlessTheyAreSlipsOfAnOperation) {
  const Analysed a("Lot --> extrud(3) Mas\nMass --> X.\nA(x) --> X. B --> A");
  EXPECT_EQ(a.problems(),
            "1:9 unknown-operation\n1:19 undefined-rule (warning)\n"
            "3:19 undefined-rule (warning)\n");
  EXPECT_EQ(a.hint(0), "did you mean 'extrude'?");
  EXPECT_EQ(a.hint(1), "did you mean 'Mass'?");
  EXPECT_EQ(a.meaning("extrud"), "leaf");
}

TEST(Analyse, rulesMayBeNamedLikeOperationsWithOtherParameters) {
  const Analysed a("Lot --> i(\"a\") i i(1,2)\ni --> X.\ni(a,b) --> X. s --> X.");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("i"), "op:i/0 rule:i@0 rule:i@0");
}

TEST(Analyse, softNamesGiveWayToTheAuthors) {
  const Analysed a("A --> grid(2) { region : X. } grid repeat(3) { X. }");
  EXPECT_EQ(a.problems(), "1:31 undefined-rule (warning)\n");
  EXPECT_EQ(a.meaning("grid"), "op:grid/0 leaf");
  EXPECT_EQ(a.meaning("region"), "selector");
  const Analysed b("A --> grid(2) repeat\ngrid(x) --> X. repeat --> X.");
  EXPECT_CLEAN(b);
  EXPECT_EQ(b.meaning("grid"), "rule:grid@0");
  EXPECT_EQ(b.meaning("repeat"), "rule:repeat@0");
}

TEST(Analyse, expressionsSeeParametersThenTheFileThenBuiltIns) {
  const Analysed a(
      "attr h = 1 const c = 2 f = 3 g(x) = x\n"
      "Lot(h) with (w := h) --> extrude(h + w + c + f + g(1)) t(scope.sx, rand, 0)\n"
      "B(t) --> t(t, 0, 0)\nC --> extrude(h)");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("h"), "slot:0 slot:0 attr:h@0");
  EXPECT_EQ(a.meaning("w"), "slot:1");
  EXPECT_EQ(a.meaning("c"), "attr:c@0");
  EXPECT_EQ(a.meaning("f"), "function:f@0");
  EXPECT_EQ(a.meaning("g"), "function:g@0");
  EXPECT_EQ(a.meaning("scope.sx"), "shape:scope.sx");
  EXPECT_EQ(a.meaning("rand"), "builtin:rand/0");
  EXPECT_EQ(a.meaning("t"), "op:t/0 op:t/0 slot:0");
  EXPECT_EQ(a.rule("Lot", 1).slotCount, 2u);
}

TEST(Analyse, unknownNamesAreErrorsWithAHint) {
  const Analysed a(
      "attr height = 3\nLot --> extrude(heigth) extrude(geometry.aera) extrude(ran(2))"
      " extrude(zzz) extrude(geometry.isOriented)");
  EXPECT_EQ(a.problems(),
            "2:17 unknown-name\n2:33 unknown-name\n2:56 unknown-function\n"
            "2:72 unknown-name\n2:85 wrong-argument-count\n");
  EXPECT_EQ(a.hint(0), "did you mean 'height'?");
  EXPECT_EQ(a.hint(1), "did you mean 'geometry.area'?");
  EXPECT_EQ(a.hint(2), "did you mean 'rand'?");
}

TEST(Analyse, ownFunctionsWinOverBuiltIns) {
  const Analysed a("min(a, b) = case a < b : a else : b\nx = min(1, 2) y = min(1, 2, 3)");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("min"), "function:min@0 builtin:min/0");
}

TEST(Analyse, oneMistakeGivesOneMessage) {
  const Analysed a(
      "import i : \"gone.cga\"\nA --> scater(surface, '2, 3) { A } s(1, unitSpace) f(word, ~3)"
      " set(i.x, 1) extrude(i.y + i.f(1)) i.R extrude(g(uv, 0))");
  EXPECT_EQ(a.problems(),
            "1:12 import-not-found (warning)\n2:30 unexpected-block\n2:36 wrong-argument-count\n"
            "2:52 undefined-rule (warning)\n2:110 unknown-function\n");
  EXPECT_EQ(a.hint(1), "did you mean 'scatter'?");
}

TEST(Analyse, messagesAreBounded) {
  std::string text = "A -->";
  for (int i = 0; i < 3000; ++i) text += " extrude(x) B";
  const Analysed a(text);
  EXPECT_EQ(a.diagnostics.errorCount(), 1001u);
  EXPECT_EQ(a.diagnostics.all().size(), 2001u);
}

// --- Selectors ---

TEST(Analyse, wordsAreSelectorsWhereOneIsAskedFor) {
  const Analysed a(
      "attr x = 5 attr top = 1\nLot(y) --> split(x) { x : A. } split(y, noAdjust) { ~y : A. }"
      " comp(f) { top : A. | front || !inside = A. | y : A. | geometry.area > x : A. }"
      " extrude(world.up, x) split(u, unitSpace, 0) { 1 : A. }");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("x"), "selector attr:x@0 attr:x@0 attr:x@0");
  EXPECT_EQ(a.meaning("y"), "selector slot:0 slot:0");
  EXPECT_EQ(a.meaning("top"), "selector");
  EXPECT_EQ(a.meaning("split"), "op:split/0 op:split/0 op:split/1");
}

TEST(Analyse, unknownSelectorsAreErrors) {
  const Analysed a(
      "A --> split(w) { 1 : X. } comp(g) { all : X. } extrude(world.upp, 1)"
      " comp(f) { tpo : X. }");
  EXPECT_EQ(a.problems(),
            "1:13 unknown-selector\n1:32 unknown-selector\n1:56 unknown-selector\n"
            "1:80 unknown-selector\n");
  EXPECT_EQ(a.hint(2), "did you mean 'world.up'?");
}

TEST(Analyse, setTakesAttributesAsPlaces) {
  const Analysed a(
      "attr h = 1 const c = 2\nA --> set(h, 2) set(material.color.r, 0.5)"
      " set(c, 1) set(scope.sx, 1) set(heigth, 3) set(h, \"x\") set(h)");
  EXPECT_EQ(a.problems(),
            "2:48 not-settable\n2:58 not-settable\n2:75 unknown-attribute\n"
            "2:93 type-mismatch\n2:98 wrong-argument-count\n");
  EXPECT_EQ(a.meaning("h"), "attr:h@0 attr:h@0 attr:h@0");
  EXPECT_EQ(a.meaning("material.color.r"), "shape:material.color.r");
}

// --- Arguments and types ---

TEST(Analyse, countsOfArgumentsAreChecked) {
  const Analysed a("A --> s(1,2) extrude() rand(1) extrude(rand(1,2,3)) color(1,2)");
  EXPECT_EQ(a.problems(),
            "1:7 wrong-argument-count\n1:14 wrong-argument-count\n"
            "1:24 undefined-rule (warning)\n1:40 wrong-argument-count\n"
            "1:53 wrong-argument-count\n");
  EXPECT_NE(a.messages().find("'extrude' takes 1 or 2 arguments, not 0"), std::string::npos);
  EXPECT_NE(a.messages().find("'color' takes 1 or 3 arguments, not 2"), std::string::npos);
}

TEST(Analyse, typesOfArgumentsAreChecked) {
  const Analysed a(
      "attr t1 = \"a\" f(x) = x + 1 g(x) = str(x)\n"
      "A --> extrude(\"3\") extrude(t1) color(3) i(true) extrude(g(1)) extrude([1])"
      " setback([1,2]) { all : X. }");
  EXPECT_EQ(a.problems(),
            "2:15 type-mismatch\n2:28 type-mismatch\n2:38 type-mismatch\n"
            "2:43 type-mismatch\n2:57 type-mismatch\n2:71 type-mismatch\n")
      << a.messages();
  EXPECT_EQ(a.meaning("setback"), "op:setback/1");
}

TEST(Analyse, typesAreInferredThroughCalls) {
  const Analysed a(
      "A(x) --> B(x) B(y) --> extrude(y) C(n) --> i(n)\n"
      "f(a) = g(a) g(b) = b * 2 h = f(1) r(n) = case n > 0 : r(n-1) else : \"done\"\n"
      "attr p = h attr m = min(p, 2) attr q = r(3) attr list = [1,2;3,4] const e = comp(f) { all : "
      "scope.sx }");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.rule("A", 1).paramTypes[0], ValueType::Float);
  EXPECT_EQ(a.rule("C", 1).paramTypes[0], ValueType::String);
  EXPECT_EQ(a.function("f").paramTypes[0], ValueType::Float);
  EXPECT_EQ(a.attribute("p").type, ValueType::Float);
  EXPECT_EQ(a.attribute("m").type, ValueType::Float);
  EXPECT_EQ(a.attribute("q").type, ValueType::String);
  EXPECT_EQ(a.attribute("list").type, ValueType::FloatArray);
  EXPECT_EQ(a.attribute("e").type, ValueType::FloatArray);
}

// A round settles one of them, and what hangs on it is looked at again: rules of importers, and
// rules that call what an importer has put in the place of another.
TEST(Analyse, typesAreInferredThroughImportsAndReplacedRules) {
  const Analysed a(
      "import i : \"i.cga\" import k : \"k.cga\"\n"
      "A(x) --> i.B(x)\n"
      "G(x) --> k.E(x)\n"
      "k.Put(x) --> Later(x)\n"
      "Later(x) --> Last(x)\n"
      "Last(x) --> extrude(x)",
      {{"i.cga", "import j : \"j.cga\"\nB(x) --> j.C(x)"},
       {"k.cga", "E(x) --> Put(x)"},
       {"j.cga", "C(x) --> D(x)\nD(x) --> F(x)\nF(x) --> extrude(x)"}});
  EXPECT_CLEAN(a);
  for (const char* name : {"A", "i.B", "i.j.C", "G", "k.E", "Later"}) {
    EXPECT_EQ(a.rule(name, 1).paramTypes[0], ValueType::Float) << name;
  }
}

TEST(Analyse, overloadsAreChosenByCountAndType) {
  const Analysed a(
      "A(x) --> extrude(x) A(n) --> i(n) A(x, y) --> X.\n"
      "B --> A(1) C C --> A(\"a\") D D --> A(1, 2)\n");
  EXPECT_CLEAN(a);
  std::vector<size_t> sites;
  const Tree& t = a.program.tree(0);
  for (NodeId id = 1; id < t.size(); ++id) {
    const Resolution& r = a.program.modules[0].at(id);
    if (r.kind == RefKind::Rule && t.text(id) == "A") {
      sites.push_back(t.span(a.program.rules[r.index].node).begin);
    }
  }
  EXPECT_EQ(sites, (std::vector<size_t>{0, 20, 34}));
}

TEST(Analyse, sizesWithPrefixStandOnlyWhereTheyMay) {
  const Analysed a(
      "A(x) --> s('1,'0.5,0) A('1) extrude('2) s(~1,0,0) split(x) { '0.5 : X. | ~1 : X. }");
  EXPECT_EQ(a.problems(),
            "1:23 endless-rule (warning)\n1:25 bad-prefix\n1:37 bad-prefix\n1:43 bad-prefix\n");
}

TEST(Analyse, comparisonsAndOperatorsCheckTypes) {
  const Analysed a(
      "a = 1 == \"1\" b = true + 1 c = \"x\" - 1 d = !3 e = \"n\" + 1 + true f = 1 && true\n"
      "g = case 1 : 2 else : 3 h = case true : 1 else : \"x\" k = [1, \"a\"] l = 5[0]");
  EXPECT_EQ(a.problems(),
            "1:5 type-mismatch\n1:18 type-mismatch\n1:31 type-mismatch\n1:44 type-mismatch\n"
            "1:69 type-mismatch\n2:10 type-mismatch\n2:50 type-mismatch\n"
            "2:62 type-mismatch\n2:72 unexpected-token\n");
}

// --- Blocks ---

TEST(Analyse, blocksAreCheckedByKind) {
  const Analysed a(
      "A --> extrude(1) { X. } split(x) comp(f) { A } split(x) { A } scatter(scope, 3) { 1 : A }"
      " comp(f) { all : A }* union { A } split(x) { 1 = A } comp(f) { { all : A } }"
      " scatter(scope, 1) { A | A } B { X. } inline { A }");
  EXPECT_EQ(a.problems(),
            "1:18 unexpected-block\n1:25 missing-block\n1:44 missing-selector\n1:59 missing-size "
            "(warning)\n"
            "1:83 unexpected-head\n1:99 unexpected-repeat\n1:118 wrong-operand-count\n"
            "1:135 bad-separator\n1:153 unexpected-group\n1:185 unexpected-separator\n"
            "1:197 unexpected-block\n");
}

TEST(Analyse, percentagesAreNoSizes) {
  const Analysed a(
      "A --> split(x) { 25% : B. | 75% : C. } B --> split(y) { 50% : B. 50% : C. | 2 : B. }");
  ASSERT_EQ(a.problems(), "1:18 missing-size\n1:29 missing-size\n1:57 missing-size (warning)\n");
  EXPECT_EQ(a.diagnostics.all()[0].hint,
            "write a share of the scope's size with a quote before it: '0.25");
}

TEST(Analyse, weightsMustAddUp) {
  const Analysed a(
      "A --> 50% : A 50% : NIL B --> 60% : A 50% : NIL else : A C --> 30% : A 20% : NIL"
      " f = 50% : 1 else : 2 g = 10% : 1");
  EXPECT_EQ(a.problems(),
            "1:31 weights-over-100 (warning)\n1:64 missing-else\n1:107 missing-else\n");
}

TEST(Analyse, operationsBehindTheLastRuleAreTold) {
  const Analysed a(
      "A --> extrude(1) B extrude(3) t(0, 1, 0)\n"
      "B --> case geometry.area > 1 : X. extrude(2) else : [ X. t(1, 0, 0) ] Y.\n"
      "C --> A t(0, 1, 0) B\n"
      "D --> X. t(0, 1, 0) comp(f) { all : X. } E --> t(1, 0, 0)\n"
      "F --> comp(f) { all : X. } t(1, 0, 0)");
  EXPECT_EQ(a.problems(),
            "1:20 unused-operation (warning)\n2:35 unused-operation (warning)\n"
            "2:58 unused-operation (warning)\n5:28 unused-operation (warning)\n");
  // What runs in place leaves its shape changed.
  EXPECT_CLEAN(Analysed("A --> do(B) X. B --> X. t(1, 0, 0)"));
}

TEST(Analyse, additionsRunRulesInPlace) {
  const Analysed a(
      "attr n = 1 A --> do(B(2)) do(C) local(n = 3) { B(n) } B(x) --> extrude(x) C --> X.");
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("B"), "rule:B@0 rule:B@0");
  EXPECT_EQ(a.meaning("C"), "rule:C@0");
  EXPECT_EQ(a.meaning("n"), "attr:n@0 attr:n@0");
}

// --- Imports ---

TEST(Analyse, importedNamesHaveAPrefix) {
  const Analysed a(
      "import imp : \"imp.cga\"\nLot --> imp.Lot extrude(imp.h + imp.f(2)) imp.Gone set(imp.h, 3)",
      {{"imp.cga", "attr h = 10 f(x) = x Lot --> extrude(h) Lot2 Lot2 --> X."}});
  EXPECT_EQ(a.problems(), "2:43 undefined-rule (warning)\n");
  EXPECT_EQ(a.meaning("imp.Lot"), "rule:imp.Lot@1");
  EXPECT_EQ(a.meaning("imp.h"), "attr:imp.h@1 attr:imp.h@1");
  EXPECT_EQ(a.meaning("imp.f"), "function:imp.f@1");
  EXPECT_EQ(a.meaning("h", 1), "attr:imp.h@1");
  EXPECT_EQ(a.meaning("Lot2", 1), "rule:imp.Lot2@1");
}

TEST(Analyse, oneFileImportedTwiceIsTwoModules) {
  const Analysed a("import p : \"i.cga\" (h = 2) import q : \"i.cga\"\nLot --> p.Lot q.Lot",
                   {{"i.cga", "attr h = 1 Lot --> extrude(h)"}});
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.program.units.size(), 2u);
  EXPECT_EQ(a.program.modules.size(), 3u);
  EXPECT_EQ(a.attribute("p.h").source, ValueSource::Override);
  EXPECT_EQ(a.attribute("q.h").source, ValueSource::Own);
  EXPECT_EQ(a.meaning("p.Lot") + " " + a.meaning("q.Lot"), "rule:p.Lot@1 rule:q.Lot@2");
}

TEST(Analyse, attributesOfTheSameNamePropagateUnlessProtected) {
  const std::map<std::string, std::string> files = {
      {"i.cga", "attr h = 1 attr w = 2 attr s = 3 Lot --> X."}};
  const char* const rest = "\nattr h = 5 attr w = 6 attr s = \"text\"";
  const Analysed a(std::string("import i : \"i.cga\"") + rest, files);
  EXPECT_EQ(a.attribute("i.h").source, ValueSource::Propagated);
  EXPECT_EQ(a.attribute("i.h").from, a.attribute("h").id);
  EXPECT_EQ(a.attribute("i.s").source, ValueSource::Own);
  EXPECT_EQ(a.problems(), "2:28 propagation-type (warning)\n");
  const Analysed b(std::string("import i : \"i.cga\" (h, s)") + rest, files);
  EXPECT_CLEAN(b);
  EXPECT_EQ(b.attribute("i.h").source, ValueSource::Own);
  EXPECT_EQ(b.attribute("i.w").source, ValueSource::Propagated);
  const Analysed c(std::string("import i : \"i.cga\" ()") + rest, files);
  EXPECT_EQ(c.attribute("i.w").source, ValueSource::Own);
  const Analysed d(std::string("import i : \"i.cga\" (h = 9, s)") + rest, files);
  EXPECT_EQ(d.attribute("i.h").source, ValueSource::Override);
  EXPECT_EQ(d.attribute("i.w").source, ValueSource::Propagated);
}

TEST(Analyse, replacementsMayReadWhatTheyReplace) {
  const Analysed a("import i : \"i.cga\" (w = i.w * 2)\nattr h = i.h + 1",
                   {{"i.cga", "attr h = 1 attr w = 2"}});
  EXPECT_CLEAN(a);
  // The value read is the attribute's own, kept beside it.
  EXPECT_EQ(a.program.attributes.size(), 5u);
  EXPECT_EQ(a.program.initOrder.size(), 5u);
}

TEST(Analyse, importersRedefineRules) {
  const Analysed a(
      "import i : \"i.cga\"\nLot --> i.Lot\ni.Window --> extrude(3) Frame\nFrame --> X.",
      {{"i.cga", "Lot --> Window Door Window --> X. Door --> X."}});
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("Window", 1), "rule:i.Window@0");
  EXPECT_EQ(a.meaning("Door", 1), "rule:i.Door@1");
  EXPECT_EQ(a.meaning("Frame"), "rule:Frame@0");
}

TEST(Analyse, extensionsAreReplacedInTheScopeOfTheImporter) {
  const Analysed a(
      "import i : \"i.cga\" ( Roof(x) --> extrude(x) Mine )\nMine --> 50% : i.start else : X.",
      {{"i.cga", "start Init --> Roof(2) Plain extension Roof(a) --> X. Plain --> X."}});
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.meaning("Roof", 1), "rule:i.Roof@0");
  EXPECT_EQ(a.meaning("Mine"), "rule:Mine@0");
  EXPECT_EQ(a.meaning("i.start"), "rule:i.Init@1");
  const Analysed b("import i : \"i.cga\" ( Plian --> X. )", {{"i.cga", "Plain --> X."}});
  EXPECT_EQ(b.problems(), "1:22 not-an-extension\n");
}

TEST(Analyse, dynamicImportsMakeModulesOfTheirOwn) {
  const Analysed a(
      "import i : \"i.cga\" ( h = 3, Roof --> X. )\nLot(w) --> i( h = w + 1 ).Lot i( ).Lot",
      {{"i.cga",
        "attr h = 10 attr a = h * 2 Lot --> extrude(a) Roof extension Roof --> extrude(1)"}});
  EXPECT_CLEAN(a);
  ASSERT_EQ(a.program.dynamicImports.size(), 2u);
  const DynamicImport& first = a.program.dynamicImports[0];
  ASSERT_EQ(first.given.size(), 1u);
  EXPECT_EQ(a.program.attributes[first.given[0].attribute].source, ValueSource::Given);
  ASSERT_EQ(first.initOrder.size(), 1u);
  EXPECT_EQ(a.program.attributes[first.initOrder[0]].name, "a");
  EXPECT_EQ(a.program.dynamicImports[1].given.size(), 0u);
  EXPECT_EQ(a.program.dynamicImports[1].initOrder.size(), 2u);
  EXPECT_EQ(a.meaning("Lot"), "rule:i.Lot@2 rule:i.Lot@3");
  EXPECT_EQ(a.meaning("Roof", first.target), "rule:i.Roof@0");
  EXPECT_EQ(a.meaning("w"), "slot:0");
  // Static attributes only.
  EXPECT_EQ(a.program.initOrder.size(), 2u);
}

TEST(Analyse, mistakesInImportsAreReported) {
  const Analysed a(
      "import a : \"gone.cga\" import b : \"b.cga\" (x, y = 1, y = 2) import b : \"b.cga\"\n"
      "import c (nostyle) : \"b.cga\" Lot --> d(h = 1).Lot a.Lot",
      {{"b.cga", "attr y = 2 A --> extrude(\"a\")"}});
  EXPECT_EQ(a.problems(),
            "1:12 import-not-found (warning)\n1:43 unknown-attribute\n1:53 duplicate-override\n"
            "1:67 duplicate-import\n2:11 unknown-style\n2:38 unknown-import\n"
            "b.cga:1:26 type-mismatch\n")
      << a.messages();
}

TEST(Analyse, goesOnWithoutMissingImports) {
  const Analysed a(
      "import a : \"gone.cga\" import b : \"gone.cga\" (h = 1) import c : \"c.cga\"\n"
      "attr x = a.h + 1\n"
      "Lot --> extrude(x) comp(f) { top : a.Roof | side : b.Wall(a.f(2)) } a.x.Y set(a.h, 2) c.Lot",
      {{"c.cga", "import a : \"gone.cga\" Lot --> a.Lot"}});
  EXPECT_EQ(a.problems(), "1:12 import-not-found (warning)\n");
  EXPECT_EQ(a.diagnostics.errorCount(), 0u);
}

TEST(Analyse, filesOfTheVisualEditorAreNamed) {
  const Analysed a("import a : \"design.vcga\" Lot --> a.Lot");
  EXPECT_EQ(a.problems(), "1:12 visual-cga (warning)\n");
}

TEST(Analyse, extensionsFallBackToWhatTheyReplace) {
  const Analysed a(
      "import i : \"i.cga\" (Roof --> Mine) extension Mine --> i.Roof Lot --> i.Lot i.Roof",
      {{"i.cga", "extension Roof --> X. Lot --> Roof"}});
  EXPECT_CLEAN(a);
  std::vector<std::string> called;
  for (const lang::Module& m : a.program.modules) {
    const Tree& t = a.program.tree(m.id);
    for (NodeId id = 1; id < t.size(); ++id) {
      if (m.at(id).kind != RefKind::Rule || t.text(id).find("Roof") == std::string::npos) continue;
      const RuleInfo& r = a.program.rules[m.at(id).index];
      called.push_back(std::to_string(m.id) + " " + std::to_string(r.module));
    }
  }
  // `i.Roof` of Mine, `i.Roof` of Lot and `Roof` of the import.
  EXPECT_EQ(called, (std::vector<std::string>{"0 1", "0 0", "1 0"}));
}

TEST(Analyse, cyclesOfImportsEnd) {
  const Analysed a("import b : \"b.cga\" Lot --> b.Lot",
                   {{"main.cga", ""},
                    {"b.cga", "import c : \"c.cga\" Lot --> c.Lot"},
                    {"c.cga", "import m : \"main.cga\" import b : \"b.cga\" Lot --> m.Lot b.Lot"}});
  EXPECT_EQ(a.diagnostics.errorCount(), 2u) << a.messages();
  EXPECT_NE(a.problems().find("c.cga:1:12 import-cycle"), std::string::npos);
}

TEST(Analyse, exponentialImportsAreBounded) {
  std::map<std::string, std::string> files;
  for (int i = 0; i < 30; ++i) {
    const std::string next = "\"f" + std::to_string(i + 1) + ".cga\"";
    files["f" + std::to_string(i) + ".cga"] = "import a : " + next + " import b : " + next;
  }
  files["f30.cga"] = "Lot --> X.";
  const Analysed a("import a : \"f0.cga\" Lot --> a.Lot", files);
  EXPECT_TRUE(a.diagnostics.hasErrors());
  EXPECT_LE(a.program.modules.size(), 2000u);
}

// --- Styles ---

TEST(Analyse, stylesRedefine) {
  const std::string text =
      "attr h = 1 Lot --> A B A --> extrude(h) B --> X.\n"
      "style S attr h = 2 A --> s(h,h,h)\nstyle T extends S B --> extrude(h)";
  const Analysed a(text);
  EXPECT_CLEAN(a);
  EXPECT_EQ(a.program.styles.size(), 3u);
  const auto line = [&](const Analysed& p, NodeId node) {
    return p.sources.locate(0, p.program.tree(0).span(node).begin).line;
  };
  EXPECT_EQ(line(a, a.rule("A").node), 1u);
  const Analysed s(text, {}, "S");
  EXPECT_EQ(line(s, s.rule("A").node), 2u);
  EXPECT_EQ(line(s, s.attribute("h").node), 2u);
  EXPECT_EQ(line(s, s.rule("B").node), 1u);
  const Analysed t(text, {}, "T");
  EXPECT_EQ(line(t, t.rule("A").node), 2u);
  EXPECT_EQ(line(t, t.rule("B").node), 3u);
  const Analysed u(text, {}, "Nope");
  EXPECT_EQ(u.problems(), "unknown-style\n");
}

TEST(Analyse, importsTakeAStyle) {
  const Analysed a("import i(S) : \"i.cga\" Lot --> i.Lot",
                   {{"i.cga", "Lot --> extrude(1)\nstyle S\nLot --> extrude(2)"}});
  EXPECT_CLEAN(a);
  const RuleInfo& r = a.rule("i.Lot");
  EXPECT_EQ(a.sources.locate(1, a.program.tree(r.module).span(r.node).begin).line, 3u);
}

TEST(Analyse, stylesOfImportsCanBeChosen) {
  const std::map<std::string, std::string> files{
      {"i.cga", "Lot --> extrude(1)\nstyle S\nLot --> extrude(2)\nstyle T\nLot --> extrude(3)"}};
  const std::string text = "import i(S, T) : \"i.cga\" Lot --> i.Lot\nstyle Own Lot --> X. i.Lot";
  const auto line = [&](const Analysed& a) {
    const RuleInfo& r = a.rule("i.Lot");
    return a.sources.locate(1, a.program.tree(r.module).span(r.node).begin).line;
  };
  EXPECT_EQ(line(Analysed(text, files)), 3u);
  const Analysed t(text, files, "Own, i.T");
  EXPECT_CLEAN(t);
  EXPECT_EQ(line(t), 5u);
  EXPECT_EQ(t.program.modules[0].style, "Own");
  ASSERT_EQ(t.program.styles.size(), 4u);
  EXPECT_EQ(t.program.styles[3].name, "i.T");
  EXPECT_EQ(Analysed(text, files, "i.Default").problems(), "1:8 unknown-style\n");
  const Analysed none(text, files, "j.T");
  EXPECT_EQ(none.problems(), "unknown-style\n");
  EXPECT_EQ(none.hint(0), "it has the import 'i'");
}

TEST(Analyse, otherStylesAreCheckedToo) {
  const Analysed a(
      "Lot --> Only\nstyle S\nLot --> extrude(\"x\") Only\nOnly --> X.\n"
      "style T extends U\nstyle A extends B style B extends A style S");
  EXPECT_EQ(a.problems(),
            "3:17 type-mismatch\n5:17 unknown-style\n6:17 style-cycle\n"
            "6:35 style-cycle\n6:43 duplicate-style\n")
      << a.messages();
}

// --- Definitions ---

TEST(Analyse, duplicatesAreErrors) {
  const Analysed a(
      "attr a = 1 attr a = 2 const a = 3 a = 4\nR --> X. R --> X. R(x) --> X. R(y) --> X.\n"
      "f(x) = 1 f(y) = 2 g(x, x) = 1");
  EXPECT_EQ(a.problems(),
            "1:17 duplicate-name\n1:29 duplicate-name\n1:35 duplicate-name\n"
            "2:10 duplicate-rule\n2:31 duplicate-rule\n3:10 duplicate-name\n"
            "3:24 duplicate-parameter\n");
}

TEST(Analyse, attributesAreOrderedByWhatTheyRead) {
  const Analysed a("attr a = f(1) f(x) = b + x attr b = c const c = 3 attr d = a");
  EXPECT_CLEAN(a);
  std::string order;
  for (const AttributeId id : a.program.initOrder) order += a.program.attributes[id].name;
  EXPECT_EQ(order, "cbad");
}

TEST(Analyse, circlesThatAreSureAreWarnings) {
  const Analysed a(
      "attr a = b attr b = f f = a + 1 g(x) = case x > 0 : g(x-1) else : 0 attr c = g(3)");
  EXPECT_EQ(a.problems(), "1:6 definition-cycle (warning)\n");
  const Analysed unsure("attr a = case b : 1 else : c attr b = true && d attr c = a attr d = b");
  EXPECT_EQ(unsure.problems(), "");
}

TEST(Analyse, constantsAreFolded) {
  const Analysed a(
      "const w = 2 * (3 + 4) - 1 const v = w / 2 attr s = \"a\" + \"b\" attr b = 1 < 2 && !false\n"
      "attr n = rand(1) attr z = 1 / 0");
  EXPECT_CLEAN(a);
  const auto constant = [&](const char* name) {
    return a.program.modules[0].constantAt(a.attribute(name).valueNode);
  };
  EXPECT_EQ(constant("w").number, 13);
  EXPECT_EQ(constant("v").number, 6.5);
  EXPECT_EQ(a.values.text(constant("s").id), "ab");
  EXPECT_TRUE(constant("b").truth());
  EXPECT_EQ(constant("n").type, ValueType::Null);
  EXPECT_EQ(constant("z").type, ValueType::Null);
}

TEST(Analyse, namesOfTheFirstGrammarsAreExplained) {
  const Analysed block(R"(Lot --> Subdiv("y", 3, 4) { A | B })");
  EXPECT_NE(block.hint(0).find("split(y) {"), std::string::npos) << block.hint(0);
  const Analysed plain("Lot --> Rx(45)");
  EXPECT_EQ(plain.hint(0), "in CGA it is 'r(angle, 0, 0)'");
}

TEST(Analyse, slipsOfCapitalsNameTheOperation) {
  const Analysed plain("Lot --> T(0, 1, 0)");
  EXPECT_EQ(plain.problems(), "1:9 unknown-operation\n");
  EXPECT_EQ(plain.hint(0), "did you mean 't'?");
  const Analysed versioned("version \"2025.1\" Lot --> T(0, 1, 0)");
  EXPECT_EQ(versioned.problems(), "1:26 undefined-rule (warning)\n");
  EXPECT_EQ(versioned.hint(0), "did you mean 't'?");
  const Analysed small("version \"2025.1\" Lot --> extrud(3) X.");
  EXPECT_EQ(small.problems(), "1:26 unknown-operation\n");
  EXPECT_EQ(small.hint(0), "did you mean 'extrude'?");
}

TEST(Analyse, valuesThatTheirEnumLeavesOutHaveTheNearest) {
  const Analysed a(R"(@Enum("low", "high") attr lod = "hihg" Lot --> X.)");
  EXPECT_EQ(a.problems(), "1:33 attribute-outside (warning)\n");
  EXPECT_EQ(a.hint(0), "did you mean 'high'?");
}

TEST(Analyse, startRules) {
  EXPECT_EQ(Analysed("A(x) --> X. B --> X. C --> X.").program.startRule, 1u);
  EXPECT_EQ(Analysed("A --> X. @StartRule B --> X. @StartRule C --> X.").program.startRule, 1u);
  EXPECT_EQ(Analysed("A --> X. start B --> X.").program.startRule, 1u);
  EXPECT_EQ(Analysed("A(x) --> X.").program.startRule, kNone);
}

TEST(Analyse, edgeMapsTakeOneParameter) {
  const Analysed a("attr streetWidth(edge) = 0 attr bad(a, b) = 1 A --> extrude(streetWidth(2))");
  EXPECT_EQ(a.problems(), "1:33 bad-parameters\n");
  EXPECT_TRUE(a.attribute("streetWidth").edgeMap);
}

// --- Annotations ---

TEST(Analyse, stylesKeepTheAnnotationsOfWhatTheyChange) {
  const char* text =
      "@Group(\"Size\", 1) @Range(min=1, max=9) @Order(3) attr h = 3 "
      "@Group(\"Look\") @Enum(\"a\", \"b\") @Description(\"Kind\") attr k = \"a\" attr plain = 1 "
      "Lot --> X. "
      "style Low attr h = 2 attr k = \"b\" "
      "style Lower extends Low @Range(min=0, max=1) attr h = 1 @Group(\"Own\") attr plain = 2";
  const auto in = [&](const char* style) { return Analysed(text, {}, style); };
  const Analysed low = in("Low"), lower = in("Lower");
  const Annotations& h = low.attribute("h").annotations;
  EXPECT_EQ(h.group.path, std::vector<std::string>{"Size"});
  ASSERT_TRUE(h.range);
  EXPECT_EQ(h.range->max, 9);
  EXPECT_EQ(h.order, 3);
  EXPECT_EQ(low.attribute("k").annotations.choices->values.size(), 2u);
  EXPECT_EQ(low.attribute("k").annotations.description, "Kind");
  EXPECT_EQ(lower.attribute("h").annotations.range->max, 1);
  EXPECT_EQ(lower.attribute("h").annotations.group.path, std::vector<std::string>{"Size"});
  EXPECT_EQ(lower.attribute("k").annotations.group.path, std::vector<std::string>{"Look"});
  EXPECT_EQ(lower.attribute("plain").annotations.group.path, std::vector<std::string>{"Own"});
}

TEST(Analyse, slipsInAnnotationsAreFound) {
  EXPECT_EQ(Analysed("@Range(min=1, mx=2) attr a = 1").problems(),
            "1:15 bad-annotation (warning)\n");
  EXPECT_EQ(Analysed("@Range(Low=0, High=1) attr a = 1").problems(), "");
  const Analysed handle("@Handle(shpe=Lot, type=lnear, axis=y, other=3) attr a = 1");
  EXPECT_EQ(handle.problems(), "1:9 bad-annotation (warning)\n1:19 bad-annotation (warning)\n");
  EXPECT_EQ(handle.hint(0), "did you mean 'shape'?");
  EXPECT_EQ(handle.hint(1), "did you mean 'linear'?");
}

TEST(Analyse, annotationsBecomeData) {
  const Analysed a(R"(@RuleFileDescription("A house") version "2025.0"
@Group("Mass", "Roof", 2) @Order(3) @Range(min=-1, max=5.5, stepsize=0.5, restricted=false)
@Description("How high") @DisplayName("Height") @Distance attr h = 1
@Range(0, 10) @Percent attr p = 0
@Range("A", "B") attr old = "A" @Enum(1, 2, restricted=false) @Hidden attr e = 1
@Enum(valuesAttr=list) attr d = "x" @Group @Color attr c = "#ff" @File("png","jpg") attr f = ""
@StartRule @InPolygon Lot --> X.
@Decription("x") @Orders attr q = 1
@PreferredSize(4, 3.5, 0) Bay --> X. @PreferredSize(4) Bad --> X.
@Label("window") Window --> X. @Label(window) Door --> X.
@Hidden attr list = ["x"])");
  EXPECT_EQ(a.problems(),
            "8:1 unknown-annotation\n8:18 unknown-annotation\n"
            "9:38 bad-annotation (warning)\n10:32 bad-annotation (warning)\n");
  EXPECT_EQ(a.hint(0), "did you mean '@Description'?");
  EXPECT_EQ(a.program.description, "A house");
  const Annotations& h = a.attribute("h").annotations;
  EXPECT_EQ(h.group.path, (std::vector<std::string>{"Mass", "Roof"}));
  EXPECT_EQ(h.group.order, 2);
  EXPECT_EQ(h.order, 3);
  EXPECT_EQ(h.range->min, -1);
  EXPECT_EQ(h.range->max, 5.5);
  EXPECT_EQ(h.range->step, 0.5);
  EXPECT_FALSE(h.range->restricted);
  EXPECT_EQ(h.description, "How high");
  EXPECT_EQ(h.displayName, "Height");
  EXPECT_EQ(h.unit, UnitNote::Distance);
  const Annotations& p = a.attribute("p").annotations;
  EXPECT_EQ(p.range->max, 10);
  EXPECT_EQ(p.unit, UnitNote::Percent);
  EXPECT_EQ(p.group.path.size(), 2u);
  EXPECT_EQ(a.attribute("old").annotations.choices->values[1].text, "B");
  EXPECT_EQ(a.attribute("e").annotations.choices->values[1].number, 2);
  EXPECT_FALSE(a.attribute("e").annotations.choices->restricted);
  EXPECT_TRUE(a.attribute("e").annotations.hidden);
  const Analysed handles("@Handle(shape=Lot^2, slip={in, -1}) @Handle(type=toggle, 3) attr a = 1");
  EXPECT_EQ(handles.problems(), "1:58 bad-annotation (warning)\n");
  EXPECT_EQ(
      handles.attribute("a").annotations.handles,
      (std::vector<HandleNote>{{{"shape", "Lot^2"}, {"slip", "{in,-1}"}}, {{"type", "toggle"}}}));
  EXPECT_EQ(a.attribute("d").annotations.choices->valuesAttribute, "list");
  EXPECT_TRUE(a.attribute("c").annotations.color);
  EXPECT_TRUE(a.attribute("c").annotations.group.path.empty());
  EXPECT_EQ(a.attribute("f").annotations.extensions.size(), 2u);
  EXPECT_TRUE(a.rule("Lot").annotations.startRule);
  EXPECT_EQ(a.rule("Lot").annotations.input, InputNote::Polygon);
  EXPECT_EQ(*a.rule("Bay").annotations.preferredSize, (std::array<double, 3>{4, 3.5, 0}));
  EXPECT_FALSE(a.rule("Bad").annotations.preferredSize);
  EXPECT_EQ(a.rule("Window").annotations.label, "window");
  EXPECT_EQ(a.rule("Door").annotations.label, "");
}

TEST(Analyse, remediesAreEdits) {
  const auto mended = [](const char* text) { return Analysed(text).mended(); };
  // Of an operation the word alone, not its arguments and its block.
  EXPECT_EQ(mended("A --> splitt(x) { ~1 : B. }"), "A --> split(x) { ~1 : B. }");
  EXPECT_EQ(mended("attr height = 1\nA --> extrude(heigth) B."),
            "attr height = 1\nA --> extrude(height) B.");
  EXPECT_EQ(mended("A --> comp(f) { sides : B. }"), "A --> comp(f) { side : B. }");
  EXPECT_EQ(mended("A --> comp(f) { side : B. }*"), "A --> comp(f) { side : B. }");
  EXPECT_EQ(mended("A --> split(x) { ~1 = B. }"), "A --> split(x) { ~1 : B. }");
  EXPECT_EQ(mended("A --> split(x) { B. }"), "A --> split(x) { ~1 : B. }");
  EXPECT_EQ(mended("A -> B."), "A --> B.");
  EXPECT_EQ(mended("A --> B.;"), "A --> B.");
  EXPECT_EQ(mended("attr A --> B."), "A --> B.");
  EXPECT_EQ(mended("A --> case true : B."), "A --> case true : B. else : NIL");
  EXPECT_EQ(mended("A --> split(x) { 1 : B. 2 : C. }"), "A --> split(x) { 1 : B. | 2 : C. }");
  EXPECT_EQ(mended("@Rnge(0, 1)\nattr a = 1"), "@Range(0, 1)\nattr a = 1");
  // What has no remedy that is an edit stays as it is.
  EXPECT_EQ(mended("A --> extrude(1, 2, 3, 4, 5) B."), "A --> extrude(1, 2, 3, 4, 5) B.");
}

TEST(Analyse, remedyOfAnImportedNameKeepsTheImport) {
  const Analysed a("import i : \"i.cga\"\nA --> i.Walll", {{"i.cga", "Wall --> X."}});
  EXPECT_EQ(a.mended(), "import i : \"i.cga\"\nA --> i.Wall");
}

TEST(Analyse, hintsSayWhatTheWordIs) {
  EXPECT_EQ(Analysed("A --> if X.").hint(),
            "conditions are written 'case condition : ... else : ...'");
  EXPECT_EQ(Analysed("A --> if (1) X.").problems(), "1:7 unknown-operation\n");
  EXPECT_EQ(Analysed("w = extrude(1)").hint(),
            "it is an operation, and those stand in rules: 'Name --> extrude(...)'");
}

}  // namespace
}  // namespace gable::lang
