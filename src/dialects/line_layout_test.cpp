// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/line_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gable {
namespace {

std::string even(std::string_view text) { return withLaidOutLines(text, SignSpacing::Even); }
std::string asWritten(std::string_view text) {
  return withLaidOutLines(text, SignSpacing::AsWritten);
}

std::string signsOf(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
  return text;
}

TEST(LineLayout, signsOfParkGrammarsHaveEvenBlanks) {
  EXPECT_EQ(even("A->Grid(2 ,2){B|C}\n"), "A -> Grid(2, 2){B | C}\n");
  EXPECT_EQ(even("A  ->   B\t|  C"), "A -> B | C\n");
  EXPECT_EQ(even("A -> case (a||b): B"), "A -> case (a || b): B\n");
}

TEST(LineLayout, blanksOfProGen3dKeepTheirMeaning) {
  EXPECT_EQ(asWritten("A -> S ( w -1 h-1 )   I ( Cube )\n"), "A -> S ( w -1 h-1 ) I ( Cube )\n");
  EXPECT_EQ(asWritten("A->B|C"), "A->B|C\n");
}

TEST(LineLayout, bracketsIndent) {
  EXPECT_EQ(even("A -> Grid(2, 2) {\nB\n     | C(1,\n2)\n}\nB -> C\n"),
            "A -> Grid(2, 2) {\n  B\n  | C(1,\n    2)\n}\nB -> C\n");
  EXPECT_EQ(even("A ->\n\tcase (x): B\n        else: C"), "A ->\n  case (x): B\n  else: C\n");
}

TEST(LineLayout, commentsAndTextsStayAsTheyAre) {
  EXPECT_EQ(even("A -> B    // both,here|there\n/* one\n     two  \n three */  C -> D\n"),
            "A -> B    // both,here|there\n/* one\n     two\n three */  C -> D\n");
  EXPECT_EQ(even("A -> Model(\"a,b|c  d\")\n# x,y"), "A -> Model(\"a,b|c  d\")\n# x,y\n");
}

TEST(LineLayout, emptyLinesAreOne) {
  EXPECT_EQ(even("\n\nA -> B\r\n\r\n\r\n\r\nB -> C\r\n\n\n"), "A -> B\n\nB -> C\n");
  EXPECT_EQ(even(""), "");
  EXPECT_EQ(even(" \n\t\n"), "");
}

TEST(LineLayout, garbageKeepsItsSignsAndIsLaidOutOnce) {
  const char* const pieces[] = {"{",    "}",  "(",  ")",  "[",  "]",    "|",  ",",  "->",
                                "\"",   "/*", "*/", "//", "#",  " ",    "  ", "\t", "\n",
                                "\n\n", "A",  "b1", "-1", "||", "\r\n", "é"};
  std::mt19937 chance(1);
  for (int n = 0; n < 3000; ++n) {
    std::string text;
    for (int k = 0; k < 30; ++k) text += pieces[chance() % std::size(pieces)];
    for (const SignSpacing spacing : {SignSpacing::Even, SignSpacing::AsWritten}) {
      const std::string once = withLaidOutLines(text, spacing);
      EXPECT_EQ(signsOf(once), signsOf(text));
      EXPECT_EQ(withLaidOutLines(once, spacing), once) << text;
    }
  }
}

}  // namespace
}  // namespace gable
