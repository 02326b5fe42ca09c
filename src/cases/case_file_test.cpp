// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "cases/case_file.h"

#include <gtest/gtest.h>

namespace gable::cases {
namespace {

constexpr const char* kTwoCases = R"(# A comment.
== first
rule:
  Lot -->
    extrude(10)

    A
shape: lot 4x5
file walls.cga:
  W --> B
expect:
  leaves A 1
  # not a statement
  print "two words" 3
  dump
    A
      face

== second
values:
  1 = 1
)";

TEST(CaseFile, readsCasesAndSections) {
  const CaseFile file = parseCases(kTwoCases);
  ASSERT_TRUE(file.errors.empty());
  ASSERT_EQ(file.cases.size(), 2u);
  EXPECT_EQ(file.cases[0].name, "first");
  EXPECT_EQ(file.cases[0].textOf("rule"), "Lot -->\n  extrude(10)\n\n  A\n");
  EXPECT_EQ(file.cases[0].textOf("shape"), "lot 4x5\n");
  EXPECT_EQ(file.cases[0].find("file")->argument, "walls.cga");
  EXPECT_EQ(file.cases[0].find("rule")->textLine, 4u);
  EXPECT_EQ(file.cases[1].textOf("values"), "1 = 1\n");
  EXPECT_EQ(file.cases[1].find("rule"), nullptr);
}

TEST(CaseFile, splitsStatements) {
  const CaseFile file = parseCases(kTwoCases);
  const std::vector<Statement> list = statements(*file.cases[0].find("expect"));
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].words, (std::vector<std::string>{"leaves", "A", "1"}));
  EXPECT_EQ(list[1].words, (std::vector<std::string>{"print", "two words", "3"}));
  EXPECT_EQ(list[1].line, 14u);
  EXPECT_EQ(list[2].block, "  A\n    face\n");
}

TEST(CaseFile, isNoneOfCases) {
  for (const char* text : {"", "rule:\n  A --> B\n", "  text\n"}) {
    const CaseFile file = parseCases(text);
    EXPECT_FALSE(file.errors.empty()) << text;
    EXPECT_TRUE(file.cases.empty()) << text;
  }
}

TEST(CaseFile, aMistakeIsThatOfItsCase) {
  for (const char* wrong : {"rulez:\n  A --> B\n", "  text\n", "rule: A\nrule: B\n"}) {
    const CaseFile file =
        parseCases("== a\nrule: A --> B\n== b\n" + std::string(wrong) + "== c\nrule: A --> B\n");
    EXPECT_TRUE(file.errors.empty()) << wrong;
    ASSERT_EQ(file.cases.size(), 3u) << wrong;
    EXPECT_TRUE(file.cases[0].errors.empty()) << wrong;
    ASSERT_EQ(file.cases[1].errors.size(), 1u) << wrong;
    EXPECT_GE(file.cases[1].errors[0].line, 4u) << wrong;
    EXPECT_TRUE(file.cases[2].errors.empty()) << wrong;
  }
  const CaseFile twice = parseCases("== a\nrule: A\n== a\nrule: B\n");
  ASSERT_EQ(twice.cases.size(), 2u);
  EXPECT_TRUE(twice.cases[0].errors.empty());
  EXPECT_EQ(twice.cases[1].errors.size(), 1u);
}

TEST(CaseFile, linesThatAreIndentedFurtherAreNotLost) {
  const CaseFile file =
      parseCases("== a\nrule:\n  A --> B\nexpect:\n  leaves 1\n    volume 7\n  dump\n    B\n");
  ASSERT_EQ(file.cases.size(), 1u);
  const std::vector<Statement> list = statements(*file.cases[0].find("expect"));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NE(strayLines(list[0]).find("'leaves'"), std::string::npos);
}

}  // namespace
}  // namespace gable::cases
