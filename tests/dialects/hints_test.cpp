// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Hints of `check` and `generate` speak the notation of the file: none names an operation, a
// function or a keyword of Gable's own language that the notation does not have.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "gable/gable.h"

namespace gable {
namespace {

struct Mistake {
  const char* path;
  const char* text;
};

constexpr Mistake kMistakes[] = {
    {"a.park", "PathWidth = foo\nLot -> GRAVEL\n"},
    {"a.park", "Lot -> case (foo == 1): A else: A\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, 2 {foo}) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, 2 {3 a[foo, 2]}) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, 2, sliver=foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, 2, pattern=foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Grid(2, 2) { A } { B } { Romb(foo) C }\nA -> LAWN\n"},
    {"a.park", "Lot -> A(foo)\nA(x) -> Contract(x) LAWN\n"},
    {"a.park", "Lot -> A(3, 4)\nA(x) -> Contract(x) LAWN\n"},
    {"a.park", "Lot -> Peel(index(foo), 1) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Peel(foo(3), 1) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Peel(OUTER, 1) { foo: A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Peel(OUTER, 1, foo=3) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Sweep(OUTER, width=foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Sweep(OUTER, width=1, profile=foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Voronoi(foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Voronoi(5 {foo}) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> CastRays(foo, Corners(Region)) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> CastRays(CENTRE [foo], Corners(Region)) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> CastRays(CENTRE, foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Place(foo) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Place((foo, 1)) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Distribute(OUTER: foo, 3) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Distribute(OUTER, [foo]) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Parametrise([0, foo]) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Scatter(3 {foo}) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> Color(foo)\n"},
    {"a.park", "Lot -> Texture(foo)\n"},
    {"a.park", "Lot -> Circle(foo) LAWN\n"},
    {"a.park", "Lot -> extrude(3) comp(f) { A }\n"},
    {"a.park", "Lot -> A\nA -> A\n"},
    {"a.park", "Lot -> Grid(40, 40, minarea=15) { A }\nA -> LAWN\n"},
    {"a.park", "Lot -> LAWN Scatter(0 {900}) { Circle(1) A }\nA -> GRAVEL\n"},
    {"a.park", "Lot -> Contract(900) LAWN\n"},
    {"a.park", ""},
    {"a.gbbg", "axiom START size (4, 4, 4)\nterminal A\nSTART -> Repeat(X) {foo}\n"},
    {"a.gbbg", "axiom START size (4, 4, 4)\nSTART -> Repeat(X) {START}\n"},
    {"a.gbbg", "axiom START size (foo, 4, 4)\nterminal A\nSTART -> Repeat(Q) {A}\n"},
    {"a.gbbg", "axiom START size (4, 4, 4)\nterminal A\nSTART -> Splt(X, {1}) {A | A}\n"},
    {"a.gbbg", "axiom START size (4, 4, 4)\nterminal A\nSTART -> Component(Y, foo) {A}\n"},
    {"a.gbbg", "axiom FOO size (4, 4, 4)\nterminal A\nSTART -> Repeat(X) {A}\n"},
    {"a.gbbg", ""},
    {"a.grammar", "START -> S ( foo 1 1 ) I ( Cube x )\n"},
    {"a.grammar", "START -> Foo I ( Cbe 0 )\n"},
    {"a.grammar", "START -> START\n"},
    {"a.grammar", "START -> A ( 90 3 ) foo ( 3 ) I ( Cube 0 )\n"},
    {"a.grammar", ""},
    {"a.pg3d", "START -> S ( foo 1 1 ) I ( Cube x )\n"},
    {"a.pg3d", "START(a) -> ?( foo > 1 ) { I ( CubeZ 0 ) } DSX ( foo 1 1 )\n"},
    {"a.pg3d", "START -> START\n"},
    {"a.pg3d", ""},
};

DiagnosticList toldOf(const Mistake& m) {
  const Rules rules = Rules::parse(m.text, m.path);
  DiagnosticList out = rules.diagnostics();
  if (!rules.ok()) return out;
  DeriveSettings settings;
  settings.jobs = 1;
  settings.limits.seconds = 20;
  const DiagnosticList made = derive(rules, Shapes::lot(20, 20), settings).diagnostics();
  out.insert(out.end(), made.begin(), made.end());
  return out;
}

TEST(Hints, SpeakTheNotationOfTheFile) {
  for (const Mistake& m : kMistakes) {
    const Dialect* dialect = dialectOfPath(m.path);
    const DiagnosticList told = toldOf(m);
    EXPECT_FALSE(told.empty()) << m.path << "\n" << m.text;
    for (const Diagnostic& d : told) {
      EXPECT_FALSE(namesForeignWord(*dialect, d.hint, builtinCatalogue())) << m.path << "\n"
                                                                           << m.text << render({d});
      for (const char* word : {"'attr'", "'const'", "-->", "otherwise :", "comp(", "'case c"}) {
        EXPECT_EQ(d.hint.find(word), d.hint.npos) << m.text << render({d});
      }
    }
  }
}

TEST(Hints, ColoursAreMended) {
  const Rules rules = Rules::parse(
      "Lot --> color(\"#ff00\") color(\"#f80\") color(\"ff8800\") color(\"blue\") X.\n", "a.cga");
  const DiagnosticList& told = rules.diagnostics();
  ASSERT_EQ(told.size(), 4u);
  const char* const mended[] = {"#ffff0000", "#ff8800", "#ff8800"};
  for (size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(told[i].fix) << i;
    EXPECT_EQ(told[i].fix->text, mended[i]);
  }
  EXPECT_FALSE(told[3].fix);
}

// What follows from a mistake is not told beside it.
TEST(Hints, OneErrorAPlace) {
  for (const Mistake& m : kMistakes) {
    std::set<std::pair<uint32_t, uint32_t>> places;
    for (const Diagnostic& d : toldOf(m)) {
      if (!d.isError() || !d.range) continue;
      EXPECT_TRUE(places.insert({d.range->line, d.range->column}).second) << m.text << render({d});
    }
  }
}

TEST(Hints, UnknownNamesOfParksAreTold) {
  const Rules rules = Rules::parse("Lot -> Grid(2, foo) { A }\nA -> LAWN\n", "a.park");
  ASSERT_EQ(rules.diagnostics().size(), 1u);
  EXPECT_EQ(rules.diagnostics()[0].code, "bad-expression");
  EXPECT_EQ(rules.diagnostics()[0].hint,
            "write numbers, constants, w, h, area, ix, iy, nx, ny, bx, by, border");
}

// Every text in the sources that a hint might be and that names a word of Gable's own language.
TEST(Hints, NoneOfThoseOfTheLanguageIsTakenOver) {
  const std::filesystem::path source = std::filesystem::path(GABLE_SOURCE_DIR) / "src";
  const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re");
  std::set<std::string> hints;
  for (const char* folder : {"lang/sema", "lang/compile", "builtins", "runtime"}) {
    for (const auto& file : std::filesystem::recursive_directory_iterator(source / folder)) {
      if (file.path().extension() != ".cpp") continue;
      std::ifstream in(file.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      for (std::sregex_iterator m(text.begin(), text.end(), literal), end; m != end; ++m) {
        const std::string one = (*m)[1];
        if (one.find(' ') != one.npos) hints.insert(one);
      }
    }
  }
  for (const Dialect* dialect : dialects()) {
    size_t foreign = 0;
    EXPECT_NE(std::string(dialect->guide), "");
    for (const std::string& hint : hints) {
      if (!namesForeignWord(*dialect, hint, builtinCatalogue())) continue;
      ++foreign;
      Diagnostics made;
      made.warning("a-code", {}, "a message", hint);
      const Diagnostics told = inWordsOf(dialect, made, builtinCatalogue());
      EXPECT_EQ(told.all()[0].hint, dialect->guide) << hint;
    }
    // The search finds them: the language's own hints are full of its words.
    EXPECT_GT(foreign, 100u) << dialect->name;
    for (const Remedy& r : dialect->remedies) {
      EXPECT_FALSE(namesForeignWord(*dialect, r.hint, builtinCatalogue())) << r.hint;
    }
    EXPECT_FALSE(namesForeignWord(*dialect, dialect->guide, builtinCatalogue()));
  }
  for (const char* hint : {"declare it with 'attr' or 'const', or put it in quotes",
                           "add 'A --> ...'", "write otherwise : ...", "take it apart: comp(f)"}) {
    EXPECT_TRUE(namesForeignWord(*dialectNamed("park"), hint, builtinCatalogue())) << hint;
  }
}

}  // namespace
}  // namespace gable
