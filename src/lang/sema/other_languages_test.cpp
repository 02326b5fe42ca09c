// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Every word and sign of the table is told once, with its remedy, and what can be put in its place
// mends the file.

#include "lang/other_languages.h"

#include <gtest/gtest.h>

#include "lang/sema/testing_analysed.h"

namespace gable::lang {
namespace {

// Words that stand in a form of their own.
struct Form {
  std::string_view word;
  ForeignUse use;
  const char* text;
};
constexpr Form kForms[] = {
    {"//", ForeignUse::Operator, "attr a = (7 // 2)\nLot --> A."},
    {"?", ForeignUse::Operator, "attr a = 3\nattr b = a > 2 ? 10 : 5\nLot --> A."},
    {"+=", ForeignUse::Operator, "attr a = 3\nLot --> a += 1\nA --> B."},
    {"-=", ForeignUse::Operator, "attr a = 3\nLot --> A(1) a -= 2 * a\nA(b) --> B."},
    {"*=", ForeignUse::Operator, "attr a = 3\nLot --> [ a *= 2 ] A."},
    {"/=", ForeignUse::Operator, "attr a = 3\nLot --> a /= 2\n  A."},
    {":=", ForeignUse::Operator, "attr a = 3\nLot --> a := 4 A."},
    {"++", ForeignUse::Operator, "attr a = 3\nLot --> a++\n  A."},
    {"->", ForeignUse::Arrow, "Lot -> A."},
    {"=>", ForeignUse::Arrow, "Lot => A.\nB(n) => A."},
    {"==>", ForeignUse::Arrow, "Lot ==> A."},
    {"else if", ForeignUse::Branch,
     "attr a = 3\nLot --> case a == 1 : A. else if a == 2 : B. else : C."},
    {"from", ForeignUse::Declaration, "from parts import Window\nLot --> A."},
    {"include", ForeignUse::Declaration, "include \"a.cga\"\nLot --> A."},
    {"require", ForeignUse::Declaration, "require \"a.cga\"\nLot --> A."},
    {"using", ForeignUse::Declaration, "using \"a.cga\"\nLot --> A."},
    {"for", ForeignUse::Statement, "Lot -->\n  for i in range(3):\n    A(i)\n  B.\nA(i) --> C."},
    {"foreach", ForeignUse::Statement, "Lot --> foreach (i in 3) { A(i) } B.\nA(i) --> C."},
    {"while", ForeignUse::Statement, "attr a = 3\nLot --> while (a > 2) { A. } B."},
    {"return", ForeignUse::Statement, "Lot -->\n  return 3 * 4\nA --> B."},
    {"if", ForeignUse::Statement, "attr a = 3\nLot --> if (a > 2) { A. } else { B. }"},
    {"switch", ForeignUse::Statement,
     "attr a = 3\nLot --> switch (a) { case 1: A. break; default: B. }\nC --> D."},
};

std::string textFor(const ForeignWord& w) {
  for (const Form& f : kForms) {
    if (f.word == w.word && f.use == w.use) return f.text;
  }
  const std::string word(w.word);
  switch (w.use) {
    case ForeignUse::Operator:
      return "attr a = 3\nattr b = true\nLot --> case " +
             std::string(w.meant == TokenKind::And || w.meant == TokenKind::Or ? "b " : "a ") +
             word + (w.meant == TokenKind::And || w.meant == TokenKind::Or ? " b" : " 2") +
             (w.meant == TokenKind::Star || w.meant == TokenKind::Percent ? " > 1" : "") +
             " : A. else : B.";
    case ForeignUse::Branch:
      return w.instead == "case"
                 ? "attr a = 3\nLot --> case a == 1 : A. " + word + " a == 2 : B. else : C."
                 : "attr a = 3\nLot --> case a == 1 : A. " + word + " : B.";
    case ForeignUse::Declaration:
      return w.instead.empty() ? "Lot --> A.\n" + word + " f(x):\n    return x * 2\nB --> C."
                               : "Lot --> A.\n" + word + " x = 3\nB --> C.";
    case ForeignUse::Value: return "f(a) = " + word + "\nLot --> A.";
    case ForeignUse::Function: return "f(a) = " + word + "(a)\nLot --> A.";
    case ForeignUse::Operation: return "Lot --> " + word + "(1) A.";
    case ForeignUse::Selector: return "Lot --> comp(f) { " + word + " : A. }";
    default: return {};
  }
}

TEST(OtherLanguages, everyRowIsToldWithItsRemedy) {
  for (const ForeignWord& w : foreignWords()) {
    const std::string text = textFor(w);
    ASSERT_FALSE(text.empty()) << w.word << " needs a form";
    const Analysed a(text);
    const size_t expected = w.word == "=>" && w.use == ForeignUse::Arrow ? 2 : 1;
    ASSERT_EQ(a.diagnostics.all().size(), expected) << text << "\n" << a.messages();
    const std::string remedy = w.use == ForeignUse::Operation && !w.instead.empty()
                                   ? "'" + std::string(w.instead) + "'"
                                   : remedyOf(w);
    EXPECT_NE(a.hint().find(remedy), std::string::npos) << text << "\n" << a.messages();
  }
}

TEST(OtherLanguages, whatStandsInTheirPlaceMendsTheFile) {
  for (const ForeignWord& w : foreignWords()) {
    const bool functions = w.use == ForeignUse::Function || w.use == ForeignUse::Operation;
    if (w.instead.empty() || functions) continue;
    const Analysed a(textFor(w));
    EXPECT_EQ(Analysed(a.mended()).messages(), "") << a.mended();
  }
}

TEST(OtherLanguages, choicesInBracesAreOneMistake) {
  const char* const kHead = "attr a = 3\nattr b = 2\n";
  const std::pair<const char*, const char*> kChoices[] = {
      {"Lot --> if (a > 2) { A. } else { B. }", "Lot --> case (a > 2) : A. else : B."},
      {"Lot --> if (a > 2) { A. B. }", "Lot --> case (a > 2) : A. B. else : NIL"},
      {"Lot --> if a > 2 { A. } else if (a > 1) { } else { B. }",
       "Lot --> case a > 2 : A. case (a > 1) : NIL else : B."},
      {"Lot --> case a > 2 { A. } else { B. }", "Lot --> case a > 2 : A. else : B."},
      {"Lot --> if (a > 2) {\n  A.\n} elif (b > 2) {\n  B.\n}\nC --> D.",
       "Lot --> case (a > 2) : A. case (b > 2) : B. else : NIL\nC --> D."},
      {"f(x) = if (x > 2) { 1 } else { 2 }\nLot --> A.",
       "f(x) = case (x > 2) : 1 else : 2\nLot --> A."},
      {"f(x) = if x > 2 : 1 else : 2\nLot --> A.", "f(x) = case x > 2 : 1 else : 2\nLot --> A."},
  };
  for (const auto& [wrong, right] : kChoices) {
    const Analysed a(std::string(kHead) + wrong);
    EXPECT_EQ(a.diagnostics.all().size(), 1u) << wrong << "\n" << a.messages();
    EXPECT_EQ(a.mended(), std::string(kHead) + right);
    EXPECT_EQ(Analysed(a.mended()).messages(), "");
  }
}

TEST(OtherLanguages, arrowsBehindSelectorsAreColons) {
  for (const char* const arrow : {"=>", "->", "-->"}) {
    const std::string sign(arrow);
    const Analysed a("Lot --> comp(f) { side " + sign + " Wall. | top " + sign +
                     " Roof. }\nA --> B.");
    EXPECT_EQ(a.problems(), "1:24 unexpected-token\n1:" + std::to_string(37 + sign.size()) +
                                " unexpected-token\n")
        << a.messages();
    EXPECT_EQ(a.mended(), "Lot --> comp(f) { side : Wall. | top : Roof. }\nA --> B.");
    const Analysed sizes("Lot --> split(x) { 3 " + sign + " A. | ~1 " + sign + " B. }");
    EXPECT_EQ(sizes.mended(), "Lot --> split(x) { 3 : A. | ~1 : B. }") << sizes.messages();
  }
  // A brace that is not closed before the next rule is another mistake.
  const Analysed open("Lot --> split(x) { 3 : A. |\nB --> C.");
  EXPECT_EQ(open.problems(), "1:18 unclosed-block\n") << open.messages();
}

TEST(OtherLanguages, declarationsWithinRulesAreTold) {
  for (const char* const text :
       {"Lot --> const a = 3 A(a)\nA(x) --> B.", "Lot -->\n  const a = 3\n  A(a)\nA(x) --> B.",
        "Lot --> a = 3 A(a)\nA(x) --> B.", "Lot --> attr a = 3 [ A(a) ] A(2)\nA(x) --> B."}) {
    const Analysed a(text);
    EXPECT_EQ(a.diagnostics.all().size(), 1u) << a.messages();
    EXPECT_NE(a.hint().find("'Rule with (a := value) --> ...'"), std::string::npos) << a.messages();
  }
}

TEST(OtherLanguages, wordsThatAFileDeclaresAreItsOwn) {
  const Analysed a(
      "attr is = 3\nattr b = 2\nLot --> for while(2) return def Mod\nfor --> A.\nwhile(n) --> A.\n"
      "return --> A.\ndef --> A.\nMod --> A.\nrule --> A.\nlet --> rule Mod\n");
  EXPECT_EQ(a.messages(), "");
}

TEST(OtherLanguages, modulesOfOtherLanguagesAreLeftOut) {
  const Analysed a("f(x) = Math.sqrt(x) + math.pi + np.round(x)\nLot --> A.");
  EXPECT_EQ(a.problems(), "1:8 unknown-function\n1:23 unknown-name\n1:33 unknown-function\n")
      << a.messages();
}

}  // namespace
}  // namespace gable::lang
